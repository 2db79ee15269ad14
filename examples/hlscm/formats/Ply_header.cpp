// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Ply_header.h"

#include "formats/Text_scanner.h"

#include <algorithm>

namespace hlscm {
namespace ply {

std::size_t size_of(Type type)
{
  static const std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[std::size_t(type)];
}

std::size_t Element::index_of(std::initializer_list<const char*> names) const
{
  const auto found = std::find_if(properties.begin(), properties.end(), [&](const Property& p) {
    return std::find(names.begin(), names.end(), p.name) != names.end();
  });
  return std::size_t(found - properties.begin());
}

namespace {

std::optional<Type> to_type(std::string_view word)
{
  static const std::pair<const char*, Type> names[] = {
      {"char", Type::INT8},      {"uchar", Type::UINT8},    {"short", Type::INT16},
      {"ushort", Type::UINT16},  {"int", Type::INT32},      {"uint", Type::UINT32},
      {"float", Type::FLOAT32},  {"double", Type::FLOAT64}, {"int8", Type::INT8},
      {"uint8", Type::UINT8},    {"int16", Type::INT16},    {"uint16", Type::UINT16},
      {"int32", Type::INT32},    {"uint32", Type::UINT32},  {"float32", Type::FLOAT32},
      {"float64", Type::FLOAT64}};
  for(const auto& [name, type] : names) {
    if(word == name) {
      return type;
    }
  }
  return std::nullopt;
}

std::optional<Encoding> to_encoding(std::string_view word)
{
  return word == "ascii"                  ? std::optional(Encoding::TEXT)
         : word == "binary_little_endian" ? std::optional(Encoding::LITTLE_ENDIAN_BINARY)
         : word == "binary_big_endian"    ? std::optional(Encoding::BIG_ENDIAN_BINARY)
                                          : std::nullopt;
}

std::optional<Property> read_property(Text_scanner& scanner)
{
  std::string_view word = scanner.word();
  std::optional<Type> list_size;
  if(word == "list") {
    list_size = to_type(scanner.word());
    word = list_size ? scanner.word() : std::string_view();
  }
  const std::optional<Type> type = to_type(word);
  const std::string name(scanner.word());
  return type && !name.empty() ? std::optional(Property{name, *type, list_size}) : std::nullopt;
}

constexpr std::size_t most_warnings = 8; // lines of text, rather than of a header

// Whether the header line makes sense, or is one of few that do not.
bool read_header_line(std::string_view keyword, Text_scanner& scanner, Header& header)
{
  if(keyword == "format") {
    const auto encoding = to_encoding(scanner.word());
    header.encoding = encoding.value_or(Encoding::TEXT);
    return encoding.has_value();
  }
  if(keyword == "element") {
    const std::string name(scanner.word());
    const auto count = scanner.integer();
    header.elements.push_back({name, std::size_t(count.value_or(0)), {}});
    return count && *count >= 0;
  }
  if(keyword == "property" && !header.elements.empty()) {
    const auto property = read_property(scanner);
    if(property) {
      header.elements.back().properties.push_back(*property);
    }
    return property.has_value();
  }
  if(keyword != "comment" && keyword != "obj_info") {
    header.warnings.push_back("line " + std::to_string(scanner.line_number())
                              + " of the header is not understood and left out");
  }
  return keyword != "property" && header.warnings.size() < most_warnings;
}

// The header ends as its first line does: with one character, or with a carriage return and a line
// feed. What follows may be any bytes, a line feed too.
const char* end_of_header(const Mesh_source& source, const Text_scanner& scanner)
{
  const char* end =
      std::find_if(source.begin, source.end, [](char c) { return c == '\n' || c == '\r'; });
  const bool has_returns_only = *end == '\r' && end + 1 != source.end && end[1] != '\n';
  if(has_returns_only) {
    end = std::find(scanner.position(), source.end, '\r');
  } else {
    end = scanner.line_end();
  }
  return end == source.end ? end : end + 1;
}

} // namespace

Header read_header(const Mesh_source& source)
{
  Text_scanner scanner(source.begin, source.end);
  if(!scanner.next_content_line('\0') || scanner.word() != "ply") {
    source.fail("it does not begin with the word ply, the file is damaged or of another format: "
                "export it again");
  }
  Header header{Encoding::TEXT, {}, nullptr, {}};
  while(scanner.next_content_line('\0')) {
    const std::string_view keyword = scanner.word();
    if(keyword == "end_header") {
      header.end = end_of_header(source, scanner);
      return header;
    }
    if(!read_header_line(keyword, scanner, header)) {
      source.fail("line " + std::to_string(scanner.line_number())
                  + " of the header is not understood, "
                    "the file is damaged: export it again");
    }
  }
  source.fail("the header has no end up to byte " + std::to_string(source.size())
              + ", the file is cut short: copy or export it again");
}

} // namespace ply
} // namespace hlscm
