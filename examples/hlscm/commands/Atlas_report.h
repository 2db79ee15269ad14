// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_ATLAS_REPORT_H
#define HLSCM_PROGRAM_ATLAS_REPORT_H

#include "commands/Layout_report.h"
#include "common/Program_options.h"

#include <CGAL/Indexed_mesh/surface_of_soup.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hlscm {

/// Angles between the normals of a picture of the fine surface and of one of the light model, in
/// degrees.
struct Normal_error
{
  double mean = 0;
  double quantile_95 = 0; ///< not exceeded in 95 % of the pixels
};

/// What a run of `bake` did beyond the atlas.
struct Bake_report
{
  std::size_t faces = 0, vertices = 0, wedges = 0; ///< of the light model
  double diagonal = 0; ///< of the bounding box of the fine surface
  /// The distance of vertices of the fine surface from a light model that is one of its levels.
  std::optional<CGAL::Surface_mesh_multiresolution::Surface_error> distance;
  double lowest = 0, highest = 0; ///< what 0 and 65535 stand for in displacement.png, lengths
  Normal_error smooth; ///< with the interpolated normals of the vertices
  Normal_error mapped; ///< with the normal map as it is written
  double silhouette_difference = 0; ///< pixels that show one model only, to those of any
  std::size_t samples_each_way = 0; ///< of a texel
  bool stopped_early = false; ///< with fewer than asked for, since the time was up
  std::size_t samples = 0;        ///< in charts of the light model
  std::size_t samples_beside = 0; ///< of these, those that took the nearest point of the fine one
  std::size_t samples_without = 0; ///< of these, those that found none
  double seconds_simplify = 0, seconds_bake = 0, seconds_compare = 0;
};

/// What a run of `atlas` or `bake` did.
struct Atlas_report
{
  CGAL::Indexed_mesh::Soup_repairs repairs; ///< before all else
  std::vector<std::string> warnings; ///< of reading
  std::size_t faces = 0, vertices = 0, wedges = 0;
  std::size_t pages = 0, width = 0, height = 0;
  std::size_t overlapping_texels = 0;
  double wanted_utilisation = 0; ///< asked for by --min-used, in [0, 1]
  /// Without, if the light model has texture coordinates of its own.
  std::optional<CGAL::Surface_mesh_texturing::Texture_atlas_report> atlas;
  Layout_report layout; ///< what options of the layout made of it
  std::vector<std::pair<std::string, std::size_t>> files; ///< names, and sizes in bytes
  double seconds_read = 0, seconds_measure = 0, seconds_write = 0;
  double peak_memory_mb = 0; ///< of the process (2^20 bytes), before pictures
  std::optional<Bake_report> bake;

  /// Returns the warnings of all stages.
  std::vector<std::string> all_warnings() const;
};

std::string to_json(const Atlas_report& report, const Program_options& options);

/// The table for people.
std::string to_table(const Atlas_report& report, const Program_options& options);

} // namespace hlscm

#endif // HLSCM_PROGRAM_ATLAS_REPORT_H
