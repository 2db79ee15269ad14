// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PLY_VALUES_H
#define HLSCM_PROGRAM_PLY_VALUES_H

#include "formats/Mesh_source.h"
#include "formats/Ply_header.h"
#include "formats/Text_scanner.h"
#include "formats/byte_order.h"

#include <cstdint>
#include <optional>
#include <string>

namespace hlscm {
namespace ply {

/// The number that bytes are in a binary encoding. All types fit into a double.
template <typename T>
double decode(Encoding encoding, const char* bytes)
{
  return double(encoding == Encoding::BIG_ENDIAN_BINARY ? big_endian<T>(bytes)
                                                        : little_endian<T>(bytes));
}

/// The value of a type whose bytes are there.
inline double decode(Type type, Encoding encoding, const char* bytes)
{
  switch(type) {
  case Type::INT8:
    return decode<std::int8_t>(encoding, bytes);
  case Type::UINT8:
    return decode<std::uint8_t>(encoding, bytes);
  case Type::INT16:
    return decode<std::int16_t>(encoding, bytes);
  case Type::UINT16:
    return decode<std::uint16_t>(encoding, bytes);
  case Type::INT32:
    return decode<std::int32_t>(encoding, bytes);
  case Type::UINT32:
    return decode<std::uint32_t>(encoding, bytes);
  case Type::FLOAT32:
    return decode<float>(encoding, bytes);
  case Type::FLOAT64:
    break;
  }
  return decode<double>(encoding, bytes);
}

/// Reads the values one after the other, whatever the encoding.
class Value_reader
{
public:
  Value_reader(const Header& header, const Mesh_source& source)
    : m_encoding(header.encoding), m_source(source), m_position(header.end),
      m_scanner(header.end, source.end)
  {
    m_scanner.ignore_lines();
  }

  const char* position() const
  {
    return m_encoding == Encoding::TEXT ? m_scanner.position() : m_position;
  }

  /// Where it is, for messages: "in line 7" or "at byte 700".
  std::string place() const
  {
    return m_encoding == Encoding::TEXT ? "in line " + std::to_string(m_source.line_of(position()))
                                        : "at byte " + std::to_string(position() - m_source.begin);
  }

  /// Nothing at the end of the file, or at a word that is not a number.
  std::optional<double> value(Type type)
  {
    if(m_encoding == Encoding::TEXT) {
      return m_scanner.number();
    }
    const std::size_t size = size_of(type);
    if(bytes_left() < size) {
      m_position = m_source.end;
      return std::nullopt;
    }
    const char* const bytes = m_position;
    m_position += size;
    return decode(type, m_encoding, bytes);
  }

  /// Whether the bytes are those that the machine has in memory.
  bool is_little_endian() const { return m_encoding == Encoding::LITTLE_ENDIAN_BINARY; }

  /// How many bytes of a binary file are left.
  std::size_t bytes_left() const { return std::size_t(m_source.end - m_position); }

  /// Passes over bytes of a binary file. Precondition: they are there.
  void skip(std::size_t bytes) { m_position += bytes; }

private:
  Encoding m_encoding;
  const Mesh_source& m_source;
  const char* m_position; // of a binary file
  Text_scanner m_scanner;
};

/// Reads the items of an element from number `first` on and hands the values of each property to
/// `use(property, value)`.
template <typename Use, typename EndOfItem>
void read_items(const Mesh_source& source, const Element& element, Value_reader& reader,
                std::size_t first, Use use, EndOfItem end_of_item)
{
  for(std::size_t item = first; item < element.count; ++item) {
    source.advance(reader.position(), item);
    for(std::size_t p = 0; p < element.properties.size(); ++p) {
      const Property& property = element.properties[p];
      const auto count = property.list_size ? reader.value(*property.list_size) : 1.;
      bool is_good = count && *count >= 0;
      for(double i = 0; is_good && i < *count; ++i) {
        const auto value = reader.value(property.type);
        is_good = value.has_value();
        if(is_good) {
          use(p, *value);
        }
      }
      if(!is_good) {
        source.fail("property " + property.name + " of " + element.name + " " + std::to_string(item)
                    + " of " + std::to_string(element.count) + " cannot be read " + reader.place()
                    + ", the file is cut short or damaged: copy or export it again");
      }
    }
    end_of_item(item);
  }
}

} // namespace ply
} // namespace hlscm

#endif // HLSCM_PROGRAM_PLY_VALUES_H
