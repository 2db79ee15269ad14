// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_CIRCLE_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_CIRCLE_MAP_H

#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretch_task.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/plane_geometry.h>

#include <CGAL/number_utils.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Tutte's map of a small mesh of genus 0: its longest border goes to a circle, by length, or to given
// places, and every other vertex to the mean of its neighbours. Other borders are filled by a vertex
// each, joined to all of the border, which is left out afterwards: what remains is one-to-one whatever
// the number of borders (Tutte 1963; Floater 2003). Empty if the equations cannot be solved.
class Circle_map
{
public:
  explicit Circle_map(const Indexed_mesh::Indexed_triangle_mesh& mesh)
    : m_mesh(mesh), m_rings(mesh), m_loops(Indexed_mesh::border_loops(m_rings))
  {}

  // The longest border of those all vertices of which are held goes to their places. Empty if there is
  // none; not valid in general unless the places are convex.
  std::vector<Plane_point> run(const std::vector<Held_vertex>& held)
  {
    const std::size_t n = m_mesh.points.size();
    std::vector<Plane_point> places(n);
    std::vector<bool> is_held(n, false);
    for(const Held_vertex& h : held) {
      places[h.vertex] = h.place;
      is_held[h.vertex] = true;
    }
    std::size_t first = m_loops.size();
    for(std::size_t l = 0; l < m_loops.size(); ++l)
      if(std::all_of(m_loops[l].begin(), m_loops[l].end(), [&](Vertex_index v) { return is_held[v]; })
         && (first == m_loops.size() || length_of(m_loops[l]) > length_of(m_loops[first])))
        first = l;
    if(first == m_loops.size())
      return {};
    m_loops[first].swap(m_loops[0]);
    return with_border(std::move(places));
  }

  // Whether the triangles of a map, all of which are positive, go around each vertex inside once.
  bool goes_around_once(const std::vector<Plane_point>& places) const
  {
    return first_branch_point(m_mesh.triangles, m_rings, places) == m_mesh.points.size();
  }

  std::vector<Plane_point> run()
  {
    longest_first();
    std::vector<Plane_point> places(m_mesh.points.size());
    double length = 0.;
    const double whole = length_of(m_loops[0]);
    for(std::size_t i = 0; i < m_loops[0].size(); ++i) {
      const double angle = 2. * CGAL_PI * length / whole;
      places[m_loops[0][i]] = {std::cos(angle), std::sin(angle)};
      length += length_of_edge(m_loops[0], i);
    }
    return with_border(std::move(places));
  }

private:
  typedef std::vector<Vertex_index> Loop;

  // Leaves the first border where it is.
  std::vector<Plane_point> with_border(std::vector<Plane_point> places) const
  {
    const std::size_t n = m_mesh.points.size();
    places.resize(n + m_loops.size() - 1);
    std::vector<bool> is_set(places.size(), false);
    for(const Vertex_index v : m_loops[0])
      is_set[v] = true;
    if(!solve(is_set, places))
      places.clear();
    places.resize(places.empty() ? 0 : n);
    return places;
  }

  double length_of_edge(const Loop& loop, std::size_t i) const
  {
    const auto &p = m_mesh.points[loop[i]], &q = m_mesh.points[loop[(i + 1) % loop.size()]];
    return std::sqrt(squared_distance(p, q)) + least_length;
  }

  double length_of(const Loop& loop) const
  {
    double sum = 0.;
    for(std::size_t i = 0; i < loop.size(); ++i)
      sum += length_of_edge(loop, i);
    return sum;
  }

  void longest_first()
  {
    for(Loop& loop : m_loops)
      if(length_of(loop) > length_of(m_loops[0]))
        m_loops[0].swap(loop);
  }

  // Calls use(v, w) for the neighbours of each vertex, those that fill borders among them.
  template <class Use>
  void for_each_neighbor(const Use& use) const
  {
    for(Vertex_index v = 0; v < m_mesh.points.size(); ++v)
      for(std::uint32_t i = 0; i < m_rings.degree(v); ++i)
        use(std::size_t(v), std::size_t(m_rings.ring(v)[i]));
    for(std::size_t l = 1; l < m_loops.size(); ++l)
      for(const Vertex_index v : m_loops[l]) {
        const std::size_t hub = m_mesh.points.size() + l - 1;
        use(hub, std::size_t(v));
        use(std::size_t(v), hub);
      }
  }

  bool solve(const std::vector<bool>& is_set, std::vector<Plane_point>& places) const
  {
    std::vector<int> rank(places.size(), -1);
    int unknowns = 0;
    for(std::size_t v = 0; v < places.size(); ++v)
      if(!is_set[v])
        rank[v] = unknowns++;
    if(unknowns == 0)
      return true;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknowns, 2);
    for_each_neighbor([&](std::size_t v, std::size_t w) {
      if(is_set[v])
        return;
      entries.emplace_back(rank[v], rank[v], 1.);
      if(is_set[w])
        right.row(rank[v]) += Eigen::RowVector2d(places[w].x, places[w].y);
      else
        entries.emplace_back(rank[v], rank[w], -1.);
    });
    Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factorization(matrix);
    if(factorization.info() != Eigen::Success)
      return false;
    const Eigen::MatrixXd solution = factorization.solve(right);
    for(std::size_t v = 0; v < places.size(); ++v)
      if(!is_set[v])
        places[v] = {solution(rank[v], 0), solution(rank[v], 1)};
    return true;
  }

  static constexpr double least_length = 1e-6; // in mean edges: no two vertices at one place

  const Indexed_mesh::Indexed_triangle_mesh& m_mesh;
  Indexed_mesh::Vertex_rings m_rings;
  std::vector<Loop> m_loops;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_CIRCLE_MAP_H
