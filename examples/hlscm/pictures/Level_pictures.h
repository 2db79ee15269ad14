// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LEVEL_PICTURES_H
#define HLSCM_PROGRAM_LEVEL_PICTURES_H

#include "writing/Level_of_detail.h"
#include "writing/Output_files.h"
#include "common/Progress_bar.h"

#include <filesystem>
#include <vector>

namespace hlscm {

/// Starts the files of the pictures of levels in a folder, which is created if necessary.
class Level_picture_files
{
public:
  Level_picture_files(Output_files& files, const std::filesystem::path& folder);

  /// - levels.png: the fine surface and up to four levels with one checkerboard as their texture;
  /// - swimming.png: for each of them below it how its picture differs from that of the fine
  ///   surface: white where it is equal, black where a dark square has taken the place of a light
  ///   one.
  void draw(const Progressive_model& model, const std::vector<Level_of_detail>& levels,
            Progress_bar& progress);

private:
  Output_file& m_levels;
  Output_file& m_swimming;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_LEVEL_PICTURES_H
