// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CHART_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/mesh_error.h>

#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Indexed_mesh/prepare_mesh.h>
#endif

#include <CGAL/Surface_mesh_parameterization/Error_code.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What went wrong, if anything: a code and a sentence. The first error stays.
struct Status
{
  Error_code error = OK;
  std::string message; // why, if error is not OK

  bool is_ok() const { return error == OK; }

  // Takes a sentence that says what is wrong, if it says so and none was before.
  void fail(Error_code code, const std::string& text)
  {
    if(error == OK && !text.empty()) {
      error = code;
      message = text;
    }
  }
};

// What CGAL's error code says. CGAL's own texts are one too few: get_error_message() returns null
// for the last code, and the text of the one before for others.
inline const char* text_of(Error_code error)
{
  switch(error) {
  case OK: return "no error";
  case ERROR_EMPTY_MESH: return "the mesh is empty";
  case ERROR_NON_TRIANGULAR_MESH: return "the mesh has faces that are not triangles";
  case ERROR_NO_TOPOLOGICAL_DISC: return "the mesh is not a disk";
  case ERROR_NO_TOPOLOGICAL_BALL: return "the mesh is not a ball";
  case ERROR_BORDER_TOO_SHORT: return "the border is too short";
  case ERROR_NON_CONVEX_BORDER: return "the border in the plane must be convex";
  case ERROR_CANNOT_SOLVE_LINEAR_SYSTEM: return "a linear system cannot be solved";
  case ERROR_NO_1_TO_1_MAPPING: return "the map is not one-to-one";
  case ERROR_WRONG_PARAMETER: return "a parameter is wrong";
  }
  return "unknown error";
}

// A chart of a mesh as arrays: a connected surface of genus 0 with a border, unless the status that
// came with it says otherwise.
struct Chart
{
  typedef Indexed_mesh::Indexed_triangle_mesh Mesh;
  typedef Indexed_mesh::Vertex_index Vertex_index;
  typedef std::vector<Indexed_mesh::Space_tensor> Metric;

  Mesh mesh;                              // normalized, in spatial order
  std::vector<std::uint32_t> source;      // for each vertex its position in vertices(mesh)
  Indexed_mesh::Vertex_rings rings;
  std::vector<std::vector<Vertex_index>> borders;
  double scale = 1.;                      // lengths of `mesh` to those of the input
  Metric metric;                          // of each triangle; empty: that of the points
};

// Calls `body(i)` for i in [0, n). Numbers that are objects may not be read by several threads.
template <class Number, class Body>
void for_each_of_mesh(std::size_t n, const Body& body)
{
  const std::size_t block = std::is_arithmetic<Number>::value ? 16384 : (std::max)(n, std::size_t(1));
  Blocked_execution::blocked_for(n, block, [&body](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      body(i);
  });
}

// Copies the positions of the vertices of `mesh`, which are numbered as in vertices(mesh).
template <class TriangleMesh, class VertexPositionMap>
void copy_points(const TriangleMesh& mesh, VertexPositionMap position, Chart& chart, Status& status)
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  const auto vpm = get(CGAL::vertex_point, mesh);
  typedef std::decay_t<decltype(get(vpm, std::declval<vertex_descriptor>())[0])> Number;
  std::vector<vertex_descriptor> all;
  all.reserve(num_vertices(mesh));
  for(const vertex_descriptor v : vertices(mesh)) {
    put(position, v, std::uint32_t(all.size()));
    all.push_back(v);
  }
  chart.mesh.points.resize(all.size());
  std::atomic<bool> is_finite(true);
  for_each_of_mesh<Number>(all.size(), [&](std::size_t i) {
    const auto& p = get(vpm, all[i]);
    const Chart::Mesh::Point_3 q(to_double(p[0]), to_double(p[1]), to_double(p[2]));
    chart.mesh.points[i] = q;
    if(!std::isfinite(q.x()) || !std::isfinite(q.y()) || !std::isfinite(q.z()))
      is_finite = false;
  });
  if(!is_finite)
    status.fail(ERROR_WRONG_PARAMETER, Indexed_mesh::point_error(chart.mesh.points));
}

// Copies the faces and positions of `mesh`; vertices are numbered as in vertices(mesh).
template <class TriangleMesh>
void copy_faces(const TriangleMesh& mesh, Chart& chart, Status& status)
{
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;
  const auto position = get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh);
  copy_points(mesh, position, chart, status);
  std::vector<face_descriptor> all;
  all.reserve(num_faces(mesh));
  for(const face_descriptor f : faces(mesh))
    all.push_back(f);
  Blocked_execution::resize_blocked(chart.mesh.triangles, all.size());
  std::atomic<std::size_t> first_polygon(all.size());
  for_each_of_mesh<int>(all.size(), [&](std::size_t i) {
    const auto h = halfedge(all[i], mesh), h1 = next(h, mesh), h2 = next(h1, mesh);
    chart.mesh.triangles[i] = {get(position, target(h, mesh)), get(position, target(h1, mesh)),
                               get(position, target(h2, mesh))};
    if(next(h2, mesh) != h)
      for(std::size_t known = first_polygon; i < known;)
        if(first_polygon.compare_exchange_weak(known, i))
          break;
  });
  if(first_polygon < all.size())
    status.fail(ERROR_NON_TRIANGULAR_MESH, "face " + std::to_string(first_polygon)
               + " is not a triangle; triangulate the mesh first");
}

// A chart, and what was wrong with the mesh that it is of, or with the metric that it is to have.
struct Prepared_chart
{
  Chart chart;
  Status status;
  bool has_bad_metric = false;
};

// Fails if the surface is closed or has handles, by its borders.
CGAL_HLSCM_INLINE void check_topology(const Chart& chart, Status& status);

// Takes the arrays of the chart's mesh, and of it the component of vertex `seed`; without a seed all must
// be one component. The chart's metric goes with its triangles.
CGAL_HLSCM_INLINE void prepare_chart(Prepared_chart& prepared, std::uint32_t seed);

// For each of `triangles`, whose vertex v is vertex `source[v]` of the `n` of an input, its number
// among those of the input, some or all of which they are.
inline std::vector<Indexed_mesh::Triangle_index>
numbers_in_input(const std::vector<Indexed_mesh::Triangle_indices>& input, std::size_t n,
                 const std::vector<Indexed_mesh::Triangle_indices>& triangles,
                 const std::vector<std::uint32_t>& source)
{
  const std::vector<Indexed_mesh::Vertex_index> rank = Indexed_mesh::ranks(source, n);
  const Indexed_mesh::Triangles_at_vertices at(triangles, source.size());
  std::vector<Indexed_mesh::Triangle_index> number(triangles.size());
  for(std::size_t t = 0; t < input.size(); ++t) {
    const std::uint32_t a = rank[input[t][0]], b = rank[input[t][1]];
    if(a == Indexed_mesh::no_vertex || b == Indexed_mesh::no_vertex)
      continue;
    for(const std::uint32_t* c = at.begin(a); c != at.end(a); ++c)
      if(Indexed_mesh::vertex_of(triangles, Indexed_mesh::next_halfedge(*c)) == b)
        number[Indexed_mesh::triangle_of(*c)] = Indexed_mesh::Triangle_index(t);
  }
  return number;
}

// A connected mesh that is two arrays, with the metric of its triangles, if that is not their own.
CGAL_HLSCM_INLINE Prepared_chart chart_of_arrays(Chart::Mesh mesh, const Chart::Metric& metric = {});

// The parameters of the `n` vertices of the input; (0, 0) of those that are not in the chart.
inline std::vector<Simple_cartesian<double>::Point_2>
points_of_values(const std::vector<std::uint32_t>& source,
                 const std::vector<std::complex<double>>& z, std::size_t n)
{
  std::vector<Simple_cartesian<double>::Point_2> uv(n, Simple_cartesian<double>::Point_2(0., 0.));
  for(std::size_t v = 0; v < z.size(); ++v)
    uv[source[v]] = Simple_cartesian<double>::Point_2(z[v].real(), z[v].imag());
  return uv;
}

// What is wrong with a halfedge that is to be on the border of a chart of `mesh`. It is looked for
// among those of the mesh first: what does not belong to it must not be asked for anything.
template <class TriangleMesh>
Status check_border(const TriangleMesh& mesh,
                    typename boost::graph_traits<TriangleMesh>::halfedge_descriptor bhd)
{
  typedef boost::graph_traits<TriangleMesh> Traits;
  Status status;
  if(faces(mesh).begin() == faces(mesh).end())
    status.fail(ERROR_EMPTY_MESH, Indexed_mesh::no_triangles_error());
  const auto all = halfedges(mesh);
  const bool is_null = bhd == Traits::null_halfedge() || !status.is_ok();
  if(!is_null && std::find(all.begin(), all.end(), bhd) == all.end())
    status.fail(ERROR_WRONG_PARAMETER, "the given halfedge does not belong to the mesh");
  else if(is_null || !is_border(bhd, mesh))
    status.fail(ERROR_NO_TOPOLOGICAL_DISC,
                "the given halfedge is not on a border; a closed surface must be cut open first");
  return status;
}

// The connected component of `mesh` that has the border halfedge `bhd`, with the metric of the faces
// of `mesh`, if that is not their own.
template <class TriangleMesh>
Prepared_chart extract_chart(const TriangleMesh& mesh,
                             typename boost::graph_traits<TriangleMesh>::halfedge_descriptor bhd,
                             const Chart::Metric& metric = {})
{
  Prepared_chart result;
  result.status = check_border(mesh, bhd);
  if(!result.status.is_ok())
    return result;
  result.chart.metric = metric;
  copy_faces(mesh, result.chart, result.status);
  std::uint32_t seed = 0;
  for(const auto v : vertices(mesh)) {
    if(v == target(bhd, mesh))
      break;
    ++seed;
  }
  prepare_chart(result, seed);
  return result;
}

#ifdef CGAL_HLSCM_DEFINITIONS

// Brings the tensors of the triangles `input` to the order of those of the chart, some or all of the
// same triangles. Vertices have `n` numbers in the input. Returns what is wrong.
inline std::string sort_metric(const std::vector<Indexed_mesh::Triangle_indices>& input, std::size_t n,
                               Chart& chart)
{
  if(chart.metric.size() != input.size())
    return Indexed_mesh::metric_size_error(chart.metric.size(), input.size());
  const auto number = numbers_in_input(input, n, chart.mesh.triangles, chart.source);
  Chart::Metric sorted;
  for(const auto t : number)
    sorted.push_back(chart.metric[t]);
  chart.metric.swap(sorted);
  return Indexed_mesh::metric_error(chart.mesh, chart.metric, number);
}

// Euler: V - E + F = 2 - 2 genus - borders.
CGAL_HLSCM_INLINE void check_topology(const Chart& chart, Status& status)
{
  const long long v = (long long)(chart.mesh.points.size());
  const long long f = (long long)(chart.mesh.triangles.size());
  long long border_edges = 0;
  for(const auto& loop : chart.borders)
    border_edges += (long long)(loop.size());
  const long long e = (3 * f + border_edges) / 2;
  const long long twice_genus = 2 - (long long)(chart.borders.size()) - (v - e + f);
  if(chart.borders.empty())
    status.fail(ERROR_NO_TOPOLOGICAL_DISC, "the surface is closed; cut it open first");
  else if(twice_genus != 0)
    status.fail(ERROR_NO_TOPOLOGICAL_DISC, "the surface has genus "
               + std::to_string(twice_genus / 2) + "; cut its handles first");
}

// The same without its metric.
inline void prepare_surface(Chart& chart, std::uint32_t seed, Status& status)
{
  if(!status.is_ok())
    return;
  if(chart.mesh.triangles.empty())
    return status.fail(ERROR_EMPTY_MESH, "the mesh has no triangles");
  Indexed_mesh::Preparation steps;
  steps.drops_unused_vertices = true;
  Indexed_mesh::Prepared_mesh prepared = Indexed_mesh::prepare_mesh(std::move(chart.mesh), steps);
  status.fail(prepared.scale > 0. ? ERROR_NO_TOPOLOGICAL_DISC : ERROR_WRONG_PARAMETER, prepared.error);
  if(!status.is_ok())
    return;
  chart.mesh = std::move(prepared.mesh);
  chart.source = std::move(prepared.source);
  chart.rings = std::move(prepared.rings);
  chart.scale = prepared.scale;
  Indexed_mesh::Vertex_index first = 0;
  for(Indexed_mesh::Vertex_index v = 0; v < chart.source.size(); ++v)
    if(chart.source[v] == seed)
      first = v;
  const std::vector<bool> is_reached = Indexed_mesh::component_of(chart.rings, first);
  if(std::find(is_reached.begin(), is_reached.end(), false) != is_reached.end()) {
    if(seed == Indexed_mesh::no_vertex)
      return status.fail(ERROR_NO_TOPOLOGICAL_DISC,
                        "the surface has several components; map them one by one");
    Indexed_mesh::keep_vertices(chart.mesh, chart.source, is_reached);
    chart.rings = Indexed_mesh::Vertex_rings(chart.mesh);
  }
  chart.borders = Indexed_mesh::border_loops(chart.rings);
  check_topology(chart, status);
}

CGAL_HLSCM_INLINE void prepare_chart(Prepared_chart& prepared, std::uint32_t seed)
{
  Chart& chart = prepared.chart;
  if(chart.metric.empty())
    return prepare_surface(chart, seed, prepared.status);
  const std::vector<Indexed_mesh::Triangle_indices> input = chart.mesh.triangles;
  const std::size_t n = chart.mesh.points.size();
  prepare_surface(chart, seed, prepared.status);
  if(!prepared.status.is_ok())
    return;
  prepared.status.fail(ERROR_WRONG_PARAMETER, sort_metric(input, n, chart));
  prepared.has_bad_metric = !prepared.status.is_ok();
}

CGAL_HLSCM_INLINE Prepared_chart chart_of_arrays(Chart::Mesh mesh, const Chart::Metric& metric)
{
  Prepared_chart result;
  result.chart.mesh = std::move(mesh);
  result.chart.metric = metric;
  if(!result.chart.mesh.triangles.empty())
    result.status.fail(ERROR_WRONG_PARAMETER, Indexed_mesh::mesh_error(result.chart.mesh));
  prepare_chart(result, Indexed_mesh::no_vertex);
  return result;
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CHART_H
