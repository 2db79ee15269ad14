// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_format.h"

#include "formats/Off_header.h"
#include "formats/Stl_kind.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace hlscm {

namespace {

constexpr std::string_view utf8_mark = "\xef\xbb\xbf";

bool begins_with(std::string_view text, std::string_view beginning)
{
  return text.substr(0, beginning.size()) == beginning;
}

bool is_binary_stl(const char* begin, const char* end)
{
  const std::size_t size = stl::binary_size(begin, end);
  return size > stl::header_size && size <= std::size_t(end - begin);
}

} // namespace

std::optional<Mesh_format> format_of_extension(const std::string& extension)
{
  static const std::pair<const char*, Mesh_format> formats[] = {
      {".glb", Mesh_format::GLTF}, {".gltf", Mesh_format::GLTF}, {".off", Mesh_format::OFF},
      {".obj", Mesh_format::OBJ},  {".ply", Mesh_format::PLY},   {".stl", Mesh_format::STL}};
  for(const auto& [name, format] : formats) {
    if(extension == name) {
      return format;
    }
  }
  return std::nullopt;
}

std::optional<Mesh_format> format_of_content(const char* begin, const char* end)
{
  if(stl::binary_size(begin, end) == std::size_t(end - begin)) {
    return Mesh_format::STL;
  }
  const char* text = begin + byte_order_mark(begin, end, Mesh_format::OBJ);
  Text_scanner scanner(text, end);
  const std::string_view word = scanner.next_content_line() ? scanner.word() : std::string_view();
  if(begins_with(word, "glTF") || begins_with(word, "{")) {
    return Mesh_format::GLTF;
  }
  if(word == "ply") {
    return Mesh_format::PLY;
  }
  if(off::to_keyword(word)) {
    return Mesh_format::OFF;
  }
  if(stl::is_keyword(word, "solid")) {
    return Mesh_format::STL;
  }
  if(std::memchr(begin, '\0', std::size_t(end - begin)) == nullptr) {
    return Mesh_format::OBJ;
  }
  return is_binary_stl(begin, end) ? std::optional(Mesh_format::STL) : std::nullopt;
}

std::size_t byte_order_mark(const char* begin, const char* end, Mesh_format format)
{
  const bool is_binary =
      format == Mesh_format::STL && stl::binary_size(begin, end) == std::size_t(end - begin);
  return !is_binary && begins_with({begin, std::size_t(end - begin)}, utf8_mark) ? utf8_mark.size()
                                                                                 : 0;
}

std::optional<std::string> text_of_utf16(const char* begin, const char* end)
{
  const std::string_view bytes(begin, std::size_t(end - begin));
  const bool has_low_first = begins_with(bytes, "\xff\xfe");
  if(!has_low_first && !begins_with(bytes, "\xfe\xff")) {
    return std::nullopt;
  }
  std::string text;
  text.reserve(bytes.size() / 2);
  for(std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
    const unsigned low = std::uint8_t(bytes[has_low_first ? i : i + 1]);
    const unsigned high = std::uint8_t(bytes[has_low_first ? i + 1 : i]);
    // What is not ASCII is in names and comments; there a question mark will do.
    text += high == 0 && low < 128 ? char(low) : '?';
  }
  return text;
}

Read_mesh read_format(const Mesh_source& source, Mesh_format format)
{
  switch(format) {
  case Mesh_format::GLTF:
    return read_gltf(source);
  case Mesh_format::OFF:
    return read_off(source);
  case Mesh_format::OBJ:
    return read_obj(source);
  case Mesh_format::PLY:
    return read_ply(source);
  case Mesh_format::STL:
    break;
  }
  return read_stl(source);
}

} // namespace hlscm
