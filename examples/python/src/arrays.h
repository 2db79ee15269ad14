// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PYTHON_ARRAYS_H
#define HLSCM_PYTHON_ARRAYS_H

#include "outcomes.h"

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace hlscm_python {

using CGAL::Indexed_mesh::Indexed_triangle_mesh;
using CGAL::Indexed_mesh::Triangle_indices;
using CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh;
typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;
typedef CGAL::Simple_cartesian<double>::Point_3 Point_3;

// Points and parameters lie in memory as in an array of numpy.
static_assert(sizeof(Point_2) == 2 * sizeof(double) && sizeof(Point_3) == 3 * sizeof(double)
              && sizeof(Triangle_indices) == 3 * sizeof(std::uint32_t));

// From numpy: arrays are read where they are, whatever their strides, into the library's own.

/// Says of an array that it has another shape than rows of `columns` entries.
inline void check_shape(const py::array& a, std::size_t columns, const char* name)
{
  if(a.ndim() != 2 || std::size_t(a.shape(1)) != columns) {
    std::string shape;
    for(py::ssize_t d = 0; d < a.ndim(); ++d)
      shape += (d == 0 ? "" : ", ") + std::to_string(a.shape(d));
    throw Bad_input(Mesh_status::BAD_OPTIONS, std::string(name) + " has the shape (" + shape
                    + (a.ndim() == 1 ? ",)" : ")") + " instead of (n, " + std::to_string(columns) + ")");
  }
  constexpr py::ssize_t most = 1000000000; // halfedges have 32 bits
  if(a.shape(0) > most)
    throw Bad_input(Mesh_status::BAD_OPTIONS, std::string(name) + " has more than 1000000000 rows");
}

/// Calls `use(row, column, value)` for all entries of a table with entries of type T.
template <class T, class Use>
void for_each_entry(const py::array& a, const Use& use)
{
  const char* data = static_cast<const char*>(a.data());
  const py::ssize_t columns = a.shape(1);
  if(a.strides(1) == py::ssize_t(sizeof(T)) && a.strides(0) == columns * py::ssize_t(sizeof(T))
     && reinterpret_cast<std::uintptr_t>(data) % alignof(T) == 0) { // as usual: quicker so
    const T* value = reinterpret_cast<const T*>(data);
    for(std::size_t i = 0; i < std::size_t(a.shape(0)); ++i)
      for(std::size_t j = 0; j < std::size_t(columns); ++j)
        use(i, j, *value++);
    return;
  }
  for(py::ssize_t i = 0; i < a.shape(0); ++i)
    for(py::ssize_t j = 0; j < a.shape(1); ++j) {
      T value; // what is not aligned, too
      std::memcpy(&value, data + i * a.strides(0) + j * a.strides(1), sizeof(T));
      use(std::size_t(i), std::size_t(j), value);
    }
}

template <class T>
bool has_type(const py::array& a) { return py::isinstance<py::array_t<T>>(a); }

[[noreturn]] inline void throw_type(const py::array& a, const char* name, const char* types)
{
  throw py::type_error(std::string(name) + " has entries of type " + std::string(py::str(a.dtype()))
                       + " instead of " + types);
}

/// The rows of an array of numbers as points of `Columns` coordinates.
template <class Point, std::size_t Columns>
std::vector<Point> to_points(const py::array& a, const char* name)
{
  check_shape(a, Columns, name);
  typedef std::array<double, Columns> Row;
  static_assert(sizeof(Point) == sizeof(Row));
  std::vector<Point> points(std::size_t(a.shape(0)));
  char* bytes = reinterpret_cast<char*>(points.data());
  const auto set = [bytes](std::size_t i, std::size_t j, double x) {
    std::memcpy(bytes + i * sizeof(Row) + j * sizeof(double), &x, sizeof(double));
  };
  if(has_type<double>(a))
    for_each_entry<double>(a, set);
  else if(has_type<float>(a))
    for_each_entry<float>(a, [&set](std::size_t i, std::size_t j, float x) { set(i, j, double(x)); });
  else
    throw_type(a, name, "float32 or float64");
  return points;
}

/// The rows of an array of indices. What is no 32-bit index becomes `no_vertex`, which the library
/// finds out of range.
inline std::vector<Triangle_indices> to_triangles(const py::array& a, const char* name)
{
  check_shape(a, 3, name);
  std::vector<Triangle_indices> triangles(std::size_t(a.shape(0)));
  const auto read = [&](auto type) {
    typedef decltype(type) Integer;
    for_each_entry<Integer>(a, [&triangles](std::size_t i, std::size_t j, Integer v) {
      const bool is_index = v >= Integer(0) && std::uint64_t(v) < CGAL::Indexed_mesh::no_vertex;
      triangles[i][j] = is_index ? std::uint32_t(v) : CGAL::Indexed_mesh::no_vertex;
    });
  };
  if(has_type<std::int64_t>(a))
    read(std::int64_t());
  else if(has_type<std::int32_t>(a))
    read(std::int32_t());
  else if(has_type<std::uint32_t>(a))
    read(std::uint32_t());
  else if(has_type<std::uint64_t>(a))
    read(std::uint64_t());
  else
    throw_type(a, name, "int32, int64, uint32 or uint64");
  return triangles;
}

inline Indexed_triangle_mesh to_mesh(const py::array& points, const py::array& triangles)
{
  return {to_points<Point_3, 3>(points, "vertices"), to_triangles(triangles, "faces")};
}

inline std::vector<Point_2> to_uv(const py::array& uv) { return to_points<Point_2, 2>(uv, "uv"); }

/// A mesh with the parameters `uv` and, for each face, their indices.
inline Textured_triangle_mesh to_textured(const py::array& points, const py::array& triangles,
                                          const py::array& uv, const py::array& uv_triangles)
{
  return {to_points<Point_3, 3>(points, "vertices"), to_triangles(triangles, "faces"), to_uv(uv),
          to_triangles(uv_triangles, "uv_faces")};
}

/// The same as Python passes it: vertices, faces, uv and uv_faces.
typedef std::array<py::array, 4> Textured_arrays;
inline Textured_triangle_mesh to_textured(const Textured_arrays& a)
{
  return to_textured(a[0], a[1], a[2], a[3]);
}

// To numpy: an array is a view of what the library returned, which it keeps alive.

/// An array of `shape` on the memory of a vector whose entries consist of numbers of type T.
template <class T, class Entry>
py::array to_array(std::vector<Entry>&& entries, std::vector<py::ssize_t> shape)
{
  auto* kept = new std::vector<Entry>(std::move(entries));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Entry>*>(p); });
  return py::array(py::dtype::of<T>(), std::move(shape), kept->data(), owner);
}

inline py::array to_array(std::vector<Point_2>&& points)
{
  const auto n = py::ssize_t(points.size());
  return to_array<double>(std::move(points), {n, 2});
}

inline py::array to_array(std::vector<Point_3>&& points)
{
  const auto n = py::ssize_t(points.size());
  return to_array<double>(std::move(points), {n, 3});
}

inline py::array to_array(std::vector<Triangle_indices>&& triangles)
{
  const auto n = py::ssize_t(triangles.size());
  return to_array<std::uint32_t>(std::move(triangles), {n, 3});
}

template <class Number>
py::array to_array(std::vector<Number>&& numbers)
{
  const auto n = py::ssize_t(numbers.size());
  return to_array<Number>(std::move(numbers), {n});
}

} // namespace hlscm_python

#endif // HLSCM_PYTHON_ARRAYS_H
