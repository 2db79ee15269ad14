// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_IMAGE_READING_H
#define HLSCM_PROGRAM_IMAGE_READING_H

#include <CGAL/Surface_mesh_texturing/Texture_image.h>

#include <string>

namespace hlscm {

/// Reads the colours of a picture, .png, .jpg, .bmp or .tga, as three channels from 0 to 1 as on a
/// screen (sRGB); throws `Program_error`.
CGAL::Surface_mesh_texturing::Texture_image read_image(const std::string& file_name);

} // namespace hlscm

#endif // HLSCM_PROGRAM_IMAGE_READING_H
