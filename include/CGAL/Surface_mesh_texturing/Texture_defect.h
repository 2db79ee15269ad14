// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TEXTURE_DEFECT_H
#define CGAL_SURFACE_MESH_TEXTURING_TEXTURE_DEFECT_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// How large the charts of a texture become in another one.
enum class Chart_scale
{
  EQUAL_DENSITY, ///< each by a factor of its own, so that all have equal texel density
  AS_GIVEN       ///< all by one factor
};

/// \ingroup PkgHLSCMTexturing
/// What becomes of the charts of a texture whose maps are not one-to-one.
enum class Defective_charts
{
  REFUSE, ///< they are an error
  KEEP    ///< they stay as they are, and are reported
};

/// \ingroup PkgHLSCMTexturing
/// How `repack_texture_atlas()` takes over charts.
struct Repacking_options
{
  Chart_scale scale = Chart_scale::EQUAL_DENSITY;        ///< their sizes
  Defective_charts defects = Defective_charts::REFUSE;   ///< those that are not one-to-one
};

/// \ingroup PkgHLSCMTexturing
/// Why the map of a chart of a texture is not one-to-one, by exact predicates.
struct Texture_defect
{
  /// What is wrong.
  enum Kind {
    NONE,             ///< nothing
    FLIPPED_TRIANGLE, ///< a triangle lies on its back, others of the chart do not
    OVERLAP,          ///< two triangles of the chart have a common area
    NO_AREA           ///< the chart has an area on the surface, but none in the texture
  };

  Kind kind = NONE;      ///< what is wrong
  std::size_t chart = 0; ///< where, in the order of `charts_of_texture()`
  /// The triangle, or both.
  std::array<std::uint32_t, 2> triangles = {{0, 0}};
  std::size_t flipped = 0; ///< triangles of the chart on their back: the smaller part of its area
  std::size_t size = 0;    ///< triangles of the chart
};

/// \ingroup PkgHLSCMTexturing
/// Returns a sentence on a defect; empty for none. `name(t)` is what triangle `t` is called, such as
/// "face 7".
template <class Name>
std::string sentence_on(const Texture_defect& defect, const Name& name)
{
  const std::string chart = "chart " + std::to_string(defect.chart) + " of the texture ";
  switch(defect.kind) {
  case Texture_defect::FLIPPED_TRIANGLE:
    return chart + "has " + std::to_string(defect.flipped)
         + (defect.flipped == 1 ? " flipped triangle of " : " flipped triangles of ")
         + std::to_string(defect.size) + ", the first in " + name(defect.triangles[0]);
  case Texture_defect::OVERLAP:
    return chart + "overlaps itself at " + name(defect.triangles[0]) + " and "
         + name(defect.triangles[1]);
  case Texture_defect::NO_AREA:
    return chart + "with " + name(defect.triangles[0]) + " has no area";
  case Texture_defect::NONE:
    break;
  }
  return {};
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TEXTURE_DEFECT_H
