// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FINE_SURFACE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FINE_SURFACE_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Textured_view.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Blocks of wedges, of about 0.1 ms each.
constexpr std::size_t deviation_block = 4096;

// The diagonal of the bounding box of n points.
template <std::size_t N, class Point_of>
double diagonal_of(std::size_t n, const Point_of& point_of)
{
  constexpr double infinity = (std::numeric_limits<double>::infinity)();
  Real_vector<N> lo, hi;
  lo.fill(infinity);
  hi.fill(-infinity);
  for(Vertex_index i = 0; i < n; ++i) {
    const Real_vector<N> p = point_of(i);
    for(std::size_t c = 0; c < N; ++c) {
      lo[c] = (std::min)(lo[c], p[c]);
      hi[c] = (std::max)(hi[c], p[c]);
    }
  }
  return n == 0 ? 0. : norm(minus(hi, lo));
}

inline double diagonal_in_space(const Textured_view& surface)
{
  return diagonal_of<3>(surface.number_of_wedges(),
                        [&surface](Vertex_index w) { return surface.point(w); });
}

inline double diagonal_in_texture(const Textured_view& surface)
{
  return diagonal_of<2>(surface.number_of_wedges(),
                        [&surface](Vertex_index w) { return surface.uv(w); });
}

// What errors are measured on: a textured surface with its areas.
class Fine_surface
{
public:
  explicit Fine_surface(const Textured_view& view) : m_view(view), m_area(view.triangles().size())
  {
    Blocked_execution::blocked_for(m_area.size(), deviation_block,
                                   [this](std::size_t begin, std::size_t end) {
      for(std::size_t t = begin; t < end; ++t)
        m_area[t] = area_of(m_view.triangles()[t]);
    });
    for(const double area : m_area)
      m_total_area += area;
    m_diagonal = diagonal_in_space(view);
  }

  const Textured_view& view() const { return m_view; }
  double total_area() const { return m_total_area; }
  double diagonal() const { return m_diagonal; }

  // A third of the area of the triangles at a wedge.
  double share(Vertex_index w) const
  {
    double sum = 0.;
    for(const std::uint32_t* at = m_view.at().begin(w); at != m_view.at().end(w); ++at)
      sum += m_area[*at / 3];
    return sum / 3.;
  }

  // Calls use(v, share) for the edges of w whose other end v has a higher number, with a third of
  // the area of the triangles at the edge: once an edge if that is done for all wedges. `edges` is
  // work space.
  template <class Use>
  void for_each_edge(Vertex_index w, std::vector<std::pair<Vertex_index, double>>& edges,
                     const Use& use) const
  {
    edges.clear();
    for(const std::uint32_t* at = m_view.at().begin(w); at != m_view.at().end(w); ++at)
      for(const Vertex_index v : m_view.triangles()[*at / 3]) {
        if(v <= w)
          continue;
        const auto is_same = [v](const std::pair<Vertex_index, double>& e) { return e.first == v; };
        const auto found = std::find_if(edges.begin(), edges.end(), is_same);
        if(found == edges.end())
          edges.push_back({v, m_area[*at / 3] / 3.});
        else
          found->second += m_area[*at / 3] / 3.;
      }
    for(const auto& [v, share] : edges)
      use(v, share);
  }

private:
  double area_of(const Triangle_indices& t) const
  {
    const Real_vector<3> p = m_view.point(t[0]), u = minus(m_view.point(t[1]), p),
                         v = minus(m_view.point(t[2]), p);
    return 0.5 * norm(Real_vector<3>{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                     u[0] * v[1] - u[1] * v[0]});
  }

  const Textured_view& m_view;
  std::vector<double> m_area; // of each triangle
  double m_total_area = 0., m_diagonal = 0.;
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FINE_SURFACE_H
