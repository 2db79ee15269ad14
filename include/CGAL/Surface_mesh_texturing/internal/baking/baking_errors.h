// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_BAKING_ERRORS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_BAKING_ERRORS_H

#include <CGAL/Surface_mesh_texturing/Baking_options.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>

#include <algorithm>
#include <string>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What is wrong with a mesh in an atlas, or nothing. Its texture coordinates may leave the texture by
// its size, which is more than rounding or a chart at the border may need.
inline Mesh_outcome atlas_error(const Textured_triangle_mesh& mesh, const std::string& name)
{
  Mesh_outcome result;
  if(result.fail(Mesh_status::BAD_MESH, mesh_error(mesh, name))
     || result.fail(Mesh_status::BAD_MESH, texture_error(mesh, name)))
    return result;
  for(std::size_t w = 0; w < mesh.uv.size(); ++w)
    for(int c = 0; c < 2; ++c)
      if(mesh.uv[w][c] < -1. || mesh.uv[w][c] > 2.)
        return {Mesh_status::BAD_MESH, "texture coordinate " + std::to_string(w) + " of " + name
                                         + " lies far beyond the texture [0, 1] x [0, 1]"};
  return {};
}

// What is wrong with an array that has `size` entries where there should be `n`, or nothing.
inline Mesh_outcome size_error(std::size_t size, std::size_t n, const std::string& what)
{
  if(size == n)
    return {};
  return {Mesh_status::BAD_OPTIONS,
          "there are " + std::to_string(size) + " " + what + " instead of " + std::to_string(n)};
}

// What is wrong with frames that are said to be those of a mesh, or nothing.
inline Mesh_outcome frame_error(const Tangent_frames& frames, const Textured_triangle_mesh& light)
{
  Mesh_outcome result = size_error(frames.normals.size(), light.points.size(),
                                   "normals in the frames of the light model");
  if(result.fail(size_error(frames.corners.size(), light.triangles.size(),
                            "triangles in the frames of the light model")))
    return result;
  for(std::size_t t = 0; t < frames.corners.size(); ++t)
    for(const Vertex_index f : frames.corners[t])
      if(f >= frames.frames.size())
        return {Mesh_status::BAD_OPTIONS,
                "triangle " + std::to_string(t) + " has a corner without frame"};
  return {};
}

inline Mesh_outcome image_error(const Texture_image& image, const std::string& name)
{
  if(image.width == 0 || image.height == 0 || image.channels == 0)
    return {Mesh_status::BAD_OPTIONS, name + " has no texels"};
  return size_error(image.texels.size(), image.width * image.height * image.channels,
                    "values in " + name);
}

inline Mesh_outcome options_error(const Baking_options& options)
{
  if(options.width == 0 || options.height == 0)
    return {Mesh_status::BAD_OPTIONS, "the image has no texels"};
  if(options.samples == 0)
    return {Mesh_status::BAD_OPTIONS, "there are no samples in a texel"};
  const std::size_t most = 65534; // what Nearest_covered counts in 16 bits
  if((std::max)(options.width, options.height) > most / (std::min)(options.samples, most))
    return {Mesh_status::BAD_OPTIONS,
            "there are more than 65534 samples in a row or column of the image"};
  return {};
}

// What is wrong with the model that gets the image, or nothing.
inline Mesh_outcome light_error(const Textured_triangle_mesh& light, const Baking_options& options)
{
  Mesh_outcome result = options_error(options);
  if(result.is_ok())
    result = atlas_error(light, "the light model");
  return result;
}

// What is wrong with the two meshes of a bake at equal texture coordinates, or nothing.
inline Mesh_outcome baking_error(const Textured_triangle_mesh& fine,
                                 const Textured_triangle_mesh& light,
                                 const Baking_options& options)
{
  Mesh_outcome result = options_error(options);
  if(result.is_ok() && !result.fail(atlas_error(fine, "the fine mesh")))
    result = atlas_error(light, "the light model");
  return result;
}

// What is wrong with the two meshes of a bake by rays, or nothing.
inline Mesh_outcome ray_baking_error(const Indexed_triangle_mesh& fine,
                                     const Textured_triangle_mesh& light,
                                     const Baking_options& options)
{
  Mesh_outcome result = options_error(options);
  if(result.is_ok() && !result.fail(Mesh_status::BAD_MESH, mesh_error(fine, "the fine mesh")))
    result = atlas_error(light, "the light model");
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_BAKING_ERRORS_H
