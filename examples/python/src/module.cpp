// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "module.h"
#include "outcomes.h"

#include <pybind11/pybind11.h>

namespace py = pybind11;

namespace hlscm_python {
namespace {

PyObject* mesh_error = nullptr; // the class; lives as long as the interpreter

const char* name_of(Mesh_status status)
{
  switch(status) {
  case Mesh_status::OK: return "OK";
  case Mesh_status::BAD_MESH: return "BAD_MESH";
  case Mesh_status::BAD_OPTIONS: return "BAD_OPTIONS";
  case Mesh_status::CANCELLED: return "CANCELLED";
  case Mesh_status::FAILED: break;
  }
  return "FAILED";
}

void raise(const Bad_input& error)
{
  py::object exception = py::reinterpret_borrow<py::object>(mesh_error)(error.what());
  exception.attr("status") = name_of(error.status());
  PyErr_SetObject(mesh_error, exception.ptr());
}

} // namespace
} // namespace hlscm_python

PYBIND11_MODULE(_hlscm, m)
{
  using namespace hlscm_python;
  m.doc() = "The compiled part of hlscm: strict about its arguments, which package/hlscm/__init__.py prepares.";
  py::dict defaults; // of those that are raised in Python
  defaults["status"] = name_of(Mesh_status::BAD_OPTIONS);
  mesh_error = PyErr_NewExceptionWithDoc(
    "hlscm.MeshError",
    "What is wrong with a mesh or an option, in a sentence that names the first element to blame.\n\n"
    "status: \"BAD_MESH\", \"BAD_OPTIONS\", \"CANCELLED\" (the progress callable said stop) or \"FAILED\"\n"
    "(the input is good, but there is no result).",
    PyExc_ValueError, defaults.ptr());
  if(mesh_error == nullptr)
    throw py::error_already_set();
  m.add_object("MeshError", mesh_error);
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if(p)
        std::rethrow_exception(p);
    } catch(const Bad_input& error) {
      raise(error);
    }
  });
  m.attr("__version__") = HLSCM_VERSION;
  bind_atlases(m);
  bind_equations(m);
  bind_levels(m);
  bind_maps(m);
  bind_measures(m);
  bind_texturing(m);
}
