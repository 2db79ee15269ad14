// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PYTHON_OUTCOMES_H
#define HLSCM_PYTHON_OUTCOMES_H

#include <CGAL/Indexed_mesh/mesh_error.h>

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <utility>

namespace hlscm_python {

namespace py = pybind11;
using CGAL::Indexed_mesh::Mesh_outcome;
using CGAL::Indexed_mesh::Mesh_status;

/// What becomes the exception `hlscm.MeshError`.
class Bad_input
  : public std::exception
{
public:
  Bad_input(Mesh_status status, std::string sentence)
    : m_status(status), m_sentence(std::move(sentence))
  {}

  Mesh_status status() const { return m_status; }
  const char* what() const noexcept override { return m_sentence.c_str(); }

private:
  Mesh_status m_status;
  std::string m_sentence;
};

/// Throws what the library says is wrong.
inline void check(const Mesh_outcome& outcome)
{
  if(!outcome.is_ok())
    throw Bad_input(outcome.status, outcome.error);
}

/// Raises OSError if a file was not written.
inline void check_written(bool is_written, const std::string& path)
{
  if(!is_written) {
    PyErr_SetString(PyExc_OSError, ("cannot write " + path).c_str());
    throw py::error_already_set();
  }
}

} // namespace hlscm_python

#endif // HLSCM_PYTHON_OUTCOMES_H
