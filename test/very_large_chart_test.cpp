// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Maps out of core: they are those of a chart in memory, whatever the blocks; a run that was killed
// goes on; what is wrong is said in a sentence, and nothing is written.

#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/map_very_large_chart.h>

#include <support/bad_surfaces.h>
#include <support/binary_ply.h>
#include <support/border_quotient.h>
#include <support/chart_generators.h>
#include <support/very_large_charts.h>
#include <support/very_large_runs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace very_large_chart_test {

namespace SMP = CGAL::Surface_mesh_parameterization;
namespace fs = std::filesystem;
using namespace test_support;

typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;

class Very_large_chart : public Very_large_runs
{
protected:
  void test_against_memory(SMP::Conformal_method method);
  void count_iterations(SMP::Conformal_method method);
};

// The map of the chart in memory, in the unit square.
SMP::Conformal_map expected_map(const Indexed_triangle_mesh& mesh, const SMP::HLSCM_options& options)
{
  SMP::Conformal_map map = SMP::conformal_map(mesh, options);
  CGAL::Bbox_2 box;
  for(const Point_2& p : map.uv)
    box += p.bbox();
  const double scale = 1. / (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  for(Point_2& p : map.uv)
    p = Point_2(scale * (p.x() - box.xmin()), scale * (p.y() - box.ymin()));
  SMP::move_report(map.report, scale, -scale * box.xmin(), -scale * box.ymin());
  return map;
}

std::size_t number_of_flips(const Indexed_triangle_mesh& mesh, const std::vector<Point_2>& uv)
{
  std::size_t result = 0;
  for(const auto& t : mesh.triangles)
    result += CGAL::orientation(uv[t[0]], uv[t[1]], uv[t[2]]) == CGAL::RIGHT_TURN ? 1 : 0;
  return result;
}

double difference(const std::vector<Point_2>& a, const std::vector<Point_2>& b)
{
  double result = 0.;
  for(std::size_t i = 0; i < a.size(); ++i)
    result = (std::max)(result, std::sqrt(squared_distance(a[i], b[i])));
  return result;
}

// The energy in the square of the distance of the pins, or in the size of the border: both, unlike the
// unit square, see the largest uv no more than others.
double measured(const Indexed_triangle_mesh& mesh, const SMP::HLSCM_report& report,
                const std::vector<Point_2>& uv)
{
  const auto& p = report.pins;
  return p.empty() ? border_quotient(mesh, uv, report.energy)
                   : report.energy / (std::pow(p[1].u - p[0].u, 2) + std::pow(p[1].v - p[0].v, 2));
}

// At full convergence, from 1 to 64 blocks.
void Very_large_chart::test_against_memory(SMP::Conformal_method method)
{
  std::size_t most_blocks = 0;
  for(const Very_large_chart_case& chart : very_large_chart_cases(method)) {
    SCOPED_TRACE(chart.name);
    const Indexed_triangle_mesh& mesh = chart.mesh;
    const std::size_t n = mesh.points.size();
    write_records(mesh, input());
    SMP::HLSCM_options in_memory;
    in_memory.method = method;
    in_memory.tolerance = chart.tolerance;
    in_memory.coarsest_size = 200;
    const SMP::Conformal_map expected = expected_map(mesh, in_memory);
    ASSERT_EQ(expected.error, "");
    for(const auto& [block, gathered] : chart.sizes) {
      SCOPED_TRACE(std::to_string(block) + " vertices a block, in memory " + std::to_string(gathered));
      Options o = options(block, gathered, chart.tolerance);
      o.solver.method = method;
      const Report report = map(o);
      ASSERT_EQ(report.error, SMP::OK) << report.message;
      const Mapped_ply mapped = read_mapped_ply(output, n, mesh.triangles.size());
      EXPECT_EQ(mapped.mesh.points, mesh.points);
      EXPECT_EQ(mapped.mesh.triangles, mesh.triangles);
      EXPECT_EQ(report.solver.method, expected.report.method);
      ASSERT_EQ(report.solver.pins.size(), expected.report.pins.size());
      for(const SMP::HLSCM_pin& pin : report.solver.pins) {
        const auto &p = expected.report.pins[0], &q = expected.report.pins[1];
        EXPECT_TRUE(pin.vertex == p.vertex || pin.vertex == q.vertex);
        EXPECT_NEAR(mapped.uv[pin.vertex].x(), pin.u, 1e-12);
      }
      EXPECT_LT(difference(mapped.uv, expected.uv), chart.largest_difference);
      const double least = measured(mesh, expected.report, expected.uv);
      EXPECT_NEAR(measured(mesh, report.solver, mapped.uv), least,
                  (chart.tolerance > 1e-11 ? 1e-4 : 1e-8) * least + 1e-12);
      EXPECT_EQ(report.flipped_faces, number_of_flips(mesh, mapped.uv));
      if(!chart.is_doubtful) {
        EXPECT_EQ(report.flipped_faces, number_of_flips(mesh, expected.uv));
      }
      EXPECT_EQ(report.solver.borders, expected.report.borders);
      EXPECT_EQ(report.levels_in_files > 0, gathered < n);
      EXPECT_GE(report.blocks, gathered < n ? n / (std::max)(block, std::size_t(200)) : 1u);
      most_blocks = (std::max)(most_blocks, report.blocks);
      EXPECT_FALSE(fs::exists(work()));
    }
  }
  EXPECT_GE(most_blocks, is_sanitized ? 16u : 64u);
}

TEST_F(Very_large_chart, is_that_in_memory) { test_against_memory(SMP::Conformal_method::HLSCM); }

TEST_F(Very_large_chart, is_that_in_memory_without_pins)
{
  test_against_memory(SMP::Conformal_method::SPECTRAL);
}

// At the tolerances in use the energy is within them of the minimum, and the iterations are hardly more
// than in memory: on one chart numbers differ by chance, all together do not.
void Very_large_chart::count_iterations(SMP::Conformal_method method)
{
  std::vector<Named_mesh> all = curved_charts(1);
  all = {all[2], all[3], all[9]};
  if(!is_sanitized)
    all.push_back(large_charts(8)[1]);
  std::size_t iterations = 0, expected_iterations = 0;
  for(const Named_mesh& chart : all) {
    SCOPED_TRACE(chart.name);
    write_records(chart.mesh, input());
    const std::size_t n = chart.mesh.points.size();
    SMP::HLSCM_options in_memory;
    in_memory.method = method;
    in_memory.tolerance = 1e-9;
    in_memory.coarsest_size = n / 15;
    const SMP::Conformal_map best = SMP::conformal_map(chart.mesh, in_memory);
    const double least = measured(chart.mesh, best.report, best.uv);
    for(const double tolerance : {1e-2, 1e-4}) {
      in_memory.tolerance = tolerance;
      const std::size_t expected = SMP::conformal_map(chart.mesh, in_memory).report.iterations;
      for(const std::size_t blocks : {1, 16}) {
        Options o = options(n / blocks, n / 3, tolerance);
        o.solver.method = method;
        o.solver.coarsest_size = in_memory.coarsest_size;
        const Report report = map(o);
        ASSERT_EQ(report.error, SMP::OK) << report.message;
        EXPECT_LE(double(report.solver.iterations), 1.3 * double(expected) + 2.)
          << tolerance << ", blocks " << report.blocks;
        iterations += report.solver.iterations;
        expected_iterations += expected;
        const double energy = measured(
          chart.mesh, report.solver, read_mapped_ply(output, n, chart.mesh.triangles.size()).uv);
        EXPECT_LE(energy, (1. + tolerance) * least);
        EXPECT_GE(energy, (1. - 1e-8) * least);
      }
    }
  }
  EXPECT_LE(double(iterations), 1.3 * double(expected_iterations));
}

TEST_F(Very_large_chart, needs_no_more_iterations) { count_iterations(SMP::Conformal_method::HLSCM); }

TEST_F(Very_large_chart, needs_no_more_iterations_without_pins)
{
  count_iterations(SMP::Conformal_method::SPECTRAL);
}

// A plane stays as it is: there no map with two pins has any energy, nor one without.
TEST_F(Very_large_chart, leaves_a_plane_as_it_is_without_pins)
{
  const Indexed_triangle_mesh mesh = with_jagged_border(irregular_grid(50, 30, 4), 0.4, 5);
  write_records(mesh, input());
  const std::size_t n = mesh.points.size();
  Options o = options(n / 6, n / 4, 1e-6);
  o.solver.method = SMP::Conformal_method::SPECTRAL;
  const Report report = map(o);
  ASSERT_EQ(report.error, SMP::OK) << report.message;
  EXPECT_EQ(report.flipped_faces, 0u);
  const std::vector<Point_2> uv = read_mapped_ply(output, n, mesh.triangles.size()).uv;
  double least = 1e9, most = 0.;
  for(const auto& t : mesh.triangles)
    for(int c = 0; c < 3; ++c) {
      const auto v = t[c], w = t[(c + 1) % 3];
      const double ratio = std::sqrt(squared_distance(uv[v], uv[w])
                                     / squared_distance(mesh.points[v], mesh.points[w]));
      least = (std::min)(least, ratio);
      most = (std::max)(most, ratio);
    }
  EXPECT_LT(most / least, 1.001);
}

// A small part of very many vertices is more than a coarse level: if they stayed, it would consist of them.
TEST_F(Very_large_chart, does_not_keep_what_noise_makes_pointed)
{
  Indexed_triangle_mesh mesh = with_hills(irregular_grid(160, 120, 4), 5., 6);
  std::mt19937 random(7);
  for(auto& p : mesh.points)
    if(random() % 12 == 0)
      p = {p.x(), p.y(), p.z() + 2.5};
  write_records(mesh, input());
  Options o = options(3000, 3000, 1e-2);
  const Report report = map(o);
  ASSERT_EQ(report.error, SMP::OK) << report.message;
  EXPECT_EQ(report.solver.levels.front().vertices, o.solver.coarsest_size);
  EXPECT_LE(report.solver.iterations, 10u);
  o.solver.angular_defect_bound = SMP::HLSCM_options().angular_defect_bound;
  EXPECT_NE(map(o).message.find("too few vertices can be removed"), std::string::npos);
}

TEST_F(Very_large_chart, does_not_depend_on_the_number_of_threads)
{
  const Indexed_triangle_mesh mesh
    = is_sanitized ? curved_charts(1)[3].mesh : large_charts(1)[1].mesh;
  write_records(mesh, input());
  Options o = options(mesh.points.size() / 3, mesh.points.size() / 4, 1e-2);
  ASSERT_EQ(map(o).error, SMP::OK);
  std::string first = output;
  const auto expect_same = [&] {
    for(const unsigned int threads : {1, 2, 3}) {
      o.solver.threads = threads;
      ASSERT_EQ(map(o).error, SMP::OK);
      EXPECT_TRUE(output == first) << threads << " threads";
    }
  };
  expect_same();
  o.solver.method = SMP::Conformal_method::SPECTRAL;
  ASSERT_EQ(map(o).error, SMP::OK);
  ASSERT_FALSE(output == first);
  first = output;
  expect_same();
}

// Floats, the other order of bytes, vertices that no face has.
TEST_F(Very_large_chart, takes_all_records)
{
  Indexed_triangle_mesh mesh = curved_charts(2)[1].mesh;
  const auto rounded = [](volatile float x) { return double(x); }; // g++ 12 -O3 leaves some as they are
  for(auto& p : mesh.points)
    p = Point_3(rounded(p.x()), rounded(p.y()), rounded(p.z()));
  const std::size_t n = mesh.points.size(), faces = mesh.triangles.size();
  const Options o = options(n / 3, n / 2, 1e-3);
  write_records(mesh, input());
  ASSERT_EQ(map(o).error, SMP::OK);
  const std::string plain = output;
  write_records<float>(mesh, input());
  EXPECT_TRUE(map(o).error == SMP::OK && output == plain);
  write_records(mesh, input(), true);
  EXPECT_TRUE(map(o).error == SMP::OK && output == plain);
  mesh.points.push_back(Point_3(1e6, 0., 0.));
  write_records(mesh, input());
  const Report report = map(o);
  ASSERT_EQ(report.error, SMP::OK) << report.message;
  EXPECT_EQ(report.solver.vertices, n);
  const Mapped_ply mapped = read_mapped_ply(output, n + 1, faces);
  EXPECT_EQ(mapped.uv.back(), Point_2(0., 0.));
  EXPECT_LT(difference(read_mapped_ply(plain, n, faces).uv, mapped.uv), 1e-12);
}

// ---- what is wrong

TEST_F(Very_large_chart, refuses_bad_surfaces)
{
  const Indexed_triangle_mesh hills = curved_charts(3)[1].mesh;
  const std::size_t n = hills.points.size();
  const auto error = [&](const Indexed_triangle_mesh& mesh, const std::string& words) {
    write_records(mesh, input());
    for(const std::size_t block : {n, n / 5}) {
      const Report report = map(options(block, block == n ? n : n / 3, 1e-2));
      const std::string error = error_in_failure(report, words);
      if(!error.empty() || fs::exists(work()))
        return error + (fs::exists(work()) ? " the folder is still there" : "");
    }
    return std::string();
  };
  EXPECT_EQ(error(sphere(5), "the surface is closed"), "");
  write_records(hills, input());
  for(const auto method : {SMP::Conformal_method::CASCADIC, SMP::Conformal_method::LSCM,
                           SMP::Conformal_method::DIRECT}) {
    Options o = options(n, n, 1e-2);
    o.solver.method = method;
    EXPECT_EQ(error_in_failure(map(o), "needs the whole chart in memory"), "");
  }
  std::vector<bool> is_kept(60 * 40, true);
  is_kept[77] = false;
  EXPECT_EQ(error(without_vertices(torus(60, 40), is_kept), "the surface has genus 1"), "");
  Indexed_triangle_mesh bad = hills;
  append(bad, translated(hills, 500., 0., 0.));
  EXPECT_EQ(error(bad, "the surface has several components"), "");
  bad = hills;
  bad.triangles[17][1] = Vertex_index(n);
  EXPECT_EQ(error(bad, "face 17 names vertex " + std::to_string(n)), "");
  bad = hills;
  bad.points[33] = Point_3(0., std::numeric_limits<double>::quiet_NaN(), 0.);
  EXPECT_EQ(error(bad, "vertex 33 has a coordinate that is not a finite number"), "");
  bad = hills;
  std::swap(bad.triangles[1000][0], bad.triangles[1000][1]);
  EXPECT_EQ(error(bad, "has an edge with more than two faces, or with two faces of different"), "");
  bad = hills; // two vertices become one
  for(auto& t : bad.triangles)
    for(auto& v : t)
      v = v == n / 2 ? Vertex_index(n / 4) : v;
  EXPECT_EQ(error(bad, "the faces at vertex " + std::to_string(n / 4) + " do not form one fan"), "");
  bad = hills;
  bad.triangles[17][1] = bad.triangles[17][2];
  EXPECT_EQ(error(bad, "face 17 has a vertex twice"), "");
  bad = hills;
  for(auto& p : bad.points)
    p = Point_3(1., 2., 3.);
  EXPECT_EQ(error(bad, "all edges are without length"), "");
}

TEST_F(Very_large_chart, refuses_bad_files)
{
  const Indexed_triangle_mesh mesh = grid(20, 20);
  const std::size_t n = mesh.points.size();
  write_records(mesh, input());
  std::ifstream in(input(), std::ios::binary);
  const std::string good(std::istreambuf_iterator<char>(in), {});
  const auto error = [&](const std::string& bytes, const std::string& words) {
    std::ofstream(input(), std::ios::binary) << bytes;
    return error_in_failure(map(options(n / 3, n / 2, 1e-2)), words);
  };
  const auto changed = [&good](const std::string& from, const std::string& to) {
    std::string bytes = good;
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  EXPECT_EQ(error(good, "nothing").find("\"\" does not"), 0u); // all is well
  EXPECT_EQ(error(good.substr(0, good.size() - 1), "the file is cut off: it should have "
                  + std::to_string(good.size()) + " bytes"), "");
  EXPECT_EQ(error(good.substr(0, 90), "the header of the PLY file does not end"), "");
  EXPECT_EQ(error(good.substr(0, good.find("end_header") + 10), "the header of the PLY file does not end"),
            "");
  const std::string format = "format binary_little_endian 1.0\n";
  EXPECT_EQ(error(changed(format, std::string(format.size() - 1, ' ') + '\n'), "has no format"), "");
  EXPECT_EQ(error("", "this is not a PLY file"), "");
  EXPECT_EQ(error("v 0 0 0\nf 1 1 1\n", "this is not a PLY file, convert it to binary PLY"), "");
  EXPECT_EQ(error(changed("binary_little_endian", "ascii"), "convert it to binary PLY"), "");
  EXPECT_EQ(error(changed("double y", "double w"), "no properties x, y and z"), "");
  EXPECT_EQ(error(changed("uchar quality", "list uchar float q"), "list \"q\""), "");
  EXPECT_EQ(error(changed("element face ", "element face 99999999999999999"), "cut off"), "");
  std::string polygon = good;
  polygon[good.size() - 15 * 5] = 4;
  EXPECT_EQ(error(polygon, "face " + std::to_string(mesh.triangles.size() - 5)
                  + " is not a triangle"), "");
  fs::remove(input());
  EXPECT_EQ(error_in_failure(map(options(n, n, 1e-2)), "cannot be opened"), "");
}

// Faces without area that several blocks know are counted once.
TEST_F(Very_large_chart, counts_faces_without_area)
{
  Indexed_triangle_mesh mesh = grid(40, 40);
  for(auto& p : mesh.points) // of a plane the energy would be that of these faces alone, by rounding
    p = Point_3(p.x(), p.y(), 3. * std::sin(0.3 * p.x()) * std::cos(0.2 * p.y()));
  std::size_t expected = 0;
  for(std::size_t t = 0; t < mesh.triangles.size(); t += 211) { // one vertex onto another
    const auto v = mesh.triangles[t];
    mesh.points[v[0]] = mesh.points[v[1]];
  }
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    expected += SMP::internal::conformal_triangle(mesh, t).is_mollified() ? 1 : 0;
  ASSERT_GT(expected, 10u);
  write_records(mesh, input());
  const std::size_t n = mesh.points.size();
  for(const std::size_t block : {n, n / 7}) {
    const Report report = map(options(block, n / 3, 1e-2));
    ASSERT_EQ(report.error, SMP::OK) << report.message;
    EXPECT_EQ(report.solver.mollified_faces, expected) << report.blocks;
  }
}

} // namespace very_large_chart_test
