// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TEST_SUPPORT_PRECOMPILED_H
#define CGAL_TEST_SUPPORT_PRECOMPILED_H

// What most groups of tests instantiate, compiled once.

#include <support/chart_generators.h>
#include <support/conformal_maps.h>
#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>

#include <gtest/gtest.h>

#endif // CGAL_TEST_SUPPORT_PRECOMPILED_H
