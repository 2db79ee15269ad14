// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The multigrid layer on an equation of its own: the hierarchy of a surface, and what it prints.

#include <support/dense_multigrid.h>

#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace multigrid_poisson_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace CGAL::Multigrid;
using namespace test_support;

std::vector<SMM::Mesh_level> hierarchy_of(const Indexed_triangle_mesh& mesh,
                                          std::size_t coarsest_size)
{
  SMM::Flat_collapse_options decimation;
  decimation.target_vertices = coarsest_size;
  const auto pm = SMM::Flat_collapse_engine<>(mesh, CGAL::Indexed_mesh::Vertex_rings(mesh), {})
                    .run(decimation);
  SMM::Hierarchy_options options;
  options.coarsest_size = coarsest_size;
  return SMM::build_hierarchy(mesh, pm, options);
}

//
// Printing
//

// The words of the line of a table that begins with `name`.
std::vector<std::string> line_of(const std::string& table, const std::string& name)
{
  std::istringstream lines(table);
  for(std::string line; std::getline(lines, line);) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for(std::string word; stream >> word;)
      words.push_back(word);
    if(!words.empty() && words[0] == name)
      return words;
  }
  return {};
}

template <class Hierarchy>
std::string printed(const Hierarchy& hierarchy)
{
  std::ostringstream out;
  out.precision(3);
  out << hierarchy << 1. / 3.; // the stream is left as it was
  EXPECT_NE(out.str().find("\n0.333"), std::string::npos) << out.str();
  return out.str();
}

TEST(Printing, of_a_hierarchy_of_meshes)
{
  const auto levels = hierarchy_of(with_hills(irregular_grid(40, 30, 1), 3., 2), 60);
  ASSERT_GE(levels.size(), 3u);
  const std::string table = printed(levels);
  std::size_t vertices = 0, triangles = 0;
  for(std::size_t l = 0; l < levels.size(); ++l) {
    const auto words = line_of(table, std::to_string(l));
    ASSERT_EQ(words.size(), l == 0 ? 4u : 5u) << table;
    EXPECT_EQ(words[1], std::to_string(levels[l].vertices.size()));
    EXPECT_EQ(words[2], std::to_string(levels[l].mesh.triangles.size()));
    EXPECT_NEAR(std::stod(words[3]), 1e-6 * double(levels[l].memory()), 0.005);
    if(l > 0) {
      const double ratio
        = double(levels[l].vertices.size()) / double(levels[l - 1].vertices.size());
      EXPECT_NEAR(std::stod(words[4]), ratio, 0.005);
    }
    vertices += levels[l].vertices.size();
    triangles += levels[l].mesh.triangles.size();
  }
  const auto complexity = line_of(table, "complexity:");
  ASSERT_EQ(complexity.size(), 5u) << table;
  EXPECT_NEAR(std::stod(complexity[2]),
              double(vertices) / double(levels.back().vertices.size()), 0.005);
  EXPECT_NEAR(std::stod(complexity[4]),
              double(triangles) / double(levels.back().mesh.triangles.size()), 0.005);
}

TEST(Printing, of_levels_of_matrices)
{
  Random_numbers random(2);
  const Chain_hierarchy chain(4, random);
  std::vector<Hermitian_matrix<float>> matrices;
  for(const Dense_matrix& h : chain.matrices)
    matrices.push_back(sparse_matrix<float>(h));
  Multigrid_levels<SMM::Prolongation, Sparse_cholesky<>> levels;
  EXPECT_EQ(line_of(printed(levels), "total")[1], "0");
  for(std::size_t l = 0; l < matrices.size(); ++l)
    levels.add_level(matrices[l], l == 0 ? nullptr : &chain.prolongations[l]);
  const std::string table = printed(levels);
  double all = 0., finest = 0.;
  for(std::size_t l = 0; l < matrices.size(); ++l) {
    const auto words = line_of(table, std::to_string(l));
    ASSERT_GE(words.size(), 4u) << table;
    EXPECT_EQ(words[1], std::to_string(matrices[l].size()));
    finest = double((chain.matrices[l].array().abs() > 0.).count());
    EXPECT_EQ(std::stod(words[2]), finest);
    all += finest;
  }
  EXPECT_NEAR(std::stod(line_of(table, "complexity:")[4]), all / finest, 0.005);
}

} // namespace multigrid_poisson_test
