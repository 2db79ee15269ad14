// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_source.h"
#include "formats/Obj_corner.h"
#include "formats/Text_scanner.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

namespace hlscm {

namespace {

/// Lines that are left out, by their first words.
class Lines_left_out
{
public:
  void add(std::string_view keyword, std::size_t line)
  {
    Found& found = m_lines.emplace(keyword, Found{0, line}).first->second;
    ++found.count;
  }

  void warn(std::vector<std::string>& warnings) const
  {
    constexpr std::size_t most_words = 5;
    std::string text = "lines that begin with words unknown here are left out:";
    std::size_t words = 0;
    for(const auto& [keyword, found] : m_lines) {
      if(words++ < most_words) {
        text += (words > 1 ? ", " : " ") + std::to_string(found.count) + " with "
                + printable(keyword) + " (the first in line " + std::to_string(found.first_line)
                + ")";
      }
    }
    if(words > most_words) {
      text += " and " + std::to_string(words - most_words) + " further words";
    }
    if(words > 0) {
      warnings.push_back(text);
    }
  }

private:
  struct Found
  {
    std::size_t count;
    std::size_t first_line;
  };

  static std::string printable(const std::string& keyword)
  {
    constexpr std::size_t longest = 20;
    std::string text = keyword.substr(0, longest);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text + (keyword.size() > longest ? "..." : "");
  }

  std::map<std::string, Found, std::less<>> m_lines;
};

/// Reads line after line.
class Obj_reader
{
public:
  explicit Obj_reader(const Mesh_source& source)
    : m_source(source), m_scanner(source.begin, source.end)
  {}

  Read_mesh read()
  {
    for(std::size_t line = 0; m_scanner.next_continued_line(); ++line) {
      m_source.advance(m_scanner.line_end(), line);
      read_line(m_scanner.word());
    }
    check_corners();
    check_corner_data(m_mesh);
    add_warnings();
    return std::move(m_mesh);
  }

private:
  void read_line(std::string_view keyword)
  {
    Polygon_soup& soup = m_mesh.soup;
    if(keyword == "v") {
      soup.points.push_back(read_point("the coordinates of vertex ", soup.points.size()));
      m_has_more_than_points = m_has_more_than_points || !m_scanner.is_line_done();
    } else if(keyword == "f" || keyword == "fo") {
      read_face();
    } else if(keyword == "vt") {
      read_uv();
    } else if(keyword == "vn") {
      m_mesh.normals.push_back(read_point("the coordinates of normal ", m_mesh.normals.size()));
    } else if(keyword == "g" || keyword == "o" || keyword == "s" || keyword == "usemtl"
              || keyword == "mtllib")
    {
      const std::string text(keyword), rest(m_scanner.rest());
      m_mesh.lines.push_back({soup.number_of_faces(), rest.empty() ? text : text + " " + rest});
    } else if(keyword == "l") {
      ++m_lines;
    } else if(keyword == "p") {
      ++m_points;
    } else {
      m_left_out.add(keyword, m_scanner.line_number());
    }
  }

  [[noreturn]] void fail_at_line(const std::string& should_hold, std::size_t number) const
  {
    m_source.fail("line " + std::to_string(m_scanner.line_number()) + " should hold " + should_hold
                  + std::to_string(number) + ", the file is cut short or damaged: export it again");
  }

  Polygon_soup::Point_3 read_point(const char* what, std::size_t number)
  {
    const auto x = m_scanner.number(), y = m_scanner.number(), z = m_scanner.number();
    if(!x || !y || !z) {
      fail_at_line(what, number);
    }
    return {*x, *y, *z};
  }

  void read_uv()
  {
    const auto u = m_scanner.number();
    const auto v = m_scanner.is_line_done() ? std::optional<double>(0.) : m_scanner.number();
    if(!u || !v) {
      fail_at_line("texture coordinate ", m_mesh.soup.uv.size());
    }
    m_mesh.soup.uv.emplace_back(*u, *v);
  }

  void read_face()
  {
    Polygon_soup& soup = m_mesh.soup;
    m_source.check_index("corners", soup.corners.size());
    while(!m_scanner.is_line_done()) {
      Corner corner;
      if(!corner.read(m_scanner.word())) {
        fail_at_line("the corners of face ", soup.number_of_faces());
      }
      soup.corners.push_back(absolute(corner.indices[0], soup.points.size()));
      if(corner.indices[1] != 0) {
        soup.uv_corners.push_back(absolute(corner.indices[1], soup.uv.size()));
      }
      if(corner.indices[2] != 0) {
        m_mesh.normal_corners.push_back(absolute(corner.indices[2], m_mesh.normals.size()));
      }
    }
    soup.close_face();
  }

  // A face may come before its vertices, hence at the end.
  void check_corners() const
  {
    const Polygon_soup& soup = m_mesh.soup;
    const auto bad = std::find_if(soup.corners.begin(), soup.corners.end(),
                                  [&](std::uint32_t v) { return v >= soup.points.size(); });
    if(bad != soup.corners.end()) {
      const auto after = std::upper_bound(soup.first_corner.begin(), soup.first_corner.end(),
                                          std::uint32_t(bad - soup.corners.begin()));
      const std::size_t face = std::size_t(after - soup.first_corner.begin()) - 1;
      m_source.fail("face " + std::to_string(face) + " in line " + std::to_string(line_of(face))
                    + " names a vertex that is not among the "
                    + std::to_string(soup.number_of_vertices())
                    + " vertices, the file is cut short or damaged: export it again");
    }
  }

  std::size_t line_of(std::size_t face) const
  {
    Text_scanner scanner(m_source.begin, m_source.end);
    for(std::size_t faces = 0; faces <= face && scanner.next_continued_line();) {
      const std::string_view keyword = scanner.word();
      faces += keyword == "f" || keyword == "fo";
    }
    return scanner.line_number();
  }

  void add_warnings()
  {
    m_source.warn_of_open_end(m_mesh);
    if(m_has_more_than_points) {
      m_mesh.warnings.push_back("numbers behind the coordinates of vertices (colours, weights) "
                                "are left out");
    }
    if(m_lines > 0) {
      m_mesh.warnings.push_back("line elements (l) are left out: " + std::to_string(m_lines));
    }
    if(m_points > 0) {
      m_mesh.warnings.push_back("point elements (p) are left out: " + std::to_string(m_points));
    }
    m_left_out.warn(m_mesh.warnings);
  }

  const Mesh_source& m_source;
  Text_scanner m_scanner;
  Read_mesh m_mesh;
  bool m_has_more_than_points = false;
  std::size_t m_lines = 0, m_points = 0; // elements
  Lines_left_out m_left_out;
};

} // namespace

Read_mesh read_obj(const Mesh_source& source)
{
  const void* zero = std::memchr(source.begin, '\0', source.size());
  if(zero != nullptr) {
    source.fail("byte " + std::to_string(static_cast<const char*>(zero) - source.begin)
                + " is zero, this is no OBJ text, the file is damaged or of another format: "
                  "export it again");
  }
  return Obj_reader(source).read();
}

} // namespace hlscm
