// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_BAKE_COLORS_H
#define CGAL_SURFACE_MESH_TEXTURING_BAKE_COLORS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Equal_uv.h>
#include <CGAL/Surface_mesh_texturing/bake.h>
#include <CGAL/Surface_mesh_texturing/internal/mesh_of_graph.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// Sees values that the vertices of the fine surface have, interpolated.
/// \cgalModels{BakingShader}
class Vertex_value_shader
{
public:
  /// `values` has `channels` entries for each vertex of the fine surface with these triangles; both
  /// must live as long.
  Vertex_value_shader(const std::vector<Triangle_indices>& fine, const std::vector<float>& values,
                      std::size_t channels)
    : m_fine(fine), m_values(values), m_channels(channels)
  {}

  /// Returns how many values a vertex has.
  std::size_t channels() const { return m_channels; }

  /// Sets `value` to those of the point.
  void shade(const Surface_point& fine, const Surface_point&, double* value) const
  {
    const Triangle_indices& t = m_fine[fine.triangle];
    for(std::size_t c = 0; c < m_channels; ++c)
      value[c] = fine.weights[0] * m_values[t[0] * m_channels + c]
               + fine.weights[1] * m_values[t[1] * m_channels + c]
               + fine.weights[2] * m_values[t[2] * m_channels + c];
  }

  /// Leaves the mean.
  void finish(double*) const {}

private:
  const std::vector<Triangle_indices>& m_fine;
  const std::vector<float>& m_values;
  std::size_t m_channels;
};

/// \ingroup PkgHLSCMTexturing
/// Sees an image through texture coordinates that the fine surface has beside those of its atlas.
/// \cgalModels{BakingShader}
class Image_shader
{
public:
  /// `fine` is the fine surface with its coordinates in `image`; both must live as long.
  Image_shader(const Textured_triangle_mesh& fine, const Texture_image& image)
    : m_fine(fine), m_image(image)
  {}

  /// Returns the channels of the image.
  std::size_t channels() const { return m_image.channels; }

  /// Sets `value` to the colour of the point; see `sample_bilinear()`.
  void shade(const Surface_point& fine, const Surface_point&, double* value) const
  {
    double u = 0., v = 0.;
    for(int c = 0; c < 3; ++c) {
      const auto& p = m_fine.uv[m_fine.wedges[fine.triangle][c]];
      u += fine.weights[c] * p.x();
      v += fine.weights[c] * p.y();
    }
    sample_bilinear(m_image, u, v, value);
  }

  /// Leaves the mean.
  void finish(double*) const {}

private:
  const Textured_triangle_mesh& m_fine;
  const Texture_image& m_image;
};

/*!
\ingroup PkgHLSCMTexturing

Bakes values of the vertices of `fine`, their colours for example, into a texture of `light`, which
shares its atlas. Means are those of the numbers: colours in sRGB stay in sRGB. `values` has
`channels` numbers for each vertex of `fine`. Errors and time are those of `bake_normal_map()`.
*/
template <class ConcurrencyTag = Default>
Baked_map bake_vertex_colors(const Textured_triangle_mesh& fine, const std::vector<float>& values,
                             std::size_t channels, const Textured_triangle_mesh& light,
                             const Baking_options& options = Baking_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_map result;
  if(result.fail(internal::baking_error(fine, light, options))
     || result.fail(Mesh_status::BAD_OPTIONS, channels == 0 ? "the vertices have no values" : "")
     || result.fail(internal::size_error(values.size(), channels * fine.points.size(),
                                         "values of the vertices of the fine mesh")))
    return result;
  return bake(light, Equal_uv(fine, light, options),
              Vertex_value_shader(fine.triangles, values, channels), options);
}

/*!
\ingroup PkgHLSCMTexturing

Bakes an image that `fine` has had before its atlas into a texture of `light`, which shares the
atlas: `former` has the triangles of `fine` in the same order, with their coordinates in `image`.
Errors and time are those of `bake_normal_map()`.
*/
template <class ConcurrencyTag = Default>
Baked_map bake_image(const Textured_triangle_mesh& fine, const Textured_triangle_mesh& former,
                     const Texture_image& image, const Textured_triangle_mesh& light,
                     const Baking_options& options = Baking_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_map result;
  if(result.fail(internal::baking_error(fine, light, options))
     || result.fail(internal::image_error(image, "the former image"))
     || result.fail(internal::size_error(former.wedges.size(), fine.triangles.size(),
                                         "triangles of the former texture"))
     || result.fail(Mesh_status::BAD_MESH, texture_error(former, "the former texture")))
    return result;
  return bake(light, Equal_uv(fine, light, options), Image_shader(former, image), options);
}

/*!
\ingroup PkgHLSCMTexturing

Bakes values of the vertices of `fine`, such as colours, into a texture of `light`, which shares its
atlas, with meshes of any types: see the other overloads. Parameters and errors are those of
`bake_normal_map()` with meshes of any types.

\param values a model of `ReadablePropertyMap` with the vertex descriptor as key; `value[c]` is number c
       of a value, as for `std::array` and `IO::Color`
\param channels the numbers of a value
*/
template <class ConcurrencyTag = Default, class FineMesh, class FineUVMap, class FineValueMap,
          class LightMesh, class LightUVMap,
          class NamedParameters_fine = parameters::Default_named_parameters,
          class NamedParameters_light = parameters::Default_named_parameters,
          class = typename boost::property_traits<FineUVMap>::key_type>
Baked_map bake_vertex_colors(const FineMesh& fine, FineUVMap fine_uv,
                             FineValueMap values, std::size_t channels,
                             const LightMesh& light, LightUVMap light_uv,
                             const Baking_options& options = Baking_options(),
                             const NamedParameters_fine& np_fine = parameters::default_values(),
                             const NamedParameters_light& np_light = parameters::default_values())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_map result;
  if(result.fail(internal::polygon_error_of_models(fine, light)))
    return result;
  std::vector<float> arrays;
  for(const auto v : vertices(fine)) {
    const auto& value = get(values, v);
    for(std::size_t c = 0; c < channels; ++c)
      arrays.push_back(float(to_double(value[c])));
  }
  return bake_vertex_colors(internal::textured_arrays_of_graph(fine, fine_uv, np_fine), arrays, channels,
                            internal::textured_arrays_of_graph(light, light_uv, np_light), options);
}

/*!
\ingroup PkgHLSCMTexturing

Bakes an image that `fine` has had before its atlas, of colours or of anything else, into a texture of
`light`, which shares the atlas, with meshes of any types: see the other overload. Parameters and
errors are those of `bake_normal_map()` with meshes of any types.

\param former_uv as `fine_uv`: the coordinates in `image`
\param image what is seen through them
*/
template <class ConcurrencyTag = Default, class FineMesh, class FineUVMap, class FormerUVMap,
          class LightMesh, class LightUVMap,
          class NamedParameters_fine = parameters::Default_named_parameters,
          class NamedParameters_light = parameters::Default_named_parameters,
          class = typename boost::property_traits<FineUVMap>::key_type>
Baked_map bake_image(const FineMesh& fine, FineUVMap fine_uv, FormerUVMap former_uv,
                     const Texture_image& image, const LightMesh& light, LightUVMap light_uv,
                     const Baking_options& options = Baking_options(),
                     const NamedParameters_fine& np_fine = parameters::default_values(),
                     const NamedParameters_light& np_light = parameters::default_values())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_map result;
  if(result.fail(internal::polygon_error_of_models(fine, light)))
    return result;
  return bake_image(internal::textured_arrays_of_graph(fine, fine_uv, np_fine),
                    internal::textured_arrays_of_graph(fine, former_uv, np_fine), image,
                    internal::textured_arrays_of_graph(light, light_uv, np_light), options);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_BAKE_COLORS_H
