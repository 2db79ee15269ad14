// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PYTHON_MODULE_H
#define HLSCM_PYTHON_MODULE_H

#include <pybind11/pybind11.h>

namespace hlscm_python {

void bind_atlases(pybind11::module_& m);
void bind_equations(pybind11::module_& m);
void bind_levels(pybind11::module_& m);
void bind_maps(pybind11::module_& m);
void bind_measures(pybind11::module_& m);
void bind_texturing(pybind11::module_& m);

} // namespace hlscm_python

#endif // HLSCM_PYTHON_MODULE_H
