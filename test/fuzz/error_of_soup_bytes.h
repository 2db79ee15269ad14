// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_FUZZ_ERROR_OF_SOUP_BYTES_H
#define HLSCM_TEST_FUZZ_ERROR_OF_SOUP_BYTES_H

#include <support/polygon_soups.h>
#include <support/soup_properties.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace test_support {

/// The soup that bytes stand for: the number of points, the exponent of their unit, three bytes for
/// the place of each, and for each corner of a face one byte, of which the highest bit ends the face.
/// Bytes that are missing are 0; more than 64 points there are not.
inline Polygon_soup soup_of_bytes(std::string_view bytes)
{
  std::size_t position = 0;
  const auto next = [&] {
    return position < bytes.size() ? std::uint8_t(bytes[position++]) : std::uint8_t(0);
  };
  const std::size_t points = 1 + next() % 64;
  const double unit = std::ldexp(1., 8 * (int(next()) - 128));
  Polygon_soup soup;
  for(std::size_t v = 0; v < points; ++v) {
    const double x = int(next()) - 128, y = int(next()) - 128, z = int(next()) - 128;
    add_point(soup, unit * x, unit * y, unit * z);
  }
  while(position < bytes.size()) {
    const std::uint8_t corner = next();
    soup.corners.push_back(Vertex_index((corner & 0x7f) % points));
    if((corner & 0x80) != 0)
      soup.close_face();
  }
  if(soup.first_corner.back() != soup.corners.size())
    soup.close_face();
  return soup;
}

/// Makes a surface of the soup that bytes stand for. Returns what is wrong with it, or nothing: it is
/// an oriented manifold that leads back to the soup, in which there is nothing more to mend; or a
/// sentence says why there is none.
inline std::string error_of_soup_bytes(std::string_view bytes)
{
  const Polygon_soup soup = soup_of_bytes(bytes);
  const Surface_of_soup surface = CGAL::Indexed_mesh::surface_of_soup(soup);
  if(!surface.is_ok())
    return surface.error.empty() ? "no surface, without a sentence" : "";
  const std::string error = surface_of_soup_error(soup, surface);
  return error.empty() ? second_repair_error(surface) : error;
}

} // namespace test_support

#endif // HLSCM_TEST_FUZZ_ERROR_OF_SOUP_BYTES_H
