// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_ATLAS_PICTURES_H
#define HLSCM_PROGRAM_ATLAS_PICTURES_H

#include "writing/Output_files.h"
#include "common/Progress_bar.h"

#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>

#include <filesystem>

namespace hlscm {

/// Starts the files of the pictures of an atlas in a folder, which is created if necessary.
class Atlas_picture_files
{
public:
  Atlas_picture_files(Output_files& files, const std::filesystem::path& folder);

  /// - charts.png: the surface, each chart in a colour of its own, beside the pages of the texture
  ///   (the first four) with the charts in the same colours;
  /// - checkerboard.png: the surface with a checkerboard as its texture, and the seams.
  void draw(const CGAL::Surface_mesh_texturing::Texture_atlas& atlas, Progress_bar& progress);

private:
  Output_file& m_charts;
  Output_file& m_checkerboard;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_ATLAS_PICTURES_H
