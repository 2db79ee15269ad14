// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_SIGNAL_METRIC_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_SIGNAL_METRIC_H

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Indexed_mesh/mesh_error.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMSignal
/// A tensor for each triangle of a mesh: of a signal, or of a metric.
struct Face_tensors
  : Indexed_mesh::Mesh_outcome
{
  /// The tensors; empty if there is an error, or if a metric is that of the surface.
  std::vector<Indexed_mesh::Space_tensor> tensors;
};

namespace internal {

typedef Indexed_mesh::Space_tensor::Vector_3 Vector_of_space;

// The normal of triangle t, twice its area long.
inline Vector_of_space area_normal(const Indexed_mesh::Indexed_triangle_mesh& mesh, std::size_t t)
{
  const auto& v = mesh.triangles[t];
  const auto& p = mesh.points;
  return cross_product(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]);
}

// The areas of the triangles.
inline std::vector<double> areas_of(const Indexed_mesh::Indexed_triangle_mesh& mesh)
{
  std::vector<double> areas;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector_of_space normal = area_normal(mesh, t);
    areas.push_back(0.5 * std::sqrt(normal * normal));
  }
  return areas;
}

} // namespace internal

/// \ingroup PkgHLSCMSignal
/// Multiplied by c_1 - c_0 and c_2 - c_0, the first and the second give the gradient of the linear
/// function with the values c_0, c_1, c_2 at the corners of triangle t; 0 if it has no area.
struct Linear_gradient
{
  typedef Indexed_mesh::Space_tensor::Vector_3 Vector_3;

  Vector_3 first = Vector_3(0., 0., 0.);  ///< by which c_1 - c_0 is multiplied
  Vector_3 second = Vector_3(0., 0., 0.); ///< by which c_2 - c_0 is multiplied

  /// Constructs that of triangle `t`. Constant time.
  Linear_gradient(const Indexed_mesh::Indexed_triangle_mesh& mesh, std::size_t t)
  {
    constexpr double least = 1e-9; // area, in squared lengths
    const auto& v = mesh.triangles[t];
    const auto e1 = mesh.points[v[0]] - mesh.points[v[2]], e2 = mesh.points[v[1]] - mesh.points[v[0]];
    const Vector_3 n = internal::area_normal(mesh, t);
    const double nn = n * n;
    if(std::sqrt(nn) > least * (e1 * e1 + e2 * e2)) {
      first = cross_product(n, e1) / nn;
      second = cross_product(n, e2) / nn;
    }
  }
};

namespace internal {

inline std::string weight_error(double weight)
{
  return weight >= 0. && std::isfinite(weight) ? ""
                                               : "the weight of the signal is negative or no number";
}

// Scales a metric so that the surface has the area that it has.
inline void keep_area(const std::vector<double>& areas, const std::vector<double>& areas_in_metric,
                      std::vector<Indexed_mesh::Space_tensor>& metric)
{
  double area = 0., in_metric = 0.;
  for(std::size_t t = 0; t < areas.size(); ++t) {
    area += areas[t];
    in_metric += areas_in_metric[t];
  }
  for(Indexed_mesh::Space_tensor& tensor : metric)
    tensor = tensor * (area / in_metric);
}

} // namespace internal

/*!
\ingroup PkgHLSCMSignal

Returns the metric tensor of a signal that is given at the vertices and linear on the triangles,
\f$ T_f = \sum_c \nabla s_c \nabla s_c^T \f$ over its channels \f$ s_c \f$: how fast the signal changes
in which direction (Sander, Gortler, Snyder, Hoppe 2002, section 3). It is 0 on triangles without
area.

\param mesh the surface
\param values `channels` numbers for each vertex, one vertex after the other
\param channels how many, such as 3 for normals or colours

Bad data (no triangles, indices out of range, coordinates or values that are not finite, another
number of values) give a result with an error. Linear time.
*/
inline Face_tensors vertex_signal(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                                  const std::vector<double>& values, std::size_t channels)
{
  using Indexed_mesh::Mesh_status;
  Face_tensors result;
  if(result.fail(Mesh_status::BAD_MESH, Indexed_mesh::mesh_error(mesh)))
    return result;
  const std::size_t wanted = channels * mesh.points.size();
  if(values.size() != wanted)
    result.fail(Mesh_status::BAD_OPTIONS, "there are " + std::to_string(values.size())
                + " values of the signal instead of " + std::to_string(wanted));
  for(std::size_t i = 0; i < values.size() && result.is_ok(); ++i)
    if(!std::isfinite(values[i]))
      result.fail(Mesh_status::BAD_OPTIONS,
                  Indexed_mesh::not_finite_error("vertex " + std::to_string(i / channels),
                                                 "a value of the signal"));
  if(!result.is_ok())
    return result;
  result.tensors.resize(mesh.triangles.size());
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const Linear_gradient gradient(mesh, t);
    for(std::size_t c = 0; c < channels; ++c) {
      const double s = values[channels * v[0] + c];
      result.tensors[t] = result.tensors[t] + Indexed_mesh::Space_tensor::square(
        (values[channels * v[1] + c] - s) * gradient.first
        + (values[channels * v[2] + c] - s) * gradient.second);
    }
  }
  return result;
}

/*!
\ingroup PkgHLSCMSignal

Returns the metric of a surface blended with that of a signal. A map with little stretch in that
metric gives parts and directions in which the signal changes fast more of the texture; see
`Low_stretch_options::metric` and `HLSCM_options::metric`.

With the tensors \f$ T_f \f$ of the signal the metric of triangle \f$ f \f$ is
\f[ P_f = c\, (\det M_f)^{-1/4} M_f, \qquad M_f = I + w T_f, \f]
determinants in the plane of the triangle. \f$ w \f$ is such that the signal counts `weight` times as
much as the surface where it changes as fast as in the mean, \f$ w s^2 = \f$ `weight` with the mean
\f$ s \f$ of \f$ \sqrt{\mathrm{tr}\, T_f / 2} \f$ over the surface: so no unit counts, be it that of
length or that of the signal, and where the signal is constant a texel remains. \f$ c \f$ keeps the area
of the surface.

The power of the determinant is what makes the map one of least error. Of a map with the Jacobian
\f$ J \f$ half the symmetric Dirichlet energy in the metric \f$ P \f$ is
\f$ \int |J_P^{-1}|^2 dA_P = \int \mathrm{tr}(J^{-T} M J^{-1})\, dA \f$ over the surface, the signal
stretch of Sander et al. (section 3), which is the mean squared error of a texture. The other half is
the Dirichlet energy in that metric: the texture that is used, and the conformal energy. With \f$ M \f$
itself as the metric, fast changes would get more of the texture than is best.

\param mesh the surface
\param signal its signal, such as `vertex_signal()`; an error in it is taken over
\param weight 0 or more; beyond the default the error of a normal map hardly falls (manual, \ref
       HLSCM_signal)

\return the metric; no tensors if the signal is constant or the weight is 0. Linear time.
*/
inline Face_tensors signal_metric(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                                  const Face_tensors& signal, double weight = 4.)
{
  using Indexed_mesh::Mesh_status;
  using Indexed_mesh::Space_tensor;
  Face_tensors result;
  if((!signal.is_ok() && result.fail(signal))
     || result.fail(Mesh_status::BAD_MESH, Indexed_mesh::mesh_error(mesh))
     || result.fail(Mesh_status::BAD_OPTIONS, internal::weight_error(weight)))
    return result;
  const std::size_t n = mesh.triangles.size();
  if(signal.tensors.size() != n)
    result.fail(Mesh_status::BAD_OPTIONS, "the signal has " + std::to_string(signal.tensors.size())
                + " tensors, but there are " + std::to_string(n) + " triangles");
  const std::vector<double> areas = internal::areas_of(mesh);
  std::vector<double> areas_in_metric(n);
  double area = 0., sum = 0.;
  for(std::size_t t = 0; t < n && result.is_ok(); ++t) {
    const double trace = signal.tensors[t].trace();
    if(!(trace >= 0.) || !std::isfinite(trace))
      result.fail(Mesh_status::BAD_OPTIONS, "the signal of triangle " + std::to_string(t)
                  + " is not finite, or negative");
    area += areas[t];
    sum += areas[t] * std::sqrt(0.5 * trace);
  }
  const double w = weight * (area / sum) * (area / sum);
  if(!result.is_ok() || !(w > 0.) || !std::isfinite(w))
    return result;
  for(std::size_t t = 0; t < n; ++t) {
    const Space_tensor blended = Space_tensor::identity() + signal.tensors[t] * w;
    const double determinant = areas[t] > 0. ? blended.plane_determinant(
      internal::area_normal(mesh, t) / (2. * areas[t])) : 1.;
    result.tensors.push_back(blended * std::pow(determinant, -0.25));
    areas_in_metric[t] = areas[t] * std::pow(determinant, 0.25);
  }
  internal::keep_area(areas, areas_in_metric, result.tensors);
  return result;
}

/*!
\ingroup PkgHLSCMSignal

Returns the metric of a surface whose triangles are of different importance: areas are multiplied by
\f$ 1 + W i_f / i \f$ with the importance \f$ i_f \f$ of a triangle, its mean \f$ i \f$ over the
surface, and `weight` \f$ W \f$, and then all by one factor that keeps the area of the surface. It has
no effect on a conformal map, which knows angles alone.

\param mesh the surface
\param importance of each triangle, 0 or more
\param weight 0 or more

\return the metric; no tensors if nothing has an importance or the weight is 0. Linear time.
*/
inline Face_tensors importance_metric(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                                      const std::vector<double>& importance, double weight = 4.)
{
  using Indexed_mesh::Mesh_status;
  using Indexed_mesh::Space_tensor;
  Face_tensors result;
  if(result.fail(Mesh_status::BAD_MESH, Indexed_mesh::mesh_error(mesh))
     || result.fail(Mesh_status::BAD_OPTIONS, internal::weight_error(weight)))
    return result;
  const std::size_t n = mesh.triangles.size();
  if(importance.size() != n)
    result.fail(Mesh_status::BAD_OPTIONS, "there are " + std::to_string(importance.size())
                + " numbers of importance, but " + std::to_string(n) + " triangles");
  const std::vector<double> areas = internal::areas_of(mesh);
  std::vector<double> areas_in_metric(n);
  double area = 0., sum = 0.;
  for(std::size_t t = 0; t < n && result.is_ok(); ++t) {
    if(!(importance[t] >= 0.) || !std::isfinite(importance[t]))
      result.fail(Mesh_status::BAD_OPTIONS, "the importance of triangle " + std::to_string(t)
                  + " is negative or no number");
    area += areas[t];
    sum += areas[t] * importance[t];
  }
  const double w = weight * (area / sum);
  if(!result.is_ok() || !(w > 0.) || !std::isfinite(w))
    return result;
  for(std::size_t t = 0; t < n; ++t) {
    const double density = 1. + w * importance[t];
    result.tensors.push_back(Space_tensor::identity(density));
    areas_in_metric[t] = areas[t] * density;
  }
  internal::keep_area(areas, areas_in_metric, result.tensors);
  return result;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_SIGNAL_METRIC_H
