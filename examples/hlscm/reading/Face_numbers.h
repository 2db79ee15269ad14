// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_FACE_NUMBERS_H
#define HLSCM_PROGRAM_FACE_NUMBERS_H

#include "reading/Surface_reading.h"

#include <CGAL/Simple_cartesian.h>

#include <string>
#include <vector>

namespace hlscm {

/// Reads a text file with a number of 0 or more for each face of the input, white space between, and
/// returns the number of each triangle; throws `Program_error`.
std::vector<double> read_face_numbers(const std::string& name, const Input_surface& surface,
                                      const std::string& input);

/// Reads a text file with two numbers for each point, white space between; throws `Program_error`.
std::vector<CGAL::Simple_cartesian<double>::Point_2> read_points(const std::string& name);

/// What parts a mesh into parts that have names.
enum class Name_of_part { GROUP, MATERIAL };

/// The groups or the materials of a mesh.
struct Named_parts
{
  std::vector<std::uint32_t> of_triangles; ///< the part of each triangle
  std::vector<std::string> names;          ///< of the parts
};

/// Returns the groups (with their objects) or the materials, in their order, equal names being one; none
/// if the file has no such names.
Named_parts parts_of_surface(const Input_surface& surface, Name_of_part name);

} // namespace hlscm

#endif // HLSCM_PROGRAM_FACE_NUMBERS_H
