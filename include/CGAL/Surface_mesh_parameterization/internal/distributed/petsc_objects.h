// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_PETSC_OBJECTS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_PETSC_OBJECTS_H

#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

#include <petscksp.h>

#if !defined(PETSC_USE_COMPLEX)
#error "The map of a distributed chart needs PETSc with complex numbers"
#endif

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What PETSc cannot do, for want of memory above all, ends all ranks: the others wait for this one.
// PETSc has said what it is.
inline void check(PetscErrorCode error)
{
  if(error != 0)
    MPI_Abort(MPI_COMM_WORLD, int(error));
}

// Begins PETSc if nobody did; it stays, since it can begin only once. It is to leave signals alone.
inline void begin_petsc()
{
  PetscBool has_begun = PETSC_FALSE;
  check(PetscInitialized(&has_begun));
  if(has_begun)
    return;
  check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "1"));
  check(PetscInitializeNoArguments());
}

// What PETSc has sent to other ranks so far.
inline std::size_t petsc_bytes() { return std::size_t(petsc_isend_len + petsc_send_len); }
inline std::size_t petsc_messages() { return std::size_t(petsc_isend_ct + petsc_send_ct); }

// An object of PETSc that goes with its owner.
template <class Object, PetscErrorCode (*Destroy)(Object*)>
class Petsc_object
{
public:
  Petsc_object() {}
  Petsc_object(Petsc_object&& other) noexcept { std::swap(m_object, other.m_object); }
  Petsc_object& operator=(Petsc_object&& other) noexcept
  {
    std::swap(m_object, other.m_object);
    return *this;
  }
  ~Petsc_object() { Destroy(&m_object); }

  operator Object() const { return m_object; }
  Object* put() { return &m_object; } // for those who create it

private:
  Object m_object = nullptr;
};

typedef Petsc_object<Vec, VecDestroy> Petsc_vector;
typedef Petsc_object<Mat, MatDestroy> Petsc_matrix;
typedef Petsc_object<KSP, KSPDestroy> Petsc_solver;
typedef Petsc_object<IS, ISDestroy> Petsc_indices;

// The part of a vector that this rank has, as long as this exists.
class Petsc_part
{
public:
  explicit Petsc_part(Vec vector) : m_vector(vector)
  {
    check(VecGetArray(vector, &m_values));
    check(VecGetLocalSize(vector, &m_size));
  }
  Petsc_part(const Petsc_part&) = delete;
  Petsc_part& operator=(const Petsc_part&) = delete;
  ~Petsc_part() { VecRestoreArray(m_vector, &m_values); }

  typedef PetscScalar value_type;

  std::size_t size() const { return std::size_t(m_size); }
  PetscScalar& operator[](std::size_t i) const { return m_values[i]; }
  PetscScalar* begin() { return m_values; }
  PetscScalar* end() { return m_values + m_size; }

private:
  Vec m_vector;
  PetscScalar* m_values = nullptr;
  PetscInt m_size = 0;
};

inline std::vector<PetscScalar> values_of(Vec vector)
{
  Petsc_part part(vector);
  return std::vector<PetscScalar>(part.begin(), part.end());
}

inline Petsc_vector vector_like(Vec other)
{
  Petsc_vector result;
  check(VecDuplicate(other, result.put()));
  check(VecSet(result, 0.));
  return result;
}

// Rows of a matrix, those of this rank one after the other, each with ascending columns.
struct Petsc_rows
{
  std::vector<PetscInt> begin = {0}, column;
  std::vector<PetscScalar> value;

  void end_row() { begin.push_back(PetscInt(column.size())); }

  // Where `own_columns` of the columns belong to this rank.
  Petsc_matrix matrix(MPI_Comm comm, std::size_t own_columns) const
  {
    Petsc_matrix result;
    check(MatCreateMPIAIJWithArrays(comm, PetscInt(begin.size() - 1), PetscInt(own_columns),
                                    PETSC_DETERMINE, PETSC_DETERMINE, begin.data(), column.data(),
                                    value.data(), result.put()));
    return result;
  }
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_PETSC_OBJECTS_H
