// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_BASE_SECTION_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_BASE_SECTION_H

#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Code_column.h>
#include <CGAL/Surface_mesh_multiresolution/internal/progressive_mesh_format.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The ends of batches, which ascend to the number of splits; nothing if they are not sound.
inline std::optional<std::vector<std::size_t>>
read_batch_ends(const File_header& header, const char*& from, const char* end)
{
  if(end - from < 4)
    return std::nullopt;
  const std::size_t count = std::size_t(load_little_endian(from, 4));
  from += 4;
  Column_reader ends(from, end, count);
  if(!ends.is_sound())
    return std::nullopt;
  std::vector<std::size_t> result;
  std::size_t last = 0;
  for(std::size_t i = 0; i < count; ++i) {
    last += ends.next<Column_code::EXP_GOLOMB>();
    if(last > header.number_of_splits())
      return std::nullopt;
    result.push_back(last);
  }
  if(!ends.is_sound() || (count > 0 && last != header.number_of_splits()))
    return std::nullopt;
  return result;
}

// The triangles of the base, by its wedges; nothing if they are not sound. Each wedge has a
// triangle: there is no memory for more than there can be.
inline std::optional<std::vector<Triangle_indices>>
read_triangles(const File_header& header, const char*& from, const char* end)
{
  Column_reader corners(from, end, 3 * std::size_t(header.base.triangles));
  if(!corners.is_sound())
    return std::nullopt;
  std::vector<Triangle_indices> triangles(header.base.triangles);
  Triangle_indices last = {0, 0, 0};
  for(Triangle_indices& t : triangles) {
    for(int c = 0; c < 3; ++c) {
      t[c] = last[c] + unzigzag(corners.next<Column_code::EXP_GOLOMB>());
      if(t[c] >= header.base.wedges)
        return std::nullopt;
    }
    last = t;
  }
  if(!corners.is_sound() || header.base.wedges > 3 * std::size_t(header.base.triangles))
    return std::nullopt;
  return triangles;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_BASE_SECTION_H
