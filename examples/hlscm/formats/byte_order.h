// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_BYTE_ORDER_H
#define HLSCM_PROGRAM_BYTE_ORDER_H

#include <algorithm>
#include <cstring>
#include <string>

namespace hlscm {

/// The number that bytes are, of any alignment, the lowest first.
template <typename T>
T little_endian(const char* bytes)
{
  T value; // on the little-endian machines that this program is built for
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// Appends the bytes of a number, the lowest first.
template <typename T>
void append_little_endian(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The number that bytes are, of any alignment, the highest first.
template <typename T>
T big_endian(const char* bytes)
{
  char reversed[sizeof(T)];
  std::reverse_copy(bytes, bytes + sizeof(T), reversed);
  return little_endian<T>(reversed);
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_BYTE_ORDER_H
