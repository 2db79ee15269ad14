// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Off_header.h"

namespace hlscm {
namespace off {

std::optional<Keyword> to_keyword(std::string_view word)
{
  Keyword keyword;
  for(const std::string_view prefix : {"ST", "C", "N", "4", "n"}) {
    if(word.substr(0, prefix.size()) == prefix) {
      keyword.prefix += prefix;
      word.remove_prefix(prefix.size());
    }
  }
  if(word.substr(0, 3) != "OFF") {
    return std::nullopt;
  }
  keyword.behind_it = word.substr(3);
  const bool is_number = keyword.behind_it.empty() || to_integer(keyword.behind_it);
  return is_number ? std::optional(keyword) : std::nullopt;
}

namespace {

// The counts may stand without the keyword: two or three whole numbers alone in their line.
bool is_line_of_counts(Text_scanner& scanner, std::string_view first)
{
  bool is_good = to_integer(first).has_value();
  std::size_t words = 1;
  for(; is_good && !scanner.is_line_done(); ++words) {
    is_good = scanner.integer().has_value();
  }
  return is_good && (words == 2 || words == 3);
}

// Goes to the keyword, past words in front of it; nothing if there is none.
std::optional<Keyword> find_keyword(Text_scanner& scanner)
{
  constexpr std::size_t most_lines = 64; // before the keyword
  for(std::size_t line = 0; line < most_lines && scanner.next_content_line(); ++line) {
    while(!scanner.is_line_done()) {
      if(const auto keyword = to_keyword(scanner.word())) {
        return keyword;
      }
    }
  }
  return std::nullopt;
}

std::optional<Keyword> read_keyword(const Mesh_source& source, Text_scanner& scanner,
                                    std::vector<std::string>& warnings)
{
  Text_scanner first(source.begin, source.end);
  const std::string_view word = first.next_content_line() ? first.word() : std::string_view();
  const bool is_first = to_keyword(word).has_value();
  if(!is_first && is_line_of_counts(first, word)) {
    warnings.push_back("the word OFF is missing; the file is read as if it was there");
    return std::nullopt;
  }
  const auto keyword = find_keyword(scanner);
  if(!keyword) {
    source.fail("it does not begin with the word OFF, the file is damaged or of another format: "
                "export it again");
  }
  if(!is_first) {
    warnings.push_back("what stands before the word OFF in line "
                       + std::to_string(scanner.line_number()) + " is left out");
  }
  if(keyword->prefix.find_first_of("4n") != std::string::npos) {
    source.fail(keyword->prefix
                + "OFF files have homogeneous or n-dimensional points, convert to plain OFF");
  }
  return keyword;
}

} // namespace

Header read_header(const Mesh_source& source, Text_scanner& scanner)
{
  Header header{};
  const auto keyword = read_keyword(source, scanner, header.warnings);
  header.is_plain = !keyword || keyword->prefix.empty();
  header.has_uv = keyword && keyword->prefix.find("ST") != std::string::npos;
  std::string_view first = keyword ? keyword->behind_it : std::string_view();
  if(first.empty()) {
    if(scanner.is_line_done() && !scanner.next_content_line()) {
      source.fail("the file ends after the word OFF, it is cut short: copy or export it again");
    }
    first = scanner.word();
  }
  if(first == "BINARY") {
    source.fail("binary OFF is not supported, convert the mesh to text OFF or to PLY");
  }
  const auto vertices = to_integer(first);
  const auto faces = scanner.integer();
  if(!vertices || !faces || *vertices < 0 || *faces < 0) {
    source.fail("line " + std::to_string(scanner.line_number())
                + " should hold the numbers of vertices and faces, the file is damaged: export it "
                  "again");
  }
  source.check_count("vertices", std::size_t(*vertices), 6); // "0 0 0\n"
  source.check_count("faces", std::size_t(*faces), 2);       // "0\n"
  header.vertices = std::size_t(*vertices);
  header.faces = std::size_t(*faces);
  scanner.word(); // the number of edges, if it is there
  return header;
}

} // namespace off
} // namespace hlscm
