// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_BAKE_PICTURES_H
#define HLSCM_PROGRAM_BAKE_PICTURES_H

#include "commands/Baking.h"
#include "writing/Output_files.h"
#include "common/Progress_bar.h"

#include <filesystem>

namespace hlscm {

/// Starts the files of the pictures of a light model in a folder, which is created if necessary.
class Bake_picture_files
{
public:
  Bake_picture_files(Output_files& files, const std::filesystem::path& folder);

  /// - bake.png: the original; the light model with its flat faces; the light model with its normal
  ///   map, and its colours if it has some;
  /// - closeup.png: the same where the normal map does most, and how the third picture differs from
  ///   the first: white where they are equal.
  void draw(const Baking_input& input, const Baked_images& images,
            const CGAL::Surface_mesh_texturing::Texture_image& normals, bool is_object_space,
            Progress_bar& progress);

private:
  Output_file& m_bake;
  Output_file& m_closeup;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_BAKE_PICTURES_H
