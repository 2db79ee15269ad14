// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_TEXTURED_MODEL_H
#define HLSCM_PROGRAM_TEXTURED_MODEL_H

#include <CGAL/Surface_mesh_texturing/IO/Textured_model.h>

namespace hlscm {

using CGAL::Surface_mesh_texturing::pages_of_triangles;
using CGAL::Surface_mesh_texturing::Texture_file;
using CGAL::Surface_mesh_texturing::Texture_material;
using CGAL::Surface_mesh_texturing::Textured_model;
using CGAL::Surface_mesh_texturing::Textured_triangle_mesh;
using CGAL::Surface_mesh_texturing::vertices_of_wedges;

} // namespace hlscm

#endif // HLSCM_PROGRAM_TEXTURED_MODEL_H
