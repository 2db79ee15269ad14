// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_RAY_CASTER_H
#define HLSCM_PROGRAM_RAY_CASTER_H

#ifdef HLSCM_WITHOUT_EMBREE
#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#else
#include <CGAL/Surface_mesh_texturing/Embree_ray_caster.h>
#endif

namespace hlscm {

/// What casts rays here: Embree where it is installed.
#ifdef HLSCM_WITHOUT_EMBREE
using Ray_caster = CGAL::Surface_mesh_texturing::AABB_tree_ray_caster;
#else
using Ray_caster = CGAL::Surface_mesh_texturing::Embree_ray_caster;
#endif

} // namespace hlscm

#endif // HLSCM_PROGRAM_RAY_CASTER_H
