// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Progressive mesh files.

#include "Kernel_chart.h"
#include "counters.h"

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>

namespace {

using namespace kernels;

// One chart, with a planar projection for texture coordinates.
const SMM::Textured_progressive_mesh& textured_mesh(std::size_t faces)
{
  return made_once(faces, [](std::size_t number) {
    SMM::Textured_progressive_mesh mesh;
    mesh.progressive_mesh = progressive_mesh(number);
    mesh.points = sorted_mesh(number).points;
    for(const auto& p : mesh.points) {
      mesh.vertex.push_back(CGAL::Indexed_mesh::Vertex_index(mesh.vertex.size()));
      mesh.uv.emplace_back(p.x(), p.y());
    }
    return SMM::coarse_first(mesh);
  });
}

// Splits a second, bytes a split, and the size as a part of that of a binary PLY file with float
// coordinates and texture coordinates a wedge.
void set_counters(benchmark::State& state, const SMM::Textured_progressive_mesh& mesh,
                  std::size_t bytes)
{
  const double splits = double(mesh.number_of_collapses());
  const double ply = 20. * double(mesh.number_of_wedges())
                   + 13. * double(mesh.progressive_mesh.triangles.size());
  set_rate(state, "splits/s", splits);
  state.counters["bytes/split"] = double(bytes) / splits;
  state.counters["of_ply"] = double(bytes) / ply;
}

void write_file(benchmark::State& state, SMM::Progressive_mesh_precision precision)
{
  const SMM::Textured_progressive_mesh& mesh = textured_mesh(std::size_t(state.range(0)));
  SMM::Progressive_mesh_write_options options;
  options.precision = precision;
  std::size_t bytes = 0;
  for(auto _ : state)
    bytes = SMM::encode_progressive_mesh(mesh, options).bytes.size();
  set_counters(state, mesh, bytes);
}

void read_file(benchmark::State& state, SMM::Progressive_mesh_precision precision)
{
  const SMM::Textured_progressive_mesh& mesh = textured_mesh(std::size_t(state.range(0)));
  SMM::Progressive_mesh_write_options options;
  options.precision = precision;
  const std::string bytes = SMM::encode_progressive_mesh(mesh, options).bytes;
  for(auto _ : state)
    benchmark::DoNotOptimize(SMM::decode_progressive_mesh(bytes.data(), bytes.size()));
  set_counters(state, mesh, bytes.size());
}

void write_quantized(benchmark::State& state)
{
  write_file(state, SMM::Progressive_mesh_precision::QUANTIZED);
}
void write_lossless(benchmark::State& state)
{
  write_file(state, SMM::Progressive_mesh_precision::LOSSLESS);
}
void read_quantized(benchmark::State& state)
{
  read_file(state, SMM::Progressive_mesh_precision::QUANTIZED);
}
void read_lossless(benchmark::State& state)
{
  read_file(state, SMM::Progressive_mesh_precision::LOSSLESS);
}
BENCHMARK(write_quantized)->Apply(small_and_large);
BENCHMARK(write_lossless)->Apply(small_and_large);
BENCHMARK(read_quantized)->Apply(small_and_large);
BENCHMARK(read_lossless)->Apply(small_and_large);

} // namespace
