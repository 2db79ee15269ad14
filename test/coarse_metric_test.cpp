// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metric that coarse levels take from the finest.

#include <support/chart_generators.h>
#include <support/operator_meshes.h>

#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/coarse_cotangents.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace coarse_metric_test {

using namespace test_support;
using namespace operator_meshes;

// --- The metric that coarse levels take from the finest

using CGAL::Surface_mesh_parameterization::internal::assemble_conformal_operator;
using CGAL::Surface_mesh_parameterization::internal::Half_cotangents;

// A hierarchy of a mesh and, for each of its levels, cotangents that begin with those of `metric`,
// a mesh of the same triangles.
struct Metric_hierarchy
{
  std::vector<CGAL::Surface_mesh_multiresolution::Mesh_level> levels;
  std::vector<Half_cotangents> cotangents;

  Metric_hierarchy(Indexed_triangle_mesh mesh, const Indexed_triangle_mesh& metric,
                   CGAL::Surface_mesh_multiresolution::Prolongation_rule rule)
  {
    namespace SMM = CGAL::Surface_mesh_multiresolution;
    namespace SMP = CGAL::Surface_mesh_parameterization;
    SMM::Flat_collapse_options decimation;
    decimation.target_vertices = mesh.points.size() / 40;
    const auto pm = SMM::Flat_collapse_engine<>(mesh, CGAL::Indexed_mesh::Vertex_rings(mesh), {})
                      .run(decimation);
    SMM::Hierarchy_options options;
    options.coarsest_size = decimation.target_vertices;
    options.rule = rule;
    levels = SMM::build_hierarchy(std::move(mesh), pm, options);
    cotangents.resize(levels.size());
    cotangents.back() = Half_cotangents(metric);
    for(std::size_t l = levels.size() - 1; l > 0; --l)
      cotangents[l - 1] = SMP::internal::coarse_cotangents(
        {{levels[l].mesh, corners(l)}, cotangents[l]}, {levels[l - 1].mesh, corners(l - 1)},
        levels[l].from_coarser);
  }

  CGAL::Indexed_mesh::Triangles_at_vertices corners(std::size_t l) const
  {
    return {levels[l].mesh.triangles, levels[l].vertices.size()};
  }
};

const auto prolongation_rules = {CGAL::Surface_mesh_multiresolution::Prolongation_rule::WALK,
                                 CGAL::Surface_mesh_multiresolution::Prolongation_rule::VSPLIT};

// In a plane there is one metric, however the levels triangulate it: also one that is not that of
// the points.
TEST(Coarse_metric, is_exact_in_a_plane)
{
  for(const auto& [name, mesh] : planar_charts(21))
    for(const double stretch : {1., 3.})
      for(const auto rule : prolongation_rules) {
        const auto stretched = [stretch](const Indexed_triangle_mesh& m) {
          return moved(m, [stretch](const Point_3& p) {
            return Point_3(stretch * p.x(), p.y(), p.z());
          });
        };
        const Metric_hierarchy hierarchy(mesh, stretched(mesh), rule);
        for(std::size_t l = 0; l < hierarchy.levels.size(); ++l) {
          const Half_cotangents expected(stretched(hierarchy.levels[l].mesh));
          ASSERT_EQ(hierarchy.cotangents[l].value.size(), expected.value.size());
          for(std::size_t i = 0; i < expected.value.size(); ++i)
            EXPECT_NEAR(hierarchy.cotangents[l].value[i], expected.value[i],
                        1e-8 * (1. + std::abs(expected.value[i]))) << name << ", level " << l;
        }
      }
}

// The energy of a triangle, D - |A|, is not negative if c_1 c_2 + c_2 c_3 + c_3 c_1 >= 1 for its
// cotangents; halves of them are stored. Equality holds for the angles of a triangle.
TEST(Coarse_metric, makes_no_energy_negative)
{
  for(const auto& [name, mesh] : curved_charts(22)) {
    Indexed_triangle_mesh normalized = mesh;
    normalize(normalized);
    for(const auto rule : prolongation_rules) {
      const Metric_hierarchy hierarchy(normalized, normalized, rule);
      for(const Half_cotangents& cot : hierarchy.cotangents)
        for(std::size_t i = 0; i < cot.value.size(); i += 3) {
          const double a = cot.value[i], b = cot.value[i + 1], c = cot.value[i + 2];
          const double rounding = 1e-12 * (a * a + b * b + c * c);
          EXPECT_GE(a * b + b * c + c * a, 0.25 - rounding) << name;
          EXPECT_GT(a + b + c, 0.) << name;
        }
    }
  }
}

// What the metric is for: on a noisy surface the minimiser of a coarse level is mostly a better
// start for the fine one.
TEST(Coarse_metric, brings_the_minimiser_of_a_coarse_level_closer_to_the_fine_one)
{
  double product = 1.;
  for(std::uint64_t seed = 31; seed < 41; ++seed) {
    const Indexed_triangle_mesh hills = with_hills(irregular_grid(70, 50, seed), 12., seed + 1);
    Indexed_triangle_mesh mesh = with_noise(hills, 0.3, seed + 2);
    normalize(mesh);
    const Metric_hierarchy hierarchy(mesh, mesh,
                                     CGAL::Surface_mesh_multiresolution::Prolongation_rule::WALK);
    const std::size_t l = hierarchy.levels.size() - 2;
    const auto& coarse = hierarchy.levels[l];
    const auto fine_energy_of_minimiser = [&](const Half_cotangents& cot) {
      auto op = assemble_conformal_operator<double>(coarse.mesh.triangles, hierarchy.corners(l),
                                                    cot, {});
      CGAL::Multigrid::Complex_vector<double> z(coarse.vertices.size()), f(z.size()), x, fine;
      z.back() = 1.;
      op.pin(0);
      op.pin(std::uint32_t(z.size() - 1));
      op.matrix.for_each_row_sum(z, [&](std::size_t i, Complex sum) { f[i] = -sum; });
      CGAL::Multigrid::Sparse_cholesky<> solver;
      EXPECT_TRUE(solver.factorize(op.matrix));
      solver.solve(f, x);
      x.back() = 1.;
      hierarchy.levels[l + 1].from_coarser.prolongate(x, fine);
      return conformal_operator<double>(mesh, no_pins(mesh)).energy(fine);
    };
    const double ratio = fine_energy_of_minimiser(hierarchy.cotangents[l])
                       / fine_energy_of_minimiser(Half_cotangents(coarse.mesh));
    EXPECT_LT(ratio, 1.1) << "seed " << seed;
    product *= ratio;
  }
  EXPECT_LT(std::pow(product, 0.1), 0.95);
}

} // namespace coarse_metric_test
