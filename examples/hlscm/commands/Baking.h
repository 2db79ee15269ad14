// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_BAKING_H
#define HLSCM_PROGRAM_BAKING_H

#include "commands/Atlas_report.h"
#include "common/Program_options.h"
#include "common/Progress_bar.h"
#include "common/Stopwatch.h"
#include "writing/Textured_model.h"

#include <CGAL/Surface_mesh_texturing/Texture_image.h>

#include <optional>
#include <vector>

namespace hlscm {

/// What is baked, of what.
struct Baking_input
{
  /// The surface with the detail; its texture is that of `light`, or none, then rays look for it.
  Textured_triangle_mesh fine;
  Textured_triangle_mesh light;
  std::optional<Textured_triangle_mesh> coloured; ///< `fine` in a texture that is to be baked, too
  CGAL::Surface_mesh_texturing::Texture_image colours; ///< that texture
  std::size_t pages = 1; ///< of the texture, which stand side by side in the unit square
  std::size_t width = 0, height = 0; ///< of a page, in texels

  bool shares_texture() const { return !fine.wedges.empty(); }
};

/// Images of the texture of the light model, all pages side by side.
struct Baked_images
{
  CGAL::Surface_mesh_texturing::Tangent_frames frames; ///< of the light model
  CGAL::Surface_mesh_texturing::Texture_image normals; ///< unit vectors
  std::optional<CGAL::Surface_mesh_texturing::Texture_image> displacement; ///< lengths
  double lowest = 0, highest = 0;                                  ///< of these
  std::optional<CGAL::Surface_mesh_texturing::Texture_image> colours;      ///< sRGB
};

/// Bakes what the options ask for; throws `Program_error`. When the time is up the result is what
/// was baked by then with fewer samples of a texel; one is baked in any case.
Baked_images bake_images(const Baking_input& input, const Program_options& options,
                         const Time_limit& limit, Progress_bar& progress, Bake_report& report);

/// Compares what is seen of the two models; `normals` is the map as it is written.
void compare_normals(const Baking_input& input, const Baked_images& images,
                     const CGAL::Surface_mesh_texturing::Texture_image& normals,
                     const Program_options& options, Bake_report& report);

} // namespace hlscm

#endif // HLSCM_PROGRAM_BAKING_H
