// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_EXAMPLES_PRECOMPILED_H
#define HLSCM_EXAMPLES_PRECOMPILED_H

// What most examples include and instantiate, compiled once for all of them: only to spare time, see
// CMakeLists.txt. They do not include this file.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <string>

// Instantiated in surface_pictures.cpp
extern template bool
CGAL::IO::read_polygon_mesh(const std::string&,
                            CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>&,
                            const CGAL::parameters::Default_named_parameters&);

#endif // HLSCM_EXAMPLES_PRECOMPILED_H
