// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_SHARE_FOLDER_H
#define HLSCM_PROGRAM_SHARE_FOLDER_H

#include <filesystem>

namespace hlscm {

/// Where the pages are that the program fills: share/hlscm beside the folder of the program, in its
/// build or where it was installed. Linux knows where the program is; elsewhere there is none.
inline std::filesystem::path share_folder()
{
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if(program.empty()) {
    return {};
  }
  return program.parent_path().parent_path() / "share" / "hlscm";
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_SHARE_FOLDER_H
