// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_DEVIATION_METER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_DEVIATION_METER_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/internal/deviation/Textured_view.h>
#include <CGAL/Surface_mesh_multiresolution/internal/deviation/Uv_walk.h>

#include <algorithm>
#include <atomic>
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
      sum += m_area[triangle_of(*at)];
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
      for(const Vertex_index v : m_view.triangles()[triangle_of(*at)]) {
        if(v <= w)
          continue;
        const auto is_same = [v](const std::pair<Vertex_index, double>& e) { return e.first == v; };
        const auto found = std::find_if(edges.begin(), edges.end(), is_same);
        if(found == edges.end())
          edges.push_back({v, m_area[triangle_of(*at)] / 3.});
        else
          found->second += m_area[triangle_of(*at)] / 3.;
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

// An error over a part of the fine surface: its maximum and its integral, and the area that lies
// outside of the coarse chart or where its triangles could not be followed.
struct Error_sum
{
  double maximum = 0., integral = 0., outside = 0., unresolved = 0.;

  Error_sum& operator+=(const Error_sum& other)
  {
    maximum = (std::max)(maximum, other.maximum);
    integral += other.integral;
    outside += other.outside;
    unresolved += other.unresolved;
    return *this;
  }

  friend Error_sum operator+(Error_sum a, const Error_sum& b) { return a += b; }
};

// Change of uv and distance of wedges.
struct Nearest_sums
{
  Error_sum uv_change, distance;

  Nearest_sums& operator+=(const Nearest_sums& other)
  {
    uv_change += other.uv_change;
    distance += other.distance;
    return *this;
  }

  friend Nearest_sums operator+(Nearest_sums a, const Nearest_sums& b) { return a += b; }
};

constexpr double unbounded = (std::numeric_limits<double>::infinity)();

// The errors of a coarse surface, over a fine one.
//
// Start tells where to look for what belongs to a wedge w of the fine surface:
//   is_kept(w)             whether w is a wedge of the coarse surface too, of the same number
//   is_common_edge(v, w)   whether both are kept, with an edge between them
//   start(w)               a triangle of the coarse surface that is not far
//   squared_distance(w, nearest)   from the whole surface, given the nearest point of a chart
//
// Each measurement takes a bound and stops early, with any result above it, once it is exceeded.
template <class Start>
class Deviation_meter
{
public:
  Deviation_meter(const Fine_surface& fine, const Textured_view& coarse, const Start& start)
    : m_fine(fine), m_view(fine.view()), m_coarse(coarse), m_walk(coarse), m_start(start)
    , m_outside(outside_tolerance * diagonal_in_texture(coarse))
    , m_image(fine.view().number_of_wedges())
  {}

  // Finds the points of equal uv of all wedges; the maximum is that of the distances from those
  // that are not outside.
  Error_sum locate_wedges(double bound = unbounded)
  {
    return sum_over_wedges<Error_sum>(bound, [this](Vertex_index w) {
      m_image[w] = locate(w);
      return Error_sum{is_outside(m_image[w]) ? 0. : norm(m_image[w].difference), 0., 0., 0.};
    });
  }

  // Looks for wedges that seem to be outside once more, from where their neighbours are: the start
  // may have been beyond a seam. In rounds, as long as some come nearer.
  void relocate_outside()
  {
    constexpr int most_rounds = 100;
    std::vector<std::pair<Vertex_index, Image>> better;
    for(int round = 0; round == 0 || (round < most_rounds && !better.empty()); ++round) {
      better.clear();
      for(Vertex_index w = 0; w < m_image.size(); ++w)
        if(is_outside(m_image[w])) {
          const Image image = locate_beside_neighbors(w);
          if(image.gap < m_image[w].gap)
            better.push_back({w, image});
        }
      m_is_relocated.resize(m_image.size(), false);
      for(const auto& [w, image] : better) {
        m_image[w] = image;
        m_is_relocated[w] = true;
      }
    }
  }

  // The texture deviation along the edges; locate_wedges() has come first.
  Error_sum deviation(double bound = unbounded) const
  {
    return sum_over_wedges<Error_sum>(bound, [this](Vertex_index w) {
      static thread_local std::vector<std::pair<Vertex_index, double>> edges;
      Error_sum sum;
      m_fine.for_each_edge(w, edges, [&](Vertex_index v, double share) {
        Error_sum along = deviation_along(w, v);
        along.integral *= share;
        along.outside *= share;
        along.unresolved *= share;
        sum += along;
      });
      return sum;
    });
  }

  // The change of uv and the distance at the wedges; locate_wedges() has come first.
  Nearest_sums nearest() const
  {
    return sum_over_wedges<Nearest_sums>(unbounded, [this](Vertex_index w) {
      return nearest(w, m_image[w]);
    });
  }

  // The distance alone, without locate_wedges().
  Error_sum distance(double bound) const
  {
    return sum_over_wedges<Error_sum>(bound, [this](Vertex_index w) {
      return nearest(w, locate(w)).distance;
    });
  }

private:
  // Of the diagonal of the map: beyond, a point is outside, not just next to the border by
  // rounding.
  static constexpr double outside_tolerance = 1e-9;

  // What belongs to a wedge of the fine surface.
  struct Image
  {
    Real_vector<3> difference = {0., 0., 0.}; // from the point of equal uv
    Triangle_index triangle = 0;             // that has this point, or the nearest one
    float gap = 0.f;                          // from there in the texture
  };

  bool is_outside(const Image& image) const { return double(image.gap) > m_outside; }

  template <class Sum, class Body>
  Sum sum_over_wedges(double bound, const Body& body) const
  {
    std::atomic<bool> is_exceeded(false);
    return Blocked_execution::blocked_sum<Sum>(
      m_view.number_of_wedges(), deviation_block, [&](std::size_t begin, std::size_t end) {
        Sum sum;
        for(std::size_t w = begin; w < end && !is_exceeded.load(std::memory_order_relaxed); ++w) {
          const Sum here = body(Vertex_index(w));
          sum += here;
          if(exceeds(here, bound))
            is_exceeded.store(true, std::memory_order_relaxed);
        }
        return sum;
      });
  }

  static bool exceeds(const Error_sum& sum, double bound) { return sum.maximum > bound; }
  static bool exceeds(const Nearest_sums&, double) { return false; }

  Image locate(Vertex_index w) const
  {
    if(!m_start.is_kept(w))
      return locate(w, m_start.start(w));
    Image image;
    image.triangle = m_coarse.triangle_at(w);
    return image;
  }

  Image locate(Vertex_index w, Triangle_index start) const
  {
    const Nearest_surface_point found = m_walk.locate(m_view.uv(w), start);
    return {minus(m_view.point(w), m_coarse.point(found.triangle, found.weights)), found.triangle,
            float(std::sqrt(found.squared_distance))};
  }

  // The image of a wedge that is outside, or a better one found from where its neighbours are.
  Image locate_beside_neighbors(Vertex_index w) const
  {
    Image best = m_image[w];
    for(const std::uint32_t* at = m_view.at().begin(w); at != m_view.at().end(w); ++at)
      for(const Vertex_index v : m_view.triangles()[triangle_of(*at)]) {
        if(!(m_image[v].gap < best.gap) || m_image[v].triangle == best.triangle)
          continue;
        const Image image = locate(w, m_image[v].triangle);
        if(image.gap < best.gap)
          best = image;
      }
    return best;
  }

  // The nearer end of the descents from the start and from the point of equal uv: so it is no
  // farther than either, and depends on the map only where the first one misses the nearest point.
  Nearest_sums nearest(Vertex_index w, const Image& image) const
  {
    if(m_start.is_kept(w))
      return Nearest_sums();
    const Real_vector<3> p = m_view.point(w);
    const Triangle_index start = m_start.start(w);
    Nearest_surface_point found = descend_to_nearest(m_coarse, image.triangle, p);
    if(image.triangle != start && (m_is_relocated.empty() || !m_is_relocated[w])) {
      const Nearest_surface_point other = descend_to_nearest(m_coarse, start, p);
      if(other.squared_distance <= found.squared_distance)
        found = other;
    }
    const double change = norm(minus(m_coarse.uv(found.triangle, found.weights), m_view.uv(w)));
    const double distance = std::sqrt(m_start.squared_distance(w, found)), share = m_fine.share(w);
    return {{change, share * change, 0., 0.}, {distance, share * distance, 0., 0.}};
  }

  // The difference on the part [s, t] of an edge, where it is linear; its norm by Simpson's rule.
  static void add_piece(double length, const Real_vector<3>& from, const Real_vector<3>& to,
                        Error_sum& sum)
  {
    const double a = norm(from), b = norm(to), middle = norm(between(from, to, 0.5));
    sum.maximum = (std::max)({sum.maximum, a, b});
    sum.integral += length * (a + 4. * middle + b) / 6.;
  }

  // If a function on a triangle is quadratic, its mean is 3/2 of that over the edges less 1/2 of
  // that at the corners; this is what an edge, with its two corners, adds to it.
  static double corrected(double mean, double begin, double end)
  {
    return (std::max)(0., 1.5 * mean - 0.25 * (begin + end));
  }

  // The means over an edge.
  Error_sum deviation_along(Vertex_index v, Vertex_index w) const
  {
    Error_sum sum;
    if(m_start.is_common_edge(v, w))
      return sum;
    const bool v_is_outside = is_outside(m_image[v]), w_is_outside = is_outside(m_image[w]);
    // From inside; away from a corner of the coarse surface if there is a choice
    if(v_is_outside || (!w_is_outside && m_start.is_kept(v)))
      std::swap(v, w);
    const Image &begin = m_image[v], &end = m_image[w];
    Real_vector<3> before = begin.difference;
    double s = 0.;
    if(is_outside(begin)) {
      sum.outside = 1.;
    } else if(is_outside(end) || begin.triangle != end.triangle) { // else in one triangle
      const Real_vector<3> p = m_view.point(v), q = m_view.point(w);
      const Way way = m_walk.follow(
        m_view.uv(v), m_view.uv(w), begin.triangle, is_outside(end) ? no_triangle : end.triangle,
        [&](Triangle_index t, const Weights& weight, double at) {
          const Real_vector<3> here = minus(between(p, q, at), m_coarse.point(t, weight));
          add_piece(at - s, before, here, sum);
          before = here;
          s = at;
        });
      (way == Way::LEFT ? sum.outside : sum.unresolved) += way == Way::ARRIVED ? 0. : 1. - s;
    }
    add_piece(1. - s, before, end.difference, sum);
    sum.integral = corrected(sum.integral, norm(begin.difference), norm(end.difference));
    return sum;
  }

  const Fine_surface& m_fine;
  const Textured_view &m_view, &m_coarse;
  Uv_walk m_walk;
  const Start& m_start;
  double m_outside;
  std::vector<Image> m_image;        // of each wedge
  std::vector<bool> m_is_relocated;  // whether its start was elsewhere; empty if none was
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_DEVIATION_METER_H
