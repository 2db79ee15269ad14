// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Gltf_file.h"

#include "formats/byte_order.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace hlscm {
namespace gltf {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t header_size = 12; // magic, version, length
constexpr std::size_t chunk_header_size = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
constexpr double largest_number = 1099511627776.; // 2^40, so that products fit into 64 bits

// The bytes that a text in base64 stands for; nothing if it is none.
std::optional<std::string> decode_base64(std::string_view text)
{
  static const std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  static const std::array<int, 256> values = [] {
    std::array<int, 256> all;
    all.fill(-1);
    for(std::size_t i = 0; i < digits.size(); ++i) {
      all[std::uint8_t(digits[i])] = int(i);
    }
    return all;
  }();
  while(!text.empty() && text.back() == '=') {
    text.remove_suffix(1);
  }
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int number_of_bits = 0;
  for(const char c : text) {
    const int value = values[std::uint8_t(c)];
    if(value < 0) {
      return std::nullopt;
    }
    bits = (bits << 6) | std::uint32_t(value);
    number_of_bits += 6;
    if(number_of_bits >= 8) {
      number_of_bits -= 8;
      bytes.push_back(char((bits >> number_of_bits) & 255));
    }
  }
  return bytes;
}

// "%20" is a space, for instance.
std::string decode_percent(const std::string& uri)
{
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string text;
  for(std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_code =
        uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    text += is_code ? char(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    i += is_code ? 2 : 0;
  }
  return text;
}

} // namespace

File::File(const Mesh_source& source) : m_source(source), m_size(source.size())
{
  const std::string_view magic = "glTF";
  if(std::string_view(source.begin, std::min(source.size(), magic.size())) == magic) {
    read_chunks();
  } else {
    parse_json(source.begin, source.end);
  }
  if(!m_json.is_object()) {
    m_source.fail("it is no glTF: its JSON is no object, export the mesh again");
  }
  const Json* asset = member(m_json, "asset");
  const std::string version = asset != nullptr ? text(*asset, "version") : std::string();
  const Json* meshes = member(m_json, "meshes"); // an object, rather than an array, until glTF 2
  if((!version.empty() && version[0] < '2') || (meshes != nullptr && meshes->is_object())) {
    m_source.fail("it is of glTF 1.0, which is out of date: export the mesh as glTF 2.0");
  }
  m_buffers.resize(count("buffers"));
}

void File::parse_json(const char* begin, const char* end)
{
  try {
    m_json = Json::parse(begin, end);
  } catch(const Json::parse_error& error) {
    m_source.fail("its JSON cannot be read at byte "
                  + std::to_string(std::size_t(begin - m_source.begin) + error.byte)
                  + ", the file is cut short, damaged or of another format: export it again");
  } catch(const Json::exception&) {
    m_source.fail("its JSON has a number out of range, the file is damaged: export it again");
  }
}

void File::read_chunks()
{
  const char* begin = m_source.begin;
  if(m_source.size() < header_size + chunk_header_size) {
    m_source.fail("it has " + std::to_string(m_source.size())
                  + " bytes, too few for a GLB file, it is cut short: copy or export it again");
  }
  const std::uint32_t version = little_endian<std::uint32_t>(begin + 4);
  const std::size_t length = little_endian<std::uint32_t>(begin + 8);
  if(version != 2) {
    m_source.fail("it is a GLB file of version " + std::to_string(version)
                  + ", export the mesh as glTF 2.0");
  }
  if(length > m_source.size()) {
    m_source.fail_truncated("bytes", m_source.size(), length);
  }
  bool has_json = false;
  for(std::size_t at = header_size; at + chunk_header_size <= length;) {
    const std::size_t size = little_endian<std::uint32_t>(begin + at);
    const std::uint32_t type = little_endian<std::uint32_t>(begin + at + 4);
    at += chunk_header_size;
    if(size > length - at) {
      fail("the part of the file from byte " + std::to_string(at) + " on",
           "promises more bytes than there are");
    }
    if(type == json_chunk && !has_json) {
      parse_json(begin + at, begin + at + size);
      has_json = true;
    } else if(type == binary_chunk && !m_chunk) {
      m_chunk = Bytes{begin + at, size};
    }
    at += size;
  }
}

std::optional<std::size_t> File::number(const Element& element, const char* key) const
{
  const Json* value = member(element.json, key);
  if(value == nullptr) {
    return std::nullopt;
  }
  const double number = value->is_number() ? value->get<double>() : -1;
  if(!(number >= 0) || number != std::floor(number) || number > largest_number) {
    fail(element.name, std::string("has a bad number for ") + key);
  }
  return std::size_t(number);
}

std::size_t File::needed_number(const Element& element, const char* key) const
{
  const auto value = number(element, key);
  if(!value) {
    fail(element.name, std::string("has no ") + key);
  }
  return *value;
}

std::size_t File::count(const char* array) const
{
  const Json* found = member(m_json, array);
  return found != nullptr && found->is_array() ? found->size() : 0;
}

Element File::element(const char* array, const char* word, std::size_t index) const
{
  const std::string name = word + (" " + std::to_string(index));
  if(index >= count(array)) {
    fail(name, "is named but is not there");
  }
  const Json& json = m_json[array][index];
  if(!json.is_object()) {
    fail(name, "is no object");
  }
  return {json, name};
}

Bytes File::view(std::size_t index)
{
  const Element element = this->element("bufferViews", "buffer view", index);
  const std::size_t offset = number(element, "byteOffset").value_or(0);
  const std::size_t length = needed_number(element, "byteLength");
  const Bytes whole = buffer(needed_number(element, "buffer"));
  if(offset > whole.size || length > whole.size - offset) {
    fail(element.name, "reaches up to byte " + std::to_string(offset + length) + " of a buffer of "
                           + std::to_string(whole.size) + " bytes");
  }
  return {whole.data + offset, length};
}

Bytes File::buffer(std::size_t index)
{
  const Element element = this->element("buffers", "buffer", index);
  Buffer& buffer = m_buffers[index];
  if(!buffer.is_read) {
    const bool is_chunk = index == 0 && member(element.json, "uri") == nullptr && m_chunk;
    if(is_chunk) {
      buffer.bytes = *m_chunk;
    } else {
      read_buffer(element, buffer);
      m_size += buffer.bytes.size;
    }
    buffer.is_read = true;
    const std::size_t length = needed_number(element, "byteLength");
    if(length > buffer.bytes.size) {
      fail(element.name, "promises " + std::to_string(length) + " bytes but has "
                             + std::to_string(buffer.bytes.size));
    }
    buffer.bytes.size = length;
  }
  return buffer.bytes;
}

void File::read_buffer(const Element& element, Buffer& buffer)
{
  const std::string uri = text(element.json, "uri");
  if(uri.empty()) {
    fail(element.name, "has no bytes");
  }
  if(uri.compare(0, 5, "data:") == 0) {
    const std::size_t comma = uri.find(";base64,");
    auto decoded = comma != std::string::npos
                       ? decode_base64(std::string_view(uri).substr(comma + 8))
                       : std::nullopt;
    if(!decoded) {
      fail(element.name, "has a data URI that is not in base64");
    }
    buffer.decoded = *std::move(decoded);
    buffer.bytes = {buffer.decoded.data(), buffer.decoded.size()};
    return;
  }
  const fs::path path = decode_percent(uri);
  const std::string file = (fs::path(m_source.file_name).parent_path() / path).string();
  if(path.is_absolute() || uri.find("://") != std::string::npos || is_stream(file)) {
    m_source.fail(element.name + " names " + file
                  + ", which is no file beside it: put it there and name it, or export one .glb");
  }
  try {
    buffer.file = load_file(file);
  } catch(const Program_error& error) {
    m_source.fail(std::string("it needs the file ") + error.what());
  }
  buffer.bytes = {buffer.file.begin(), buffer.file.size()};
}

} // namespace gltf
} // namespace hlscm
