// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// decimate(): in the meshes of users, where it must leave what the engine leaves of the arrays, and
// its constraints, policies and refusals.

#include <support/decimated_hills.h>
#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_multiresolution/decimate.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties_PolyMesh_ArrayKernelT.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace decimate_test {

using namespace test_support;
using namespace decimated_hills;
using CGAL::Indexed_mesh::Vertex_index;
using CGAL::Indexed_mesh::Mesh_status;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Polyhedron_3<Kernel> Polyhedron;

struct Open_mesh_traits : OpenMesh::DefaultTraits
{
  typedef OpenMesh::Vec3d Point;
  typedef OpenMesh::Vec3d Normal;
  VertexAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
};
typedef OpenMesh::PolyMesh_ArrayKernelT<Open_mesh_traits> Open_mesh;

template <class Mesh>
void fill(const Indexed_triangle_mesh& arrays, Mesh& mesh)
{
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(arrays.points, arrays.triangles,
                                                              mesh);
}

void fill(const Indexed_triangle_mesh& arrays, Open_mesh& mesh)
{
  std::vector<Open_mesh::VertexHandle> v;
  for(const Point_3& p : arrays.points)
    v.push_back(mesh.add_vertex(OpenMesh::Vec3d(p.x(), p.y(), p.z())));
  for(const auto& t : arrays.triangles)
    mesh.add_face(v[t[0]], v[t[1]], v[t[2]]);
}

template <class Mesh>
void collect_garbage(Mesh& mesh)
{
  if constexpr(std::is_same<Mesh, Surface_mesh>::value)
    mesh.collect_garbage();
  else if constexpr(std::is_same<Mesh, Open_mesh>::value)
    mesh.garbage_collection();
}

// What is wrong with the mesh as a halfedge structure, before its garbage is collected.
template <class Mesh>
std::string defect_of(Mesh& mesh)
{
  for(const auto v : vertices(mesh)) {
    bool is_on_border = false;
    for(const auto h : CGAL::halfedges_around_target(v, mesh)) {
      if(target(h, mesh) != v)
        return "a halfedge around a vertex goes elsewhere";
      is_on_border = is_on_border || CGAL::is_border(h, mesh);
    }
    const auto h = halfedge(v, mesh);
    if(std::is_same<Mesh, Surface_mesh>::value && is_on_border && !CGAL::is_border(h, mesh))
      return "the halfedge of a border vertex is inside";
    if(std::is_same<Mesh, Open_mesh>::value && is_on_border && !CGAL::is_border(opposite(h, mesh), mesh))
      return "the halfedge of a border vertex is inside";
  }
  for(const auto f : faces(mesh))
    for(const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh))
      if(face(h, mesh) != f || prev(next(h, mesh), mesh) != h)
        return "the halfedges of a face are not linked";
  if(!CGAL::is_triangle_mesh(mesh))
    return "there are faces that are no triangles";
  return {};
}

template <class Mesh>
std::vector<Triangle_indices>
numbered_triangles(const Mesh& mesh,
                   const std::map<typename boost::graph_traits<Mesh>::vertex_descriptor,
                                  Vertex_index>& number)
{
  std::vector<Triangle_indices> result;
  for(const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    result.push_back({number.at(source(h, mesh)), number.at(target(h, mesh)),
                      number.at(target(next(h, mesh), mesh))});
  }
  return sorted_triangles(result);
}

template <class Mesh>
class Decimate : public testing::Test {};
typedef testing::Types<Surface_mesh, Polyhedron, Open_mesh> Meshes;
TYPED_TEST_SUITE(Decimate, Meshes);

TYPED_TEST(Decimate, leaves_what_the_engine_leaves_of_the_arrays)
{
  for(const SMM::Collapse_order order : {SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT})
    for(const auto& [name, arrays] : generated_meshes(seed)) {
      SCOPED_TRACE(name + ", seed " + std::to_string(seed));
      TypeParam mesh;
      fill(arrays, mesh);
      std::map<typename boost::graph_traits<TypeParam>::vertex_descriptor, Vertex_index> number;
      for(const auto v : vertices(mesh))
        number.emplace(v, Vertex_index(number.size()));
      SMM::Decimation_options options;
      options.order = order;
      options.target_vertices = arrays.points.size() / 5;
      const SMM::Progressive_surface expected = SMM::build_progressive_mesh(arrays, options);
      const std::size_t k = expected.progressive_mesh.collapses.size();
      const SMM::Decimation_result result = SMM::decimate(mesh, options);
      ASSERT_EQ(result.error, "");
      EXPECT_EQ(result.number_of_collapses, k);
      EXPECT_EQ(result.status, Mesh_status::OK);
      EXPECT_EQ(!result.is_exhausted,
                arrays.points.size() - k == options.target_vertices);
      EXPECT_EQ(defect_of(mesh), "");
      EXPECT_EQ(numbered_triangles(mesh, number),
                sorted_triangles(SMM::triangles_after(expected.progressive_mesh, k)));
      const auto vpm = get(CGAL::vertex_point, mesh);
      for(const auto v : vertices(mesh))
        for(int c = 0; c < 3; ++c)
          EXPECT_EQ(get(vpm, v)[c], arrays.points[number.at(v)][c]);
      collect_garbage(mesh);
      EXPECT_EQ(num_vertices(mesh), arrays.points.size() - k);
      EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));

      Indexed_triangle_mesh level = arrays;
      const SMM::Decimation_result of_arrays = SMM::decimate(level, options);
      EXPECT_EQ(of_arrays.number_of_collapses, k);
      ASSERT_EQ(of_arrays.source_vertex.size(), level.points.size());
      for(std::size_t v = 0; v < level.points.size(); ++v)
        EXPECT_EQ(level.points[v], arrays.points[of_arrays.source_vertex[v]]);
      for(Triangle_indices& t : level.triangles)
        for(Vertex_index& v : t)
          v = of_arrays.source_vertex[v];
      EXPECT_EQ(level.triangles, SMM::triangles_after(expected.progressive_mesh, k));
    }
}

TYPED_TEST(Decimate, keeps_constrained_edges)
{
  const Indexed_triangle_mesh arrays = with_hills(irregular_grid(30, 25, seed), 3., seed);
  TypeParam mesh;
  fill(arrays, mesh);
  typedef typename boost::graph_traits<TypeParam>::edge_descriptor Edge;
  typedef typename boost::graph_traits<TypeParam>::vertex_descriptor Vertex;
  auto is_constrained = get(CGAL::dynamic_edge_property_t<int>(), mesh);
  std::vector<std::pair<Vertex, Vertex>> kept;
  std::size_t i = 0;
  for(const Edge e : edges(mesh)) {
    put(is_constrained, e, i++ % 37 == 0);
    if(get(is_constrained, e))
      kept.push_back({source(e, mesh), target(e, mesh)});
  }
  ASSERT_GT(kept.size(), 30u);
  const SMM::Decimation_result result
    = SMM::decimate(mesh, SMS::Count_stop_predicate<TypeParam>(1),
                    CGAL::parameters::edge_is_constrained_map(is_constrained));
  EXPECT_TRUE(result.is_ok() && result.is_exhausted) << result.error;
  EXPECT_GT(result.number_of_collapses, arrays.points.size() / 2);
  EXPECT_EQ(defect_of(mesh), "");
  for(const auto& [v, w] : kept) {
    EXPECT_TRUE(halfedge(v, w, mesh).second);
  }
}

// --- The rest

TEST(Decimate_policies, are_those_of_edge_collapse)
{
  Surface_mesh mesh;
  fill(hills(), mesh);
  const auto is_locked = mesh.add_property_map<Surface_mesh::Vertex_index, bool>("v:lock", false).first;
  std::vector<Surface_mesh::Vertex_index> locked;
  for(const auto v : mesh.vertices())
    if(v.idx() % 10 == 0) {
      is_locked[v] = true;
      locked.push_back(v);
    }
  typedef SMS::Collapse_shape_filter<> Filter;
  typedef SMS::Halfedge_collapse_placement<
    SMS::Edge_length_cost<Surface_mesh>, Filter,
    Surface_mesh::Property_map<Surface_mesh::Vertex_index, bool>> Placement;
  const SMM::Decimation_result result = SMM::decimate(
    mesh, SMS::Count_ratio_stop_predicate<Surface_mesh>(0.2),
    CGAL::parameters::get_cost(SMS::Edge_length_cost<Surface_mesh>())
      .get_placement(Placement({}, Filter(), is_locked))
      .filter(SMS::Bounded_normal_change_filter<>()));
  EXPECT_TRUE(result.is_ok() && !result.is_exhausted) << result.error;
  for(const auto v : locked)
    EXPECT_FALSE(mesh.is_removed(v));
  EXPECT_EQ(defect_of(mesh), "");
}

TEST(Decimate_parameters, points_may_be_elsewhere)
{
  Surface_mesh mesh, flat;
  fill(hills(), mesh);
  const auto points = flat.add_property_map<Surface_mesh::Vertex_index, Point_3>("v:hill").first;
  Indexed_triangle_mesh plane = hills();
  for(Point_3& p : plane.points)
    p = Point_3(0., 0., 0.);
  for(const Point_3& p : plane.points)
    flat.add_vertex(p);
  for(const auto& t : plane.triangles)
    flat.add_face(Surface_mesh::Vertex_index(t[0]), Surface_mesh::Vertex_index(t[1]),
                  Surface_mesh::Vertex_index(t[2]));
  for(const auto v : flat.vertices())
    points[v] = hills().points[v];
  SMM::Decimation_options options;
  options.target_vertices = 500;
  SMM::decimate(mesh, options);
  EXPECT_EQ(SMM::decimate(flat, options).error, "all edges are without length");
  EXPECT_EQ(flat.number_of_removed_vertices(), 0u);
  SMM::decimate(flat, options, CGAL::parameters::vertex_point_map(points));
  for(const auto v : mesh.vertices()) // those that are left
    EXPECT_FALSE(flat.is_removed(v));
  EXPECT_EQ(flat.number_of_vertices(), 500u);
}

TEST(Decimate_threads, do_not_change_the_result)
{
  Indexed_triangle_mesh one = with_hills(irregular_grid(300, 300, seed), 30., seed), two = one;
  SMM::Decimation_options options;
  options.target_edges = 9000;
  SMM::decimate(one, options);
  for(const unsigned int threads : {2u, 7u}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    Indexed_triangle_mesh other = two;
    SMM::decimate(other, options);
    EXPECT_EQ(other.points, one.points);
    EXPECT_EQ(other.triangles, one.triangles);
  }
#ifdef CGAL_LINKED_WITH_TBB
  SMM::decimate<CGAL::Parallel_tag>(two, options);
#else
  SMM::decimate<CGAL::Parallel_if_available_tag>(two, options);
#endif
  EXPECT_EQ(two.triangles, one.triangles);
}

TEST(Decimate_errors, are_sentences_and_leave_the_mesh)
{
  SMM::Decimation_options options;
  options.target_vertices = 3;
  Indexed_triangle_mesh alone = grid(3, 3), fans = grid(3, 3);
  alone.points.push_back(Point_3(7., 7., 7.));
  fans.points.push_back(Point_3(9., 9., 9.));
  fans.points.push_back(Point_3(9., 8., 9.));
  fans.triangles.push_back({0, 16, 17});
  const std::vector<std::pair<Indexed_triangle_mesh, std::string>> bad = {
    {alone, "vertex 16 has no face; remove it first"},
    {fans, "the faces at vertex 0 do not form one fan; split the vertex first"}};
  for(const auto& [mesh, sentence] : bad) {
    Indexed_triangle_mesh copy = mesh;
    const SMM::Decimation_result result = SMM::decimate(copy, options);
    EXPECT_EQ(result.status, Mesh_status::BAD_MESH);
    EXPECT_EQ(result.error, sentence);
    EXPECT_EQ(result.number_of_collapses, 0u);
    EXPECT_EQ(copy.triangles, mesh.triangles);
  }
  Surface_mesh square;
  const auto a = square.add_vertex(Point_3(0, 0, 0)), b = square.add_vertex(Point_3(1, 0, 0)),
             c = square.add_vertex(Point_3(1, 1, 0)), d = square.add_vertex(Point_3(0, 1, 0));
  square.add_face(a, b, c, d);
  EXPECT_EQ(SMM::decimate(square, options).error,
            "not all faces are triangles; triangulate the mesh first");
  EXPECT_EQ(square.number_of_removed_vertices(), 0u);
  options.is_locked = {true};
  Indexed_triangle_mesh good = grid(3, 3);
  EXPECT_EQ(SMM::decimate(good, options).error, "is_locked has 1 entries for 16 vertices");
}

TEST(Decimate_progress, may_cancel)
{
  SMM::Decimation_options options;
  double last = 0.;
  options.target_faces = 100;
  options.progress = [&last](double part) {
    EXPECT_LE(last, part);
    EXPECT_LE(part, 1.);
    last = part;
    return part < 0.5;
  };
  Indexed_triangle_mesh mesh = hills();
  const SMM::Decimation_result result = SMM::decimate(mesh, options);
  EXPECT_EQ(result.status, Mesh_status::CANCELLED);
  EXPECT_EQ(result.error, "cancelled");
  EXPECT_FALSE(result.is_exhausted);
  EXPECT_EQ(mesh.points.size() + result.number_of_collapses, hills().points.size());
  EXPECT_EQ(topology_of(mesh.triangles).defect, "");
  EXPECT_GT(mesh.triangles.size(), 100u);
}

} // namespace decimate_test
