// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the examples of CGAL's package for parameterization do with LSCM_parameterizer_3 and with
// border parameterizers, written anew, for it and for HLSCM_parameterizer_3: nothing but the name of
// the type changes.

#include <support/chart_generators.h>
#include <support/mesh_generators.h>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Square_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Two_vertices_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/boost/graph/Seam_mesh.h>

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

namespace cgal_examples_test {

using namespace test_support;
namespace SMP = CGAL::Surface_mesh_parameterization;

typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;
typedef Surface_mesh::Vertex_index Vertex;
typedef CGAL::Seam_mesh<Surface_mesh, Surface_mesh::Property_map<Surface_mesh::Edge_index, bool>,
                        Surface_mesh::Property_map<Vertex, bool>>
  Seam_mesh;

// The two parameterizers by one name
struct Cgal_lscm
{
  template <class... Arguments>
  using Parameterizer = SMP::LSCM_parameterizer_3<Arguments...>;
};

struct Hlscm
{
  template <class... Arguments>
  using Parameterizer = SMP::HLSCM_parameterizer_3<Arguments...>;
};

template <class Names>
class Cgal_example
  : public testing::Test
{};

typedef testing::Types<Cgal_lscm, Hlscm> Both;
TYPED_TEST_SUITE(Cgal_example, Both);

Surface_mesh hills() { return to_surface_mesh(with_hills(irregular_grid(20, 15, 1), 2., 3)); }

// A sphere that is cut open along two edges, and two vertices of the seam mesh pinned.
TYPED_TEST(Cgal_example, two_vertices_of_a_seam_mesh)
{
  Surface_mesh mesh = to_surface_mesh(sphere(3));
  const auto is_seam_edge
    = mesh.add_property_map<Surface_mesh::Edge_index, bool>("e:on_seam", false).first;
  const auto is_seam_vertex = mesh.add_property_map<Vertex, bool>("v:on_seam", false).first;
  Seam_mesh seam_mesh(mesh, is_seam_edge, is_seam_vertex);
  const auto first = *halfedges(mesh).begin();
  const auto second = next(opposite(next(first, mesh), mesh), mesh);
  seam_mesh.add_seam(source(first, mesh), target(first, mesh));
  seam_mesh.add_seam(target(first, mesh), target(second, mesh));

  typedef boost::graph_traits<Seam_mesh>::vertex_descriptor vertex_descriptor;
  typedef boost::graph_traits<Seam_mesh>::halfedge_descriptor halfedge_descriptor;
  const halfedge_descriptor one(first), two(second);
  const vertex_descriptor v1 = source(one, seam_mesh), v2 = target(two, seam_mesh);
  const auto uv_of_halfedge
    = mesh.add_property_map<Surface_mesh::Halfedge_index, Point_2>("h:uv").first;

  typedef SMP::Two_vertices_parameterizer_3<Seam_mesh> Border_parameterizer;
  typedef typename TypeParam::template Parameterizer<Seam_mesh, Border_parameterizer> Parameterizer;
  const halfedge_descriptor bhd = CGAL::Polygon_mesh_processing::longest_border(seam_mesh).first;
  ASSERT_EQ(SMP::parameterize(seam_mesh, Parameterizer(Border_parameterizer(v1, v2)), bhd,
                              uv_of_halfedge),
            SMP::OK);
  // Both are pinned, elsewhere
  const Point_2 p = get(uv_of_halfedge, v1), q = get(uv_of_halfedge, v2);
  EXPECT_TRUE(std::isfinite(p.x()) && std::isfinite(q.x()));
  EXPECT_NE(p, q);
}

// A border that is pinned as a whole stays where it is.
template <class Parameterizer, class Border_parameterizer>
void expect_border_in_place(const Parameterizer& parameterizer, Border_parameterizer border)
{
  Surface_mesh mesh = hills();
  const auto bhd = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  const auto uvmap = mesh.add_property_map<Vertex, Point_2>("v:uv").first;
  ASSERT_EQ(SMP::parameterize(mesh, parameterizer, bhd, uvmap), SMP::OK);
  const auto expected = mesh.add_property_map<Vertex, Point_2>("v:expected").first;
  const auto indices = mesh.add_property_map<Vertex, int>("v:index").first;
  const auto is_pinned = mesh.add_property_map<Vertex, bool>("v:pinned", false).first;
  ASSERT_EQ(border.parameterize(mesh, bhd, expected, indices, is_pinned), SMP::OK);
  std::size_t pinned = 0;
  for(const Vertex v : vertices(mesh)) {
    EXPECT_TRUE(std::isfinite(uvmap[v].x()) && std::isfinite(uvmap[v].y()));
    EXPECT_TRUE(is_pinned[v] || !mesh.is_border(v));
    if(!is_pinned[v])
      continue;
    ++pinned;
    EXPECT_NEAR(uvmap[v].x(), expected[v].x(), 1e-12);
    EXPECT_NEAR(uvmap[v].y(), expected[v].y(), 1e-12);
  }
  EXPECT_EQ(pinned, 70u);
}

TYPED_TEST(Cgal_example, square_border)
{
  typedef SMP::Square_border_arc_length_parameterizer_3<Surface_mesh> Border_parameterizer;
  typedef typename TypeParam::template Parameterizer<Surface_mesh, Border_parameterizer>
    Parameterizer;
  expect_border_in_place(Parameterizer(Border_parameterizer()), Border_parameterizer());
  typedef SMP::Square_border_uniform_parameterizer_3<Surface_mesh> Uniform;
  typedef typename TypeParam::template Parameterizer<Surface_mesh, Uniform> Uniform_parameterizer;
  expect_border_in_place(Uniform_parameterizer(Uniform()), Uniform());
}

TYPED_TEST(Cgal_example, circular_border)
{
  typedef SMP::Circular_border_arc_length_parameterizer_3<Surface_mesh> Border_parameterizer;
  typedef typename TypeParam::template Parameterizer<Surface_mesh, Border_parameterizer>
    Parameterizer;
  expect_border_in_place(Parameterizer(Border_parameterizer()), Border_parameterizer());
}

// A solver as template argument and as object: one that factorizes, and one that iterates.
template <class Names, class EigenSolver>
void expect_map_by()
{
  typedef CGAL::Eigen_solver_traits<EigenSolver> Solver_traits;
  typedef SMP::Two_vertices_parameterizer_3<Surface_mesh> Border_parameterizer;
  typedef
    typename Names::template Parameterizer<Surface_mesh, Border_parameterizer, Solver_traits>
      Parameterizer;
  Surface_mesh mesh = hills();
  const auto uvmap = mesh.add_property_map<Vertex, Point_2>("v:uv").first;
  const auto bhd = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  Parameterizer parameterizer(Border_parameterizer(Vertex(0), Vertex(20)), Solver_traits());
  ASSERT_EQ(SMP::parameterize(mesh, parameterizer, bhd, uvmap), SMP::OK);
  for(const Vertex v : vertices(mesh))
    ASSERT_TRUE(std::isfinite(uvmap[v].x()) && std::isfinite(uvmap[v].y()));
  EXPECT_NE(uvmap[Vertex(0)], uvmap[Vertex(20)]);
}

TYPED_TEST(Cgal_example, solvers_as_arguments)
{
  typedef CGAL::Eigen_sparse_matrix<double>::EigenType Matrix;
  expect_map_by<TypeParam, Eigen::SimplicialLDLT<Matrix>>();
  expect_map_by<TypeParam, Eigen::ConjugateGradient<Matrix>>();
}

// The constructor without arguments, and the question whether the map is one-to-one.
TYPED_TEST(Cgal_example, default_arguments)
{
  typedef typename TypeParam::template Parameterizer<Surface_mesh> Parameterizer;
  Surface_mesh mesh = hills();
  const auto uvmap = mesh.add_property_map<Vertex, Point_2>("v:uv").first;
  const auto bhd = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  const Parameterizer parameterizer;
  EXPECT_EQ(SMP::parameterize(mesh, parameterizer, bhd, uvmap), SMP::OK);
  const bool is_one_to_one = parameterizer.is_one_to_one_mapping(mesh, bhd, uvmap);
  static_assert(std::is_same<decltype(is_one_to_one), const bool>::value, "");
}

// A solver without factor(), as CGAL's default one is, is recognised, so that one sentence says what
// is missing.
static_assert(!SMP::internal::Has_factor<CGAL::Eigen_solver_traits<>>::value, "");
static_assert(SMP::internal::Has_factor<CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<
                CGAL::Eigen_sparse_matrix<double>::EigenType>>>::value, "");

} // namespace cgal_examples_test
