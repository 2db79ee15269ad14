// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_DISTORTION_MEASURES_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_DISTORTION_MEASURES_H

#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <CGAL/boost/graph/properties.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMMeasures

The struct `Distortion_measures` says how good a map of a triangle mesh to the plane is.

On each face the map from the surface to the plane is linear, with the singular values
\f$ \sigma_1 \ge \sigma_2 \f$. The means, the quantile and the extremes are over the *regular*
faces, those with an area on the surface and a positive one in the plane; flipped and degenerate
faces, on which ratios and stretch would be infinite, are counted instead. If no face is regular,
the measures are 0, as they are if there is an error.
*/
struct Distortion_measures
  : Indexed_mesh::Mesh_outcome
{
  /// Dirichlet energy minus signed area, \f$ \frac12 \sum A (\sigma_1 \mp \sigma_2)^2 \f$ (minus;
  /// plus on flipped faces), over all faces; see `Conformal_triangle`. In units of the plane's
  /// area.
  double conformal_energy = 0.;
  /// The mean of the quasi-conformal ratio \f$ \sigma_1 / \sigma_2 \ge 1 \f$, weighted by the areas
  /// on the surface.
  double quasi_conformal_mean = 0.;
  /// The ratio that is not exceeded on 99 % of the surface.
  double quasi_conformal_99 = 0.;
  /// The greatest ratio.
  double quasi_conformal_max = 0.;
  /// The greatest area scale \f$ \sigma_1 \sigma_2 \f$ to the smallest.
  double area_scale_range = 0.;
  /// The stretch \f$ L^2 \f$ of Sander, Snyder, Gortler and Hoppe 2001 (section 3): the root of the
  /// mean, over the surface, of \f$ (\sigma_1^{-2} + \sigma_2^{-2}) / 2 \f$, once the plane is
  /// scaled so that the total areas agree. At least 1; 1 for an isometry.
  double stretch_L2 = 0.;
  /// The stretch \f$ L^\infty \f$ of the same: the greatest \f$ \sigma_2^{-1} \f$, at that scale.
  double stretch_Linf = 0.;
  /// Faces whose area in the plane is negative, by an exact predicate.
  std::size_t flipped_faces = 0;
  /// Faces whose area in the plane is 0, by the same; also those with a parameter that is not a
  /// finite number.
  std::size_t degenerate_faces = 0;
};

/// \ingroup PkgHLSCMMeasures
/// Collects the measures of a map face by face, for maps that are no property map.
class Distortion_summary
{
public:
  /// Adds a face and its image `uv`, whose orientation is `sign`.
  void add(const Conformal_triangle& triangle, const Uv_triangle& uv, Orientation sign);
  /// Returns the measures of all faces that were added. Linear time; to be called once.
  Distortion_measures result();

private:
  void add_regular(double area, double uv_area, double sigma_1);
  double quantile(double wanted);

  Distortion_measures m_sums;
  std::vector<std::pair<float, float>> m_ratios; // and the areas they hold on
  double m_area = 0., m_uv_area = 0.;            // of the regular faces
  double m_greatest_scale = 0., m_smallest_scale = 0.;
};

inline void Distortion_summary::add(const Conformal_triangle& triangle, const Uv_triangle& uv,
                                    Orientation sign)
{
  typedef std::complex<double> Complex;
  m_sums.flipped_faces += sign == RIGHT_TURN ? 1 : 0;
  m_sums.degenerate_faces += sign == COLLINEAR ? 1 : 0;
  const Complex b(uv[1].x() - uv[0].x(), uv[1].y() - uv[0].y());
  const Complex c(uv[2].x() - uv[0].x(), uv[2].y() - uv[0].y());
  const std::array<Complex, 3> z = {Complex(0.), b, c};
  m_sums.conformal_energy += triangle.energy(z);
  const double uv_area = 0.5 * (b.real() * c.imag() - b.imag() * c.real());
  if(sign != LEFT_TURN || !(uv_area > 0.) || triangle.is_mollified())
    return;
  // |dz/dw| + |dz/dw'| and, of the area, no difference that cancels
  add_regular(triangle.area(), uv_area,
              0.5 * (std::sqrt(std::norm(triangle.holomorphic_derivative(z)))
                     + std::sqrt(std::norm(triangle.antiholomorphic_derivative(z)))));
}

inline void Distortion_summary::add_regular(double area, double uv_area, double sigma_1)
{
  const double scale = uv_area / area, sigma_2 = scale / sigma_1;
  const double ratio = (std::max)(1., sigma_1 / sigma_2);
  m_ratios.push_back({float(ratio), float(area)});
  m_smallest_scale = m_area > 0. ? (std::min)(m_smallest_scale, scale) : scale;
  m_greatest_scale = (std::max)(m_greatest_scale, scale);
  m_area += area;
  m_uv_area += uv_area;
  m_sums.quasi_conformal_mean += area * ratio;
  m_sums.quasi_conformal_max = (std::max)(m_sums.quasi_conformal_max, ratio);
  m_sums.stretch_L2 += 0.5 * area * (1. / (sigma_1 * sigma_1) + 1. / (sigma_2 * sigma_2));
  m_sums.stretch_Linf = (std::max)(m_sums.stretch_Linf, 1. / sigma_2);
}

inline Distortion_measures Distortion_summary::result()
{
  if(m_ratios.empty())
    return m_sums;
  Distortion_measures measures = m_sums;
  const double scale = m_uv_area / m_area;
  measures.quasi_conformal_mean /= m_area;
  measures.area_scale_range = m_greatest_scale / m_smallest_scale;
  measures.stretch_L2 = std::sqrt(m_sums.stretch_L2 / m_area * scale);
  measures.stretch_Linf *= std::sqrt(scale);
  measures.quasi_conformal_99 = (std::min)(quantile(0.99 * m_area), measures.quasi_conformal_max);
  return measures;
}

// The least ratio that is not exceeded on faces of the given area together. Only the faces with the
// highest ratios are sorted, more of them if they are small.
inline double Distortion_summary::quantile(double wanted)
{
  auto end = m_ratios.end();
  double below = 0.;
  for(std::size_t tail = m_ratios.size() / 16 + 1;; tail *= 4) {
    const auto begin = tail < m_ratios.size() ? m_ratios.end() - tail : m_ratios.begin();
    std::nth_element(m_ratios.begin(), begin, end);
    below = std::accumulate(m_ratios.begin(), begin, 0., [](double sum, const auto& face) {
      return sum + face.second;
    });
    end = begin; // what is above stays there
    if(below < wanted || begin == m_ratios.begin())
      break;
  }
  std::sort(end, m_ratios.end());
  for(; end != m_ratios.end(); ++end) {
    below += end->second;
    if(below >= wanted)
      return end->first;
  }
  return m_ratios.back().first;
}

/*!
\ingroup PkgHLSCMMeasures

Measures the map `uvmap` over all faces of `mesh`.

\tparam TriangleMesh a model of `FaceListGraph` whose faces are triangles
\tparam VertexUVMap a model of `ReadablePropertyMap` with the vertex descriptor as key and a model
        of `Kernel::Point_2` as value; the parameters are taken as numbers of type `double`
\param mesh the mesh
\param uvmap the map
\param np optional named parameters: `vertex_point_map`

Errors: no faces, faces that are no triangles, points with coordinates that are not finite. Linear
time: two passes over the faces, and 8 bytes a face.
*/
template <class TriangleMesh, class VertexUVMap,
          class NamedParameters = parameters::Default_named_parameters>
Distortion_measures measure_distortion(const TriangleMesh& mesh, VertexUVMap uvmap,
                                       const NamedParameters& np = parameters::default_values())
{
  Distortion_measures error;
  if(error.fail(Indexed_mesh::Mesh_status::BAD_MESH, Indexed_mesh::polygon_error(mesh)))
    return error;
  const auto vpm
    = parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                   get_const_property_map(CGAL::vertex_point, mesh));
  if(faces(mesh).begin() == faces(mesh).end())
    error.fail(Indexed_mesh::Mesh_status::BAD_MESH, Indexed_mesh::no_triangles_error());
  std::size_t position = 0;
  for(const auto v : vertices(mesh)) {
    if(!Indexed_mesh::is_finite(Indexed_mesh::double_point(get(vpm, v), np)))
      error.fail(Indexed_mesh::Mesh_status::BAD_MESH,
                 Indexed_mesh::not_finite_error("vertex " + std::to_string(position)));
    ++position;
  }
  if(!error.is_ok())
    return error;
  const Uv_view<TriangleMesh, VertexUVMap> view(mesh, uvmap);
  const double mean_edge = internal::mean_edge_length(mesh, vpm);
  Distortion_summary summary;
  for(const auto f : faces(mesh)) {
    const Uv_triangle uv = view.triangle(f);
    summary.add(internal::conformal_triangle(mesh, vpm, f, mean_edge), uv,
                orientation_of(uv));
  }
  return summary.result();
}

/*!
\ingroup PkgHLSCMMeasures

The same for a mesh with its texture coordinates, which may have seams. A `mesh_error()` or a
`texture_error()` is an error. Linear time.
*/
inline Distortion_measures
measure_distortion(const Surface_mesh_multiresolution::Textured_triangle_mesh& mesh)
{
  typedef Surface_mesh_multiresolution::Textured_triangle_mesh Mesh;
  Distortion_measures error;
  if(error.fail(Indexed_mesh::Mesh_status::BAD_MESH, mesh_error(mesh))
     || error.fail(Indexed_mesh::Mesh_status::BAD_MESH, texture_error(mesh)))
    return error;
  const auto side = [&mesh](const Triangle_indices& t, int from, int to, double unit) {
    const auto &p = mesh.points[t[from]], &q = mesh.points[t[to]];
    return Mesh::Point_3((q.x() - p.x()) / unit, (q.y() - p.y()) / unit, (q.z() - p.z()) / unit);
  };
  const double mean_edge = internal::mean_side_length(mesh.triangles.size(), [&](const auto& use) {
    for(const Triangle_indices& t : mesh.triangles)
      for(const int c : {2, 0, 1}) {
        const Mesh::Point_3 e = side(t, c, (c + 1) % 3, 1.);
        use(e.x(), e.y(), e.z());
      }
  });
  Distortion_summary summary;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    const Triangle_indices& w = mesh.wedges[t];
    const auto point = [&](int c) { return Uv_point(mesh.uv[w[c]].x(), mesh.uv[w[c]].y()); };
    const Uv_triangle uv = {point(0), point(1), point(2)};
    summary.add(Conformal_triangle(Mesh::Point_3(0., 0., 0.), side(v, 0, 1, mean_edge),
                                   side(v, 0, 2, mean_edge)),
                uv, orientation_of(uv));
  }
  return summary.result();
}

/*!
\ingroup PkgHLSCMMeasures

Writes the flipped faces of the map `uvmap`, those whose area in the plane is negative by an exact
predicate, to `out`.

\tparam FaceOutputIterator a model of `OutputIterator` that takes face descriptors

\return `out` after the last face
*/
template <class TriangleMesh, class VertexUVMap, class FaceOutputIterator>
FaceOutputIterator flipped_faces(const TriangleMesh& mesh, VertexUVMap uvmap,
                                 FaceOutputIterator out)
{
  const Uv_view<TriangleMesh, VertexUVMap> view(mesh, uvmap);
  for(const auto f : faces(mesh))
    if(orientation_of(view.triangle(f)) == RIGHT_TURN)
      *out++ = f;
  return out;
}

/*!
\ingroup PkgHLSCMMeasures

Returns whether the map `uvmap` covers a part of the plane twice, that is whether two faces of
`mesh` have images whose interiors intersect. The answer is exact for the parameters as numbers of
type `double`: faces that only touch do not overlap, but faces that would touch overlap by as much
as rounding makes them. Faces without area in the plane overlap nothing; a map that is mirrored as a
whole does not overlap itself for that.

A flipped face beside one that is not decides at once. If all faces have the same orientation, the
images of the border edges decide in time \f$ O(b \log^2 b) \f$ for \f$ b \f$ of them, if they meet
nowhere and one border cycle surrounds all others. Only in the remaining cases (a border that meets
itself, several charts, degenerate faces) the images of all faces are compared, by their boxes.
*/
template <class TriangleMesh, class VertexUVMap>
bool has_global_overlap(const TriangleMesh& mesh, VertexUVMap uvmap)
{
  return has_global_overlap(
    Uv_view<TriangleMesh, VertexUVMap>(mesh, uvmap));
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_DISTORTION_MEASURES_H
