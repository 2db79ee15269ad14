// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_STAGES_BYTES_H
#define HLSCM_BENCHMARK_STAGES_BYTES_H

#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>

#include <cmath>
#include <cstddef>
#include <vector>

// The bytes that each stage reads and writes, each array once for each pass over it, as if all
// accesses were in order: what a stage must move as it is written. A point has 24 bytes, a triangle
// 12, an index 4, three cotangents 24, a line of the rings 64.
namespace stages {

// A level: its vertices, how many of them the next coarser one lacks, its faces.
struct Level_size
{
  double vertices, removed, faces;
};

inline std::vector<Level_size>
sizes_of(const std::vector<CGAL::Surface_mesh_multiresolution::Mesh_level>& levels)
{
  std::vector<Level_size> sizes;
  for(const auto& level : levels)
    sizes.push_back({double(level.vertices.size()), double(level.from_coarser.stencils().size()),
                     double(level.mesh.triangles.size())});
  return sizes;
}

// The mesh: points, three halfedges a face of 16 bytes and one of 4. The copy: points, triangles,
// and the index of each vertex, written and read.
inline double copy_bytes(double v, double f)
{
  return (24 + 24 + 4 + 4) * v + (4 + 3 * 16 + 12) * f;
}

// Which vertices are used: points and triangles once more. Bounding box, two changes of the unit,
// lengths of the edges.
inline double normalize_bytes(double v, double f)
{
  return (48 + 8 + 4 + 24 + 48 + 24 + 48) * v + (12 + 24 + 12) * f;
}

// Bounding box and codes; three passes of the radix sort over codes and order, one to count;
// points, ranks and sources in the new order; triangles renumbered, then sorted.
inline double sort_bytes(double v, double f)
{
  return (24 + 24 + 4 + 4 + 3 * 16 + 48 + 4 + 4 + 8 + 8 + 12) * v + (24 + 24) * f;
}

// Counted, cut into wedges of 8 bytes, three a triangle; wedges read, lines written.
inline double ring_bytes(double v, double f)
{
  return (8 + 8 + 64 + 1) * v + (12 + 12 + 24 + 24) * f;
}

// Lines read for the components, twice, and for the borders.
inline double border_bytes(double v) { return (3 * 64 + 16) * v; }

// Per level: ancestors, ranks and indices; points and triangles of the coarse one; corners of its
// triangles; stencils of 28 bytes and the triangle of each, whose transposed terms have 24.
inline double level_bytes(const std::vector<Level_size>& sizes)
{
  double sum = 0;
  for(std::size_t l = 1; l < sizes.size(); ++l) {
    const Level_size &fine = sizes[l], &coarse = sizes[l - 1];
    sum += (6 * 4 + 24) * fine.vertices + (8 + 48 + 8) * coarse.vertices
           + (8 + 3 * 28 + 4 + 24) * fine.removed + 12 * fine.faces + (24 + 36) * coarse.faces;
  }
  return sum;
}

// Per level: corners of the triangles; cotangents from points; rows from corners, triangles and two
// cotangents for each corner; the matrix, of `row_bytes` a row. Cotangents of the next level:
// owners, and points and cotangents of the fine triangles; points of the coarse ones.
inline double operator_bytes(const std::vector<Level_size>& sizes, double row_bytes)
{
  double sum = 0;
  for(std::size_t l = 0; l < sizes.size(); ++l) {
    const Level_size& level = sizes[l];
    sum += (8 + 4 + row_bytes) * level.vertices + (36 + 12 + 12 + 12 + 24) * level.faces;
    if(l > 0)
      sum += (24 + 4) * level.vertices + (12 + 12 + 24 + 12) * level.faces
             + (24 + 24) * sizes[l - 1].faces;
  }
  sum += (24 + 24) * sizes.back().faces; // the cotangents of the finest level, from its points
  return sum;
}

// What the iterations read of a matrix, for each row.
struct Row_bytes
{
  double in_double, in_float;
};

// One visit of a level by a cycle with two smoothing steps before and after, in single precision:
// four products, 38 vectors (smoothing from zero 15, residual 3, restriction 1, prolongation and
// correction 4, smoothing 15), the diagonal four times, the transfer in both directions.
inline double visit_bytes(const Level_size& level, const Row_bytes& row)
{
  return (4 * row.in_float + 38 * 8 + 4 * 4) * level.vertices + (24 + 28) * level.removed
         + 24 * (level.vertices - level.removed);
}

// A step of conjugate gradients on a coarse level of a K-cycle: a product and 17 vectors, the mean
// of the first and the second.
inline double acceleration_bytes(const Level_size& level, const Row_bytes& row)
{
  return (row.in_float + 17 * 8) * level.vertices;
}

// One K-cycle from level `top`, each level visited `visits` times for each visit of the next finer
// one. The coarsest one does not count.
inline double cycle_bytes(const std::vector<Level_size>& sizes, std::size_t top, double visits,
                          const Row_bytes& row)
{
  double sum = visit_bytes(sizes[top], row), times = 1;
  for(std::size_t l = top; l-- > 1;) {
    times *= visits;
    sum += times * (visit_bytes(sizes[l], row) + acceleration_bytes(sizes[l], row));
  }
  return sum;
}

// Preconditioned conjugate gradients on level `top`. Each iteration: a product, 20 vectors, to and
// from the single precision of the cycle. At the begin two products, for energy and residual.
inline double iteration_bytes(const std::vector<Level_size>& sizes, std::size_t top,
                              double iterations, double visits, const Row_bytes& row)
{
  const bool is_finest = top + 1 == sizes.size();
  const double matrix = is_finest ? row.in_double : row.in_float, vector = is_finest ? 16 : 8;
  return iterations
             * ((matrix + 20 * vector + 16) * sizes[top].vertices
                + cycle_bytes(sizes, top, visits, row))
         + (2 * matrix + 6 * vector) * sizes[top].vertices;
}

} // namespace stages

#endif // HLSCM_BENCHMARK_STAGES_BYTES_H
