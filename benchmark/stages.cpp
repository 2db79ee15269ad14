// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What each stage of parameterize() costs, beside what bounds it: a CSV file on stdout. The stages
// are run one by one, by the functions that the parameterizer calls; the last rows are their sum
// and parameterize() itself. With --threads, the same with that many threads beside it: the runs
// alternate.
//
// Usage: stages [--threads N] MESH...

#include "charts/chart_io.h"
#include "machine.h"
#include "stages/Stage.h"
#include "stages/bytes.h"

#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>

#include <CLI/CLI.hpp>

#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

using namespace stages;
namespace MG = CGAL::Multigrid;
namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMP = CGAL::Surface_mesh_parameterization;
typedef charts::Surface_mesh Mesh;
typedef Mesh::Property_map<Mesh::Vertex_index, charts::Kernel::Point_2> Uv_map;

constexpr int repetitions = 5;

// The default solver of the coarsest level, which counts what it solves.
class Counting_cholesky
  : public MG::Sparse_cholesky<>
{
public:
  template <class Real>
  void solve(const MG::Complex_vector<Real>& f, MG::Complex_vector<Real>& x)
  {
    const timing::Stopwatch stopwatch;
    MG::Sparse_cholesky<>::solve(f, x);
    m_seconds += stopwatch.seconds();
    ++m_solutions;
  }

  double seconds() const { return m_seconds; }
  double solutions() const { return m_solutions; }

private:
  double m_seconds = 0, m_solutions = 0;
};

SMP::internal::Chart copy_of(const Mesh& mesh)
{
  SMP::internal::Chart chart;
  SMP::internal::Status status;
  SMP::internal::copy_faces(mesh, chart, status);
  return chart;
}

// One cost evaluation for each vertex of the mesh, in its order: one collapse only.
double seconds_per_evaluation(const Mesh& mesh)
{
  SMP::internal::Prepared_chart prepared;
  prepared.chart = copy_of(mesh);
  SMP::internal::prepare_chart(prepared, CGAL::Indexed_mesh::no_vertex);
  const SMP::internal::Chart& chart = prepared.chart;
  SMM::Flat_collapse_options options;
  options.target_vertices = chart.mesh.points.size() - 1;
  double best = 1;
  for(int i = 0; i < repetitions; ++i) {
    SMM::Flat_collapse_engine<> engine(chart.mesh, chart.rings, {});
    const timing::Stopwatch stopwatch;
    engine.run(options);
    best = std::min(best, stopwatch.seconds() / double(engine.number_of_evaluations()));
  }
  return best;
}

// A map that is made stage by stage, as by HLSCM_parameterizer_3 with its default options.
class Staged_map
{
public:
  Staged_map(const Mesh& mesh, Uv_map uvmap, double seconds_per_evaluation)
    : m_mesh(mesh), m_uvmap(uvmap), m_seconds_per_evaluation(seconds_per_evaluation)
    , m_v(double(mesh.number_of_vertices())), m_f(double(mesh.number_of_faces()))
  {}

  std::vector<Stage> run()
  {
    prepare_chart();
    decimate();
    build_operators();
    solve();
    write_back();
    return m_list.stages();
  }

private:
  void prepare_chart();
  void decimate();
  void build_operators();
  void solve();
  void write_back();
  double iterate(std::size_t l);
  Row_bytes row_bytes() const;

  Stage& stage(const std::string& name, double count, const std::string& of, const Bound& bound,
               const std::function<void()>& work)
  {
    Stage& result = m_list.run(name, work);
    result.count = count;
    result.of = of;
    result.bound = bound;
    return result;
  }

  const Mesh& m_mesh;
  Uv_map m_uvmap;
  double m_seconds_per_evaluation, m_v, m_f;
  const SMP::HLSCM_options m_options;
  SMP::internal::Chart m_chart;
  SMP::internal::Status m_status;
  SMP::internal::Pins m_pins;
  std::shared_ptr<Counting_cholesky> m_coarsest = std::make_shared<Counting_cholesky>();
  SMP::internal::Conformal_hierarchy m_hierarchy{SMP::internal::Coarsest_solver(m_coarsest)};
  std::vector<Level_size> m_sizes;
  MG::Complex_vector<double> m_z;
  Stage_list m_list;
};

// As internal::extract_chart() of a mesh with one component.
void Staged_map::prepare_chart()
{
  stage("copy of the mesh", m_f, "faces", copying(copy_bytes(m_v, m_f)),
        [this] { m_chart = copy_of(m_mesh); });
  stage("unused vertices and unit of length", m_v, "vertices", copying(normalize_bytes(m_v, m_f)),
        [this] {
          m_chart.source.resize(m_chart.mesh.points.size());
          std::iota(m_chart.source.begin(), m_chart.source.end(), 0u);
          CGAL::Indexed_mesh::drop_unused_vertices(m_chart.mesh, m_chart.source);
          m_chart.scale = CGAL::Indexed_mesh::normalize(m_chart.mesh);
        });
  stage("spatial order", m_v, "vertices", copying(sort_bytes(m_v, m_f)), [this] {
    const std::vector<CGAL::Indexed_mesh::Vertex_index> order = CGAL::Indexed_mesh::sort_spatially(m_chart.mesh);
    std::vector<std::uint32_t> source(order.size());
    for(std::size_t v = 0; v < order.size(); ++v)
      source[v] = m_chart.source[order[v]];
    m_chart.source.swap(source);
  });
  stage("rings", m_v, "vertices", copying(ring_bytes(m_v, m_f)),
        [this] { m_chart.rings = CGAL::Indexed_mesh::Vertex_rings(m_chart.mesh); });
  stage("component; borders; pins", m_v, "vertices", copying(border_bytes(m_v)), [this] {
    const std::vector<bool> is_reached = CGAL::Indexed_mesh::component_of(m_chart.rings, 0);
    if(std::find(is_reached.begin(), is_reached.end(), false) != is_reached.end())
      throw std::runtime_error("the chart has several components");
    m_chart.borders = CGAL::Indexed_mesh::border_loops(m_chart.rings);
    SMP::internal::check_topology(m_chart, m_status);
    m_pins = SMP::internal::far_border_pins(m_chart);
  });
}

// As internal::decimate() and internal::Conformal_system.
void Staged_map::decimate()
{
  SMM::Progressive_mesh pm;
  std::size_t evaluations = 0;
  Stage& decimation = stage("decimation", 0, "collapses", {}, [&] {
    std::vector<bool> is_locked(m_chart.mesh.points.size(), false);
    for(const SMP::internal::Pin& pin : m_pins)
      is_locked[pin.vertex] = true;
    SMM::Flat_collapse_options options;
    options.target_vertices = m_options.coarsest_size;
    SMM::Flat_collapse_engine<> engine(
        m_chart.mesh, std::move(m_chart.rings), is_locked, SMM::hierarchy_collapse_cost(),
        SMM::hierarchy_collapse_filter(m_options.angular_defect_bound));
    pm = engine.run(options);
    evaluations = engine.number_of_evaluations();
  });
  decimation.count = double(pm.collapses.size());
  decimation.bound = {"cost evaluations", double(evaluations), m_seconds_per_evaluation};
  Stage& levels = stage("levels and prolongation", m_v, "vertices", {}, [&] {
    SMM::Hierarchy_options options;
    options.coarsest_size = m_options.coarsest_size;
    m_hierarchy.set_levels(SMM::build_hierarchy(std::move(m_chart.mesh), pm, options));
    pm = SMM::Progressive_mesh();
  });
  m_sizes = sizes_of(m_hierarchy.levels());
  levels.bound = copying(level_bytes(m_sizes));
}

Row_bytes Staged_map::row_bytes() const
{
  const MG::Hermitian_matrix<double>& h = m_hierarchy.finest().matrix;
  MG::Hermitian_matrix<float> rounded;
  rounded.assign(h);
  return {traffic::matrix_bytes(h) / m_v, traffic::matrix_bytes(rounded) / m_v};
}

void Staged_map::build_operators()
{
  Stage& operators = stage("operators", m_f, "faces", {}, [this] {
    std::vector<SMM::Mesh_level>& levels = m_hierarchy.levels();
    m_hierarchy.build_operators({}, [&levels](std::size_t l) {
      levels[l].mesh.points = std::vector<CGAL::Indexed_mesh::Indexed_triangle_mesh::Point_3>();
      if(l + 1 < levels.size())
        levels[l].mesh.triangles = std::vector<CGAL::Indexed_mesh::Triangle_indices>();
      return true;
    });
    m_hierarchy.build_cycle();
    m_hierarchy.pin_only({m_pins[0].vertex, m_pins[1].vertex});
  });
  const Row_bytes row = row_bytes();
  const double finest = m_v * (row.in_double + row.in_float); // the finest one in single precision
  operators.bound = copying(operator_bytes(m_sizes, row.in_float) + finest);
}

// Improves the map of level l as Cycle_iteration does; returns the iterations.
double Staged_map::iterate(std::size_t l)
{
  m_z = m_hierarchy.prolonged(l, m_z);
  m_hierarchy.set_pins(l, m_pins, m_z);
  MG::Energy_stop stop;
  stop.tolerance = m_options.tolerance;
  stop.maximal_iterations = l + 1 == m_hierarchy.number_of_levels() ? 500 : 2;
  const auto result =
      m_hierarchy.minimize(l, MG::Schedule(), stop, [](double) { return true; }, m_z);
  return double(result.iterations);
}

void Staged_map::solve()
{
  const Counting_cholesky& coarsest = *m_coarsest;
  stage("factorization of the coarsest level", m_sizes[0].vertices, "unknowns", {}, [&] {
    m_z = m_hierarchy.at_pins(m_pins);
    if(!m_hierarchy.factorize_coarsest()
       || !SMP::internal::solve_for_free(m_hierarchy.coarsest_solver(), m_hierarchy.coarsest(),
                                         m_z))
      throw std::runtime_error("the coarsest level cannot be factorized");
  });
  const std::size_t finest = m_hierarchy.number_of_levels() - 1;
  const double first_seconds = coarsest.seconds(), first_solutions = coarsest.solutions();
  std::vector<double> iterations(finest + 1, 0);
  Stage& on_coarse = stage("iterations on the levels between", 0, "iterations", {}, [&] {
    for(std::size_t l = 1; l < finest; ++l)
      iterations[l] = iterate(l);
  });
  const double coarse_seconds = coarsest.seconds(), coarse_solutions = coarsest.solutions();
  on_coarse.seconds -= coarse_seconds - first_seconds;
  on_coarse.count = std::accumulate(iterations.begin(), iterations.end(), 0.);
  Stage& on_finest = stage("iterations on the finest level", 0, "iterations", {},
                           [&] { iterations[finest] = iterate(finest); });
  on_finest.seconds -= coarsest.seconds() - coarse_seconds;
  on_finest.count = iterations[finest];
  // Of the visits of each level only those of the coarsest are known: the same factor for all.
  const double solutions_per_cycle = (coarsest.solutions() - coarse_solutions) / iterations[finest];
  const double visits = finest > 1 ? std::pow(solutions_per_cycle, 1. / double(finest - 1)) : 1;
  const Row_bytes row = row_bytes();
  double coarse_bytes = 0;
  for(std::size_t l = 1; l < finest; ++l)
    coarse_bytes += iteration_bytes(m_sizes, l, iterations[l], visits, row);
  on_coarse.bound = copying(coarse_bytes);
  on_finest.bound = copying(iteration_bytes(m_sizes, finest, iterations[finest], visits, row));
  Stage solutions;
  solutions.name = "solutions on the coarsest level";
  solutions.seconds = coarsest.seconds() - first_seconds;
  solutions.count = coarsest.solutions() - first_solutions;
  solutions.of = "solutions";
  m_list.add(solutions);
}

void Staged_map::write_back()
{
  const auto& triangles = m_hierarchy.levels().back().mesh.triangles;
  stage("neighbourhoods of flipped faces", m_f, "faces", copying(12 * m_f + 16 * m_v), [&] {
    SMP::internal::relax_flipped_faces(m_hierarchy.finest().matrix, triangles, m_z);
  });
  const double bytes = (row_bytes().in_double + (2 + 2) * 16 + 16 + 16 + 4 + 4) * m_v;
  stage("energy; writing back", m_v, "vertices", copying(bytes), [this] {
    m_hierarchy.finest().energy(m_z);
    const auto rank
        = CGAL::Indexed_mesh::ranks(m_chart.source, m_mesh.number_of_vertices());
    std::size_t position = 0;
    for(const auto v : m_mesh.vertices()) {
      const std::complex<double> z = m_z[rank[position++]];
      put(m_uvmap, v, charts::Kernel::Point_2(z.real(), z.imag()));
    }
  });
}

Stage sum_of(const std::vector<Stage>& all)
{
  Stage sum;
  sum.name = "all stages";
  for(const Stage& stage : all) {
    sum.seconds += stage.seconds;
    sum.page_faults += stage.page_faults;
  }
  return sum;
}

Stage parameterize(const Mesh& mesh, Uv_map uvmap, unsigned int threads)
{
  Mesh::Halfedge_index border;
  for(const auto h : mesh.halfedges())
    if(mesh.is_border(h))
      border = h;
  SMP::HLSCM_parameterizer_3<Mesh, CGAL::Default, CGAL::Default, CGAL::Parallel_if_available_tag>
      parameterizer;
  parameterizer.options().threads = threads;
  Stage_list list;
  Stage& stage = list.run("parameterize()", [&] {
    if(parameterizer.parameterize(mesh, border, uvmap) != SMP::OK)
      throw std::runtime_error(parameterizer.report().message);
  });
  stage.count = double(mesh.number_of_faces());
  stage.of = "faces";
  return stage;
}

// Gives the memory that is free back to the system, so that each run has to ask for its own.
void release_memory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

// The runs with one number of threads.
struct Runs
{
  unsigned int threads;
  std::vector<std::vector<Stage>> staged, whole;

  void add(const Mesh& mesh, Uv_map uvmap, double per_evaluation)
  {
    release_memory();
    {
      const CGAL::Blocked_execution::Thread_scope scope(threads);
      staged.push_back(Staged_map(mesh, uvmap, per_evaluation).run());
    }
    release_memory();
    whole.push_back({parameterize(mesh, uvmap, threads)});
  }

  void print(const std::string& chart, std::size_t faces) const
  {
    std::vector<Stage> rows = median(staged);
    const Stage sum = sum_of(rows);
    rows.push_back(sum);
    rows.push_back(median(whole).front());
    for(const Stage& row : rows)
      write_row(chart, faces, threads, row, sum.seconds, std::cout);
  }
};

void print_rows(const std::string& path, const std::vector<unsigned int>& numbers_of_threads)
{
  Mesh mesh = charts::make_surface_mesh(charts::read_chart(path));
  const Uv_map uvmap =
      mesh.add_property_map<Mesh::Vertex_index, charts::Kernel::Point_2>("v:uv").first;
  const double per_evaluation = seconds_per_evaluation(mesh);
  std::vector<Runs> all;
  for(const unsigned int threads : numbers_of_threads)
    all.push_back({threads, {}, {}});
  for(int i = 0; i < repetitions; ++i)
    for(Runs& runs : all)
      runs.add(mesh, uvmap, per_evaluation);
  for(const Runs& runs : all)
    runs.print(std::filesystem::path(path).stem().string(), mesh.number_of_faces());
}

} // namespace

int main(int argc, char** argv)
{
  CLI::App app("What each stage of parameterize() costs, beside what bounds it, as CSV");
  unsigned int threads = 1;
  std::vector<std::string> paths;
  app.add_option("--threads", threads, "Measure with so many threads, too")->check(CLI::Range(1, 64));
  app.add_option("MESH", paths, "Charts")->required();
  CLI11_PARSE(app, argc, argv);
  std::vector<unsigned int> numbers(1, 1);
  if(threads > 1)
    numbers.push_back(threads);
  try {
    std::cout << "# " << machine::description() << "; memory copied at";
    for(const unsigned int n : numbers)
      std::cout << (n == 1 ? " " : " and ") << traffic::copy_bandwidth(n) * 1e-9;
    std::cout << " GB/s read and written" << (threads > 1 ? " by one and all threads" : "") << "\n";
    write_header(std::cout);
    for(const std::string& path : paths)
      print_rows(path, numbers);
  } catch(const std::exception& e) {
    std::cerr << "stages: " << e.what() << "\n";
    return 1;
  }
}
