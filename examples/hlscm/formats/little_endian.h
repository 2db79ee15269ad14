// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LITTLE_ENDIAN_H
#define HLSCM_PROGRAM_LITTLE_ENDIAN_H

#include <cstring>

namespace hlscm {

/// The number that bytes are, of any alignment, the lowest first.
template <typename T>
T little_endian(const char* bytes)
{
  T value; // on the little-endian machines that this program is built for
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_LITTLE_ENDIAN_H
