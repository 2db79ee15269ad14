// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_SURFACE_MULTIGRID_SOLVER_H
#define CGAL_SURFACE_MESH_MULTIGRID_SURFACE_MULTIGRID_SOLVER_H

#include <CGAL/Multigrid/Block_values.h>
#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_multigrid/Element_matrix.h>
#include <CGAL/Surface_mesh_multigrid/Surface_hierarchy.h>
#include <CGAL/Surface_mesh_multigrid/internal/galerkin_rows.h>
#include <CGAL/Surface_mesh_multigrid/internal/surface_rows.h>

#include <CGAL/Default.h>

#include <Eigen/SparseCholesky>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multigrid {

/// \ingroup PkgHLSCMSurfaceMultigrid
/// The options of `Surface_multigrid_solver`.
struct Surface_multigrid_options
{
  double tolerance = 1e-6; ///< of the norm of the residual to that of the right-hand side
  std::size_t maximal_iterations = 100; ///< at most so many
  /// The cycle that preconditions each iteration.
  Multigrid::Schedule schedule = Multigrid::Schedule::v_cycle(3, 3);
  /// How many threads there may be if the solver has a parallel tag; 0 stands for all.
  unsigned int threads = 0;
  /// Told the part done in [0, 1] from time to time; returning false stops it.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMSurfaceMultigrid
/// What came of a matrix or of a solution.
struct Surface_multigrid_report
  : Indexed_mesh::Mesh_outcome
{
  std::size_t iterations = 0;     ///< steps of the conjugate gradient method
  double relative_residual = 0.;  ///< the norm of the residual to that of the right-hand side
  /// The part of the right-hand side that no solution can have, to its norm: where constants are in
  /// the kernel of the matrix, the mean over each component is left out.
  double unsolvable_part = 0.;
  double seconds = 0.;            ///< of wall-clock time
};

namespace internal {

// The single precision of a value.
template <class Value>
struct Single { typedef float type; };
template <class Real>
struct Single<std::complex<Real>> { typedef std::complex<float> type; };
template <class Real, int N>
struct Single<Eigen::Matrix<Real, N, N>> { typedef Eigen::Matrix<float, N, N> type; };

} // namespace internal

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
        `Eigen::Vector2d` or `Eigen::Vector3d`
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
  template <class Mesh>
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

  /// Takes a sparse matrix of Eigen as \f$ A \f$: row i is vertex i of the mesh; of blocks of N rows
  /// the rows N i and following.
  template <class Number, int Options_, class Index>
  Report set_matrix(const Eigen::SparseMatrix<Number, Options_, Index>& matrix,
                    const std::vector<bool>& is_fixed = {})
  {
    return set_rows(is_fixed, [&](Report& report) {
      constexpr int rows = Multigrid::Value_traits<Value>::rows;
      typedef Indexed_mesh::Mesh_status Mesh_status;
      if(report.fail(Mesh_status::BAD_OPTIONS, internal::matrix_error<rows>(size(), matrix)))
        return Rows();
      return internal::copy_rows<Double>(*m_surface, matrix);
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
  Report solve(const B& b, X& x);

  /// Solves for several right-hand sides, one after the other; returns the worst report. `x` has as
  /// many vectors as `b`.
  template <class Bs, class Xs>
  Report solve_all(const Bs& b, Xs& x);

  /// Returns the bytes that it takes beside the hierarchy.
  std::size_t memory() const
  {
    std::size_t result = m_matrix.memory();
    for(const auto& h : m_matrices)
      result += h.memory();
    return result;
  }

  /// Prints the matrices of the levels as a table, the finest first.
  friend std::ostream& operator<<(std::ostream& out, const Surface_multigrid_solver& solver)
  {
    return solver.m_levels == nullptr ? out << Levels() : out << *solver.m_levels;
  }

private:
  typedef Multigrid::Value_traits<Value> Traits;
  typedef typename Traits::Double Double;
  typedef typename internal::Single<Value>::type Single;
  typedef typename Traits::Inner Inner;
  typedef Multigrid::Sparse_rows<Double> Rows;
  typedef Multigrid::Value_traits<Vector_value> Vector_traits;
  typedef Multigrid::Sparse_cholesky<Eigen::SimplicialLLT<Eigen::SparseMatrix<Inner>>> Coarsest;
  typedef Multigrid::Multigrid_levels<Surface_hierarchy::Prolongation, Coarsest, Single> Levels;
  typedef std::chrono::steady_clock Clock;

  std::size_t size() const { return m_surface->number_of_vertices(); }
  template <class Make_rows>
  Report set_rows(const std::vector<bool>& is_fixed, const Make_rows& make_rows);
  std::string rows_error(const Rows& rows) const;
  void find_kernel(const Rows& rows);
  void build_levels(Rows rows, Report& report);
  bool factorize(Rows& coarsest);
  template <class B, class X>
  std::string vectors_error(const B& b, const X& x) const;
  double remove_mean(Vector& f) const;
  void residual(const Vector& f, const Vector& x, Vector& r) const;
  static double seconds_since(Clock::time_point start)
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  std::shared_ptr<const Surface_hierarchy> m_surface;
  Options m_options;
  std::vector<Surface_hierarchy::Point_3> m_moved; // in the order of the level
  std::vector<bool> m_is_fixed;                    // the same
  std::vector<bool> m_has_kernel;                  // components on which constants are
  Multigrid::Self_adjoint_matrix<Value> m_matrix;  // rows of fixed unknowns are zero
  std::vector<Multigrid::Self_adjoint_matrix<Single>> m_matrices;
  std::unique_ptr<Levels> m_levels;
};

template <class Value, class Tag>
Surface_multigrid_report Surface_multigrid_solver<Value, Tag>::
set_points(const std::vector<Surface_hierarchy::Point_3>& points)
{
  Report report;
  if(report.fail(*m_surface))
    return report;
  if(points.size() != size()) {
    report.fail(Indexed_mesh::Mesh_status::BAD_OPTIONS,
                std::to_string(points.size()) + " points for " + std::to_string(size()) + " vertices");
    return report;
  }
  if(report.fail(Indexed_mesh::Mesh_status::BAD_OPTIONS, Indexed_mesh::point_error(points)))
    return report;
  m_moved.resize(size());
  for(std::size_t v = 0; v < size(); ++v)
    m_moved[v] = points[m_surface->source()[v]];
  return report;
}

// What is wrong with the rows, as a sentence: entries that are no numbers, and diagonal entries that
// no positive semi-definite matrix without a row of zeros has.
template <class Value, class Tag>
std::string Surface_multigrid_solver<Value, Tag>::rows_error(const Rows& rows) const
{
  typedef Multigrid::Value_traits<typename Rows::Diagonal> Diagonal_traits;
  for(std::uint32_t i = 0; i < rows.size(); ++i) {
    double size = double(Diagonal_traits::squared_norm(rows.diagonal()[i]));
    for(std::uint32_t k = 0; k < rows.length(i); ++k)
      size += double(Multigrid::Value_traits<Double>::squared_norm(rows.values(i)[k]));
    const std::string vertex = std::to_string(m_surface->source()[i]);
    if(!std::isfinite(size))
      return "the row of vertex " + vertex + " has an entry that is not a finite number";
    if(!m_is_fixed[i] && !Diagonal_traits::is_positive(rows.diagonal()[i]))
      return "the diagonal entry of vertex " + vertex
           + " is not positive: the matrix is not positive definite";
  }
  return {};
}

// The components without fixed unknowns all rows of which have the sum 0, up to rounding.
template <class Value, class Tag>
void Surface_multigrid_solver<Value, Tag>::find_kernel(const Rows& rows)
{
  constexpr double rounding = 1e-22; // of squares
  m_has_kernel.assign(m_surface->number_of_components(), true);
  for(std::uint32_t i = 0; i < rows.size(); ++i) {
    Double sum = Multigrid::Value_traits<Double>::zero();
    sum += rows.diagonal()[i];
    double size = double(Multigrid::Value_traits<Double>::squared_norm(sum));
    for(std::uint32_t k = 0; k < rows.length(i); ++k) {
      sum += rows.values(i)[k];
      size += double(Multigrid::Value_traits<Double>::squared_norm(rows.values(i)[k]));
    }
    if(m_is_fixed[i] || Multigrid::Value_traits<Double>::squared_norm(sum) > rounding * size)
      m_has_kernel[m_surface->component()[i]] = false;
  }
}

template <class Value, class Tag>
template <class Make_rows>
Surface_multigrid_report Surface_multigrid_solver<Value, Tag>::
set_rows(const std::vector<bool>& is_fixed, const Make_rows& make_rows)
{
  typedef Indexed_mesh::Mesh_status Mesh_status;
  const Blocked_execution::Tagged_threads<Tag> threads(m_options.threads);
  const auto start = Clock::now();
  Report report;
  m_matrix = Multigrid::Self_adjoint_matrix<Value>();
  if(report.fail(*m_surface))
    return report;
  if(!is_fixed.empty() && is_fixed.size() != size()) {
    report.fail(Mesh_status::BAD_OPTIONS, "is_fixed has " + std::to_string(is_fixed.size())
                                            + " entries for " + std::to_string(size()) + " vertices");
    return report;
  }
  m_is_fixed.assign(size(), false);
  for(std::size_t v = 0; v < size() && !is_fixed.empty(); ++v)
    m_is_fixed[v] = is_fixed[m_surface->source()[v]];
  Rows rows = make_rows(report);
  if(report.is_ok() && !report.fail(Mesh_status::BAD_OPTIONS, rows_error(rows))) {
    find_kernel(rows);
    rows.clear_rows([this](std::uint32_t i) { return m_is_fixed[i]; });
    m_matrix = rows.template matrix<Value>();
    build_levels(std::move(rows), report);
  }
  report.seconds = seconds_since(start);
  return report;
}

// The matrices of the levels, the finest first, and the cycle over them.
template <class Value, class Tag>
void Surface_multigrid_solver<Value, Tag>::build_levels(Rows rows, Report& report)
{
  const std::size_t count = m_surface->number_of_levels();
  m_matrices.clear();
  m_matrices.resize(count);
  m_matrices.back().assign(m_matrix);
  for(std::size_t l = count - 1; l-- > 0;) {
    rows = internal::galerkin_rows(rows, m_surface->from_coarser(l + 1));
    m_matrices[l] = rows.template matrix<Single>();
  }
  m_levels = std::make_unique<Levels>();
  for(std::size_t l = 0; l < count; ++l)
    m_levels->add_level(m_matrices[l], l == 0 ? nullptr : &m_surface->from_coarser(l));
  if(!factorize(rows)) {
    m_matrix = Multigrid::Self_adjoint_matrix<Value>();
    report.fail(Indexed_mesh::Mesh_status::FAILED, "the matrix is not positive semi-definite");
  }
}

// The diagonal of the coarsest matrix is shifted: by less than what single precision tells apart if
// there is a kernel, by much less otherwise, for kernels that are not constants.
template <class Value, class Tag>
bool Surface_multigrid_solver<Value, Tag>::factorize(Rows& coarsest)
{
  bool has_kernel = false;
  for(const bool is_in_kernel : m_has_kernel)
    has_kernel = has_kernel || is_in_kernel;
  for(const double shift : {has_kernel ? 1e-7 : 1e-10, 1e-6}) {
    coarsest.shift_diagonal(shift);
    if(m_levels->coarsest_solver().factorize(coarsest.template matrix<Double>()))
      return true;
  }
  return false;
}

template <class Value, class Tag>
template <class B, class X>
std::string Surface_multigrid_solver<Value, Tag>::vectors_error(const B& b, const X& x) const
{
  if(m_matrix.size() == 0)
    return "there is no matrix, or not a good one";
  if(std::size_t(b.size()) != size() || std::size_t(x.size()) != size())
    return "the right-hand side has " + std::to_string(b.size()) + " entries and the solution "
         + std::to_string(x.size()) + " for " + std::to_string(size()) + " vertices";
  for(std::size_t v = 0; v < size(); ++v) {
    const double size_of_b = double(Vector_traits::squared_norm(b[v])),
                 size_of_x = double(Vector_traits::squared_norm(x[v]));
    if(!std::isfinite(size_of_b) || !std::isfinite(size_of_x))
      return "the " + std::string(std::isfinite(size_of_b) ? "solution" : "right-hand side")
           + " has an entry at vertex " + std::to_string(v) + " that is not a finite number";
  }
  return {};
}

// Removes the means over the components that have constants in the kernel; returns the norm of what
// was removed.
template <class Value, class Tag>
double Surface_multigrid_solver<Value, Tag>::remove_mean(Vector& f) const
{
  const auto& component = m_surface->component();
  std::vector<Vector_value> sum(m_has_kernel.size(), Vector_traits::zero());
  std::vector<std::size_t> number(sum.size(), 0);
  for(std::size_t i = 0; i < f.size(); ++i) {
    sum[component[i]] += f[i];
    ++number[component[i]];
  }
  double removed = 0.;
  for(std::size_t c = 0; c < sum.size(); ++c) {
    sum[c] = sum[c] * (typename Traits::Real(m_has_kernel[c] ? 1. : 0.)
                       / typename Traits::Real(number[c]));
    removed += double(number[c]) * double(Vector_traits::squared_norm(sum[c]));
  }
  for(std::size_t i = 0; i < f.size(); ++i)
    f[i] -= sum[component[i]];
  return std::sqrt(removed);
}

// f - A x, 0 at fixed unknowns.
template <class Value, class Tag>
void Surface_multigrid_solver<Value, Tag>::residual(const Vector& f, const Vector& x,
                                                    Vector& r) const
{
  r.resize(x.size());
  m_matrix.multiply(x, r);
  Multigrid::for_each_index(r.size(), [&](std::size_t i) { r[i] = f[i] - r[i]; });
}

template <class Value, class Tag>
template <class B, class X>
Surface_multigrid_report Surface_multigrid_solver<Value, Tag>::solve(const B& b, X& x)
{
  typedef Indexed_mesh::Mesh_status Mesh_status;
  const Blocked_execution::Tagged_threads<Tag> threads(m_options.threads);
  const auto start = Clock::now();
  Report report;
  if(report.fail(*m_surface) || report.fail(Mesh_status::BAD_OPTIONS, vectors_error(b, x)))
    return report;
  const auto& source = m_surface->source();
  const Vector_value zero = Vector_traits::zero();
  Vector f(size()), u(size()), given(size()), r;
  Multigrid::for_each_index(size(), [&](std::size_t i) {
    f[i] = m_is_fixed[i] ? zero : Vector_value(b[source[i]]);
    u[i] = x[source[i]];
    given[i] = m_is_fixed[i] ? u[i] : zero;
  });
  const double norm_of_b = std::sqrt(Multigrid::squared_norm(f));
  report.unsolvable_part = norm_of_b > 0. ? remove_mean(f) / norm_of_b : 0.;
  residual(f, given, r);
  const double norm = std::sqrt(Multigrid::squared_norm(r));
  Multigrid::Energy_stop stop;
  stop.tolerance = 0.;
  stop.residual_tolerance = m_options.tolerance * norm;
  stop.maximal_iterations = m_options.maximal_iterations;
  bool goes_on = true;
  if(norm > 0.) {
    const auto iterations = Multigrid::minimize_energy(
      m_matrix, f, u,
      [&](const Vector& defect, Vector& z) {
        m_levels->precondition(m_options.schedule, m_surface->number_of_levels() - 1, defect, z);
        if(report.unsolvable_part > 0.)
          remove_mean(z);
      },
      stop, [&](double part) {
        return goes_on = !m_options.progress || m_options.progress(part);
      });
    report.iterations = iterations.iterations;
    residual(f, u, r);
    report.relative_residual = std::sqrt(Multigrid::squared_norm(r)) / norm;
  } else
    u = given;
  Multigrid::for_each_index(size(), [&](std::size_t i) { x[source[i]] = u[i]; });
  constexpr double rounding = 1.1; // the residual of the iteration is not that of x
  if(!goes_on)
    report.cancel();
  else if(!(report.relative_residual <= rounding * m_options.tolerance))
    report.fail(Mesh_status::FAILED,
                "the residual is " + std::to_string(report.relative_residual)
                  + " of the right-hand side after " + std::to_string(report.iterations)
                  + " iterations; the matrix may not be positive semi-definite, or the tolerance is "
                    "beyond rounding");
  report.seconds = seconds_since(start);
  return report;
}

template <class Value, class Tag>
template <class Bs, class Xs>
Surface_multigrid_report Surface_multigrid_solver<Value, Tag>::solve_all(const Bs& b, Xs& x)
{
  Report worst;
  if(b.size() != x.size()) {
    worst.fail(Indexed_mesh::Mesh_status::BAD_OPTIONS,
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
