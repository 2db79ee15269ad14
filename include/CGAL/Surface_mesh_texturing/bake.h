// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_BAKE_H
#define CGAL_SURFACE_MESH_TEXTURING_BAKE_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/Uv_rasterizer.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
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

/// \ingroup PkgHLSCMTexturing
/// A sample of a row of a texture that lies in a chart of a light model.
struct Baking_sample
{
  std::uint32_t x = 0;    ///< its column
  Surface_point light;    ///< where it lies on the light model
  Surface_point fine;     ///< the point of the fine surface, if there is one
  bool is_beside = false; ///< whether `fine` is only near, in the sense of what found it
};

/*!
\ingroup PkgHLSCMTexturing

Fills the texels of `map` that are not covered and at most `dilation` texels from one that is (from
centre to centre) with the value of the nearest one. Linear time.
*/
inline void dilate(Baked_map& map, std::size_t dilation = unlimited_dilation)
{
  Texture_image& image = map.image;
  if(dilation == 0 || map.number_of_covered_texels == 0
     || map.is_covered.size() != image.width * image.height)
    return;
  const internal::Nearest_covered nearest(image.width, image.height, [&map](std::size_t i) {
    return bool(map.is_covered[i]);
  });
  const double limit = double(dilation) * double(dilation);
  Blocked_execution::blocked_for(image.height, 16, [&](std::size_t y, std::size_t end) {
    std::vector<std::size_t> cells;
    for(; y < end; ++y) {
      nearest.row(y, cells);
      for(std::size_t x = 0; x < image.width; ++x) {
        const std::size_t from_x = cells[x] % image.width, from_y = cells[x] / image.width;
        const double dx = double(from_x) - double(x), dy = double(from_y) - double(y);
        if(!map.is_covered[y * image.width + x] && dx * dx + dy * dy <= limit)
          std::copy_n(image.texel(from_x, from_y), image.channels, image.texel(x, y));
      }
    }
  });
}

namespace internal {

// As in Baked_map.
struct Sample_counts
{
  std::size_t samples = 0, beside = 0, without = 0;

  Sample_counts operator+(const Sample_counts& other) const
  {
    return {samples + other.samples, beside + other.beside, without + other.without};
  }
  void operator+=(const Sample_counts& other) { *this = *this + other; }
};

// What `bake()` calls of its models, whatever their types.
struct Baking_functions
{
  Blocked_execution::Function_ref<void(std::size_t, std::vector<Baking_sample>&)> find;
  Blocked_execution::Function_ref<void(const Surface_point&, const Surface_point&, double*)> shade;
  Blocked_execution::Function_ref<void(double*)> finish;
};

CGAL_HLSCM_INLINE Baked_map bake_samples(const Textured_triangle_mesh& light, std::size_t channels,
                                         const Baking_functions& functions,
                                         const Baking_options& options);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS

// Bakes the rows of texels of one band; see bake().
class Band_baker
{
public:
  Band_baker(const Uv_rasterizer& raster, const Baking_functions& functions, std::size_t samples,
             Baked_map& map)
    : m_raster(raster), m_functions(functions), m_samples(samples), m_map(map)
    , m_channels(map.image.channels)
  {}

  // Bits of std::vector<bool> are not written by bands at the same time: is_covered is of bytes.
  Sample_counts run(std::size_t band, std::vector<std::uint8_t>& is_covered) const
  {
    const std::size_t columns = m_raster.columns(), first = m_raster.begin_row(band);
    std::vector<std::uint32_t> triangles((m_raster.end_row(band) - first) * columns);
    m_raster.first_triangles(band, triangles.data());
    std::vector<double> sums(m_map.image.width * m_channels), value(m_channels);
    std::vector<std::uint32_t> numbers(m_map.image.width);
    std::vector<Baking_sample> samples;
    Sample_counts counts;
    for(std::size_t y = first; y < m_raster.end_row(band); ++y) {
      samples.clear();
      for(std::size_t x = 0; x < columns; ++x) {
        const std::uint32_t t = triangles[(y - first) * columns + x];
        if(t != no_triangle)
          samples.push_back({std::uint32_t(x), m_raster.point(t, x, y), {}, false});
      }
      m_functions.find(y, samples);
      counts.samples += samples.size();
      for(const Baking_sample& sample : samples) {
        counts.beside += sample.is_beside ? 1 : 0;
        counts.without += sample.fine.exists() ? 0 : 1;
        if(!sample.fine.exists())
          continue;
        m_functions.shade(sample.fine, sample.light, value.data());
        const std::size_t x = sample.x / m_samples;
        for(std::size_t c = 0; c < m_channels; ++c)
          sums[x * m_channels + c] += value[c];
        ++numbers[x];
      }
      if((y + 1) % m_samples == 0)
        write_row(y / m_samples, sums, numbers, is_covered);
    }
    return counts;
  }

private:
  void write_row(std::size_t y, std::vector<double>& sums, std::vector<std::uint32_t>& numbers,
                 std::vector<std::uint8_t>& is_covered) const
  {
    for(std::size_t x = 0; x < numbers.size(); ++x) {
      if(numbers[x] == 0)
        continue;
      double* mean = &sums[x * m_channels];
      for(std::size_t c = 0; c < m_channels; ++c)
        mean[c] /= numbers[x];
      m_functions.finish(mean);
      std::copy_n(mean, m_channels, m_map.image.texel(x, y));
      is_covered[y * numbers.size() + x] = 1;
    }
    std::fill(sums.begin(), sums.end(), 0.);
    std::fill(numbers.begin(), numbers.end(), 0u);
  }

  const Uv_rasterizer& m_raster;
  const Baking_functions& m_functions;
  std::size_t m_samples;
  Baked_map& m_map;
  std::size_t m_channels;
};

CGAL_HLSCM_INLINE Baked_map bake_samples(const Textured_triangle_mesh& light, std::size_t channels,
                                         const Baking_functions& functions,
                                         const Baking_options& options)
{
  const std::size_t texel_rows = 8, bands_between_progress = 16;
  Baked_map map;
  if(map.fail(light_error(light, options)))
    return map;
  map.image = {options.width, options.height, channels, {}};
  map.image.texels.assign(options.width * options.height * channels, 0.f);
  const Uv_rasterizer raster(light.uv, light.wedges, options.width * options.samples,
                             options.height * options.samples, texel_rows * options.samples);
  std::vector<std::uint8_t> is_covered(options.width * options.height, 0);
  const Band_baker baker(raster, functions, options.samples, map);
  Sample_counts counts;
  const std::size_t bands = raster.number_of_bands();
  for(std::size_t first = 0; first < bands; first += bands_between_progress) {
    if(options.progress && !options.progress(double(first) / double(bands))) {
      map.cancel();
      map.image = Texture_image();
      return map;
    }
    const std::size_t n = (std::min)(bands - first, bands_between_progress);
    counts += Blocked_execution::blocked_sum<Sample_counts>(
      n, 1, [&](std::size_t band, std::size_t) { return baker.run(first + band, is_covered); });
  }
  map.is_covered.assign(is_covered.begin(), is_covered.end());
  map.number_of_covered_texels
    = std::size_t(std::count(is_covered.begin(), is_covered.end(), std::uint8_t(1)));
  map.number_of_samples = counts.samples;
  map.number_of_samples_beside = counts.beside;
  map.number_of_samples_without = counts.without;
  dilate(map, options.dilation);
  return map;
}

#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Bakes an image of a fine surface in the texture of the light model `light`: of each sample of the
image that lies in a triangle of `light` (in the first one, if several overlap), `correspondence`
says which point of the fine surface it shows, and `shader` what is to be seen there.

\tparam ConcurrencyTag as for `bake_normal_map()`
\tparam Correspondence a model of `SurfaceCorrespondence`
\tparam Shader a model of `BakingShader`

The result does not depend on the number of threads. Linear time beside that of `correspondence`.
Errors are those of `bake_normal_map()` for `light` and `options`.
*/
template <class ConcurrencyTag = Default, class Correspondence, class Shader>
Baked_map bake(const Textured_triangle_mesh& light, const Correspondence& correspondence,
               const Shader& shader, const Baking_options& options)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  const auto find = [&correspondence](std::size_t y, std::vector<Baking_sample>& samples) {
    correspondence.find(y, samples);
  };
  const auto shade = [&shader](const Surface_point& fine, const Surface_point& at, double* value) {
    shader.shade(fine, at, value);
  };
  const auto finish = [&shader](double* value) { shader.finish(value); };
  return internal::bake_samples(light, shader.channels(), {find, shade, finish}, options);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_BAKE_H
