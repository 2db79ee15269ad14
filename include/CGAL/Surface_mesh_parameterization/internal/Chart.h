// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CHART_H

#include <CGAL/Surface_mesh_multiresolution/internal/Vertex_rings.h>
#include <CGAL/Surface_mesh_multiresolution/internal/border_loops.h>

#include <CGAL/Surface_mesh_parameterization/Error_code.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A chart of a mesh as arrays, or what is wrong with it.
struct Chart
{
  typedef Surface_mesh_multiresolution::Indexed_triangle_mesh Mesh;
  typedef Surface_mesh_multiresolution::Vertex_index Vertex_index;

  Mesh mesh;                              // normalized, in spatial order
  std::vector<std::uint32_t> source;      // for each vertex its position in vertices(mesh)
  Surface_mesh_multiresolution::internal::Vertex_rings rings;
  std::vector<std::vector<Vertex_index>> borders;
  double scale = 1.;                      // lengths of `mesh` to those of the input
  Error_code error = OK;
  std::string message;                    // why, if error is not OK

  void fail(Error_code code, const std::string& text)
  {
    if(error == OK) {
      error = code;
      message = text;
    }
  }

  // The position of each vertex of the input in the chart, or `no_vertex`.
  std::vector<Vertex_index> rank(std::size_t number_of_input_vertices) const
  {
    return Surface_mesh_multiresolution::internal::ranks(source, number_of_input_vertices);
  }
};

inline void check_point(const Chart::Mesh::Point_3& p, std::size_t vertex, Chart& chart)
{
  if(!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
    chart.fail(ERROR_WRONG_PARAMETER, "vertex " + std::to_string(vertex)
               + " has a coordinate that is not a finite number; correct or remove it");
}

// Copies the faces and positions of `mesh`; vertices are numbered as in vertices(mesh).
template <class TriangleMesh>
void copy_faces(const TriangleMesh& mesh, Chart& chart)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef CGAL::dynamic_vertex_property_t<std::uint32_t> Tag;
  auto position = get(Tag(), mesh);
  const auto vpm = get(CGAL::vertex_point, mesh);
  chart.mesh.points.reserve(num_vertices(mesh));
  chart.mesh.triangles.reserve(num_faces(mesh));
  std::uint32_t index = 0;
  for(const typename Graph_traits::vertex_descriptor v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    const Chart::Mesh::Point_3 q(to_double(p[0]), to_double(p[1]), to_double(p[2]));
    check_point(q, index, chart);
    chart.mesh.points.push_back(q);
    put(position, v, index++);
  }
  std::size_t face = 0;
  for(const typename Graph_traits::face_descriptor f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    const auto h1 = next(h, mesh), h2 = next(h1, mesh);
    if(next(h2, mesh) != h)
      chart.fail(ERROR_NON_TRIANGULAR_MESH, "face " + std::to_string(face)
                 + " is not a triangle; triangulate the mesh first");
    chart.mesh.triangles.push_back({get(position, target(h, mesh)), get(position, target(h1, mesh)),
                                    get(position, target(h2, mesh))});
    ++face;
  }
}

// Keeps the vertices for which `is_kept` and the triangles that have them.
inline void keep_vertices(Chart& chart, const std::vector<bool>& is_kept)
{
  std::vector<std::uint32_t> rank(is_kept.size());
  std::size_t kept = 0;
  for(std::size_t v = 0; v < is_kept.size(); ++v) {
    rank[v] = std::uint32_t(kept);
    if(!is_kept[v])
      continue;
    chart.mesh.points[kept] = chart.mesh.points[v];
    chart.source[kept] = chart.source[v];
    ++kept;
  }
  chart.mesh.points.erase(chart.mesh.points.begin() + kept, chart.mesh.points.end());
  chart.source.resize(kept);
  std::size_t triangles = 0;
  for(const auto& t : chart.mesh.triangles)
    if(is_kept[t[0]] && is_kept[t[1]] && is_kept[t[2]])
      chart.mesh.triangles[triangles++] = {rank[t[0]], rank[t[1]], rank[t[2]]};
  chart.mesh.triangles.resize(triangles);
}

inline void remove_unused_vertices(Chart& chart)
{
  std::vector<bool> is_used(chart.mesh.points.size(), false);
  for(const auto& t : chart.mesh.triangles)
    for(const std::uint32_t v : t)
      is_used[v] = true;
  keep_vertices(chart, is_used);
}

// Builds the rings; says which vertex has none.
inline void connect(Chart& chart)
{
  typedef Surface_mesh_multiresolution::internal::Ring_defect Ring_defect;
  chart.rings = Surface_mesh_multiresolution::internal::Vertex_rings(chart.mesh);
  if(chart.rings.defect() == Ring_defect::NONE)
    return;
  const std::string vertex
    = "vertex " + std::to_string(chart.source[chart.rings.defective_vertex()]);
  if(chart.rings.defect() == Ring_defect::REPEATED_HALFEDGE)
    chart.fail(ERROR_NO_TOPOLOGICAL_DISC, vertex + " has an edge with more than two faces, or with "
               "two faces of different orientation; repair the mesh first");
  else
    chart.fail(ERROR_NO_TOPOLOGICAL_DISC, "the faces at " + vertex
               + " do not form one fan; split the vertex first");
}

// Euler: V - E + F = 2 - 2 genus - borders.
inline void check_topology(Chart& chart)
{
  const long long v = (long long)(chart.mesh.points.size());
  const long long f = (long long)(chart.mesh.triangles.size());
  long long border_edges = 0;
  for(const auto& loop : chart.borders)
    border_edges += (long long)(loop.size());
  const long long e = (3 * f + border_edges) / 2;
  const long long twice_genus = 2 - (long long)(chart.borders.size()) - (v - e + f);
  if(chart.borders.empty())
    chart.fail(ERROR_NO_TOPOLOGICAL_DISC, "the surface is closed; cut it open first");
  else if(twice_genus != 0)
    chart.fail(ERROR_NO_TOPOLOGICAL_DISC, "the surface has genus "
               + std::to_string(twice_genus / 2) + "; cut its handles first");
}

// Takes the arrays of `chart.mesh` with `chart.source` set, and of it the component of the vertex at
// position `seed`; without a seed all must be one component.
inline void prepare_chart(Chart& chart, std::uint32_t seed)
{
  namespace SMM = Surface_mesh_multiresolution;
  if(chart.error != OK)
    return;
  if(chart.mesh.triangles.empty())
    return chart.fail(ERROR_EMPTY_MESH, "the mesh has no faces");
  remove_unused_vertices(chart);
  chart.scale = SMM::normalize(chart.mesh);
  if(!(chart.scale > 0.))
    return chart.fail(ERROR_WRONG_PARAMETER, "all vertices lie in one point");
  const auto sort = [&chart] {
    const std::vector<SMM::Vertex_index> order = SMM::sort_spatially(chart.mesh);
    std::vector<std::uint32_t> source(order.size());
    for(std::size_t v = 0; v < order.size(); ++v)
      source[v] = chart.source[order[v]];
    chart.source.swap(source);
  };
  sort();
  connect(chart);
  if(chart.error != OK)
    return;
  SMM::Vertex_index first = 0;
  for(SMM::Vertex_index v = 0; v < chart.source.size(); ++v)
    if(chart.source[v] == seed)
      first = v;
  const std::vector<bool> is_reached = SMM::internal::component_of(chart.rings, first);
  if(std::find(is_reached.begin(), is_reached.end(), false) != is_reached.end()) {
    if(seed == SMM::no_vertex)
      return chart.fail(ERROR_NO_TOPOLOGICAL_DISC,
                        "the surface has several components; map them one by one");
    keep_vertices(chart, is_reached);
    connect(chart);
  }
  chart.borders = SMM::internal::border_loops(chart.rings);
  check_topology(chart);
}

// A connected mesh that is two arrays.
inline Chart chart_of_arrays(Chart::Mesh mesh)
{
  Chart chart;
  chart.mesh = std::move(mesh);
  chart.source.resize(chart.mesh.points.size());
  for(std::uint32_t v = 0; v < chart.source.size(); ++v) {
    chart.source[v] = v;
    check_point(chart.mesh.points[v], v, chart);
  }
  prepare_chart(chart, Surface_mesh_multiresolution::no_vertex);
  return chart;
}

// The parameters of the `n` vertices of the input; (0, 0) of those that are not in the chart.
inline std::vector<Simple_cartesian<double>::Point_2>
points_of_values(const Chart& chart, const std::vector<std::complex<double>>& z, std::size_t n)
{
  std::vector<Simple_cartesian<double>::Point_2> uv(n, Simple_cartesian<double>::Point_2(0., 0.));
  for(std::size_t v = 0; v < z.size(); ++v)
    uv[chart.source[v]] = Simple_cartesian<double>::Point_2(z[v].real(), z[v].imag());
  return uv;
}

// The connected component of `mesh` that has the halfedge `bhd`.
template <class TriangleMesh>
Chart extract_chart(const TriangleMesh& mesh,
                    typename boost::graph_traits<TriangleMesh>::halfedge_descriptor bhd)
{
  Chart chart;
  copy_faces(mesh, chart);
  chart.source.resize(chart.mesh.points.size());
  for(std::uint32_t v = 0; v < chart.source.size(); ++v)
    chart.source[v] = v;
  std::uint32_t seed = 0;
  for(const auto v : vertices(mesh)) {
    if(v == target(bhd, mesh))
      break;
    ++seed;
  }
  prepare_chart(chart, seed);
  return chart;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CHART_H
