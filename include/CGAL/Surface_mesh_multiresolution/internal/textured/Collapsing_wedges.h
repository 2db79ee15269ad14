// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_COLLAPSING_WEDGES_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_COLLAPSING_WEDGES_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The wedges of a mesh under decimation: which one is at which corner, which edges are seams, and
// what collapses leave of them.
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
class Collapsing_wedges
{
public:
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

  // `texture` has its wedges from `with_wedges()`, so that an edge `is_smooth()` just if its indices
  // are the same on both sides; `source` has for each vertex of the rings its number in `texture`.
  Collapsing_wedges(const Textured_triangle_mesh& texture, const std::vector<Vertex_index>& source,
                    const Vertex_rings& rings)
    : m_rings(&rings), m_wedge(source.size(), no_vertex), m_begin(source.size() + 1, 0)
    , m_kept_wedge(texture.uv.size(), no_vertex)
  {
    find_wedges(texture, source);
  }

  // Tells where the rings are while the engine changes them.
  void set_rings(const Vertex_rings& rings) { m_rings = &rings; }
  const Vertex_rings& rings() const { return *m_rings; }
  std::size_t number_of_vertices() const { return m_wedge.size(); }

  bool has_spokes(Vertex_index v) const { return m_begin[v] != m_begin[v + 1]; }
  std::uint32_t number_of_spokes(Vertex_index v) const { return m_begin[v + 1] - m_begin[v]; }
  const Spoke& spoke(Vertex_index v, std::uint32_t i) const { return m_spokes[m_begin[v] + i]; }
  bool is_spoke(Vertex_index v, Vertex_index w) const { return find_spoke(v, w) != nullptr; }

  // The wedge of a vertex without spokes.
  Vertex_index only_wedge(Vertex_index v) const { return m_wedge[v]; }

  bool is_on_chart_border(Vertex_index v) const { return has_spokes(v) || m_rings->is_border(v); }
  bool is_chart_border(Vertex_index v, Vertex_index w) const;

  // The other neighbour than t along the seam or border that v is on.
  Vertex_index other_end(Vertex_index v, Vertex_index t) const;

  // Calls use(change) for each triangle of v that survives the collapse into ring vertex k.
  template <class Use>
  void for_each_change(Vertex_index v, std::uint32_t k, const Use& use) const;

  // Calls use(wedge of v, of t, of s) for each chart whose border goes from t to s instead of over
  // v after the collapse into ring vertex k, which is t. Precondition: v is on a seam or border.
  template <class Use>
  void for_each_shortcut(Vertex_index v, std::uint32_t k, const Use& use) const;

  // Notes the collapse of v into its ring vertex k. To be called before the rings change.
  void collapse(Vertex_index v, std::uint32_t k);

  bool is_gone(Vertex_index wedge) const { return m_kept_wedge[wedge] != no_vertex; }

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
  // The wedges of the target of a collapse: in the triangle behind the edge from the removed
  // vertex, as rings count, and in the one ahead of it. At a border there is only one triangle,
  // which is both.
  struct Target_wedges
  {
    Vertex_index behind, ahead;
  };

  void find_wedges(const Textured_triangle_mesh& texture, const std::vector<Vertex_index>& source);
  const Spoke* find_spoke(Vertex_index v, Vertex_index neighbor) const;
  Vertex_index wedge_behind(Vertex_index v, Vertex_index neighbor) const;
  Target_wedges target_wedges(Vertex_index v, std::uint32_t k) const;
  void replace_spoke(Vertex_index v, Vertex_index neighbor, Vertex_index other);

  const Vertex_rings* m_rings;
  std::vector<Vertex_index> m_wedge;  // of each vertex without spokes
  std::vector<std::uint32_t> m_begin; // of the spokes of each vertex
  std::vector<Spoke> m_spokes;
  std::vector<Vertex_index> m_kept_wedge; // of each wedge that is gone
};

// Gives each vertex its wedge or its spokes.
inline void Collapsing_wedges::find_wedges(const Textured_triangle_mesh& texture,
                                           const std::vector<Vertex_index>& source)
{
  const Triangles_at_vertices corners(texture.triangles, texture.points.size());
  const auto wedge_behind = [&](Vertex_index v, Vertex_index neighbor) {
    for(const std::uint32_t* c = corners.begin(source[v]); c != corners.end(source[v]); ++c)
      if(vertex_of(texture.triangles, next_halfedge(*c)) == source[neighbor])
        return vertex_of(texture.wedges, *c);
    return no_vertex;
  };
  // Seams as seen from the ends where the wedges differ
  typedef std::pair<Vertex_index, Vertex_index> Edge;
  std::vector<Edge> seams;
  for(Vertex_index v = 0; v < source.size(); ++v) {
    const std::uint32_t* first = corners.begin(source[v]);
    m_wedge[v] = vertex_of(texture.wedges, *first);
    if(std::all_of(first, corners.end(source[v]), [&](std::uint32_t c) {
         return vertex_of(texture.wedges, c) == m_wedge[v];
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

inline const Collapsing_wedges::Spoke* Collapsing_wedges::find_spoke(Vertex_index v,
                                                                     Vertex_index neighbor) const
{
  for(std::uint32_t i = m_begin[v]; i < m_begin[v + 1]; ++i)
    if(m_spokes[i].neighbor == neighbor)
      return &m_spokes[i];
  return nullptr;
}

// The wedge of v in the triangle (v, neighbor, next in the ring).
inline Vertex_index Collapsing_wedges::wedge_behind(Vertex_index v, Vertex_index neighbor) const
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

inline bool Collapsing_wedges::is_chart_border(Vertex_index v, Vertex_index w) const
{
  const Vertex_index* r = m_rings->ring(v);
  if(m_rings->is_border(v) && (r[0] == w || r[m_rings->degree(v) - 1] == w))
    return true;
  return is_spoke(v, w) || is_spoke(w, v);
}

inline Vertex_index Collapsing_wedges::other_end(Vertex_index v, Vertex_index t) const
{
  if(has_spokes(v))
    return spoke(v, spoke(v, 0).neighbor == t ? 1 : 0).neighbor;
  const Vertex_index* r = m_rings->ring(v);
  return r[0] == t ? r[m_rings->degree(v) - 1] : r[0];
}

inline Collapsing_wedges::Target_wedges Collapsing_wedges::target_wedges(Vertex_index v,
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

template <class Use>
void Collapsing_wedges::for_each_change(Vertex_index v, std::uint32_t k, const Use& use) const
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

template <class Use>
void Collapsing_wedges::for_each_shortcut(Vertex_index v, std::uint32_t k, const Use& use) const
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

inline void Collapsing_wedges::replace_spoke(Vertex_index v, Vertex_index neighbor,
                                             Vertex_index other)
{
  for(std::uint32_t i = m_begin[v]; i < m_begin[v + 1]; ++i)
    if(m_spokes[i].neighbor == neighbor)
      m_spokes[i].neighbor = other;
}

inline void Collapsing_wedges::collapse(Vertex_index v, std::uint32_t k)
{
  const Vertex_index t = m_rings->ring(v)[k];
  const Target_wedges target = target_wedges(v, k);
  if(has_spokes(v)) {
    m_kept_wedge[find_spoke(v, t)->wedge] = target.behind;
    m_kept_wedge[find_spoke(v, other_end(v, t))->wedge] = target.ahead;
  } else {
    m_kept_wedge[m_wedge[v]] = target.behind;
  }
  if(is_on_chart_border(v)) {
    const Vertex_index s = other_end(v, t);
    replace_spoke(s, v, t);
    replace_spoke(t, v, s);
  }
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_COLLAPSING_WEDGES_H
