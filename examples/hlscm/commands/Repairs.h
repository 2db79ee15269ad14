// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_REPAIRS_H
#define HLSCM_PROGRAM_REPAIRS_H

#include <CGAL/Indexed_mesh/surface_of_soup.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace hlscm {

/// A finding: how often, and as many indices of the first case as say where it is.
nlohmann::ordered_json to_json(const CGAL::Indexed_mesh::Soup_finding& finding,
                               std::size_t elements);

/// What was done to a mesh before it was mapped: for each kind the number and the first elements.
nlohmann::ordered_json to_json(const CGAL::Indexed_mesh::Soup_repairs& repairs);

/// Says it, and the warnings, on stderr: a line for each.
void print_notes(const std::string& file, const CGAL::Indexed_mesh::Soup_repairs& repairs,
                 const std::vector<std::string>& warnings);

} // namespace hlscm

#endif // HLSCM_PROGRAM_REPAIRS_H
