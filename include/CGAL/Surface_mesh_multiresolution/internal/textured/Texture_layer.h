// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_TEXTURE_LAYER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_TEXTURE_LAYER_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/textured/Chart_borders.h>
#include <CGAL/Surface_mesh_multiresolution/internal/textured/Collapsing_wedges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The texture of a mesh under decimation: what it adds to the costs of collapses, and which of them
// it forbids.
class Texture_layer
{
public:
  static constexpr bool is_active = true;

  typedef Textured_triangle_mesh::Point_2 Point_2;
  typedef Textured_triangle_mesh::Point_3 Point_3;

  // `texture` has its wedges from `with_wedges()`; `mesh` is the same mesh with its vertices in
  // another order, in which they were the vertices `source` of the former, and `rings` are those of
  // `mesh`. Both meshes must live as long as the layer.
  Texture_layer(const Textured_triangle_mesh& texture, const Indexed_triangle_mesh& mesh,
                const std::vector<Vertex_index>& source, const Vertex_rings& rings,
                double deviation_weight)
    : m_uv(texture.uv), m_points(mesh.points), m_wedges(texture, source, rings)
    , m_deviation_weight(deviation_weight)
    , m_deviation(deviation_weight > 0. ? source.size() : 0, 0.f)
  {}

  // From here on no border of a chart may be taken over a corner of another or of its own.
  void keep_borders_simple(const Textured_triangle_mesh& texture);

  // To be called before each pass, by one thread.
  void begin_pass()
  {
    m_borders.update([this](const Chart_border_corner& corner) {
      return m_wedges.is_gone(corner.wedge);
    });
  }

  // Tells where the rings are while the engine changes them.
  void set_rings(const Vertex_rings& rings) { m_wedges.set_rings(rings); }

  // Whether seams keep v where it is.
  bool is_fixed(Vertex_index v) const
  {
    return m_wedges.has_spokes(v)
        && (m_wedges.number_of_spokes(v) != 2 || m_wedges.rings().is_border(v));
  }

  // Whether v, which is not fixed, may go to its neighbour t.
  bool is_target(Vertex_index v, Vertex_index t) const
  {
    return !m_wedges.has_spokes(v) || m_wedges.is_spoke(v, t);
  }

  // What the texture adds to the cost of collapsing v into its ring vertex k, as a length.
  float cost(Vertex_index v, std::uint32_t k) const
  {
    double result = 0.;
    if(m_wedges.has_spokes(v))
      result += std::sqrt(seam_shift(v, k));
    if(m_deviation_weight > 0.)
      result += m_deviation_weight * (deviation(v, k) + double(m_deviation[v]));
    return float(result);
  }

  // Whether charts stay disks, no triangle turns over in the texture and borders stay simple. In
  // this pass the caller is the only one that removes the vertices from `low` to `high`.
  bool is_possible(Vertex_index v, std::uint32_t k, Vertex_index low, Vertex_index high) const
  {
    return leaves_charts(v, k) && leaves_orientations(v, k) && leaves_borders(v, k, low, high);
  }

  // Notes the collapse of v into its ring vertex k. To be called before the rings change.
  void collapse(Vertex_index v, std::uint32_t k);

  // What has become of the wedges.
  const Collapsing_wedges& wedges() const { return m_wedges; }

private:
  typedef Collapsing_wedges::Change Change;

  double seam_shift(Vertex_index v, std::uint32_t k) const;
  double deviation(Vertex_index v, std::uint32_t k) const;
  bool leaves_charts(Vertex_index v, std::uint32_t k) const;
  bool leaves_orientations(Vertex_index v, std::uint32_t k) const;
  bool leaves_borders(Vertex_index v, std::uint32_t k, Vertex_index low, Vertex_index high) const;

  double double_area(Vertex_index p, Vertex_index q, Vertex_index r) const
  {
    return internal::double_area(m_uv[p], m_uv[q], m_uv[r]);
  }

  const std::vector<Point_2>& m_uv;
  const std::vector<Point_3>& m_points;
  Collapsing_wedges m_wedges;
  double m_deviation_weight;
  std::vector<float> m_deviation; // of each vertex: what is lost already
  Chart_borders m_borders;        // as the pass began; none if they need not stay simple
};

// The area by which the collapse moves the seam in the charts, the larger of both, in the units of
// the surface.
inline double Texture_layer::seam_shift(Vertex_index v, std::uint32_t k) const
{
  const double length = squared_distance(m_points[v], m_points[m_wedges.rings().ring(v)[k]]);
  double result = 0.;
  m_wedges.for_each_shortcut(v, k, [&](Vertex_index wedge_v, Vertex_index wedge_t,
                                       Vertex_index wedge_s) {
    const double uv_length = squared_distance(m_uv[wedge_v], m_uv[wedge_t]);
    const double area = 0.5 * std::abs(double_area(wedge_v, wedge_t, wedge_s));
    if(uv_length > 0.)
      result = (std::max)(result, area * length / uv_length);
  });
  return result;
}

// The distance between the point of v and the points that get its texture coordinates: the texture
// deviation (Cohen, Olano, Manocha 1998) at v alone. Where no new triangle has them, the nearest to
// having them counts.
inline double Texture_layer::deviation(Vertex_index v, std::uint32_t k) const
{
  struct Best
  {
    Vertex_index wedge = no_vertex;
    double inside = -1e300, distance = 0.;
  };
  Best sides[2];
  const Point_3& p = m_points[v];
  const Point_3& pt = m_points[m_wedges.rings().ring(v)[k]];
  m_wedges.for_each_change(v, k, [&](const Change& c) {
    const double area = double_area(c.t, c.a, c.b);
    if(area == 0.)
      return;
    const double x = double_area(c.v, c.a, c.b) / area, y = double_area(c.t, c.v, c.b) / area;
    const double z = 1. - x - y, inside = (std::min)({x, y, z});
    Best& best = sides[sides[0].wedge == no_vertex || sides[0].wedge == c.v ? 0 : 1];
    if(inside <= best.inside)
      return;
    const Point_3 &a = m_points[c.vertex_a], &b = m_points[c.vertex_b];
    const Point_3 q(x * pt.x() + y * a.x() + z * b.x(), x * pt.y() + y * a.y() + z * b.y(),
                    x * pt.z() + y * a.z() + z * b.z());
    best = {c.v, inside, std::sqrt(squared_distance(p, q))};
  });
  return (std::max)(sides[0].distance, sides[1].distance);
}

// A chart vanishes with its last triangle, which has no edge that is not its border.
inline bool Texture_layer::leaves_charts(Vertex_index v, std::uint32_t k) const
{
  if(!m_wedges.is_on_chart_border(v))
    return true;
  const Vertex_index* r = m_wedges.rings().ring(v);
  const std::uint32_t d = m_wedges.rings().degree(v);
  const Vertex_index t = r[k], s = m_wedges.other_end(v, t);
  const bool is_ear = r[k + 1 == d ? 0 : k + 1] == s || r[k == 0 ? d - 1 : k - 1] == s;
  return !is_ear || !m_wedges.is_chart_border(s, t);
}

inline bool Texture_layer::leaves_orientations(Vertex_index v, std::uint32_t k) const
{
  bool result = true;
  m_wedges.for_each_change(v, k, [&](const Change& c) {
    result &= !has_turned_over(double_area(c.v, c.a, c.b), double_area(c.t, c.a, c.b));
  });
  return result;
}

inline void Texture_layer::keep_borders_simple(const Textured_triangle_mesh& texture)
{
  std::vector<Chart_border_corner> corners;
  const auto add = [&](Vertex_index wedge, Vertex_index v) {
    if(wedge != no_vertex)
      corners.push_back({m_uv[wedge], wedge, v});
  };
  for(Vertex_index v = 0; v < m_wedges.number_of_vertices(); ++v) {
    for(std::uint32_t i = 0; i < m_wedges.number_of_spokes(v); ++i)
      add(m_wedges.spoke(v, i).wedge, v);
    if(!m_wedges.has_spokes(v) && m_wedges.rings().is_border(v))
      add(m_wedges.only_wedge(v), v);
  }
  m_borders = Chart_borders(std::move(corners), texture.wedges, m_uv);
}

// Corners are only ever removed: those that are there as the pass begins are all that there can be
// when the collapse takes place, in whatever order the threads collapse. Of those that this thread
// may remove in this pass, and no other, it knows which are gone. What the others have done by now
// is not looked at, so that the number of threads makes no difference.
inline bool Texture_layer::leaves_borders(Vertex_index v, std::uint32_t k, Vertex_index low,
                                          Vertex_index high) const
{
  if(m_borders.number_of_corners() == 0 || !m_wedges.is_on_chart_border(v))
    return true;
  bool result = true;
  m_wedges.for_each_shortcut(v, k, [&](Vertex_index wedge_v, Vertex_index wedge_t,
                                       Vertex_index wedge_s) {
    result = result
          && m_borders.is_free({wedge_v, wedge_t, wedge_s}, m_uv,
                               [&](const Chart_border_corner& corner) {
                                 return low <= corner.vertex && corner.vertex < high
                                     && m_wedges.is_gone(corner.wedge);
                               });
  });
  return result;
}

inline void Texture_layer::collapse(Vertex_index v, std::uint32_t k)
{
  const Vertex_index t = m_wedges.rings().ring(v)[k];
  if(m_deviation_weight > 0.)
    m_deviation[t] = (std::max)(m_deviation[t], float(deviation(v, k)) + m_deviation[v]);
  m_wedges.collapse(v, k);
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_TEXTURE_LAYER_H
