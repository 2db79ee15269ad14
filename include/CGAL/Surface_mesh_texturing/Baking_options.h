// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_BAKING_OPTIONS_H
#define CGAL_SURFACE_MESH_TEXTURING_BAKING_OPTIONS_H

#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// What the vectors of a normal map are relative to.
enum class Normal_space
{
  TANGENT, ///< the frame of tangent space of the light model; see `Tangent_frames`
  OBJECT   ///< the coordinates of the mesh
};

/// \ingroup PkgHLSCMTexturing
/// `Baking_options::dilation` for all texels.
constexpr std::size_t unlimited_dilation = std::size_t(-1);

/// \ingroup PkgHLSCMTexturing
/// The options of all functions that bake.
struct Baking_options
{
  std::size_t width = 1024;  ///< of the image, in texels
  std::size_t height = 1024; ///< of the image, in texels
  /// Samples of a texel in each direction; a texel has the mean of those that lie in a chart.
  std::size_t samples = 2;
  /// How far beyond the charts texels are filled, in texels. Each has the value of the nearest
  /// texel of a chart, so that what filters the image across its border finds no other colour.
  std::size_t dilation = unlimited_dilation;
  /// Of the vectors of normal maps.
  Normal_space space = Normal_space::TANGENT;
  /// Threads with `Parallel_tag`; 0 for all that the machine has. The result does not depend on it.
  unsigned int threads = 0;
  /// Told the part done in [0, 1] from time to time; returning false stops early.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMTexturing
/// An image that has been baked; none if there is an error.
struct Baked_map
  : Indexed_mesh::Mesh_outcome
{
  /// Texels beyond the charts and out of reach of the dilation are 0 in all channels.
  Texture_image image;
  /// For each texel, row by row, whether a sample of it lies in a chart of the light model and has
  /// a value of its own.
  std::vector<bool> is_covered;
  std::size_t number_of_covered_texels = 0; ///< in `is_covered`
  std::size_t number_of_samples = 0;        ///< that lie in a chart of the light model
  /// Of these, those that lie beside the right chart of the fine surface in the texture and have
  /// the value of the nearest sample that does not; see `Equal_uv`.
  std::size_t number_of_samples_beside = 0;
  std::size_t number_of_samples_without = 0; ///< Of these, those that found no point at all.
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_BAKING_OPTIONS_H
