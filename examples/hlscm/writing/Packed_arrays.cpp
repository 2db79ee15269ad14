// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Packed_arrays.h"

#include "common/Interruption.h"

#include <algorithm>
#include <new>

#include <zlib.h>

namespace hlscm {

std::string base64(std::string_view bytes)
{
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for(std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for(std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < here ? std::uint8_t(bytes[i + k]) : 0u);
    }
    for(std::size_t k = 0; k < 4; ++k) {
      text += k <= here ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

void Packed_arrays::add(const std::vector<std::uint32_t>& numbers)
{
  Interruption::check();
  const std::uint32_t greatest
      = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
  unsigned int planes = 0;
  while(planes < 4 && greatest >> (8 * planes) > 0) {
    ++planes;
  }
  for(unsigned int shift = 0; shift < 32; shift += 8) {
    m_bytes += char(numbers.size() >> shift & 255);
  }
  m_bytes += char(planes);
  m_bytes.reserve(m_bytes.size() + planes * numbers.size());
  for(unsigned int plane = 0; plane < planes; ++plane) {
    for(const std::uint32_t number : numbers) {
      m_bytes += char(number >> (8 * plane) & 255);
    }
  }
}

void Packed_arrays::add_signed(const std::vector<std::int32_t>& numbers)
{
  std::vector<std::uint32_t> unsigned_numbers;
  unsigned_numbers.reserve(numbers.size());
  for(const std::int32_t number : numbers) {
    unsigned_numbers.push_back(std::uint32_t(number) << 1 ^ (number < 0 ? ~0u : 0u));
  }
  add(unsigned_numbers);
}

std::string Packed_arrays::text() const
{
  uLongf size = compressBound(uLong(m_bytes.size()));
  std::string packed(size, '\0');
  if(compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
               reinterpret_cast<const Bytef*>(m_bytes.data()), uLong(m_bytes.size()),
               Z_DEFAULT_COMPRESSION)
     != Z_OK)
  {
    throw std::bad_alloc(); // nothing else can go wrong
  }
  return base64(std::string_view(packed).substr(0, size));
}

} // namespace hlscm
