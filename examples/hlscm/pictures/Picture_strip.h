// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PICTURE_STRIP_H
#define HLSCM_PROGRAM_PICTURE_STRIP_H

#include "writing/Output_files.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hlscm {

/// Pictures of one size, given by the red, green and blue of their pixels, in a row.
class Picture_strip
{
public:
  explicit Picture_strip(std::size_t width) : m_width(width) {}

  void add(std::vector<std::uint8_t> rgb) { m_pictures.push_back(std::move(rgb)); }

  void write(Output_file& file) const;

private:
  std::size_t m_width; // of each
  std::vector<std::vector<std::uint8_t>> m_pictures;
};

/// Where two pictures differ: white where they are equal, the darker the more a channel differs.
std::vector<std::uint8_t> difference(const std::vector<std::uint8_t>& a,
                                     const std::vector<std::uint8_t>& b);

} // namespace hlscm

#endif // HLSCM_PROGRAM_PICTURE_STRIP_H
