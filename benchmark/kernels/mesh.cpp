// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Order, connectivity, decimation, hierarchy, progressive mesh.

#include "Kernel_chart.h"
#include "counters.h"

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_cursor.h>

namespace {

using namespace kernels;

void sort_chart(benchmark::State& state, charts::Chart (*make)(std::size_t))
{
  const CGAL::Indexed_mesh::Indexed_triangle_mesh unsorted =
      charts::make_indexed_mesh(make(std::size_t(state.range(0))));
  for(auto _ : state) {
    state.PauseTiming();
    CGAL::Indexed_mesh::Indexed_triangle_mesh mesh = unsorted;
    state.ResumeTiming();
    benchmark::DoNotOptimize(CGAL::Indexed_mesh::sort_spatially(mesh));
  }
  set_rate(state, "vertices/s", double(unsorted.points.size()));
}

void sort_spatially_rows(benchmark::State& state) { sort_chart(state, make_bumpy_square); }
void sort_spatially_shuffled(benchmark::State& state) { sort_chart(state, make_shuffled_square); }
BENCHMARK(sort_spatially_rows)->Apply(small_and_large);
BENCHMARK(sort_spatially_shuffled)->Apply(small_and_large);

void vertex_rings(benchmark::State& state)
{
  const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh = sorted_mesh(std::size_t(state.range(0)));
  for(auto _ : state)
    benchmark::DoNotOptimize(Vertex_rings(mesh));
  set_rate(state, "vertices/s", double(mesh.points.size()));
}
BENCHMARK(vertex_rings)->Apply(small_and_large);

// Decimates to a number of vertices; the rings are copied beforehand.
void decimate(benchmark::State& state, std::size_t target, SMM::Collapse_order order)
{
  const std::size_t faces = std::size_t(state.range(0));
  const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh = sorted_mesh(faces);
  const std::vector<bool> is_pinned = pinned_vertices(mesh);
  SMM::Flat_collapse_options options;
  options.target_vertices = target;
  options.order = order;
  double evaluations = 0, collapses = 0;
  for(auto _ : state) {
    state.PauseTiming();
    Vertex_rings copy = rings(faces);
    state.ResumeTiming();
    SMM::Flat_collapse_engine<> engine(mesh, std::move(copy), is_pinned);
    const SMM::Progressive_mesh pm = engine.run(options);
    evaluations = double(engine.number_of_evaluations());
    collapses = double(pm.collapses.size());
  }
  set_rate(state, "evaluations/s", evaluations);
  if(collapses > 1) {
    set_rate(state, "collapses/s", collapses);
    state.counters["evaluations/collapse"] = evaluations / collapses;
  }
}

// One collapse only: each vertex is evaluated once.
void evaluate_costs(benchmark::State& state)
{
  const std::size_t n = sorted_mesh(std::size_t(state.range(0))).points.size();
  decimate(state, n - 1, SMM::Collapse_order::BATCHED);
}
void decimate_flat(benchmark::State& state)
{
  decimate(state, coarsest_size, SMM::Collapse_order::BATCHED);
}
void decimate_flat_strict(benchmark::State& state)
{
  decimate(state, coarsest_size, SMM::Collapse_order::STRICT);
}
BENCHMARK(evaluate_costs)->Apply(small_and_large);
BENCHMARK(decimate_flat)->Apply(small_and_large);
BENCHMARK(decimate_flat_strict)->Apply(small_and_large);

void hierarchy(benchmark::State& state, SMM::Prolongation_rule rule)
{
  const std::size_t faces = std::size_t(state.range(0));
  const SMM::Progressive_mesh& pm = progressive_mesh(faces);
  SMM::Hierarchy_options options;
  options.coarsest_size = coarsest_size;
  options.rule = rule;
  std::size_t number_of_levels = 0;
  for(auto _ : state) {
    state.PauseTiming();
    CGAL::Indexed_mesh::Indexed_triangle_mesh mesh = sorted_mesh(faces);
    state.ResumeTiming();
    number_of_levels = SMM::build_hierarchy(std::move(mesh), pm, options).size();
  }
  set_rate(state, "vertices/s", double(pm.number_of_vertices));
  state.counters["levels"] = double(number_of_levels);
}

void build_hierarchy_walk(benchmark::State& state)
{
  hierarchy(state, SMM::Prolongation_rule::WALK);
}
void build_hierarchy_vsplit(benchmark::State& state)
{
  hierarchy(state, SMM::Prolongation_rule::VSPLIT);
}
BENCHMARK(build_hierarchy_walk)->Apply(small_and_large);
BENCHMARK(build_hierarchy_vsplit)->Apply(small_and_large);

// All steps in one direction.
void move_cursor(benchmark::State& state, std::size_t from, std::size_t to)
{
  const SMM::Progressive_mesh& pm = progressive_mesh(std::size_t(state.range(0)));
  SMM::Progressive_mesh_cursor cursor(pm);
  for(auto _ : state) {
    state.PauseTiming();
    cursor.move_to(from);
    state.ResumeTiming();
    cursor.move_to(to);
  }
  set_rate(state, "steps/s", double(pm.collapses.size()));
}

void cursor_collapse(benchmark::State& state)
{
  move_cursor(state, 0, progressive_mesh(std::size_t(state.range(0))).collapses.size());
}
void cursor_split(benchmark::State& state)
{
  move_cursor(state, progressive_mesh(std::size_t(state.range(0))).collapses.size(), 0);
}
BENCHMARK(cursor_collapse)->Apply(small_and_large);
BENCHMARK(cursor_split)->Apply(small_and_large);

// The triangles of a level in one go.
void extract_level(benchmark::State& state)
{
  const SMM::Progressive_mesh& pm = progressive_mesh(std::size_t(state.range(0)));
  for(auto _ : state)
    benchmark::DoNotOptimize(SMM::triangles_after(pm, pm.collapses.size() / 2));
  set_rate(state, "triangles/s", double(pm.triangles.size()));
}
BENCHMARK(extract_level)->Apply(small_and_large);

} // namespace
