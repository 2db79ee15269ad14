// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_GLTF_ACCESSOR_H
#define HLSCM_PROGRAM_GLTF_ACCESSOR_H

#include "formats/Gltf_file.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hlscm {
namespace gltf {

/// How many elements an accessor has.
std::size_t count_of_accessor(const File& file, std::size_t accessor);

/// The numbers of an accessor of vectors ("VEC3" has three), one vector after the other. Normalised
/// integers are fractions; sparse elements are in their places.
std::vector<double> read_vectors(File& file, std::size_t accessor, std::size_t components);

/// The whole numbers of an accessor of scalars.
std::vector<std::uint32_t> read_indices(File& file, std::size_t accessor);

} // namespace gltf
} // namespace hlscm

#endif // HLSCM_PROGRAM_GLTF_ACCESSOR_H
