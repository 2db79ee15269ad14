// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_LEVEL_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_LEVEL_H

#include <CGAL/Surface_mesh_parameterization/internal/distributed/Distributed_mesh.h>
#include <CGAL/Surface_mesh_parameterization/internal/distributed/petsc_objects.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_matrix.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/border_pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/decimate_blocks.h>

#include <algorithm>
#include <array>
#include <complex>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Collects the rows of the blocks of a rank.
class Conformal_row_collector
{
public:
  Conformal_row_collector() {}
  explicit Conformal_row_collector(const Distributed_mesh& mesh)
  {
    const std::size_t n = mesh.points.size(), border = n / 50; // more than that is rare
    m_rows.begin.reserve(n + 1);
    m_rows.column.reserve(mesh.number_of_own_corners() + n + border);
    m_rows.value.reserve(m_rows.column.capacity());
    m_inverse_diagonal.reserve(n);
  }

  void add(const Mesh_block& block)
  {
    const auto& triangles = block.mesh.triangles;
    const Indexed_mesh::Triangles_at_vertices at(triangles, block.mesh.points.size());
    Multigrid::Matrix_row row;
    for(std::uint32_t v = 0; v < block.own; ++v) {
      row.entries.clear();
      row.diagonal = 0.;
      fill_conformal_row(v, triangles, at, block.cotangents, {}, row);
      for(auto& entry : row.entries)
        entry.column = block.global(entry.column);
      add_row(std::uint32_t(block.first + v), row);
    }
  }

  const Petsc_rows& rows() const { return m_rows; }
  const std::vector<PetscScalar>& inverse_diagonal() const { return m_inverse_diagonal; }
  const std::vector<Border_entry>& border() const { return m_border; } // those that are not real

private:
  void add_row(std::uint32_t i, Multigrid::Matrix_row& row)
  {
    m_inverse_diagonal.push_back(inverse_diagonal_of(row));
    row.entries.push_back({i, row.diagonal, 0.});
    std::sort(row.entries.begin(), row.entries.end(),
              [](const auto& a, const auto& b) { return a.column < b.column; });
    for(const auto& entry : row.entries) {
      m_rows.column.push_back(PetscInt(entry.column));
      m_rows.value.emplace_back(entry.re, entry.im);
      if(entry.im != 0.)
        m_border.push_back({i, entry.column, entry.re, entry.im});
    }
    m_rows.end_row();
  }

  Petsc_rows m_rows;
  std::vector<PetscScalar> m_inverse_diagonal;
  std::vector<Border_entry> m_border;
};

// The pins of a mesh with such rows. The border is found by rank 0.
inline Pins far_border_pins(Ranks& ranks, const Distributed_mesh& mesh,
                            const Conformal_row_collector& rows)
{
  std::vector<Three_numbers> points;
  for(const Border_entry& entry : rows.border())
    points.push_back(mesh.point(entry.row));
  const std::vector<Border_entry> border = ranks.gathered(rows.border());
  points = ranks.gathered(points);
  std::array<Pin, 2> pins = {};
  ranks.together([&] {
    if(ranks.rank() != 0)
      return;
    const Pins chosen = far_border_pins(border, [&](std::uint32_t v) -> const Three_numbers& {
      const auto entry = std::lower_bound(border.begin(), border.end(), v,
                                          [](const Border_entry& e, std::uint32_t row) {
        return e.row < row;
      });
      return points[std::size_t(entry - border.begin())];
    });
    std::copy(chosen.begin(), chosen.end(), pins.begin());
  });
  pins = ranks.broadcast(pins);
  return Pins(pins.begin(), pins.end());
}

// A level that all ranks share: what PETSc's cycle needs of it.
//
// With pins that have values E(z) is a function of the others, E = energy_of_pins + 1/2 z^H H z
// - Re f^H z, where z, f and the rows and columns of H but for its diagonal are 0 at pins.
struct Distributed_level
{
  Petsc_matrix matrix;           // H
  Petsc_matrix prolongation;     // from the coarser level; 0 at pins that have values
  Petsc_vector inverse_diagonal; // of the smoother; 0 at pins
  Petsc_vector pinned;           // the values of the pins, 0 elsewhere
  Petsc_vector right_side;       // f
  double energy_of_pins = 0.;
  std::size_t size = 0;          // of all ranks
  std::size_t first, own;        // the vertices of this rank
  std::vector<std::uint32_t> pins, own_pins; // of all vertices, of this rank's
  Multigrid::Diagonal_mass mass; // of the border vertices of this rank

  // For a map without pins, all rows stay: see `hold_pins()`.
  Distributed_level(MPI_Comm comm, const Distributed_mesh& mesh, const Pins& of_level, bool is_free,
                    const Conformal_row_collector& rows)
    : matrix(rows.rows().matrix(comm, mesh.points.size())), size(mesh.number_of_vertices())
    , first(mesh.first), own(mesh.points.size()), mass(own_border_mass(mesh, rows))
  {
    check(MatCreateVecs(matrix, pinned.put(), right_side.put()));
    check(VecSet(pinned, 0.));
    check(VecSet(right_side, 0.));
    inverse_diagonal = vector_like(pinned);
    {
      Petsc_part inverse(inverse_diagonal);
      std::copy(rows.inverse_diagonal().begin(), rows.inverse_diagonal().end(), inverse.begin());
    }
    for(const Pin& pin : of_level)
      pins.push_back(pin.vertex);
    if(!is_free)
      pin_rows(of_level);
  }

  // No correction of a cycle moves the first `number` pins.
  void hold_pins(std::size_t number)
  {
    pins.resize(number);
    Petsc_part inverse(inverse_diagonal);
    for(const std::uint32_t v : pins)
      if(v >= first && v - first < own) {
        own_pins.push_back(std::uint32_t(v - first));
        inverse[own_pins.back()] = 0.;
      }
  }

  void clear_pins(Vec x) const
  {
    Petsc_part part(x);
    for(const std::uint32_t pin : own_pins)
      part[pin] = 0.;
  }

private:
  // Half the lengths of the border edges at the vertices of this rank.
  static Multigrid::Diagonal_mass own_border_mass(const Distributed_mesh& mesh,
                                                  const Conformal_row_collector& rows)
  {
    const Multigrid::Diagonal_mass of_mesh
      = border_mass(rows.border(), [&mesh](std::uint32_t v) { return mesh.point(v); });
    auto entries = of_mesh.entries();
    for(auto& entry : entries)
      entry.row -= std::uint32_t(mesh.first);
    return Multigrid::Diagonal_mass(std::move(entries));
  }

  // Takes the pins out of the matrix.
  void pin_rows(const Pins& of_level)
  {
    hold_pins(of_level.size());
    {
      Petsc_part values(pinned);
      for(const Pin& pin : of_level)
        if(pin.vertex >= first && pin.vertex - first < own)
          values[pin.vertex - first] = pin.value;
    }
    check(MatMult(matrix, pinned, right_side));
    PetscScalar product;
    check(VecDot(right_side, pinned, &product));
    energy_of_pins = 0.5 * product.real();
    check(VecScale(right_side, -1.));
    clear_pins(right_side);
    std::vector<PetscInt> rows;
    for(const std::uint32_t pin : own_pins)
      rows.push_back(PetscInt(first + pin));
    check(MatSetOption(matrix, MAT_KEEP_NONZERO_PATTERN, PETSC_TRUE));
    check(MatZeroRowsColumns(matrix, PetscInt(rows.size()), rows.data(), 1., nullptr, nullptr));
  }
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_LEVEL_H
