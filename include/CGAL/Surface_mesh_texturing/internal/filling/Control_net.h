// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CONTROL_NET_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CONTROL_NET_H

#include <CGAL/Surface_mesh_parameterization/Reference_triangle.h>
#include <CGAL/Surface_mesh_texturing/Chart_packing.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

typedef Surface_mesh_parameterization::Plane_vector<double> Plane_vector_d;

inline Plane_vector_d vector_of(const Chart_shape::Point_2& p) { return {p.x(), p.y()}; }

// A control point and its weight.
struct Control_weight
{
  std::uint32_t point;
  double weight;
};
typedef std::vector<Control_weight> Control_weights;

inline Plane_vector_d sum_of(const Control_weights& weights, const std::vector<Plane_vector_d>& points)
{
  Plane_vector_d result;
  for(const Control_weight& w : weights)
    result = result + points[w.point] * w.weight;
  return result;
}

// A part of a chart with about one strain: the map has the Jacobian alpha = sum conj(g_k) p_k and beta =
// sum g_k p_k of the control points p_k, see `Plane_jacobian`.
struct Strain_element
{
  double area = 0.;
  std::vector<std::pair<std::uint32_t, Plane_vector_d>> half_gradients;
};

// A chart that bends with some control points (free-form deformation, Sederberg and Parry 1986): the
// place of a point is the mean of theirs with weights that depend on where it is at rest. At rest they
// lie such that this is the identity.
//
// A chart of few vertices without thin triangles has them as control points. Another one has those of
// uniform quadratic B-splines on a grid of squares around it, or, if it is not larger than a square, or shall
// be affine, the corners of a triangle around it, so that it is mapped linearly.
class Control_net
{
public:
  typedef Plane_vector_d Vector;
  typedef std::vector<Indexed_mesh::Triangle_indices> Triangles;

  // Adds the control points, at rest, to `points`; `size` is that of the squares. The chart must outlive
  // this, and have a triangle.
  Control_net(const std::vector<Chart_shape::Point_2>& uv, const Triangles& triangles, double size,
              bool is_affine, std::vector<Vector>& points)
    : m_uv(uv), m_triangles(triangles), m_first(std::uint32_t(points.size())), m_size(size)
  {
    Vector low = vector_of(uv[triangles[0][0]]), high = low;
    for(const auto& t : triangles)
      for(const auto v : t) {
        low = {(std::min)(low.x, uv[v].x()), (std::min)(low.y, uv[v].y())};
        high = {(std::max)(high.x, uv[v].x()), (std::max)(high.y, uv[v].y())};
      }
    const Vector extent = high - low;
    m_columns = (std::max)(1, int(std::ceil(extent.x / size)));
    m_rows = (std::max)(1, int(std::ceil(extent.y / size)));
    const std::size_t splines = std::size_t(m_columns + 2) * std::size_t(m_rows + 2);
    if(!is_affine && uv.size() <= splines && has_no_thin_triangle()) {
      m_kind = Kind::VERTICES;
      for(const auto& p : uv)
        points.push_back(vector_of(p));
    } else if(is_affine || (m_columns == 1 && m_rows == 1)) {
      m_kind = Kind::LINEAR;
      m_origin = low;
      m_middle = (low + high) * 0.5;
      m_size = (std::max)(extent.x, extent.y);
      for(const Vector& p : {low, low + Vector{2. * m_size, 0.}, low + Vector{0., 2. * m_size}})
        points.push_back(p);
    } else {
      m_kind = Kind::SPLINES;
      m_origin = low - Vector{m_columns * size - extent.x, m_rows * size - extent.y} * 0.5;
      for(int y = 0; y < m_rows + 2; ++y)
        for(int x = 0; x < m_columns + 2; ++x)
          points.push_back(m_origin + Vector{(x - 0.5) * size, (y - 0.5) * size});
    }
  }

  // Sets the weights of a vertex, by ascending control points.
  void weigh(std::uint32_t v, Control_weights& weights) const
  {
    if(m_kind == Kind::VERTICES)
      weights.assign(1, {m_first + v, 1.});
    else
      weigh(vector_of(m_uv[v]), weights);
  }

  // Lets the chart be moved, turned and scaled only from now on, about as its control points are; returns false
  // if it is not mapped linearly.
  bool make_rigid()
  {
    m_is_rigid = m_kind == Kind::LINEAR;
    return m_is_rigid;
  }

  // The place of a vertex with control points where `points` says.
  Vector place(std::uint32_t v, const std::vector<Vector>& points) const
  {
    if(m_is_rigid)
      return rigid_place(vector_of(m_uv[v]), points);
    Vector result;
    for_each_weight(v, [&](std::uint32_t k, double w) { result = result + points[k] * w; });
    return result;
  }

  // Elements that cover the chart.
  std::vector<Strain_element> elements() const
  {
    std::vector<Strain_element> elements;
    if(m_kind == Kind::VERTICES)
      add_triangles(elements);
    else if(m_kind == Kind::LINEAR) {
      double area = 0.;
      for(const auto& t : m_triangles)
        area += std::abs(twice_area(t)) / 2.;
      elements.push_back(element_at(m_origin, area));
    } else
      add_samples(elements);
    return elements;
  }

  // Differences of the control points of splines that are 0 where the map is affine: of two steps along
  // rows and columns, and along both.
  std::vector<Control_weights> differences() const
  {
    std::vector<Control_weights> result;
    if(m_kind != Kind::SPLINES)
      return result;
    const std::uint32_t columns = std::uint32_t(m_columns + 2), rows = std::uint32_t(m_rows + 2);
    for(std::uint32_t y = 0; y < rows; ++y)
      for(std::uint32_t x = 0; x < columns; ++x) {
        const std::uint32_t i = m_first + y * columns + x;
        if(x + 2 < columns)
          result.push_back({{i, 1.}, {i + 1, -2.}, {i + 2, 1.}});
        if(y + 2 < rows)
          result.push_back({{i, 1.}, {i + columns, -2.}, {i + 2 * columns, 1.}});
        if(x + 1 < columns && y + 1 < rows)
          result.push_back({{i, 1.}, {i + 1, -1.}, {i + columns, -1.}, {i + columns + 1, 1.}});
      }
    return result;
  }

private:
  enum class Kind { VERTICES, LINEAR, SPLINES };

  // The three quadratic B-splines of a cell and their derivatives.
  static void splines(double t, std::array<double, 3>& b, std::array<double, 3>& d)
  {
    const double u = 1. - t;
    b = {0.5 * u * u, 0.5 + t * u, 0.5 * t * t};
    d = {-u, u - t, t};
  }

  double twice_area(const Indexed_mesh::Triangle_indices& t) const
  {
    return (vector_of(m_uv[t[1]]) - vector_of(m_uv[t[0]]))
      .cross(vector_of(m_uv[t[2]]) - vector_of(m_uv[t[0]]));
  }

  // The square of the longest edge.
  static double squared_size(const Vector& a, const Vector& b, const Vector& c)
  {
    return (std::max)({(b - a).squared_length(), (c - b).squared_length(), (a - c).squared_length()});
  }

  bool has_no_thin_triangle() const
  {
    constexpr double thin = 0.02; // area, to the square of the longest edge
    return std::all_of(m_triangles.begin(), m_triangles.end(), [this](const auto& t) {
      return twice_area(t) > 2. * thin * squared_size(vector_of(m_uv[t[0]]), vector_of(m_uv[t[1]]),
                                                      vector_of(m_uv[t[2]]));
    });
  }

  // Where the conformal part of the linear map, which is that at the middle, takes a point.
  Vector rigid_place(const Vector& p, const std::vector<Vector>& points) const
  {
    Vector middle, alpha;
    for_each_weight(m_middle, [&](std::uint32_t k, double w, const Vector& g) {
      middle = middle + points[k] * w;
      alpha = alpha + points[k].times(g.conjugate()) * 0.5;
    });
    return middle + (p - m_middle).times(alpha);
  }

  template <class Use>
  void for_each_weight(std::uint32_t v, const Use& use) const
  {
    if(m_kind == Kind::VERTICES)
      use(m_first + v, 1.);
    else
      for_each_weight(vector_of(m_uv[v]), [&use](std::uint32_t k, double w, const Vector&) { use(k, w); });
  }

  // Calls use(control point, weight, its gradient) for those of a point at rest.
  template <class Use>
  void for_each_weight(const Vector& p, const Use& use) const
  {
    const Vector q = (p - m_origin) * (1. / m_size);
    if(m_kind == Kind::LINEAR) {
      const double g = 0.5 / m_size;
      use(m_first, 1. - 0.5 * (q.x + q.y), Vector{-g, -g});
      use(m_first + 1, 0.5 * q.x, Vector{g, 0.});
      use(m_first + 2, 0.5 * q.y, Vector{0., g});
      return;
    }
    const int column = std::clamp(int(q.x), 0, m_columns - 1), row = std::clamp(int(q.y), 0, m_rows - 1);
    std::array<double, 3> x, dx, y, dy;
    splines(q.x - column, x, dx);
    splines(q.y - row, y, dy);
    for(int j = 0; j < 3; ++j)
      for(int i = 0; i < 3; ++i)
        use(m_first + std::uint32_t((row + j) * (m_columns + 2) + column + i), x[i] * y[j],
            Vector{dx[i] * y[j], x[i] * dy[j]} * (1. / m_size));
  }

  void weigh(const Vector& p, Control_weights& weights) const
  {
    weights.clear();
    for_each_weight(p, [&](std::uint32_t k, double w, const Vector&) { weights.push_back({k, w}); });
  }

  Strain_element element_at(const Vector& p, double area) const
  {
    Strain_element result;
    result.area = area;
    for_each_weight(p, [&](std::uint32_t k, double, const Vector& g) {
      result.half_gradients.push_back({k, g * 0.5});
    });
    return result;
  }

  void add_triangles(std::vector<Strain_element>& elements) const
  {
    for(const auto& t : m_triangles) {
      const double twice = twice_area(t);
      Strain_element e;
      e.area = 0.5 * twice;
      for(int c = 0; c < 3; ++c) {
        const Vector across = vector_of(m_uv[t[(c + 2) % 3]]) - vector_of(m_uv[t[(c + 1) % 3]]);
        e.half_gradients.push_back({m_first + t[c], Vector{-across.y, across.x} * (0.5 / twice)});
      }
      std::sort(e.half_gradients.begin(), e.half_gradients.end(),
                [](const auto& p, const auto& q) { return p.first < q.first; });
      elements.push_back(std::move(e));
    }
  }

  // One in each quarter of a square, in the middle of what of the chart lies there.
  void add_samples(std::vector<Strain_element>& elements) const
  {
    constexpr int parts = 2;
    constexpr double small = 0.02; // areas to those of a quarter
    const double size = m_size / parts;
    struct Sum
    {
      double area = 0.;
      Vector moment;
    };
    std::vector<Sum> sums(std::size_t(parts * m_columns) * std::size_t(parts * m_rows));
    std::vector<std::array<Vector, 3>> pieces;
    for(const auto& t : m_triangles)
      for(pieces.push_back({vector_of(m_uv[t[0]]), vector_of(m_uv[t[1]]), vector_of(m_uv[t[2]])});
          !pieces.empty();) {
        const auto [a, b, c] = pieces.back();
        pieces.pop_back();
        const double area = 0.5 * std::abs((b - a).cross(c - a));
        if(squared_size(a, b, c) > size * size && area > small * size * size) {
          const Vector d = (b + c) * 0.5, e = (c + a) * 0.5, f = (a + b) * 0.5;
          pieces.insert(pieces.end(), {{a, f, e}, {b, d, f}, {c, e, d}, {d, e, f}});
          continue;
        }
        const Vector middle = (a + b + c) * (1. / 3.), q = (middle - m_origin) * (1. / size);
        const int column = std::clamp(int(q.x), 0, parts * m_columns - 1);
        const int row = std::clamp(int(q.y), 0, parts * m_rows - 1);
        Sum& sum = sums[std::size_t(row) * std::size_t(parts * m_columns) + std::size_t(column)];
        sum.area += area;
        sum.moment = sum.moment + middle * area;
      }
    for(int y = 0; y < parts * m_rows; ++y)
      for(int x = 0; x < parts * m_columns; ++x) {
        const Sum& sum = sums[std::size_t(y) * std::size_t(parts * m_columns) + std::size_t(x)];
        if(sum.area > 0.)
          elements.push_back(element_at(sum.moment * (1. / sum.area), sum.area));
      }
  }

  const std::vector<Chart_shape::Point_2>& m_uv;
  const Triangles& m_triangles;
  Kind m_kind = Kind::SPLINES;
  std::uint32_t m_first; // of the control points
  Vector m_origin;       // of the grid, or of the triangle
  Vector m_middle;       // of a chart that is mapped linearly
  bool m_is_rigid = false;
  double m_size;         // of a square, or half a side of the triangle
  int m_columns = 1, m_rows = 1; // of squares
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CONTROL_NET_H
