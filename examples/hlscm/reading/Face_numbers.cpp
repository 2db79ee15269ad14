// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/Face_numbers.h"

#include "common/Program_error.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <utility>

namespace hlscm {

namespace {

// `contents`: what the file should have; `kind`: what its numbers should be.
std::vector<double> read_numbers(const std::string& name, double least, const char* contents,
                                 const char* kind)
{
  std::ifstream file(name);
  if(!file) {
    throw Program_error(name, std::string("cannot be opened, give a file with ") + contents);
  }
  std::vector<double> numbers;
  for(std::string word; file >> word;) {
    double number = 0;
    const auto end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, number);
    if(result.ec != std::errc() || result.ptr != end || !std::isfinite(number) || number < least) {
      throw Program_error(name, "its word " + std::to_string(numbers.size() + 1)
                                    + " is not " + kind + ": " + word.substr(0, 20));
    }
    numbers.push_back(number);
  }
  return numbers;
}

bool begins_with(const std::string& text, const std::string& keyword)
{
  return text == keyword || text.rfind(keyword + " ", 0) == 0;
}

// What a line says after its keyword.
std::string name_in(const std::string& line)
{
  const std::size_t first = line.find_first_not_of(' ', line.find(' '));
  return first == std::string::npos
             ? std::string()
             : line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
}

} // namespace

std::vector<double> read_face_numbers(const std::string& name, const Input_surface& surface,
                                      const std::string& input)
{
  const std::vector<double> of_faces
      = read_numbers(name, 0, "a number for each face", "a number of 0 or more");
  const std::size_t faces = surface.file.soup.number_of_faces();
  if(of_faces.size() != faces) {
    throw Program_error(name, "it has " + std::to_string(of_faces.size()) + " numbers, but " + input
                                  + " has " + std::to_string(faces)
                                  + " faces, give one for each of them");
  }
  std::vector<double> result;
  for(const std::uint32_t face : surface.surface.face) {
    result.push_back(of_faces[face]);
  }
  return result;
}

std::vector<CGAL::Simple_cartesian<double>::Point_2> read_points(const std::string& name)
{
  const std::vector<double> numbers
      = read_numbers(name, std::numeric_limits<double>::lowest(), "two numbers for each point", "a number");
  if(numbers.size() % 2 != 0) {
    throw Program_error(name, "it has " + std::to_string(numbers.size())
                                  + " numbers, give two for each point");
  }
  std::vector<CGAL::Simple_cartesian<double>::Point_2> points;
  for(std::size_t i = 0; i < numbers.size(); i += 2) {
    points.emplace_back(numbers[i], numbers[i + 1]);
  }
  return points;
}

Named_parts parts_of_surface(const Input_surface& surface, Name_of_part name)
{
  const std::string keyword = name == Name_of_part::MATERIAL ? "usemtl" : "g";
  std::map<std::pair<std::string, std::string>, std::uint32_t> numbers;
  std::string object, part;
  Named_parts result;
  auto line = surface.file.lines.begin();
  for(const std::uint32_t face : surface.surface.face) { // ascending
    for(; line != surface.file.lines.end() && line->face <= face; ++line) {
      if(begins_with(line->text, keyword)) {
        part = name_in(line->text);
      } else if(name == Name_of_part::GROUP && begins_with(line->text, "o")) {
        object = name_in(line->text);
      }
    }
    const auto added = numbers.insert({{object, part}, std::uint32_t(numbers.size())});
    result.of_triangles.push_back(added.first->second);
    if(added.second) {
      result.names.push_back(object + (object.empty() || part.empty() ? "" : "/") + part);
    }
  }
  return result.names == std::vector<std::string>{""} ? Named_parts() : result;
}

} // namespace hlscm
