// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parameterizer and the measures on every kind of mesh, by SMP::parameterize() and directly. A
// mesh of the same vertices and faces gets the same parameters, whatever its type.

#include <support/conformal_maps.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/boost/graph/Seam_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>
#include <CGAL/boost/graph/properties_PolyMesh_ArrayKernelT.h>

#include <gtest/gtest.h>

#include <unordered_map>
#include <utility>
#include <vector>

namespace mesh_types_test {

using namespace test_support;

typedef CGAL::Simple_cartesian<double> Double_kernel;
typedef CGAL::Simple_cartesian<float> Float_kernel;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Epick;

// Hills of a few thousand faces with holes, at points that float holds exactly
Indexed_triangle_mesh hills()
{
  return moved(with_hills(with_holes(irregular_grid(50, 30, 1), 5, 2), 8., 3),
               [](const Point_3& p) { return Point_3(float(p.x()), float(p.y()), float(p.z())); });
}

SMP::HLSCM_options options()
{
  SMP::HLSCM_options result;
  result.tolerance = 1e-10;
  result.coarsest_size = 300;
  return result;
}

Parameters expected_parameters()
{
  Surface_mesh mesh = to_surface_mesh(hills());
  const Outcome run = parameterize(mesh, options());
  EXPECT_EQ(run.error, SMP::OK) << run.report.message;
  EXPECT_GT(run.report.levels.size(), 1u);
  return run.uv;
}

template <class Mesh, class VertexUVMap>
Parameters parameters_of(const Mesh& mesh, VertexUVMap uvmap)
{
  Parameters result;
  for(const auto v : vertices(mesh))
    result.push_back({CGAL::to_double(get(uvmap, v).x()), CGAL::to_double(get(uvmap, v).y())});
  return result;
}

// Whether each way of parameterizing the mesh gives the same as on the Surface_mesh, and the
// measures too. `uvmap` is used twice.
template <class Mesh, class VertexUVMap>
void expect_same_parameters(const Mesh& mesh, VertexUVMap uvmap, double tolerance)
{
  typedef SMP::HLSCM_parameterizer_3<Mesh> Parameterizer;
  const Parameters expected = expected_parameters();
  Parameterizer parameterizer(options());
  ASSERT_EQ(parameterizer.parameterize(mesh, border_halfedge(mesh), uvmap), SMP::OK)
    << parameterizer.report().message;
  EXPECT_LE(difference(parameters_of(mesh, uvmap), expected), tolerance);
  Surface_mesh reference = to_surface_mesh(hills());
  const SMP::Distortion_measures expected_measures = measure(reference, expected),
                                 measures = SMP::measure_distortion(mesh, uvmap);
  const double rounding = 1e-10 + 1e3 * tolerance; // of sums in another order
  EXPECT_NEAR(measures.conformal_energy, expected_measures.conformal_energy,
              rounding * expected_measures.conformal_energy);
  EXPECT_NEAR(measures.stretch_L2, expected_measures.stretch_L2, rounding);
  EXPECT_EQ(measures.flipped_faces, expected_measures.flipped_faces);
  EXPECT_FALSE(SMP::has_global_overlap(mesh, uvmap));
}

// The same through the function of CGAL.
template <class Mesh, class VertexUVMap>
void expect_same_by_function(Mesh& mesh, VertexUVMap uvmap, double tolerance)
{
  SMP::HLSCM_parameterizer_3<Mesh> parameterizer(options());
  ASSERT_EQ(SMP::parameterize(mesh, parameterizer, border_halfedge(mesh), uvmap), SMP::OK)
    << parameterizer.report().message;
  EXPECT_LE(difference(parameters_of(mesh, uvmap), expected_parameters()), tolerance);
  EXPECT_EQ(parameterizer.report().vertices, num_vertices(mesh)); // though it was copied
}

template <class Kernel>
void test_surface_mesh(double tolerance)
{
  typedef CGAL::Surface_mesh<typename Kernel::Point_3> Mesh;
  Mesh mesh = to_surface_mesh<Mesh>(hills());
  const auto uvmap = mesh.template add_property_map<typename Mesh::Vertex_index,
                                                    typename Kernel::Point_2>("v:uv").first;
  expect_same_parameters(mesh, uvmap, tolerance);
  expect_same_by_function(mesh, uvmap, tolerance);
}

TEST(Surface_mesh, of_doubles) { test_surface_mesh<Double_kernel>(0.); }
TEST(Surface_mesh, of_floats) { test_surface_mesh<Float_kernel>(1e-7); }
TEST(Surface_mesh, with_exact_predicates) { test_surface_mesh<Epick>(0.); }

template <class Mesh>
void test_polyhedron()
{
  typedef typename boost::graph_traits<Mesh>::vertex_descriptor vertex_descriptor;
  Mesh mesh;
  const auto arrays = hills(); // copy_face_graph() would change the order of the vertices
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(arrays.points, arrays.triangles,
                                                              mesh);
  std::unordered_map<vertex_descriptor, Point_2> uv;
  const boost::associative_property_map<std::unordered_map<vertex_descriptor, Point_2>> uvmap(uv);
  expect_same_parameters(mesh, uvmap, 0.);
  uv.clear();
  if constexpr(CGAL::graph_has_property<Mesh, boost::vertex_index_t>::value) {
    CGAL::set_halfedgeds_items_id(mesh);
  }
  expect_same_by_function(mesh, uvmap, 0.);
}

TEST(Polyhedron, without_ids) { test_polyhedron<CGAL::Polyhedron_3<Double_kernel>>(); }

TEST(Polyhedron, with_ids)
{
  test_polyhedron<CGAL::Polyhedron_3<Double_kernel, CGAL::Polyhedron_items_with_id_3>>();
}

TEST(OpenMesh, of_doubles)
{
  struct Traits : OpenMesh::DefaultTraits
  {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
  };
  typedef OpenMesh::PolyMesh_ArrayKernelT<Traits> Mesh;
  typedef SMP::HLSCM_parameterizer_3<Mesh>::Point_2 Point;
  Mesh mesh;
  const auto arrays = hills();
  std::vector<Mesh::VertexHandle> v;
  for(const Point_3& p : arrays.points)
    v.push_back(mesh.add_vertex(OpenMesh::Vec3d(p.x(), p.y(), p.z())));
  for(const auto& t : arrays.triangles)
    mesh.add_face(v[t[0]], v[t[1]], v[t[2]]);
  const auto uvmap = get(CGAL::dynamic_vertex_property_t<Point>(), mesh);
  expect_same_parameters(mesh, uvmap, 0.);
  expect_same_by_function(mesh, uvmap, 0.);
}

// --- Two arrays

// Where products and sums are contracted, another copy of the machine code rounds differently.
constexpr double other_rounding = 1e-6;

Parameters parameters_of(const SMP::Conformal_map& map)
{
  Parameters result;
  for(const auto& p : map.uv)
    result.push_back({p.x(), p.y()});
  return result;
}

TEST(Arrays, by_conformal_map)
{
  const SMP::Conformal_map map = SMP::conformal_map(hills(), options());
  ASSERT_EQ(map.error, "");
  EXPECT_LE(difference(parameters_of(map), expected_parameters()), other_rounding);
  EXPECT_EQ(map.report.vertices, hills().points.size());
  EXPECT_EQ(map.report.faces, hills().triangles.size());
  EXPECT_EQ(map.report.borders, 6u);
}

TEST(Arrays, may_have_vertices_without_a_face)
{
  Indexed_triangle_mesh mesh = hills();
  mesh.points.push_back(Point_3(1., 2., 3.));
  const SMP::Conformal_map map = SMP::conformal_map(mesh, options());
  ASSERT_EQ(map.error, "");
  Parameters uv = parameters_of(map);
  ASSERT_EQ(uv.size(), mesh.points.size());
  EXPECT_EQ(map.uv.back(), CGAL::Simple_cartesian<double>::Point_2(0., 0.));
  uv.pop_back();
  EXPECT_LE(difference(uv, expected_parameters()), other_rounding);
}

TEST(Arrays, without_a_map_say_why)
{
  SMP::HLSCM_options wrong = options(), cancelled = options();
  wrong.tolerance = 0.;
  cancelled.progress = [](double) { return false; };
  Indexed_triangle_mesh two = grid(3, 3);
  for(const Point_3& p : grid(3, 3).points)
    two.points.push_back(p);
  for(const auto& t : grid(3, 3).triangles)
    two.triangles.push_back({t[0] + 16, t[1] + 16, t[2] + 16});
  for(const SMP::Conformal_map& map :
      {SMP::conformal_map(hills(), wrong), SMP::conformal_map(hills(), cancelled),
       SMP::conformal_map(sphere(2)), SMP::conformal_map(two),
       SMP::conformal_map(Indexed_triangle_mesh())}) {
    EXPECT_FALSE(map.is_ok());
    EXPECT_TRUE(map.uv.empty());
    EXPECT_NE(map.report.message, "");
  }
}

// --- A closed mesh cut along seams

typedef boost::graph_traits<Surface_mesh>::edge_descriptor Edge;
typedef boost::graph_traits<Surface_mesh>::vertex_descriptor Vertex;
typedef Surface_mesh::Property_map<Edge, bool> Seam_edge_map;
typedef Surface_mesh::Property_map<Vertex, bool> Seam_vertex_map;
typedef CGAL::Seam_mesh<Surface_mesh, Seam_edge_map, Seam_vertex_map> Seam_mesh;

// Marks the edges of a path from vertex to vertex that goes up as steeply as possible.
template <class AddSeam>
void mark_ascending_path(const Surface_mesh& mesh, Vertex from, const AddSeam& add_seam)
{
  while(true) {
    Vertex next = from;
    for(const auto h : halfedges_around_target(from, mesh))
      if(mesh.point(source(h, mesh)).z() > mesh.point(next).z())
        next = source(h, mesh);
    if(next == from)
      return;
    add_seam(from, next);
    from = next;
  }
}

TEST(Seam_mesh, is_the_mesh_cut_open)
{
  Surface_mesh mesh = to_surface_mesh(with_noise(sphere(5), 0.001, 1));
  const auto is_seam_edge = mesh.add_property_map<Edge, bool>("e:seam", false).first;
  const auto is_seam_vertex = mesh.add_property_map<Vertex, bool>("v:seam", false).first;
  Seam_mesh seam_mesh(mesh, is_seam_edge, is_seam_vertex);
  Vertex lowest = *vertices(mesh).begin();
  for(const Vertex v : vertices(mesh))
    if(mesh.point(v).z() < mesh.point(lowest).z())
      lowest = v;
  mark_ascending_path(mesh, lowest, [&](Vertex a, Vertex b) {
    EXPECT_TRUE(seam_mesh.add_seam(a, b));
  });
  typedef boost::graph_traits<Surface_mesh>::halfedge_descriptor Halfedge;
  const auto uvmap = mesh.add_property_map<Halfedge, Point_2>("h:uv").first;
  const auto bhd = border_halfedge(seam_mesh);
  SMP::HLSCM_parameterizer_3<Seam_mesh> parameterizer(options());
  for(const bool by_function : {false, true}) {
    const auto error = by_function ? SMP::parameterize(seam_mesh, parameterizer, bhd, uvmap)
                                   : parameterizer.parameterize(seam_mesh, bhd, uvmap);
    ASSERT_EQ(error, SMP::OK) << parameterizer.report().message;
    EXPECT_EQ(parameterizer.report().vertices, num_vertices(seam_mesh));
    EXPECT_GT(num_vertices(seam_mesh), num_vertices(mesh));
    EXPECT_EQ(parameterizer.report().borders, 1u);
    // The same surface with the vertices of the seam doubled
    Surface_mesh cut;
    std::vector<std::pair<boost::graph_traits<Seam_mesh>::vertex_descriptor, Vertex>> copies;
    CGAL::copy_face_graph(seam_mesh, cut,
      CGAL::parameters::vertex_to_vertex_output_iterator(std::back_inserter(copies)));
    const Outcome expected = parameterize(cut, options());
    ASSERT_EQ(expected.error, SMP::OK) << expected.report.message;
    Parameters uv(cut.number_of_vertices());
    for(const auto& [v, copy] : copies)
      uv[copy] = {get(uvmap, v).x(), get(uvmap, v).y()};
    // The copy's vertices have another order, and so do the two decimations.
    EXPECT_LE(difference(uv, expected.uv), 1e-6);
    EXPECT_EQ(SMP::measure_distortion(seam_mesh, uvmap).flipped_faces,
              measure(cut, expected.uv).flipped_faces);
    EXPECT_EQ(SMP::has_global_overlap(seam_mesh, uvmap),
              SMP::has_global_overlap(cut, to_uv_map(cut, expected.uv)));
  }
}

} // namespace mesh_types_test
