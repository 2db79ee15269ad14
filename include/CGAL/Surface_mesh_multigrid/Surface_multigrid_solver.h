// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_SURFACE_MULTIGRID_SOLVER_H
#define CGAL_SURFACE_MESH_MULTIGRID_SURFACE_MULTIGRID_SOLVER_H

#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Surface_mesh_multigrid/Element_matrix.h>
#include <CGAL/Surface_mesh_multigrid/Surface_hierarchy.h>
#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_options.h>
#include <CGAL/Surface_mesh_multigrid/internal/Surface_system.h>
#include <CGAL/Surface_mesh_multigrid/internal/surface_rows.h>

#include <CGAL/Default.h>

#include <Eigen/SparseCore>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multigrid {

/*!
\ingroup PkgHLSCMSurfaceMultigrid

The class `Surface_multigrid_solver` solves \f$ A x = b \f$ for unknowns at the vertices of a
surface: a conjugate gradient method, each step of which is preconditioned by a multigrid cycle over
the levels of a `Surface_hierarchy`. \f$ A \f$ is self-adjoint and positive semi-definite.

The matrices of coarse levels are the products \f$ P^H A P \f$ (Galerkin), so that any matrix will
do: iterations are fewer than with matrices that are built anew on the coarse meshes, and do not
depend on how \f$ A \f$ came about.

Some unknowns can be fixed: their values in `x` are given (Dirichlet). Where constants are in the
kernel of \f$ A \f$ on a component of the surface, the solution is that of the right-hand side
without its mean, and `x` keeps its mean there.

The result does not depend on the number of threads.

\tparam Value an entry of \f$ A \f$: `double`, `float`, `std::complex<double>`, `Eigen::Matrix2d` or
        `Eigen::Matrix3d`; entries of vectors are then `double`, `float`, `std::complex<double>`,
        `Eigen::Vector2d` or `Eigen::Vector3d`. With `Multigrid::Columns<double, N>` \f$ A \f$ is a
        matrix of numbers for N right-hand sides at once, the tolerance is that of all together, and
        entries of vectors are `Eigen::Matrix<double, 1, N>`
\tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; by default
        what the caller's `Blocked_execution::Thread_scope` allows

Linear time for a matrix, and for each iteration.
*/
template <class Value_ = double, class ConcurrencyTag = Default>
class Surface_multigrid_solver
{
public:
  typedef Value_ Value;                                              ///< an entry of the matrix
  typedef typename Multigrid::Value_traits<Value>::Vector_value Vector_value; ///< of a vector
  typedef std::vector<Vector_value> Vector;                          ///< a vector
  typedef Surface_multigrid_options Options;                         ///< the options
  typedef Surface_multigrid_report Report;                           ///< what is returned

  /// Constructs a solver that shares a hierarchy.
  explicit Surface_multigrid_solver(std::shared_ptr<const Surface_hierarchy> hierarchy,
                                    const Options& options = Options())
    : m_surface(std::move(hierarchy)), m_options(options)
  {}

  /// Constructs a solver with a hierarchy of its own, of arrays or any model of `FaceListGraph`.
  template <class Mesh, class = std::enable_if_t<
              !std::is_convertible_v<const Mesh&, std::shared_ptr<const Surface_hierarchy>>>>
  explicit Surface_multigrid_solver(const Mesh& mesh, const Options& options = Options())
    : m_options(options)
  {
    const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
    m_surface = std::make_shared<const Surface_hierarchy>(mesh);
  }

  /// Returns the hierarchy.
  const std::shared_ptr<const Surface_hierarchy>& hierarchy() const { return m_surface; }
  /// Returns the options, which may be changed before any call.
  Options& options() { return m_options; }

  /// \name The Matrix
  /// It can be set again, also of another pattern; the hierarchy stays.
  /// @{

  /*!
  Takes the sum of the element matrices of all faces as \f$ A \f$.

  \param element a model of `SurfaceElement`: `element(triangle, matrix)` sets an `Element_matrix` of
         zeros for a `Surface_triangle`; called for all triangles in any order, possibly at the same
         time
  \param is_fixed for each vertex whether its unknown is fixed; empty for none
  */
  template <class Element>
  Report set_element(const Element& element, const std::vector<bool>& is_fixed = {})
  {
    return set_rows(is_fixed, [&](Report&) {
      return internal::assemble_rows<Double>(*m_surface, m_moved, element);
    });
  }

  /// Takes a sparse matrix of Eigen as \f$ A \f$, or a `Eigen::Map` of one on arrays of the caller's:
  /// row i is vertex i of the mesh; of blocks of N rows the rows N i and following. Entries of a row, or
  /// of a column if these come first, are in the order of their indices.
  template <class Matrix>
  Report set_matrix(const Eigen::SparseCompressedBase<Matrix>& matrix,
                    const std::vector<bool>& is_fixed = {})
  {
    return set_rows(is_fixed, [&](Report& report) {
      constexpr int rows = Multigrid::Value_traits<Value>::rows;
      const Matrix& a = matrix.derived();
      if(report.fail(Mesh_status::BAD_OPTIONS, internal::matrix_error<rows>(size(), a)))
        return Rows();
      return internal::copy_rows<Double>(*m_surface, a);
    });
  }

  /// Moves the vertices for the next `set_element()`, as in a flow; the levels, and how values go
  /// from one to the next, stay.
  ///
  /// \param points for each vertex its place
  Report set_points(const std::vector<Surface_hierarchy::Point_3>& points);
  /// @}

  /*!
  Solves for `x`.

  \param b the right-hand side, for each vertex; entries of fixed unknowns do not count
  \param x on entry where to begin, and the values of fixed unknowns; on exit the solution

  \return whether the tolerance is met. `FAILED` if it is not; `x` is then the best there is

  \tparam B, X have `size()` and `operator[]`: `Vector`, or for numbers a vector of Eigen
  */
  template <class B, class X>
  Surface_multigrid_report solve(const B& b, X& x);

  /// Solves for several right-hand sides, one after the other; returns the worst report. `x` has as
  /// many vectors as `b`. With `Multigrid::Columns` they are solved for at once, in less time.
  template <class Bs, class Xs>
  Surface_multigrid_report solve_all(const Bs& b, Xs& x);

  /// Returns the bytes that it takes beside the hierarchy.
  std::size_t memory() const { return m_system.memory(); }

  /// Prints the matrices of the levels as a table, the finest first.
  friend std::ostream& operator<<(std::ostream& out, const Surface_multigrid_solver& solver)
  {
    return solver.m_system.has_matrix() ? out << solver.m_system.levels() : out;
  }

private:
  typedef internal::Surface_system<Value> System;
  typedef typename System::Double Double;
  typedef typename System::Rows Rows;
  typedef Multigrid::Value_traits<Vector_value> Vector_traits;
  typedef Indexed_mesh::Mesh_status Mesh_status;
  typedef std::chrono::steady_clock Clock;

  std::size_t size() const { return m_surface->number_of_vertices(); }
  // Says that an array has not one entry a vertex.
  std::string size_error(const std::string& name, std::size_t entries) const
  {
    return Indexed_mesh::size_error(name, entries, size());
  }
  template <class Make_rows>
  Surface_multigrid_report set_rows(const std::vector<bool>& is_fixed, const Make_rows& make_rows);
  template <class Values>
  std::string values_error(const std::string& name, const Values& values) const;
  void iterate(const Vector& f, double norm, Vector& u, Report& report);
  static double seconds_since(Clock::time_point start)
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  std::shared_ptr<const Surface_hierarchy> m_surface;
  Options m_options;
  std::vector<Surface_hierarchy::Point_3> m_moved; // in the order of the level
  System m_system;
};

template <class Value, class Tag>
Surface_multigrid_report Surface_multigrid_solver<Value, Tag>::
set_points(const std::vector<Surface_hierarchy::Point_3>& points)
{
  Report report;
  if(report.fail(*m_surface))
    return report;
  if(report.fail(Mesh_status::BAD_OPTIONS, size_error("the array of points", points.size()))
     || report.fail(Mesh_status::BAD_OPTIONS, Indexed_mesh::point_error(points)))
    return report;
  m_moved.resize(size());
  for(std::size_t v = 0; v < size(); ++v)
    m_moved[v] = points[m_surface->source()[v]];
  return report;
}

template <class Value, class Tag>
template <class Make_rows>
Surface_multigrid_report Surface_multigrid_solver<Value, Tag>::
set_rows(const std::vector<bool>& is_fixed, const Make_rows& make_rows)
{
  const Blocked_execution::Tagged_threads<Tag> threads(m_options.threads);
  const auto start = Clock::now();
  Report report;
  m_system = System();
  if(report.fail(*m_surface)
     || (!is_fixed.empty()
         && report.fail(Mesh_status::BAD_OPTIONS, size_error("is_fixed", is_fixed.size()))))
    return report;
  std::vector<bool> is_fixed_here(size(), false);
  for(std::size_t v = 0; v < size() && !is_fixed.empty(); ++v)
    is_fixed_here[v] = is_fixed[m_surface->source()[v]];
  Rows rows = make_rows(report);
  if(report.is_ok())
    report.fail(Mesh_status::BAD_OPTIONS,
                m_system.set(*m_surface, std::move(rows), std::move(is_fixed_here)));
  report.seconds = seconds_since(start);
  return report;
}

// What is wrong with an array of values, as a sentence.
template <class Value, class Tag>
template <class Values>
std::string Surface_multigrid_solver<Value, Tag>::values_error(const std::string& name,
                                                               const Values& values) const
{
  for(std::size_t v = 0; v < std::size_t(values.size()); ++v)
    if(!std::isfinite(double(Vector_traits::squared_norm(Vector_value(values[v])))))
      return Indexed_mesh::not_finite_error(name, "an entry at vertex " + std::to_string(v));
  return size_error(name, values.size());
}

// Lowers the residual to the tolerance, which is relative to `norm`.
template <class Value, class Tag>
void Surface_multigrid_solver<Value, Tag>::iterate(const Vector& f, double norm, Vector& u,
                                                   Report& report)
{
  Multigrid::Energy_stop stop;
  stop.tolerance = 0.;
  stop.residual_tolerance = m_options.tolerance * norm;
  bool goes_on = true;
  const auto observe
    = [&](double part) { return goes_on = !m_options.progress || m_options.progress(part); };
  const auto precondition
    = [this](const Vector& r, Vector& z) { m_system.precondition(m_options.schedule, r, z); };
  // The iteration updates its residual, it does not compute it: where that makes a difference, it
  // begins again.
  constexpr double rounding = 1.1;
  const auto is_enough = [&] { return report.relative_residual <= rounding * m_options.tolerance; };
  for(int run = 0; run < 3 && goes_on && (run == 0 || !is_enough()); ++run) {
    stop.maximal_iterations = m_options.maximal_iterations - report.iterations;
    report.iterations
      += Multigrid::minimize_energy(m_system.matrix(), f, u, precondition, stop, observe).iterations;
    report.relative_residual = m_system.norm_of_residual(f, u) / norm;
  }
  if(!goes_on)
    report.cancel();
  else if(!is_enough()) {
    std::ostringstream sentence;
    sentence << "the residual is " << report.relative_residual << " of the right-hand side after "
             << report.iterations << " iterations; the matrix may not be positive semi-definite, or "
             << "the tolerance is beyond rounding";
    report.fail(Mesh_status::FAILED, sentence.str());
  }
}

template <class Value, class Tag>
template <class B, class X>
Surface_multigrid_report Surface_multigrid_solver<Value, Tag>::solve(const B& b, X& x)
{
  const Blocked_execution::Tagged_threads<Tag> threads(m_options.threads);
  const auto start = Clock::now();
  Report report;
  if(report.fail(*m_surface)
     || report.fail(Mesh_status::BAD_OPTIONS,
                    m_system.has_matrix() ? "" : "there is no matrix, or not a good one")
     || report.fail(Mesh_status::BAD_OPTIONS, values_error("the right-hand side", b))
     || report.fail(Mesh_status::BAD_OPTIONS, values_error("the solution", x)))
    return report;
  const auto& source = m_surface->source();
  const Vector_value zero = Vector_traits::zero();
  Vector f(size()), u(size()), given(size());
  Multigrid::for_each_index(size(), [&](std::size_t i) {
    f[i] = zero;
    if(!m_system.is_fixed(i))
      f[i] = m_system.scale() * Vector_value(b[source[i]]);
    u[i] = Vector_value(x[source[i]]);
    given[i] = m_system.is_fixed(i) ? u[i] : zero;
  });
  const double norm_of_b = std::sqrt(Multigrid::squared_norm(f));
  report.unsolvable_part = norm_of_b > 0. ? m_system.remove_mean(f) / norm_of_b : 0.;
  const double norm = Multigrid::squared_norm(given) > 0. ? m_system.norm_of_residual(f, given)
                                                          : std::sqrt(Multigrid::squared_norm(f));
  constexpr double rounding = 1e-15;
  if(norm > rounding * norm_of_b)
    iterate(f, norm, u, report);
  else
    u = given;
  Multigrid::for_each_index(size(), [&](std::size_t i) { x[source[i]] = u[i]; });
  report.seconds = seconds_since(start);
  return report;
}

template <class Value, class Tag>
template <class Bs, class Xs>
Surface_multigrid_report Surface_multigrid_solver<Value, Tag>::solve_all(const Bs& b, Xs& x)
{
  Report worst;
  if(b.size() != x.size()) {
    worst.fail(Mesh_status::BAD_OPTIONS,
               std::to_string(b.size()) + " right-hand sides for " + std::to_string(x.size())
                 + " solutions");
    return worst;
  }
  double seconds = 0.;
  for(std::size_t i = 0; i < b.size() && worst.is_ok(); ++i) {
    const Report report = solve(b[i], x[i]);
    seconds += report.seconds;
    if(!report.is_ok() || report.relative_residual > worst.relative_residual)
      worst = report;
  }
  worst.seconds = seconds;
  return worst;
}

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_SURFACE_MULTIGRID_SOLVER_H
