// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURE_LAYER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURE_LAYER_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Chart_borders.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Triangles_at_vertices.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Vertex_rings.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The texture of a mesh under decimation: which wedge is at which corner, which edges are seams,
// and what a collapse does to them.
//
// A vertex at the end of a seam edge has a list of *spokes*: its edges that are seams or borders,
// in the order of its ring, each with the wedge of the corners from it to the next.
//
//            s        The wedges of v are w0 (from the spoke t to s) and w1 (from s to t). Vertices
//        w1  |  w1    off the seams have one wedge and no spokes.
//      t --- v
//          w0
//
// The number of spokes of a vertex never changes: v goes along a seam only, and its other spoke
// takes the place of the one that is lost. Vertices on seams with another number than two stay.
class Texture_layer
{
public:
  static constexpr bool is_textured = true;

  typedef Textured_triangle_mesh::Point_2 Point_2;
  typedef Textured_triangle_mesh::Point_3 Point_3;

  // `texture` has its wedges from `with_wedges()`; `mesh` is the same mesh with its vertices in
  // another order, in which they were the vertices `source` of the former, and `rings` are those of
  // `mesh`. Both meshes must live as long as the layer.
  Texture_layer(const Textured_triangle_mesh& texture, const Indexed_triangle_mesh& mesh,
                const std::vector<Vertex_index>& source, const Vertex_rings& rings,
                double deviation_weight);

  // From here on no border of a chart may be taken over a corner of another or of its own.
  void keep_borders_simple(const Textured_triangle_mesh& texture);

  // To be called before each pass, by one thread.
  void begin_pass()
  {
    m_borders.update([this](const Chart_border_corner& corner) { return is_gone(corner.wedge); });
  }

  // Tells where the rings are while the engine changes them.
  void set_rings(const Vertex_rings& rings) { m_rings = &rings; }

  // Whether seams keep v where it is.
  bool is_fixed(Vertex_index v) const
  {
    return has_spokes(v) && (number_of_spokes(v) != 2 || m_rings->is_border(v));
  }

  // Whether v, which is not fixed, may go to its neighbour t.
  bool is_target(Vertex_index v, Vertex_index t) const
  {
    return !has_spokes(v) || is_spoke(v, t);
  }

  // What the texture adds to the cost of collapsing v into its ring vertex k, as a length.
  float cost(Vertex_index v, std::uint32_t k) const
  {
    double result = 0.;
    if(has_spokes(v))
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

  // Calls use(wedge, the wedge into which it has collapsed) for the wedges of a removed vertex.
  template <class Use>
  void for_each_collapse(Vertex_index v, const Use& use) const
  {
    if(!has_spokes(v))
      use(m_wedge[v], m_kept_wedge[m_wedge[v]]);
    for(std::uint32_t i = 0; i < number_of_spokes(v); ++i)
      use(spoke(v, i).wedge, m_kept_wedge[spoke(v, i).wedge]);
  }

private:
  struct Spoke
  {
    Vertex_index neighbor;
    Vertex_index wedge; // `no_vertex` behind the last border edge
  };

  // A triangle (v, a, b) that a collapse turns into (t, a, b), by its wedges and vertices.
  struct Change
  {
    Vertex_index v, t, a, b;
    Vertex_index vertex_a, vertex_b;
  };

  // The wedges of the target of a collapse: in the triangle behind the edge from the removed vertex,
  // as rings count, and in the one ahead of it. At a border there is only one triangle, which is both.
  struct Target_wedges
  {
    Vertex_index behind, ahead;
  };

  Target_wedges target_wedges(Vertex_index v, std::uint32_t k) const;
  void find_wedges(const Textured_triangle_mesh& texture, const std::vector<Vertex_index>& source);

  template <class Use>
  void for_each_change(Vertex_index v, std::uint32_t k, const Use& use) const;

  bool has_spokes(Vertex_index v) const { return m_begin[v] != m_begin[v + 1]; }
  std::uint32_t number_of_spokes(Vertex_index v) const { return m_begin[v + 1] - m_begin[v]; }
  const Spoke& spoke(Vertex_index v, std::uint32_t i) const { return m_spokes[m_begin[v] + i]; }
  const Spoke* find_spoke(Vertex_index v, Vertex_index neighbor) const;
  bool is_spoke(Vertex_index v, Vertex_index w) const { return find_spoke(v, w) != nullptr; }
  bool is_chart_border(Vertex_index v, Vertex_index w) const;
  Vertex_index wedge_behind(Vertex_index v, Vertex_index neighbor) const;
  Vertex_index other_end(Vertex_index v, Vertex_index t) const;
  void replace_spoke(Vertex_index v, Vertex_index neighbor, Vertex_index other);
  template <class Use>
  void for_each_shortcut(Vertex_index v, std::uint32_t k, const Use& use) const;
  bool is_gone(Vertex_index wedge) const { return m_kept_wedge[wedge] != no_vertex; }
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
  const Vertex_rings* m_rings;
  double m_deviation_weight;
  std::vector<Vertex_index> m_wedge;  // of each vertex without spokes
  std::vector<std::uint32_t> m_begin; // of the spokes of each vertex
  std::vector<Spoke> m_spokes;
  std::vector<Vertex_index> m_kept_wedge; // of each wedge that is gone
  std::vector<float> m_deviation;         // of each vertex: what is lost already
  Chart_borders m_borders;                // as the pass began; none if they need not stay simple
};

inline Texture_layer::Texture_layer(const Textured_triangle_mesh& texture,
                                    const Indexed_triangle_mesh& mesh,
                                    const std::vector<Vertex_index>& source,
                                    const Vertex_rings& rings, double deviation_weight)
  : m_uv(texture.uv), m_points(mesh.points), m_rings(&rings)
  , m_deviation_weight(deviation_weight)
  , m_wedge(source.size(), no_vertex), m_begin(source.size() + 1, 0)
  , m_kept_wedge(texture.uv.size(), no_vertex)
  , m_deviation(deviation_weight > 0. ? source.size() : 0, 0.f)
{
  find_wedges(texture, source);
}

// Gives each vertex its wedge or its spokes.
inline void Texture_layer::find_wedges(const Textured_triangle_mesh& texture,
                                       const std::vector<Vertex_index>& source)
{
  const Triangles_at_vertices corners(texture.triangles, texture.points.size());
  const auto wedge_behind = [&](Vertex_index v, Vertex_index neighbor) {
    for(const std::uint32_t* c = corners.begin(source[v]); c != corners.end(source[v]); ++c)
      if(texture.triangles[*c / 3][(*c + 1) % 3] == source[neighbor])
        return texture.wedges[*c / 3][*c % 3];
    return no_vertex;
  };
  // Seams as seen from the ends where the wedges differ
  typedef std::pair<Vertex_index, Vertex_index> Edge;
  std::vector<Edge> seams;
  for(Vertex_index v = 0; v < source.size(); ++v) {
    const std::uint32_t* first = corners.begin(source[v]);
    m_wedge[v] = texture.wedges[*first / 3][*first % 3];
    if(std::all_of(first, corners.end(source[v]), [&](std::uint32_t c) {
         return texture.wedges[c / 3][c % 3] == m_wedge[v];
       }))
      continue;
    const std::uint32_t d = m_rings->degree(v);
    const Vertex_index* r = m_rings->ring(v);
    for(std::uint32_t i = m_rings->is_border(v) ? 1 : 0; i < d; ++i) {
      if(m_rings->is_border(v) && i + 1 == d)
        break;
      if(wedge_behind(v, r[i]) != wedge_behind(v, r[i == 0 ? d - 1 : i - 1])) {
        seams.push_back({v, r[i]});
        seams.push_back({r[i], v});
      }
    }
  }
  std::sort(seams.begin(), seams.end());
  seams.erase(std::unique(seams.begin(), seams.end()), seams.end());
  auto seam = seams.begin();
  for(Vertex_index v = 0; v < source.size(); ++v) {
    const auto first = seam;
    while(seam != seams.end() && seam->first == v)
      ++seam;
    const std::uint32_t d = m_rings->degree(v);
    for(std::uint32_t i = 0; i < d && first != seam; ++i) {
      const Vertex_index w = m_rings->ring(v)[i];
      const bool is_border = m_rings->is_border(v) && (i == 0 || i + 1 == d);
      if(is_border || std::binary_search(first, seam, Edge(v, w)))
        m_spokes.push_back({w, wedge_behind(v, w)});
    }
    m_begin[v + 1] = std::uint32_t(m_spokes.size());
  }
}

inline const Texture_layer::Spoke* Texture_layer::find_spoke(Vertex_index v,
                                                             Vertex_index neighbor) const
{
  for(std::uint32_t i = m_begin[v]; i < m_begin[v + 1]; ++i)
    if(m_spokes[i].neighbor == neighbor)
      return &m_spokes[i];
  return nullptr;
}

// The wedge of v in the triangle (v, neighbor, next in the ring).
inline Vertex_index Texture_layer::wedge_behind(Vertex_index v, Vertex_index neighbor) const
{
  if(!has_spokes(v))
    return m_wedge[v];
  const Vertex_index* r = m_rings->ring(v);
  const std::uint32_t d = m_rings->degree(v);
  std::uint32_t i = std::uint32_t(std::find(r, r + d, neighbor) - r);
  while(true) {
    if(const Spoke* found = find_spoke(v, r[i]))
      return found->wedge;
    i = i == 0 ? d - 1 : i - 1;
  }
}

inline bool Texture_layer::is_chart_border(Vertex_index v, Vertex_index w) const
{
  const Vertex_index* r = m_rings->ring(v);
  if(m_rings->is_border(v) && (r[0] == w || r[m_rings->degree(v) - 1] == w))
    return true;
  return is_spoke(v, w) || is_spoke(w, v);
}

// The other neighbour than t along the seam or border that v is on.
inline Vertex_index Texture_layer::other_end(Vertex_index v, Vertex_index t) const
{
  if(has_spokes(v))
    return spoke(v, spoke(v, 0).neighbor == t ? 1 : 0).neighbor;
  const Vertex_index* r = m_rings->ring(v);
  return r[0] == t ? r[m_rings->degree(v) - 1] : r[0];
}

inline Texture_layer::Target_wedges Texture_layer::target_wedges(Vertex_index v,
                                                                 std::uint32_t k) const
{
  const Vertex_index* r = m_rings->ring(v);
  const std::uint32_t d = m_rings->degree(v);
  const bool is_open = m_rings->is_border(v);
  const auto behind = [&] { return wedge_behind(r[k], r[k + 1 == d ? 0 : k + 1]); };
  const auto ahead = [&] { return wedge_behind(r[k], v); };
  if(is_open && k + 1 == d)
    return {ahead(), ahead()};
  if(is_open && k == 0)
    return {behind(), behind()};
  return {behind(), ahead()};
}

// Calls use(change) for each triangle of v that survives the collapse into ring vertex k.
template <class Use>
void Texture_layer::for_each_change(Vertex_index v, std::uint32_t k, const Use& use) const
{
  const Vertex_index* r = m_rings->ring(v);
  const std::uint32_t d = m_rings->degree(v);
  const bool is_open = m_rings->is_border(v);
  const Vertex_index t = r[k];
  const Target_wedges target = target_wedges(v, k);
  Vertex_index wedge_v = has_spokes(v) ? find_spoke(v, t)->wedge : m_wedge[v];
  Vertex_index wedge_t = target.behind;
  for(std::uint32_t step = 0; step < d; ++step) {
    const std::uint32_t i = (k + step) % d;
    const Vertex_index a = r[i], b = r[i + 1 == d ? 0 : i + 1];
    if(step > 0 && has_spokes(v) && is_spoke(v, a)) { // the other chart begins
      wedge_v = find_spoke(v, a)->wedge;
      wedge_t = target.ahead;
    }
    if(a != t && b != t && !(is_open && i + 1 == d))
      use(Change{wedge_v, wedge_t, wedge_behind(a, b), wedge_behind(b, v), a, b});
  }
}

// Calls use(wedge of v, of t, of s) for each chart whose border goes from t to s instead of over v
// after the collapse into ring vertex k, which is t. Precondition: v is on a seam or border.
template <class Use>
void Texture_layer::for_each_shortcut(Vertex_index v, std::uint32_t k, const Use& use) const
{
  const Vertex_index* r = m_rings->ring(v);
  const std::uint32_t d = m_rings->degree(v);
  const Vertex_index t = r[k], s = other_end(v, t);
  const Target_wedges target = target_wedges(v, k);
  if(!has_spokes(v)) {
    use(m_wedge[v], target.behind, wedge_behind(s, s == r[0] ? r[1] : v));
    return;
  }
  const std::uint32_t j = std::uint32_t(std::find(r, r + d, s) - r);
  use(find_spoke(v, t)->wedge, target.behind, wedge_behind(s, v));
  use(find_spoke(v, s)->wedge, target.ahead, wedge_behind(s, r[j + 1 == d ? 0 : j + 1]));
}

// The area by which the collapse moves the seam in the charts, the larger of both, in the units of
// the surface.
inline double Texture_layer::seam_shift(Vertex_index v, std::uint32_t k) const
{
  const double length = squared_distance(m_points[v], m_points[m_rings->ring(v)[k]]);
  double result = 0.;
  for_each_shortcut(v, k, [&](Vertex_index wedge_v, Vertex_index wedge_t, Vertex_index wedge_s) {
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
  const Point_3& pt = m_points[m_rings->ring(v)[k]];
  for_each_change(v, k, [&](const Change& c) {
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
  if(!has_spokes(v) && !m_rings->is_border(v))
    return true;
  const Vertex_index* r = m_rings->ring(v);
  const std::uint32_t d = m_rings->degree(v);
  const Vertex_index t = r[k], s = other_end(v, t);
  const bool is_ear = r[k + 1 == d ? 0 : k + 1] == s || r[k == 0 ? d - 1 : k - 1] == s;
  return !is_ear || !is_chart_border(s, t);
}

inline bool Texture_layer::leaves_orientations(Vertex_index v, std::uint32_t k) const
{
  bool result = true;
  for_each_change(v, k, [&](const Change& c) {
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
  for(Vertex_index v = 0; v < m_wedge.size(); ++v) {
    for(std::uint32_t i = 0; i < number_of_spokes(v); ++i)
      add(spoke(v, i).wedge, v);
    if(!has_spokes(v) && m_rings->is_border(v))
      add(m_wedge[v], v);
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
  if(m_borders.number_of_corners() == 0 || (!has_spokes(v) && !m_rings->is_border(v)))
    return true;
  bool result = true;
  for_each_shortcut(v, k, [&](Vertex_index wedge_v, Vertex_index wedge_t, Vertex_index wedge_s) {
    result = result
          && m_borders.is_free({wedge_v, wedge_t, wedge_s}, m_uv,
                               [&](const Chart_border_corner& corner) {
                                 return low <= corner.vertex && corner.vertex < high
                                     && is_gone(corner.wedge);
                               });
  });
  return result;
}

inline void Texture_layer::replace_spoke(Vertex_index v, Vertex_index neighbor, Vertex_index other)
{
  for(std::uint32_t i = m_begin[v]; i < m_begin[v + 1]; ++i)
    if(m_spokes[i].neighbor == neighbor)
      m_spokes[i].neighbor = other;
}

inline void Texture_layer::collapse(Vertex_index v, std::uint32_t k)
{
  const Vertex_index t = m_rings->ring(v)[k];
  if(m_deviation_weight > 0.)
    m_deviation[t] = (std::max)(m_deviation[t], float(deviation(v, k)) + m_deviation[v]);
  const Target_wedges target = target_wedges(v, k);
  if(has_spokes(v)) {
    m_kept_wedge[find_spoke(v, t)->wedge] = target.behind;
    m_kept_wedge[find_spoke(v, other_end(v, t))->wedge] = target.ahead;
  } else {
    m_kept_wedge[m_wedge[v]] = target.behind;
  }
  if(has_spokes(v) || m_rings->is_border(v)) {
    const Vertex_index s = other_end(v, t);
    replace_spoke(s, v, t);
    replace_spoke(t, v, s);
  }
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURE_LAYER_H
