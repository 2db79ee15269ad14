// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_BYTE_OUTPUT_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_BYTE_OUTPUT_H

#include <CGAL/Blocked_execution/blocked_for.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Collects bytes and passes them to a stream in large pieces, whatever the stream's locale and
// flags are. To be ended by finish(). Without a stream it only collects.
class Byte_output
{
public:
  Byte_output() = default;
  explicit Byte_output(std::ostream& os) : m_os(&os) { m_bytes.reserve(piece); }

  void put(std::string_view bytes)
  {
    if(m_os == nullptr) {
      m_bytes += bytes;
      return;
    }
    if(m_bytes.size() + bytes.size() > piece)
      flush();
    if(bytes.size() > piece)
      m_os->write(bytes.data(), std::streamsize(bytes.size()));
    else
      m_bytes += bytes;
  }

  // The shortest text that reads back as the same number.
  void put_text(double number) { put_number(number); }
  void put_text(std::size_t number) { put_number(number); }

  // The text with so many digits behind the point.
  void put_text(double number, int digits) { put_number(number, std::chars_format::fixed, digits); }

  // Calls `put(output, i)` for each i of [0, n): what is put comes in this order, though several
  // threads may put it into outputs of their own.
  template <class Put>
  void put_each(std::size_t n, const Put& put)
  {
    constexpr std::size_t block = 4096;
    const std::size_t threads = n > block ? Blocked_execution::Thread_scope::concurrency() : 1;
    if(threads == 1) {
      for(std::size_t i = 0; i < n; ++i)
        put(*this, i);
      return;
    }
    std::vector<Byte_output> parts(4 * threads); // so that no thread waits long for the others
    for(std::size_t begin = 0; begin < n; begin += parts.size() * block) {
      const std::size_t end = (std::min)(n, begin + parts.size() * block);
      Blocked_execution::blocked_for(end - begin, block, [&](std::size_t first, std::size_t last) {
        Byte_output& part = parts[first / block];
        for(std::size_t i = first; i < last; ++i)
          put(part, begin + i);
      });
      for(Byte_output& part : parts) {
        this->put(part.m_bytes);
        part.m_bytes.clear();
      }
    }
  }

  // The bytes of a number, the lowest first.
  template <class Number>
  void put_bytes(Number number)
  {
    typedef std::conditional_t<sizeof(Number) == 8, std::uint64_t,
              std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint8_t>> Bits;
    static_assert(sizeof(Bits) == sizeof(Number), "numbers of 1, 4 or 8 bytes");
    Bits bits;
    std::memcpy(&bits, &number, sizeof bits);
    char bytes[sizeof bits];
    for(std::size_t i = 0; i < sizeof bits; ++i)
      bytes[i] = char((std::uint64_t(bits) >> (8 * i)) & 255u);
    put(std::string_view(bytes, sizeof bytes));
  }

  // Writes what is left; returns whether the stream took all.
  bool finish()
  {
    flush();
    m_os->flush();
    return bool(*m_os);
  }

private:
  template <class Number, class... Format>
  void put_number(Number number, const Format&... format)
  {
    char text[384]; // a number of 309 digits before the point
    const std::to_chars_result end = std::to_chars(text, text + sizeof text, number, format...);
    put(std::string_view(text, std::size_t(end.ptr - text)));
  }

  void flush()
  {
    m_os->write(m_bytes.data(), std::streamsize(m_bytes.size()));
    m_bytes.clear();
  }

  static constexpr std::size_t piece = 1 << 16;

  std::ostream* m_os = nullptr;
  std::string m_bytes;
};

// Calls `write` with the stream of a file; returns whether all went well.
template <class Write>
bool write_file(const std::string& name, const Write& write)
{
  std::ofstream file(name, std::ios::binary);
  const bool is_written = file && write(static_cast<std::ostream&>(file));
  file.close();
  return is_written && !file.fail();
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_BYTE_OUTPUT_H
