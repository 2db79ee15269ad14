// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_BAKING_ERRORS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_BAKING_ERRORS_H

#include <CGAL/Surface_mesh_texturing/Baking_options.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>

#include <algorithm>
#include <string>
#include <utility>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What is wrong with the texture coordinates of a mesh in an atlas, or nothing. They may leave the texture by its size, which is more than
// rounding or a chart at the border may need.
inline std::string atlas_error(const Textured_triangle_mesh& mesh, const std::string& name)
{
  const std::string error = texture_error(mesh, name);
  if(!error.empty())
    return error;
  for(std::size_t w = 0; w < mesh.uv.size(); ++w)
    for(int c = 0; c < 2; ++c)
      if(mesh.uv[w][c] < -1. || mesh.uv[w][c] > 2.)
        return "texture coordinate " + std::to_string(w) + " of " + name
             + " lies far beyond the texture [0, 1] x [0, 1]";
  return {};
}

inline std::string options_error(const Baking_options& options)
{
  if(options.width == 0 || options.height == 0)
    return "the image has no texels";
  if(options.samples == 0)
    return "there are no samples in a texel";
  const std::size_t most = 65534; // what Nearest_covered counts in 16 bits
  if((std::max)(options.width, options.height) > most / (std::min)(options.samples, most))
    return "there are more than 65534 samples in a row or column of the image";
  return {};
}

// What is wrong with the two meshes of a bake at equal texture coordinates, or nothing.
inline std::string baking_error(const Textured_triangle_mesh& fine,
                                const Textured_triangle_mesh& light, const Baking_options& options)
{
  std::string error = options_error(options);
  for(const auto& [mesh, name] : {std::make_pair(&fine, "the fine mesh"),
                                  std::make_pair(&light, "the light model")}) {
    if(error.empty())
      error = mesh_error(*mesh, name);
    if(error.empty())
      error = atlas_error(*mesh, name);
  }
  return error;
}

// What is wrong with the two meshes of a bake by rays, or nothing.
inline std::string ray_baking_error(const Indexed_triangle_mesh& fine,
                                    const Textured_triangle_mesh& light,
                                    const Baking_options& options)
{
  std::string error = options_error(options);
  if(error.empty())
    error = mesh_error(fine, "the fine mesh");
  if(error.empty())
    error = mesh_error(light, "the light model");
  if(error.empty())
    error = atlas_error(light, "the light model");
  return error;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_BAKING_ERRORS_H
