// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "arrays.h"
#include "module.h"
#include "running.h"

#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>

#include <pybind11/stl.h>

#include <complex>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hlscm_python {
namespace {

namespace SMG = CGAL::Surface_mesh_multigrid;

template <class Value>
using Array = py::array_t<Value, py::array::c_style | py::array::forcecast>;
typedef Array<std::int32_t> Indices;

// A square matrix of compressed rows where numpy has it.
template <class Value>
using Matrix_map = Eigen::Map<const Eigen::SparseMatrix<Value, Eigen::RowMajor, std::int32_t>>;

// Throws what is wrong with the arrays of such a matrix, whose columns ascend in each row.
template <class Value>
void check_matrix(std::size_t n, const Indices& starts, const Indices& columns,
                  const Array<Value>& values)
{
  const auto entries = std::int64_t(values.size());
  const auto fail = [](const std::string& sentence) {
    throw Bad_input(Mesh_status::BAD_OPTIONS, sentence);
  };
  if(starts.ndim() != 1 || columns.ndim() != 1 || values.ndim() != 1
     || std::int64_t(starts.size()) != std::int64_t(n) + 1 || columns.size() != values.size())
    fail("the arrays of the sparse matrix do not fit each other or the vertices");
  const std::int32_t* start = starts.data();
  const std::int32_t* column = columns.data();
  if(start[0] != 0 || start[n] != entries)
    fail("the rows of the sparse matrix are not all of its entries");
  for(std::size_t i = 0; i < n; ++i) {
    if(start[i] > start[i + 1] || start[i] < 0 || start[i + 1] > entries)
      fail("row " + std::to_string(i) + " of the sparse matrix ends before it begins");
    for(std::int32_t e = start[i]; e < start[i + 1]; ++e)
      if(column[e] < 0 || std::size_t(column[e]) >= n || (e > start[i] && column[e] <= column[e - 1]))
        fail("the columns of row " + std::to_string(i)
             + " of the sparse matrix do not exist or do not ascend");
  }
}

/// The levels of a surface, and the matrix on it that was set last.
template <class Value>
class Solver
{
public:
  typedef SMG::Surface_multigrid_solver<Value> Library_solver;
  typedef std::vector<Value> Vector;

  Solver(std::shared_ptr<const SMG::Surface_hierarchy> hierarchy, unsigned int threads)
    : m_solver(std::move(hierarchy)), m_threads(threads)
  {}

  void set_matrix(const Indices& starts, const Indices& columns, const Array<Value>& values,
                  const std::optional<py::array_t<bool>>& fixed)
  {
    const Exclusive::Use use(m_exclusive);
    check_matrix<Value>(size(), starts, columns, values);
    const auto n = Eigen::Index(size());
    const Matrix_map<Value> matrix(n, n, values.size(), starts.data(), columns.data(), values.data());
    std::vector<bool> is_fixed;
    for(py::ssize_t i = 0; fixed && i < fixed->size(); ++i)
      is_fixed.push_back(fixed->at(i));
    if(fixed && is_fixed.empty())
      throw Bad_input(Mesh_status::BAD_OPTIONS, "fixed has no entries");
    check(run(m_threads, [&] { return m_solver.set_matrix(matrix, is_fixed); }));
  }

  // The columns of b are right-hand sides; x has where to begin, and the values of fixed unknowns.
  py::tuple solve(const Array<Value>& b, const Array<Value>& x, double tolerance,
                  std::size_t maximal_iterations, const py::object& progress)
  {
    const Exclusive::Use use(m_exclusive);
    if(b.ndim() != 2 || x.ndim() != 2 || b.shape(0) != x.shape(0) || b.shape(1) != x.shape(1))
      throw Bad_input(Mesh_status::BAD_OPTIONS, "b and x do not have the same shape");
    std::vector<Vector> sides = columns_of(b), solutions = columns_of(x);
    std::vector<SMG::Surface_multigrid_report> reports(sides.size());
    m_solver.options().tolerance = tolerance;
    m_solver.options().maximal_iterations = maximal_iterations;
    run(m_threads, progress, [&](const auto& function) {
      for(std::size_t i = 0; i < sides.size(); ++i) {
        m_solver.options().progress = [&](double part) {
          return function((double(i) + part) / double(sides.size()));
        };
        reports[i] = m_solver.solve(sides[i], solutions[i]);
        if(!reports[i].is_ok())
          break;
      }
      m_solver.options().progress = nullptr;
      return true;
    });
    py::array_t<Value> result({b.shape(0), b.shape(1)});
    auto entries = result.template mutable_unchecked<2>();
    py::list all;
    for(std::size_t j = 0; j < sides.size(); ++j) {
      check(reports[j]);
      for(std::size_t i = 0; i < solutions[j].size(); ++i)
        entries(py::ssize_t(i), py::ssize_t(j)) = solutions[j][i];
      py::dict report;
      report["iterations"] = reports[j].iterations;
      report["relative_residual"] = reports[j].relative_residual;
      report["unsolvable_part"] = reports[j].unsolvable_part;
      report["seconds"] = reports[j].seconds;
      all.append(report);
    }
    return py::make_tuple(result, all);
  }

private:
  std::size_t size() const { return m_solver.hierarchy()->number_of_vertices(); }

  static std::vector<Vector> columns_of(const Array<Value>& table)
  {
    const auto entries = table.template unchecked<2>();
    std::vector<Vector> columns;
    for(py::ssize_t j = 0; j < table.shape(1); ++j) {
      columns.emplace_back();
      for(py::ssize_t i = 0; i < table.shape(0); ++i)
        columns.back().push_back(entries(i, j));
    }
    return columns;
  }

  Library_solver m_solver;
  unsigned int m_threads;
  Exclusive m_exclusive;
};

/// The levels of a surface, for any number of solvers.
class Hierarchy
{
public:
  Hierarchy(const py::array& points, const py::array& triangles, double ratio,
            std::size_t coarsest_size, unsigned int threads, const py::object& progress)
  {
    const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
    SMG::Surface_hierarchy_options options;
    options.ratio = ratio;
    options.coarsest_size = coarsest_size;
    m_levels = run(threads, progress, [&](const auto& function) {
      options.progress = function;
      return std::make_shared<const SMG::Surface_hierarchy>(mesh, options);
    });
    check(*m_levels);
  }

  std::vector<std::size_t> vertices() const
  {
    std::vector<std::size_t> result;
    for(std::size_t l = 0; l < m_levels->number_of_levels(); ++l)
      result.push_back(m_levels->number_of_vertices(l));
    return result;
  }

  const std::shared_ptr<const SMG::Surface_hierarchy>& levels() const { return m_levels; }

private:
  std::shared_ptr<const SMG::Surface_hierarchy> m_levels;
};

template <class Value>
void bind_solver(py::module_& m, const char* name)
{
  using namespace py::literals;
  py::class_<Solver<Value>>(m, name, "A multigrid solver for one matrix at a time.")
    .def(py::init([](const Hierarchy& hierarchy, unsigned int threads) {
           return std::make_unique<Solver<Value>>(hierarchy.levels(), threads);
         }),
         "hierarchy"_a, "threads"_a)
    .def("set_matrix", &Solver<Value>::set_matrix,
         "Takes a matrix of compressed rows; fixed (n,) are unknowns whose values are given.",
         "indptr"_a, "indices"_a, "data"_a, "fixed"_a)
    .def("solve", &Solver<Value>::solve,
         "The solutions (n, k) for the right-hand sides b (n, k), from x (n, k), and their reports.",
         "b"_a, "x"_a, "tolerance"_a, "max_iterations"_a, "progress"_a);
}

} // namespace

void bind_equations(py::module_& m)
{
  using namespace py::literals;
  py::class_<Hierarchy>(m, "Hierarchy", "The levels of a surface for multigrid.")
    .def(py::init<const py::array&, const py::array&, double, std::size_t, unsigned int,
                  const py::object&>(),
         "vertices"_a, "faces"_a, "ratio"_a, "coarsest_size"_a, "threads"_a, "progress"_a)
    .def_property_readonly("vertices", &Hierarchy::vertices,
                           "The number of vertices of each level, the coarsest first.");
  bind_solver<double>(m, "RealSolver");
  bind_solver<std::complex<double>>(m, "ComplexSolver");
}

} // namespace hlscm_python
