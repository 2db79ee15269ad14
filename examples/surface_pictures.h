// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the examples of equations on surfaces share: a surface of a file or made of formulas, and a
// picture of a function on it.

#ifndef HLSCM_EXAMPLES_SURFACE_PICTURES_H
#define HLSCM_EXAMPLES_SURFACE_PICTURES_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <string>
#include <vector>

namespace surface_pictures {

typedef CGAL::Indexed_mesh::Indexed_triangle_mesh Mesh;

// n x n squares, each cut in two, of a hilly field.
Mesh hills(unsigned int n);

// 2 n x n squares of a torus with bumps.
Mesh bumpy_torus(unsigned int n);

// The surface of the file that is the program's argument, or another one if there is no argument;
// says what is wrong with the file.
bool get_surface(int argc, char* argv[], Mesh other, Mesh& mesh);

// Draws a surface as seen obliquely from above, from blue, where the function is least, to red, with
// so many contours.
bool draw(const std::string& filename, const Mesh& mesh, const std::vector<double>& value,
          int contours);

} // namespace surface_pictures

#endif // HLSCM_EXAMPLES_SURFACE_PICTURES_H
