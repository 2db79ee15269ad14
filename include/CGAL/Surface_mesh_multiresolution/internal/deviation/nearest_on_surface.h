// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_NEAREST_ON_SURFACE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_NEAREST_ON_SURFACE_H

#include <CGAL/Surface_mesh_multiresolution/internal/deviation/Textured_view.h>

#include <algorithm>
#include <array>
#include <limits>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// A point of a triangle. A weight is 0 just if the point lies on the side opposite to its corner.
struct Surface_point
{
  Triangle_number triangle = no_triangle;
  Weights weight = {1., 0., 0.};
  double squared_distance = (std::numeric_limits<double>::infinity)(); // from what it is nearest to
};

// The point nearest to the origin of the triangle abc in the plane or in space: the foot of the
// perpendicular, or the best point of the sides.
template <std::size_t N>
Surface_point nearest_to_origin(const std::array<Real_vector<N>, 3>& abc)
{
  const Real_vector<N> u = minus(abc[1], abc[0]), v = minus(abc[2], abc[0]);
  const double uu = product(u, u), uv = product(u, v), vv = product(v, v);
  const double au = -product(abc[0], u), av = -product(abc[0], v);
  const double area = uu * vv - uv * uv, wb = vv * au - uv * av, wc = uu * av - uv * au;
  const auto at = [&abc](const Weights& w) {
    Real_vector<N> p;
    for(std::size_t i = 0; i < N; ++i)
      p[i] = w[0] * abc[0][i] + w[1] * abc[1][i] + w[2] * abc[2][i];
    return Surface_point{no_triangle, w, product(p, p)};
  };
  // Below 1e-24 of its squared sides, a doubled squared area is rounding.
  if(area > 1e-24 * uu * vv && wb > 0. && wc > 0. && wb + wc < area)
    return at({1. - (wb + wc) / area, wb / area, wc / area});
  Surface_point best;
  for(int c = 0; c < 3; ++c) {
    const Real_vector<N>&a = abc[c], e = minus(abc[(c + 1) % 3], a);
    const double length = product(e, e);
    const double s = length > 0. ? -product(a, e) / length : 0.;
    Weights w = {0., 0., 0.};
    w[(c + 1) % 3] = (std::min)(1., (std::max)(0., s));
    w[c] = 1. - w[(c + 1) % 3];
    const Surface_point candidate = at(w);
    if(candidate.squared_distance < best.squared_distance)
      best = candidate;
  }
  return best;
}

// The point of triangle t that is nearest to p, in space.
inline Surface_point nearest_in(const Textured_view& surface, Triangle_number t,
                                const Real_vector<3>& p)
{
  const Triangle_indices& abc = surface.triangles()[t];
  Surface_point result = nearest_to_origin<3>({minus(surface.point(abc[0]), p),
                                               minus(surface.point(abc[1]), p),
                                               minus(surface.point(abc[2]), p)});
  result.triangle = t;
  return result;
}

// The same in the texture.
inline Surface_point nearest_in(const Textured_view& surface, Triangle_number t,
                                const Real_vector<2>& p)
{
  const Triangle_indices& abc = surface.triangles()[t];
  Surface_point result = nearest_to_origin<2>({minus(surface.uv(abc[0]), p),
                                               minus(surface.uv(abc[1]), p),
                                               minus(surface.uv(abc[2]), p)});
  result.triangle = t;
  return result;
}

// A local minimum of the distance from p along the surface, which is no farther than any point of
// the triangle `start`: from a nearest point on a side, or at a corner, the descent goes on in the
// triangles beyond.
inline Surface_point descend_to_nearest(const Textured_view& surface, Triangle_number start,
                                        const Real_vector<3>& p)
{
  Surface_point best = nearest_in(surface, start, p);
  const auto improves = [&](Triangle_number t) {
    const Surface_point candidate = nearest_in(surface, t, p);
    const bool is_better = candidate.squared_distance < best.squared_distance;
    if(is_better)
      best = candidate;
    return is_better;
  };
  for(bool goes_on = true; goes_on;) {
    goes_on = false;
    const Weights w = best.weight;
    const Triangle_number t = best.triangle;
    const auto zeros = std::count(w.begin(), w.end(), 0.);
    if(zeros == 1) {
      const int c = int(std::find(w.begin(), w.end(), 0.) - w.begin());
      const Triangle_number next = surface.neighbor(t, c);
      goes_on = next != no_triangle && improves(next);
    } else if(zeros == 2) {
      const auto corner = std::max_element(w.begin(), w.end()) - w.begin();
      const Vertex_index v = surface.triangles()[t][std::size_t(corner)];
      for(const std::uint32_t* at = surface.at().begin(v); at != surface.at().end(v); ++at)
        goes_on = (*at / 3 != t && improves(*at / 3)) || goes_on;
    }
  }
  return best;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_NEAREST_ON_SURFACE_H
