// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_INTERNAL_POLYGON_TRIANGULATOR_H
#define CGAL_INDEXED_MESH_INTERNAL_POLYGON_TRIANGULATOR_H

#include <CGAL/Indexed_mesh/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {
namespace internal {

// Cuts faces into triangles along diagonals, in the plane in which they have the largest shadow.
//
// Of a quadrangle the better diagonal; of larger faces the best ears, one after the other (Meisters
// 1975, "Polygons have ears"; an ear is a corner whose triangle lies within and holds no other corner).
// Faces may be concave, and have holes that a bridge joins to the rim; of others, which cross
// themselves, some triangles are made all the same. Time O(n log n) unless ears are long and thin.
class Polygon_triangulator
{
public:
  typedef std::array<std::uint32_t, 3> Corners;

  explicit Polygon_triangulator(const Polygon_soup& soup) : m_soup(soup) {}

  // Calls `use(corners)` for each triangle of face f, the vertices of which are different.
  template <class Use>
  void operator()(std::size_t f, const Use& use)
  {
    find_rim(f);
    const auto use_triangle = [&](std::size_t i, std::size_t j, std::size_t k) {
      const Corners t = {m_corner[i], m_corner[j], m_corner[k]};
      const Vertex_index a = m_soup.corners[t[0]], b = m_soup.corners[t[1]],
                         c = m_soup.corners[t[2]];
      if(a != b && b != c && c != a)
        use(t);
    };
    if(m_corner.size() == 3)
      use_triangle(0, 1, 2);
    if(m_corner.size() < 4)
      return;
    project();
    if(m_corner.size() == 4 && has_first_diagonal()) {
      use_triangle(0, 1, 2);
      use_triangle(0, 2, 3);
    } else if(m_corner.size() == 4) {
      use_triangle(0, 1, 3);
      use_triangle(1, 2, 3);
    } else {
      clip_ears(use_triangle);
    }
  }

private:
  typedef std::array<double, 3> Vector;
  typedef std::array<double, 2> Plane_point;

  struct Ear
  {
    double quality;
    std::uint32_t corner;
    std::uint32_t version;

    bool operator<(const Ear& other) const // the better one, of equal ones the first, is the greatest
    {
      return quality != other.quality ? quality < other.quality : corner > other.corner;
    }
  };

  // The corners of a face, without repeated vertices and without spikes: to a vertex and back.
  void find_rim(std::size_t f)
  {
    const auto& v = m_soup.corners;
    m_corner.clear();
    for(std::uint32_t c = m_soup.first_corner[f]; c < m_soup.first_corner[f + 1]; ++c) {
      if(!m_corner.empty() && v[m_corner.back()] == v[c])
        continue;
      if(m_corner.size() > 1 && v[m_corner[m_corner.size() - 2]] == v[c])
        m_corner.pop_back();
      else
        m_corner.push_back(c);
    }
    for(std::size_t n = m_corner.size(); n > 1; n = m_corner.size()) {
      if(v[m_corner[n - 1]] == v[m_corner[0]] || (n > 2 && v[m_corner[n - 2]] == v[m_corner[0]]))
        m_corner.pop_back();
      else if(n > 2 && v[m_corner[n - 1]] == v[m_corner[1]])
        m_corner.erase(m_corner.begin());
      else
        break;
    }
  }

  Vector point(std::size_t i) const
  {
    const auto& p = m_soup.points[m_soup.corners[m_corner[i]]];
    return {(p.x() - m_origin[0]) / m_extent, (p.y() - m_origin[1]) / m_extent,
            (p.z() - m_origin[2]) / m_extent};
  }

  // Drops the axis along which the face extends least, so that it runs counterclockwise.
  void project()
  {
    const auto& p = m_soup.points[m_soup.corners[m_corner[0]]];
    m_origin = {p.x(), p.y(), p.z()};
    m_extent = 1.;
    double extent = 0.;
    for(std::size_t i = 0; i < m_corner.size(); ++i)
      for(const double x : point(i))
        extent = (std::max)(extent, std::abs(x));
    m_extent = extent > 0. && std::isfinite(extent) ? extent : 1.;
    Vector normal = {0., 0., 0.};
    m_space.clear();
    for(std::size_t i = 0; i < m_corner.size(); ++i)
      m_space.push_back(point(i));
    for(std::size_t i = 0; i < m_corner.size(); ++i) {
      const Vector &a = m_space[i], &b = m_space[i + 1 < m_corner.size() ? i + 1 : 0];
      for(std::size_t k = 0; k < 3; ++k)
        normal[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    std::size_t axis = 0;
    for(std::size_t k = 1; k < 3; ++k)
      axis = std::abs(normal[k]) > std::abs(normal[axis]) ? k : axis;
    m_plane.clear();
    for(const Vector& x : m_space)
      m_plane.push_back(normal[axis] < 0. ? Plane_point{x[(axis + 2) % 3], x[(axis + 1) % 3]}
                                          : Plane_point{x[(axis + 1) % 3], x[(axis + 2) % 3]});
  }

  double turn(std::size_t i, std::size_t j, std::size_t k) const
  {
    const Plane_point &p = m_plane[i], &q = m_plane[j], &r = m_plane[k];
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  }

  // 1 for an equilateral triangle, 0 for one without area or that is turned over in the plane.
  double quality(std::size_t i, std::size_t j, std::size_t k) const
  {
    if(!(turn(i, j, k) > 0.))
      return 0.;
    Vector e = m_space[j], f = m_space[k];
    double lengths = 0.;
    for(std::size_t c = 0; c < 3; ++c) {
      e[c] -= m_space[i][c];
      f[c] -= m_space[i][c];
      lengths += e[c] * e[c] + f[c] * f[c] + (f[c] - e[c]) * (f[c] - e[c]);
    }
    const double area = std::hypot(e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2],
                                   e[0] * f[1] - e[1] * f[0]);
    return 2. * std::sqrt(3.) * area / lengths;
  }

  bool has_first_diagonal() const
  {
    constexpr double rounding = 1e-9; // of parallelograms, both diagonals of which are as good
    const double first = (std::min)(quality(0, 1, 2), quality(0, 2, 3));
    const double second = (std::min)(quality(0, 1, 3), quality(1, 2, 3));
    return first > 0. ? first >= second - rounding : !(second > 0.);
  }

  template <class UseTriangle>
  void clip_ears(const UseTriangle& use_triangle)
  {
    const std::uint32_t n = std::uint32_t(m_corner.size());
    m_next.resize(n);
    m_previous.resize(n);
    m_version.assign(n, 0);
    m_waiting.assign(n, {});
    for(std::uint32_t i = 0; i < n; ++i) {
      m_next[i] = i + 1 < n ? i + 1 : 0;
      m_previous[i] = i > 0 ? i - 1 : n - 1;
    }
    fill_grid();
    std::priority_queue<Ear> ears;
    const auto offer = [&](std::uint32_t i) {
      const double q = quality(m_previous[i], i, m_next[i]);
      if(q > 0.)
        ears.push({q, i, m_version[i]});
    };
    for(std::uint32_t i = 0; i < n; ++i)
      offer(i);
    std::uint32_t any = 0;
    for(std::uint32_t left = n; left > 2;) {
      std::uint32_t ear = any; // where none is left, of faces that cross themselves
      if(!ears.empty()) {
        const Ear best = ears.top();
        ears.pop();
        ear = best.corner;
        if(best.version != m_version[ear])
          continue;
        const std::uint32_t obstacle = corner_within(ear);
        if(obstacle != n) {
          m_waiting[obstacle].push_back(ear);
          continue;
        }
      }
      const std::uint32_t before = m_previous[ear], after = m_next[ear];
      use_triangle(before, ear, after);
      m_next[before] = after;
      m_previous[after] = before;
      m_version[ear] = gone;
      any = after;
      --left;
      for(const std::uint32_t i : {before, after}) {
        ++m_version[i];
        offer(i);
      }
      for(const std::uint32_t i : m_waiting[ear])
        if(m_version[i] != gone && i != before && i != after)
          offer(i);
    }
  }

  // Corners by the cells of a grid, one cell a corner.
  void fill_grid()
  {
    m_low = m_high = m_plane[0];
    for(const Plane_point& p : m_plane)
      for(std::size_t k = 0; k < 2; ++k) {
        m_low[k] = (std::min)(m_low[k], p[k]);
        m_high[k] = (std::max)(m_high[k], p[k]);
      }
    m_side = std::size_t(std::sqrt(double(m_plane.size()))) + 1;
    m_cells.assign(m_side * m_side, {});
    for(std::uint32_t i = 0; i < m_plane.size(); ++i)
      m_cells[cell(m_plane[i][1], 1) * m_side + cell(m_plane[i][0], 0)].push_back(i);
  }

  std::size_t cell(double x, std::size_t axis) const
  {
    const double extent = m_high[axis] - m_low[axis];
    const double part = extent > 0. ? (x - m_low[axis]) / extent * double(m_side) : 0.;
    return (std::min)(std::size_t((std::max)(part, 0.)), m_side - 1);
  }

  // A corner of another vertex in the triangle of an ear, or their number.
  std::uint32_t corner_within(std::uint32_t ear) const
  {
    const std::array<std::uint32_t, 3> t = {m_previous[ear], ear, m_next[ear]};
    std::array<std::size_t, 2> first, last;
    for(std::size_t k = 0; k < 2; ++k) {
      const auto ends = std::minmax({m_plane[t[0]][k], m_plane[t[1]][k], m_plane[t[2]][k]});
      first[k] = cell(ends.first, k);
      last[k] = cell(ends.second, k);
    }
    const auto vertex = [this](std::uint32_t i) { return m_soup.corners[m_corner[i]]; };
    for(std::size_t y = first[1]; y <= last[1]; ++y)
      for(std::size_t x = first[0]; x <= last[0]; ++x)
        for(const std::uint32_t i : m_cells[y * m_side + x])
          if(m_version[i] != gone && vertex(i) != vertex(t[0]) && vertex(i) != vertex(t[1])
             && vertex(i) != vertex(t[2]) && turn(t[0], t[1], i) >= 0.
             && turn(t[1], t[2], i) >= 0. && turn(t[2], t[0], i) >= 0.)
            return i;
    return std::uint32_t(m_plane.size());
  }

  static constexpr std::uint32_t gone = std::uint32_t(-1);

  const Polygon_soup& m_soup;
  std::vector<std::uint32_t> m_corner; // of the soup
  Vector m_origin{};
  double m_extent = 1.;
  std::vector<Vector> m_space;
  std::vector<Plane_point> m_plane;
  std::vector<std::uint32_t> m_next, m_previous, m_version; // a version is what an ear was offered in
  std::vector<std::vector<std::uint32_t>> m_waiting; // ears that a corner lies in
  Plane_point m_low{}, m_high{};
  std::size_t m_side = 1;
  std::vector<std::vector<std::uint32_t>> m_cells;
};

} // namespace internal
} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_INTERNAL_POLYGON_TRIANGULATOR_H
