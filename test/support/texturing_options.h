// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_TEXTURING_OPTIONS_H
#define HLSCM_TEST_SUPPORT_TEXTURING_OPTIONS_H

#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>

#include <cstddef>

// Small textures, which are soon filled.

namespace test_support {

inline CGAL::Surface_mesh_texturing::Texture_atlas_options
small_texture(std::size_t texels = 256, std::size_t coarse_faces = 500)
{
  CGAL::Surface_mesh_texturing::Texture_atlas_options options;
  options.packing.width = options.packing.height = texels;
  options.coarse_faces = coarse_faces;
  return options;
}

inline CGAL::Surface_mesh_texturing::Baking_by_rays_options small_image(std::size_t texels = 32)
{
  CGAL::Surface_mesh_texturing::Baking_by_rays_options options;
  options.width = options.height = texels;
  return options;
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_TEXTURING_OPTIONS_H
