// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_MIRROR_FINDER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_MIRROR_FINDER_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/principal_axes.h>
#include <CGAL/Surface_mesh_texturing/internal/mapped_charts/Part_matcher.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Finds a plane that mirrors a component of a surface onto itself, vertices onto vertices and
// triangles onto triangles. Tried are the planes through the centre of its area across the axes of
// space and its principal axes, which is where they are, unless a surface has many. Expected linear
// time, much less where the first vertices have no mirror image.
class Mirror_finder
{
public:
  typedef std::uint32_t Index;

  // Vertices agree within the tolerance, in radii of the part.
  Mirror_finder(const Indexed_triangle_mesh& mesh, const Surface_part& part,
                double tolerance)
    : m_mesh(mesh), m_part(part), m_allowed(tolerance * part.radius)
  {}

  // For each triangle of one half, whose mirror image is the other half, the one that it is mirrored
  // to; triangles that are mirrored to themselves are in none. Of the planes that do, it is the one
  // with the shortest cut. Nothing if there is none.
  std::vector<std::pair<Index, Triangle_match>> half()
  {
    constexpr double clearly = 1. - 1e-9; // ties must not depend on rounding
    std::vector<std::pair<Index, Triangle_match>> best;
    if(!prepare())
      return best;
    double shortest = 0.;
    for(const Vector& normal : candidates()) {
      if(!find_images(normal) || !find_mirrored())
        continue;
      double cut = 0.;
      auto found = half_behind(normal, cut);
      if(!found.empty() && (best.empty() || cut < clearly * shortest)) {
        best = std::move(found);
        shortest = cut;
      }
    }
    return best;
  }

private:
  typedef Eigen::Vector3d Vector;

  Vector point(Vertex_index v) const
  {
    const auto& p = m_mesh.points[v];
    return Vector(p.x(), p.y(), p.z()) - m_origin;
  }

  // The centre, the principal axes, and tables of vertices and edges. False if there is no area.
  bool prepare()
  {
    const auto& first = m_mesh.points[m_mesh.triangles[m_part.triangles[0]][0]];
    m_origin = Vector(first.x(), first.y(), first.z());
    const Area_moments moments
      = area_moments(m_part.triangles,
                     [this](Index t) -> const Triangle_indices& { return m_mesh.triangles[t]; },
                     [this](Vertex_index v) { return point(v); });
    if(!(moments.area > 0.) || !(m_allowed > 0.))
      return false;
    m_axes = moments.second;
    m_origin += moments.centre;
    for(const Index t : m_part.triangles)
      for(int c = 0; c < 3; ++c) {
        const Vertex_index v = m_mesh.triangles[t][c];
        m_edges.emplace(directed(v, m_mesh.triangles[t][(c + 1) % 3]), 3 * t + Index(c));
        if(m_images.emplace(v, no_vertex).second) {
          m_vertices.push_back(v);
          m_cells.emplace(cell(point(v), Vector::Zero()), v);
        }
      }
    return true;
  }

  std::vector<Vector> candidates() const
  {
    constexpr double same = 1. - 1e-12; // cosine
    std::vector<Vector> result = {Vector::UnitX(), Vector::UnitY(), Vector::UnitZ()};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m_axes);
    for(int i = 0; i < 3; ++i) {
      const Vector axis = solver.eigenvectors().col(i);
      if(std::none_of(result.begin(), result.end(),
                      [&](const Vector& other) { return std::abs(axis.dot(other)) > same; }))
        result.push_back(axis);
    }
    return result;
  }

  static std::uint64_t directed(Vertex_index from, Vertex_index to)
  {
    return std::uint64_t(from) << 32 | to;
  }

  // The number of a cell, which some far from each other share.
  std::uint64_t cell(const Vector& p, const Vector& shift) const
  {
    std::uint64_t result = 0;
    for(int k = 0; k < 3; ++k) {
      const double place = std::floor((p[k] + m_allowed * shift[k]) / (2. * m_allowed));
      result = result << 21 | (std::uint64_t(std::int64_t(place)) & 0x1fffff);
    }
    return result;
  }

  // The nearest vertex to a point, if it is near enough.
  Vertex_index vertex_at(const Vector& p) const
  {
    Vertex_index best = no_vertex;
    double nearest = m_allowed;
    std::array<std::uint64_t, 8> seen;
    for(int corner = 0; corner < 8; ++corner) {
      const auto side = [corner](int axis) { return (corner >> axis & 1) != 0 ? 1. : -1.; };
      seen[corner] = cell(p, Vector(side(0), side(1), side(2)));
      if(std::find(seen.begin(), seen.begin() + corner, seen[corner]) != seen.begin() + corner)
        continue;
      const auto [begin, end] = m_cells.equal_range(seen[corner]);
      for(auto i = begin; i != end; ++i) {
        const double distance = (point(i->second) - p).norm();
        if(distance < nearest || (distance == nearest && i->second < best)) {
          nearest = distance;
          best = i->second;
        }
      }
    }
    return best;
  }

  // Of all vertices, if each has one that is mirrored back to it.
  bool find_images(const Vector& normal)
  {
    for(const Vertex_index v : m_vertices) {
      const Vector p = point(v);
      const Vertex_index w = vertex_at(p - 2. * normal.dot(p) * normal);
      if(w == no_vertex)
        return false;
      m_images[v] = w;
    }
    return std::all_of(m_vertices.begin(), m_vertices.end(),
                       [this](Vertex_index v) { return m_images[m_images[v]] == v; });
  }

  // The mirror image of each triangle, if each has one.
  bool find_mirrored()
  {
    m_mirrored.clear();
    for(const Index t : m_part.triangles) {
      const Triangle_indices& v = m_mesh.triangles[t];
      const auto edge = m_edges.find(directed(m_images[v[1]], m_images[v[0]]));
      if(edge == m_edges.end())
        return false;
      const Index other = edge->second / 3;
      const Corner_match corners{int(edge->second % 3 + 1) % 3, true};
      if(m_mesh.triangles[other][corners(2)] != m_images[v[2]])
        return false;
      m_mirrored.push_back({other, corners});
    }
    return true;
  }

  // The half behind the plane, and how long its border with the other one is.
  std::vector<std::pair<Index, Triangle_match>> half_behind(const Vector& normal, double& cut) const
  {
    const auto place = [&](Index t) {
      const Triangle_indices& v = m_mesh.triangles[t];
      return normal.dot(point(v[0]) + point(v[1]) + point(v[2]));
    };
    const auto is_behind = [&](Index t, Index mirrored) {
      const double here = place(t), there = place(mirrored);
      return here < there || (here == there && t > mirrored);
    };
    std::vector<std::pair<Index, Triangle_match>> result;
    std::unordered_map<Index, bool> behind;
    for(std::size_t i = 0; i < m_mirrored.size(); ++i) {
      const Index t = m_part.triangles[i];
      behind[t] = is_behind(t, m_mirrored[i].triangle);
      if(behind[t])
        result.push_back({t, m_mirrored[i]});
    }
    for(const auto& found : result)
      for(int c = 0; c < 3; ++c) {
        const Triangle_indices& v = m_mesh.triangles[found.first];
        const auto opposite = m_edges.find(directed(v[(c + 1) % 3], v[c]));
        if(opposite != m_edges.end() && !behind[opposite->second / 3])
          cut += (point(v[c]) - point(v[(c + 1) % 3])).norm();
      }
    return result;
  }

  const Indexed_triangle_mesh& m_mesh;
  const Surface_part& m_part;
  double m_allowed;
  Vector m_origin; // the centre, once it is known
  Eigen::Matrix3d m_axes;
  std::vector<Vertex_index> m_vertices;
  std::unordered_map<Vertex_index, Vertex_index> m_images;
  std::unordered_multimap<std::uint64_t, Vertex_index> m_cells;
  std::unordered_map<std::uint64_t, Index> m_edges; // halfedges between two vertices
  std::vector<Triangle_match> m_mirrored;           // of the triangles of the part
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_MIRROR_FINDER_H
