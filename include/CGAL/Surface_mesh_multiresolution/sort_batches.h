// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_SORT_BATCHES_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_SORT_BATCHES_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// New numbers for the wedges of a mesh that are the order of `sort_batches()`.
//
// A group is the wedges of a vertex that splits make, one or two, which stay together; it has the
// number of its first wedge. Any order of the collapses of a batch leads to the same level, but one
// collapse may keep a manifold only if another took place before. So the order is tried, collapse
// by collapse from the fine mesh on, and groups that cannot go are late: they go when all others of
// the batch are gone.
class Batch_sorter
{
public:
  explicit Batch_sorter(const Textured_progressive_mesh& mesh);

  // Returns whether there is an order.
  bool run();

  // The new number of each wedge.
  const std::vector<Vertex_index>& numbers() const { return m_number; }

private:
  struct Batch
  {
    Vertex_index begin, end;         // wedges
    std::vector<Vertex_index> late;  // groups, in the order of their splits
  };

  template <class Use>
  void for_group(Vertex_index first, const Batch& batch, const Use& use) const
  {
    for(Vertex_index w = first; w < batch.end && m_mesh.vertex[w] == m_mesh.vertex[first]; ++w)
      use(w);
  }

  void set_generations(const Batch& batch);
  void sort(Batch& batch);
  bool collapse(Vertex_index first, const Batch& batch, Vertex_rings& rings);
  bool try_order(Batch& batch, Vertex_rings& rings);

  const Textured_progressive_mesh& m_mesh;
  std::vector<Batch> m_batches; // the coarsest first
  std::vector<Vertex_index> m_number;
  std::vector<std::uint32_t> m_generation; // 0: the parents are older than the batch
  std::vector<std::uint32_t> m_children;   // that are still there, of the same batch
  std::vector<bool> m_is_late;
};

inline Batch_sorter::Batch_sorter(const Textured_progressive_mesh& mesh)
  : m_mesh(mesh), m_number(mesh.number_of_wedges()), m_generation(mesh.number_of_wedges(), 0)
  , m_children(mesh.number_of_wedges(), 0), m_is_late(mesh.number_of_wedges(), false)
{
  std::iota(m_number.begin(), m_number.end(), Vertex_index(0));
  const std::vector<std::size_t>& ends = mesh.progressive_mesh.batch_ends;
  const std::size_t n = mesh.number_of_wedges();
  for(std::size_t i = ends.size(); i-- > 0;)
    m_batches.push_back(
      {Vertex_index(n - ends[i]), Vertex_index(n - (i == 0 ? 0 : ends[i - 1])), {}});
  for(const Batch& batch : m_batches)
    set_generations(batch);
}

inline void Batch_sorter::set_generations(const Batch& batch)
{
  for(Vertex_index w = batch.begin; w < batch.end; ++w) {
    const Vertex_index parent = m_mesh.parent(w);
    if(parent >= batch.begin)
      m_generation[w] = m_generation[parent] + 1;
    if(w > batch.begin && m_mesh.vertex[w] == m_mesh.vertex[w - 1]) // its parents share a vertex
      m_generation[w] = m_generation[w - 1] = (std::max)(m_generation[w], m_generation[w - 1]);
  }
}

// Numbers the late groups first, then generation by generation by the numbers of the parents.
inline void Batch_sorter::sort(Batch& batch)
{
  typedef std::pair<Vertex_index, Vertex_index> Entry; // number of the parent, group
  std::vector<std::vector<Entry>> generations;
  Vertex_index next = batch.begin;
  const auto append = [&](Vertex_index first) {
    for_group(first, batch, [&](Vertex_index w) { m_number[w] = next++; });
  };
  for(const Vertex_index first : batch.late)
    append(first);
  for(Vertex_index w = batch.begin; w < batch.end; ++w)
    if((w == batch.begin || m_mesh.vertex[w] != m_mesh.vertex[w - 1]) && !m_is_late[w]) {
      generations.resize((std::max)(generations.size(), std::size_t(m_generation[w]) + 1));
      generations[m_generation[w]].push_back({0, w});
    }
  for(std::vector<Entry>& entries : generations) {
    for(Entry& entry : entries)
      entry.first = m_number[m_mesh.parent(entry.second)];
    std::sort(entries.begin(), entries.end());
    for(const Entry& entry : entries)
      append(entry.second);
  }
}

// Collapses the wedges of a group, if all of them can.
inline bool Batch_sorter::collapse(Vertex_index first, const Batch& batch, Vertex_rings& rings)
{
  std::size_t gone = 0;
  bool is_valid = true;
  for_group(first, batch, [&](Vertex_index w) {
    const Vertex_index* ring = rings.ring(w);
    const std::uint32_t degree = rings.degree(w);
    const auto k = std::uint32_t(std::find(ring, ring + degree, m_mesh.parent(w)) - ring);
    is_valid = is_valid && m_children[w] == 0 && k < degree && rings.is_collapse_valid(w, k);
    if(is_valid) {
      rings.collapse(w, k);
      ++gone;
    }
  });
  if(!is_valid && gone > 0) // a group has two wedges at most
    rings.split(first, m_mesh.parent(first));
  if(!is_valid)
    return false;
  for_group(first, batch, [&](Vertex_index w) {
    if(m_mesh.parent(w) >= batch.begin)
      --m_children[m_mesh.parent(w)];
  });
  return true;
}

// Goes through a batch and finds the groups that are late. Returns whether all went at last.
inline bool Batch_sorter::try_order(Batch& batch, Vertex_rings& rings)
{
  std::vector<Vertex_index> waiting(batch.end - batch.begin);
  for(Vertex_index w = batch.begin; w < batch.end; ++w) {
    waiting[batch.end - 1 - m_number[w]] = w;
    if(m_mesh.parent(w) >= batch.begin)
      ++m_children[m_mesh.parent(w)];
  }
  // Groups, the last split first
  waiting.erase(std::remove_if(waiting.begin(), waiting.end(), [&](Vertex_index w) {
    return w > batch.begin && m_mesh.vertex[w] == m_mesh.vertex[w - 1];
  }), waiting.end());
  std::vector<Vertex_index> late;
  bool is_first_pass = true, has_progress = true;
  while(!waiting.empty() && has_progress) {
    std::vector<Vertex_index> left;
    for(const Vertex_index first : waiting)
      if(!collapse(first, batch, rings))
        left.push_back(first);
      else if(!is_first_pass || m_is_late[first])
        late.push_back(first);
    has_progress = left.size() < waiting.size();
    is_first_pass = false;
    waiting.swap(left);
  }
  for(const Vertex_index first : late)
    m_is_late[first] = true;
  batch.late.assign(late.rbegin(), late.rend());
  return waiting.empty();
}

inline bool Batch_sorter::run()
{
  const auto number_of_late = [this] {
    return std::count(m_is_late.begin(), m_is_late.end(), true);
  };
  for(const Batch& batch : m_batches) // a batch that parts two wedges of a vertex cannot be sorted
    if(batch.begin > 0 && batch.begin < m_mesh.number_of_wedges()
       && m_mesh.vertex[batch.begin] == m_mesh.vertex[batch.begin - 1])
      return false;
  for(int trial = 0; trial < 4; ++trial) { // late groups number others anew, which may be late then
    for(Batch& batch : m_batches)
      sort(batch);
    const auto before = number_of_late();
    Indexed_triangle_mesh wedges;
    wedges.triangles = m_mesh.progressive_mesh.triangles;
    wedges.points.resize(m_mesh.number_of_wedges());
    Vertex_rings rings(wedges);
    if(rings.defect() != Ring_defect::NONE)
      return false;
    for(auto batch = m_batches.rbegin(); batch != m_batches.rend(); ++batch)
      if(!try_order(*batch, rings))
        return false;
    if(number_of_late() == before)
      return true;
  }
  return false;
}

} // namespace internal

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns `mesh` with the splits of each batch in the order of their parents: the same levels at all
`batch_ends`, and other ones between them. Such a mesh is what a progressive mesh file has, as its
parents take a quarter of the bits; it also reads and refines from one end of the memory to the other.
Wedges, vertices and triangles are numbered anew as `coarse_first()` does.

A split whose parent is made in the same batch comes behind all others, and one that only goes
before others that keep a manifold comes first. `mesh` is returned as it is if there is no such
order, if its collapses do not keep manifolds, and without `batch_ends`.

Expected time \f$ O(n \log n) \f$.
*/
inline Textured_progressive_mesh sort_batches(const Textured_progressive_mesh& mesh)
{
  const std::size_t n = mesh.number_of_wedges();
  if(mesh.progressive_mesh.batch_ends.empty())
    return mesh;
  internal::Batch_sorter sorter(mesh);
  if(!sorter.run())
    return mesh;
  Textured_progressive_mesh result = mesh;
  for(const Halfedge_collapse& c : mesh.progressive_mesh.collapses)
    result.progressive_mesh.collapses[n - 1 - sorter.numbers()[c.removed]] = c;
  return coarse_first(result);
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_SORT_BATCHES_H
