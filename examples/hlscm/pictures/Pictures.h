// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PICTURES_H
#define HLSCM_PROGRAM_PICTURES_H

#include "pictures/Drawn_surface.h"
#include "writing/Output_files.h"
#include "common/Progress_bar.h"

#include <filesystem>

namespace hlscm {

/// Starts the files of the pictures in a folder, which is created if necessary: an error shows up
/// before the work begins.
class Picture_files
{
public:
  Picture_files(Output_files& files, const std::filesystem::path& folder);

  /// - domain.png: the parameter domain, its triangles coloured by quasi-conformal ratio (1 pale, 2
  /// and
  ///   more dark blue), flipped triangles red;
  /// - isolines.png: the surface with lines of equal u (red) and equal v (blue);
  /// - checker.png: the surface with a checkerboard in parameter space;
  /// - levels.png: isolines and domain of the given levels, side by side, coarse to fine.
  ///
  /// `levels` shall share one scale; the last one is the whole surface.
  void draw(const std::vector<Drawn_surface>& levels, Progress_bar& progress);

private:
  Output_file& m_domain;
  Output_file& m_isolines;
  Output_file& m_checker;
  Output_file& m_levels;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_PICTURES_H
