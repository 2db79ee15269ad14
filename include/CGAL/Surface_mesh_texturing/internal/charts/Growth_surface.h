// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_GROWTH_SURFACE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_GROWTH_SURFACE_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_graph.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A mesh with what the growth of charts asks it again and again.
struct Growth_surface
{
  typedef Indexed_triangle_mesh::Point_3 Point;

  Indexed_triangle_mesh mesh;        // in a unit and at a place of its own
  double scale = 1.;                 // its lengths to those of the input
  Halfedge_triangles adjacency;
  std::vector<double> length;        // of each halfedge, shorter where it is hidden
  std::vector<double> angle;         // across each halfedge between the normals, 0 on the border
  std::vector<double> area;          // of each triangle
  std::vector<Point> centre;         // of each triangle
  std::vector<double> defect;        // of each vertex 2 pi less its angles, 0 on the border
  std::vector<std::uint32_t> component;
  std::size_t number_of_components = 0;

  // The ambient occlusion is that of each vertex, or empty.
  explicit Growth_surface(const Indexed_triangle_mesh& input,
                          const std::vector<float>& occlusion = {});

  std::size_t size() const { return mesh.triangles.size(); }
};

// Takes the mesh to unit edge length and rounds its coordinates, so that the same surface in
// another unit or at another place gives the same charts although it differs in the last bits.
inline double round_to_unit(Indexed_triangle_mesh& mesh)
{
  const double scale = Indexed_mesh::normalize(mesh);
  constexpr double cells = 1 << 28;    // of unit length
  constexpr double offset = 0.2360679; // coordinates that are simple fractions are no ties
  const auto round = [](double x) { return std::floor(x * cells + offset) / cells; };
  for(auto& p : mesh.points)
    p = Growth_surface::Point(round(p.x()), round(p.y()), round(p.z()));
  return scale;
}

inline Growth_surface::Growth_surface(const Indexed_triangle_mesh& input,
                                      const std::vector<float>& occlusion)
  : mesh(input), scale(round_to_unit(mesh)), adjacency(mesh.triangles, mesh.points.size())
  , length(3 * size()), angle(3 * size(), 0.), area(size()), centre(size())
  , defect(mesh.points.size(), 2. * CGAL_PI)
{
  std::vector<Simple_cartesian<double>::Vector_3> normal(size());
  for(std::uint32_t t = 0; t < size(); ++t) {
    const Point &p = mesh.points[mesh.triangles[t][0]], &q = mesh.points[mesh.triangles[t][1]],
                &r = mesh.points[mesh.triangles[t][2]];
    normal[t] = cross_product(q - p, r - p);
    area[t] = 0.5 * std::sqrt(normal[t] * normal[t]);
    centre[t] = centroid(p, q, r);
    for(std::uint32_t c = 0; c < 3; ++c) {
      const Point &u = mesh.points[mesh.triangles[t][c]],
                  &v = mesh.points[mesh.triangles[t][(c + 1) % 3]],
                  &w = mesh.points[mesh.triangles[t][(c + 2) % 3]];
      length[3 * t + c] = std::sqrt(squared_distance(u, v));
      defect[mesh.triangles[t][c]] -= std::atan2(2. * area[t], (v - u) * (w - u));
    }
  }
  for(std::uint32_t h = 0; h < angle.size(); ++h) {
    const Halfedge g = adjacency.opposite(h);
    if(g == no_halfedge) {
      defect[adjacency.source(h)] = 0.;
      continue;
    }
    const auto &m = normal[triangle_of(h)], &n = normal[triangle_of(g)];
    const auto x = cross_product(m, n);
    angle[h] = std::atan2(std::sqrt(x * x), m * n);
  }
  if(!occlusion.empty())
    for(std::uint32_t h = 0; h < length.size(); ++h)
      length[h] *= Crease_weights().part_seen(occlusion[adjacency.source(h)],
                                              occlusion[adjacency.target(h)]);
  const Face_charts components
    = label_charts(adjacency, std::vector<std::uint8_t>(size(), 0));
  component = components.chart;
  number_of_components = components.number_of_charts;
}

// Finds the curves along which a surface is sharp, as Lévy et al. 2002, section 3.1: from the
// sharpest edges on paths are grown to both sides, at each step along the path of a few edges whose
// sum of angles is largest.
class Feature_curves
{
  typedef Simple_cartesian<double>::Vector_3 Vector;

public:
  // Angles below `least_angle` (radians) are not sharp.
  Feature_curves(const Growth_surface& surface, double least_angle)
    : m_surface(surface), m_mesh(surface.adjacency)
    , m_is_feature(3 * surface.size(), 0)
    , m_near(surface.mesh.points.size(), Vector(0., 0., 0.))
    , m_threshold((std::max)(least_angle, (std::min)(sharpest_angle(), surely_sharp)))
  {
    find();
  }

  // Of each halfedge whether it lies on a curve.
  const std::vector<std::uint8_t>& is_feature() const { return m_is_feature; }

private:
  static constexpr double sharp_part = 0.05;  // of the edges, from which curves start
  static constexpr double surely_sharp = 0.8; // radians; enough, whatever the others are
  static constexpr int search_depth = 4;      // edges that are looked ahead
  static constexpr double least_length = 0.1; // of a curve, to the diameter of a disk of equal area

  double sharpest_angle() const;
  double best_ahead(std::uint32_t h, int depth, std::uint32_t& first) const;
  void extend(std::vector<std::uint32_t>& path) const;
  void find();
  void keep(const std::vector<std::uint32_t>& path);

  Vector step_of(std::uint32_t h) const
  {
    return m_surface.mesh.points[m_mesh.target(h)] - m_surface.mesh.points[m_mesh.source(h)];
  }

  bool is_border(Halfedge h) const { return m_mesh.opposite(h) == no_halfedge; }

  // Whether h lies on a curve or runs along one.
  bool is_taken(std::uint32_t h) const
  {
    const Vector step = step_of(h);
    const auto is_parallel = [&](const Vector& direction) {
      const double cosine = step * direction;
      return cosine * cosine > 0.5 * (step * step);
    };
    return m_is_feature[h] || (is_parallel(m_near[m_mesh.source(h)])
                               && is_parallel(m_near[m_mesh.target(h)]));
  }

  // Calls f for the halfedges from the target of h, clockwise from the one that leads back,
  // as far as the border.
  template <class F>
  void for_each_after(std::uint32_t h, const F& f) const
  {
    const std::uint32_t back = m_mesh.opposite(h);
    for(std::uint32_t g = next_halfedge(h); g != back; g = next_halfedge(m_mesh.opposite(g))) {
      f(g);
      if(is_border(g))
        return;
    }
  }

  const Growth_surface& m_surface;
  const Halfedge_triangles& m_mesh;
  std::vector<std::uint8_t> m_is_feature;
  std::vector<Vector> m_near; // for each vertex on or beside a curve the direction of the curve
  double m_threshold;
};

inline double Feature_curves::sharpest_angle() const
{
  std::vector<double> angles = m_surface.angle;
  const std::size_t i = std::size_t((1. - sharp_part) * double(angles.size()));
  if(i >= angles.size())
    return 0.;
  std::nth_element(angles.begin(), angles.begin() + i, angles.end());
  return 0.999 * angles[i];
}

// The largest sum of angles of a path of `depth` edges after h that does not turn back sharply.
inline double Feature_curves::best_ahead(std::uint32_t h, int depth, std::uint32_t& first) const
{
  double best = 0.;
  if(depth == 0)
    return best;
  const Vector along = step_of(h);
  for_each_after(h, [&](std::uint32_t g) {
    if(is_border(g) || m_surface.angle[g] < 0.5 * m_threshold || is_taken(g)
       || !(step_of(g) * along > 0.))
      return;
    std::uint32_t unused = g;
    const double sum = m_surface.angle[g] + best_ahead(g, depth - 1, unused);
    if(sum > best) {
      best = sum;
      first = g;
    }
  });
  return best;
}

// Goes on from the last halfedge of the path while the next edge, or their mean, is sharp.
inline void Feature_curves::extend(std::vector<std::uint32_t>& path) const
{
  while(path.size() < m_surface.size()) {
    std::uint32_t first = path.back();
    const double ahead = best_ahead(path.back(), search_depth, first);
    if(first == path.back()
       || !(ahead >= search_depth * m_threshold || m_surface.angle[first] >= m_threshold))
      return;
    const std::uint32_t end = m_mesh.target(first);
    const bool closes = std::any_of(path.begin(), path.end(),
                                    [&](std::uint32_t g) { return m_mesh.source(g) == end; });
    path.push_back(first);
    if(closes)
      return;
  }
}

inline void Feature_curves::find()
{
  const double area
    = std::accumulate(m_surface.area.begin(), m_surface.area.end(), 0.);
  const double least = least_length * std::sqrt(area);
  std::vector<std::uint32_t> sharp;
  for(std::uint32_t h = 0; h < m_is_feature.size(); ++h)
    if(!is_border(h) && h < m_mesh.opposite(h) && m_surface.angle[h] >= m_threshold)
      sharp.push_back(h);
  std::stable_sort(sharp.begin(), sharp.end(), [this](std::uint32_t a, std::uint32_t b) {
    return m_surface.angle[a] > m_surface.angle[b];
  });
  for(const std::uint32_t h : sharp) {
    if(is_taken(h))
      continue;
    std::vector<std::uint32_t> path(1, m_mesh.opposite(h));
    extend(path);
    std::reverse(path.begin(), path.end());
    for(std::uint32_t& g : path)
      g = m_mesh.opposite(g);
    extend(path);
    double sum = 0.;
    for(const std::uint32_t g : path)
      sum += m_surface.length[g];
    if(sum >= least)
      keep(path);
  }
}

// Marks the vertices beside the path too, lest a second curve run along it.
inline void Feature_curves::keep(const std::vector<std::uint32_t>& path)
{
  for(const std::uint32_t g : path)
    m_is_feature[g] = m_is_feature[m_mesh.opposite(g)] = 1;
  for(const std::uint32_t g : path) {
    const Vector step = step_of(g);
    if(!(step * step > 0.))
      continue;
    const Vector direction = step / std::sqrt(step * step);
    for(const std::uint32_t side : {g, m_mesh.opposite(g)}) {
      m_near[m_mesh.source(side)] = direction;
      Vector& beside = m_near[m_mesh.source(previous_halfedge(side))];
      if(beside * beside == 0.)
        beside = direction;
    }
  }
}

// Of each halfedge whether it lies on a feature curve.
inline std::vector<std::uint8_t> feature_edges(const Growth_surface& surface, double least_angle)
{
  return Feature_curves(surface, least_angle).is_feature();
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_GROWTH_SURFACE_H
