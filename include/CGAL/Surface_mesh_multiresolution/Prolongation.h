// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROLONGATION_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROLONGATION_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <complex>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMMultiresolution
/// How the vertices that a coarse level does not have get their values.
enum class Prolongation_rule
{
  WALK,  ///< from the nearest triangle of the coarse level, found by a walk from the ancestor
  VSPLIT ///< from the nearest triangle at the time of the vertex split (Ray and Lévy 2003, 4.1)
};
namespace internal {

// The real numbers that an entry of a vector is multiplied by: the entry's own type, that of its
// parts if it is complex, `Scalar` of a small vector of Eigen.
template <class Value, class = void>
struct Real_of { typedef Value type; };
template <class Real>
struct Real_of<std::complex<Real>> { typedef Real type; };
template <class Value>
struct Real_of<Value, std::void_t<typename Value::Scalar>> { typedef typename Value::Scalar type; };

template <class Vector>
using Real_of_entries = typename Real_of<std::decay_t<decltype(std::declval<Vector>()[0])>>::type;

} // namespace internal

/*!
\ingroup PkgHLSCMMultiresolution

The class `Prolongation` takes values at the vertices of a coarse level to a fine one: a vertex that
both have keeps its value, every other gets a convex combination of three vertices whose values are
known by then. Indices are those of the fine level.

\cgalModels{MultigridTransfer}
*/
class Prolongation
{
public:
  /// Where a vertex that the coarse level does not have gets its value from.
  struct Stencil
  {
    Vertex_index vertex;                ///< the vertex
    std::array<Vertex_index, 3> source; ///< three others
    std::array<float, 3> weight;        ///< their weights, non-negative, with the sum 1
  };

  Prolongation() {}

  /// Constructs the operator.
  ///
  /// \param kept for each coarse vertex its index in the fine level, ascending
  /// \param stencils for each of the other vertices of the fine level where its value comes from,
  ///        in an order in which each refers only to kept vertices and to those of stencils before
  ///        it
  Prolongation(std::vector<Vertex_index> kept, std::vector<Stencil> stencils);

  /// Returns for each coarse vertex its index in the fine level.
  const std::vector<Vertex_index>& kept() const { return m_kept; }

  /// Returns the stencils of the other vertices.
  const std::vector<Stencil>& stencils() const { return m_stencils; }

  /// Returns the number of vertices of the fine level.
  std::size_t number_of_fine_vertices() const { return m_kept.size() + m_stencils.size(); }

  /// Returns the bytes that it takes.
  std::size_t memory() const
  {
    return m_kept.size() * sizeof(Vertex_index) + m_stencils.size() * sizeof(Stencil)
           + m_begin.size() * sizeof(std::uint32_t) + m_terms.size() * sizeof(Term);
  }

  /// Returns the coarse vertex from which a fine one gets the most, in indices of the coarse level.
  /// Linear time at worst.
  Vertex_index heaviest_source(Vertex_index fine) const;

  /// Returns whether all sources of stencils are kept vertices, as by `Prolongation_rule::WALK`.
  bool is_direct() const { return m_is_direct; }

  /// Calls `use(i, w)` for each fine vertex `i` that gets `w` times the value of the coarse vertex
  /// `j`: the entries of column `j` of \f$ P \f$, first that of the vertex itself. Precondition:
  /// `is_direct()`.
  template <class Use>
  void for_each_fine_vertex(Vertex_index j, const Use& use) const
  {
    use(m_kept[j], 1.f);
    for(std::uint32_t t = m_begin[j]; t < m_begin[j + 1]; ++t)
      use(m_terms[t].vertex, m_terms[t].weight);
  }

  /// Sets `fine` to \f$ P \f$ times `coarse`, vectors of real or complex numbers or of small
  /// vectors of Eigen.
  template <class Vector>
  void prolongate(const Vector& coarse, Vector& fine) const;

  /// Sets `coarse` to \f$ P^T \f$ times `fine`, which is used as work space.
  template <class Vector>
  void restrict_in_place(Vector& fine, Vector& coarse) const;

private:
  static constexpr std::size_t block_size = 16384;

  struct Term // of a row of the transpose; by the stencils it would take half the bytes and twice the time
  {
    Vertex_index vertex;
    float weight;
  };

  template <class Vector>
  static void apply(const Stencil& s, Vector& fine)
  {
    typedef internal::Real_of_entries<Vector> Real;
    fine[s.vertex] = Real(s.weight[0]) * fine[s.source[0]] + Real(s.weight[1]) * fine[s.source[1]]
                   + Real(s.weight[2]) * fine[s.source[2]];
  }

  void transpose();

  std::vector<Vertex_index> m_kept;
  std::vector<Stencil> m_stencils;
  // If all sources are kept vertices: for each coarse vertex the fine ones that it is a source of.
  bool m_is_direct = false;
  Blocked_execution::Uninitialized_vector<std::uint32_t> m_begin;
  Blocked_execution::Uninitialized_vector<Term> m_terms;
};

inline Prolongation::Prolongation(std::vector<Vertex_index> kept, std::vector<Stencil> stencils)
  : m_kept(std::move(kept)), m_stencils(std::move(stencils))
{
  transpose();
}

inline void Prolongation::transpose()
{
  const std::vector<Vertex_index> rank = Indexed_mesh::ranks(m_kept, number_of_fine_vertices());
  std::atomic<bool> is_direct(true);
  Blocked_execution::blocked_for(m_stencils.size(), block_size,
                                 [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      for(const Vertex_index v : m_stencils[i].source)
        if(rank[v] == no_vertex)
          is_direct = false;
  });
  m_is_direct = is_direct;
  if(!m_is_direct)
    return;
  const auto for_each_term = [&](const auto& use) {
    for(const Stencil& s : m_stencils)
      for(int c = 0; c < 3; ++c)
        use(rank[s.source[c]], Term{s.vertex, s.weight[c]});
  };
  m_begin = Blocked_execution::sort_by_key(
    m_kept.size(), for_each_term, [this](std::size_t count) { m_terms.resize(count); },
    [this](std::uint32_t i, const Term& term) { m_terms[i] = term; });
}

inline Vertex_index Prolongation::heaviest_source(Vertex_index fine) const
{
  for(;;) {
    const auto kept = std::lower_bound(m_kept.begin(), m_kept.end(), fine);
    if(kept != m_kept.end() && *kept == fine)
      return Vertex_index(kept - m_kept.begin());
    const auto is_its = [fine](const Stencil& s) { return s.vertex == fine; };
    auto s = std::lower_bound(m_stencils.begin(), m_stencils.end(), fine,
                              [](const Stencil& s, Vertex_index v) { return s.vertex < v; });
    if(s == m_stencils.end() || !is_its(*s)) // they need not be in the order of their vertices
      s = std::find_if(m_stencils.begin(), m_stencils.end(), is_its);
    fine = s->source[std::max_element(s->weight.begin(), s->weight.end()) - s->weight.begin()];
  }
}

template <class Vector>
void Prolongation::prolongate(const Vector& coarse, Vector& fine) const
{
  fine.resize(number_of_fine_vertices());
  Blocked_execution::blocked_for(m_kept.size(), block_size, [&](std::size_t begin, std::size_t end) {
    for(std::size_t j = begin; j < end; ++j)
      fine[m_kept[j]] = coarse[j];
  });
  if(m_is_direct)
    Blocked_execution::blocked_for(m_stencils.size(), block_size,
                                   [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        apply(m_stencils[i], fine);
    });
  else
    for(const Stencil& s : m_stencils)
      apply(s, fine);
}

template <class Vector>
void Prolongation::restrict_in_place(Vector& fine, Vector& coarse) const
{
  typedef internal::Real_of_entries<Vector> Real;
  coarse.resize(m_kept.size());
  if(m_is_direct) {
    Blocked_execution::blocked_for(m_kept.size(), block_size,
                                   [&](std::size_t begin, std::size_t end) {
      for(std::size_t j = begin; j < end; ++j) {
        auto sum = fine[m_kept[j]];
        for(std::uint32_t t = m_begin[j]; t < m_begin[j + 1]; ++t)
          sum += Real(m_terms[t].weight) * fine[m_terms[t].vertex];
        coarse[j] = sum;
      }
    });
    return;
  }
  for(std::size_t i = m_stencils.size(); i-- > 0;) {
    const Stencil& s = m_stencils[i];
    for(int c = 0; c < 3; ++c)
      fine[s.source[c]] += Real(s.weight[c]) * fine[s.vertex];
  }
  for(std::size_t j = 0; j < m_kept.size(); ++j)
    coarse[j] = fine[m_kept[j]];
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROLONGATION_H
