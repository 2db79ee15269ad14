// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_FACE_DISTORTION_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_FACE_DISTORTION_H

#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMMeasures

The struct `Face_distortion` says how a map distorts one face, on which it has the singular values
\f$ \sigma_1 \ge \sigma_2 \f$.
*/
struct Face_distortion
{
  /// The quasi-conformal ratio \f$ \sigma_1 / \sigma_2 \ge 1 \f$: 1 where the map is conformal,
  /// infinite for a face without area on the surface or in the plane.
  double quasi_conformal = std::numeric_limits<double>::infinity();
  /// The area scale \f$ \sigma_1 \sigma_2 \f$, the area in the plane to that on the surface; negative
  /// on flipped faces, 0 for a face without area in the plane, infinite for one without area on the
  /// surface alone.
  double area_scale = 0.;
};

namespace internal {

// Lengths are in units of the longest edge: their squares exist whatever the unit of the mesh.
template <class Points, class Uvs>
Face_distortion face_distortion(const Points& p, const Uvs& uv)
{
  typedef std::complex<double> Complex;
  const auto length = [&p](int i, int j) {
    return std::hypot(p[j][0] - p[i][0], p[j][1] - p[i][1], p[j][2] - p[i][2]);
  };
  const double unit = (std::max)({length(0, 1), length(1, 2), length(2, 0)});
  const auto corner = [&](int c) {
    return Conformal_triangle::Point_3((p[c][0] - p[0][0]) / unit, (p[c][1] - p[0][1]) / unit,
                                       (p[c][2] - p[0][2]) / unit);
  };
  const auto value = [&](int c) {
    return Complex((uv[c][0] - uv[0][0]) / unit, (uv[c][1] - uv[0][1]) / unit);
  };
  Face_distortion result;
  const Complex b = value(1), c = value(2);
  const double uv_area = 0.5 * (b.real() * c.imag() - b.imag() * c.real());
  if(unit > 0.) {
    const Conformal_triangle triangle(corner(0), corner(1), corner(2));
    if(!triangle.is_mollified()) {
      const std::array<Complex, 3> z = {Complex(0.), b, c};
      const double sigma_1 = 0.5 * (std::abs(triangle.holomorphic_derivative(z))
                                    + std::abs(triangle.antiholomorphic_derivative(z)));
      result.area_scale = uv_area / triangle.area();
      if(result.area_scale != 0.) // no difference of derivatives, which would cancel
        result.quasi_conformal = (std::max)(1., sigma_1 * sigma_1 / std::abs(result.area_scale));
      return result;
    }
  }
  const double area = (uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1])
                    - (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]);
  if(area != 0.)
    result.area_scale = std::copysign(result.quasi_conformal, area);
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMMeasures

Returns how each triangle is distorted by its texture coordinates. Linear time. Nothing is returned
if an index is out of range or there are not as many triangles in the texture as on the surface.
*/
inline std::vector<Face_distortion>
measure_face_distortion(const Surface_mesh_multiresolution::Textured_triangle_mesh& mesh)
{
  typedef Surface_mesh_multiresolution::Textured_triangle_mesh Mesh;
  std::vector<Face_distortion> result;
  if(mesh.wedges.size() != mesh.triangles.size())
    return result;
  result.reserve(mesh.triangles.size());
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto &v = mesh.triangles[t], &w = mesh.wedges[t];
    if((std::max)({v[0], v[1], v[2]}) >= mesh.points.size()
       || (std::max)({w[0], w[1], w[2]}) >= mesh.uv.size())
      return {};
    result.push_back(internal::face_distortion(
      std::array<Mesh::Point_3, 3>{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]},
      std::array<Mesh::Point_2, 3>{mesh.uv[w[0]], mesh.uv[w[1]], mesh.uv[w[2]]}));
  }
  return result;
}

/// \ingroup PkgHLSCMMeasures
/// Returns how each triangle is distorted by a map with one parameter for each vertex, such as that
/// of `conformal_map()`. Linear time. Nothing is returned if an index is out of range.
inline std::vector<Face_distortion>
measure_face_distortion(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                        const std::vector<Simple_cartesian<double>::Point_2>& uv)
{
  return measure_face_distortion(Surface_mesh_multiresolution::Textured_triangle_mesh{
    mesh.points, mesh.triangles, uv, mesh.triangles});
}

/*!
\ingroup PkgHLSCMMeasures

Tells for each face of a mesh how the map `uvmap` distorts it. Linear time.

\tparam FaceGraph a model of `FaceListGraph`
\param mesh a triangle mesh
\param uvmap a model of `ReadablePropertyMap` with a point with two coordinates as value, and with the
       vertex descriptor as key, or the halfedge descriptor, for the corner at its target
\param distortionmap a model of `WritablePropertyMap` with the face descriptor as key and
       `Face_distortion` as value
\param np optional named parameters: `vertex_point_map`, `geom_traits`; see
       `Indexed_mesh::copy_points()`

\return `false`, and does nothing, if not all faces are triangles
*/
template <class FaceGraph, class UVMap, class FaceDistortionMap,
          class NamedParameters = parameters::Default_named_parameters>
bool measure_face_distortion(const FaceGraph& mesh, UVMap uvmap, FaceDistortionMap distortionmap,
                             const NamedParameters& np = parameters::default_values())
{
  typedef typename boost::property_traits<UVMap>::key_type Key;
  typedef typename boost::graph_traits<FaceGraph>::halfedge_descriptor Halfedge_descriptor;
  if(!is_triangle_mesh(mesh))
    return false;
  const auto vpm
    = parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                   get_const_property_map(CGAL::vertex_point, mesh));
  for(const auto f : faces(mesh)) {
    std::array<Conformal_triangle::Point_3, 3> p;
    std::array<std::array<double, 2>, 3> uv;
    auto h = halfedge(f, mesh);
    for(int c = 0; c < 3; ++c, h = next(h, mesh)) {
      const auto parameter = [&] {
        if constexpr(std::is_same<Key, Halfedge_descriptor>::value)
          return get(uvmap, h);
        else
          return get(uvmap, target(h, mesh));
      }();
      p[c] = Indexed_mesh::double_point(get(vpm, target(h, mesh)), np);
      uv[c] = {to_double(parameter[0]), to_double(parameter[1])};
    }
    put(distortionmap, f, internal::face_distortion(p, uv));
  }
  return true;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_FACE_DISTORTION_H
