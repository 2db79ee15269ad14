// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_FOLDER_OUTPUTS_H
#define HLSCM_PROGRAM_FOLDER_OUTPUTS_H

#include "writing/Output_files.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hlscm {

/// The files of a command that fills a folder.
class Folder_outputs
{
public:
  /// Creates the folder if there is none; `inputs` are never overwritten, empty names are none.
  Folder_outputs(std::string folder, std::vector<std::string> inputs)
    : m_folder(std::move(folder)), m_inputs(std::move(inputs))
  {
    m_files.create_folder(m_folder);
  }

  /// Starts a file in the folder, whose size will be listed.
  Output_file& create(const std::string& name)
  {
    Output_file& file = create_anywhere(m_folder / name);
    m_named.emplace_back((m_folder / name).string(), &file);
    return file;
  }

  /// Starts a file that is not listed.
  Output_file& create_anywhere(const std::filesystem::path& path)
  {
    for(const std::string& input : m_inputs) {
      refuse_to_overwrite(input, path);
    }
    return m_files.create(path);
  }

  /// The names of the files so far, and their sizes in bytes.
  std::vector<std::pair<std::string, std::size_t>> sizes() const
  {
    std::vector<std::pair<std::string, std::size_t>> result;
    for(const auto& [name, file] : m_named) {
      result.emplace_back(name, file->size());
    }
    return result;
  }

  Output_files& files() { return m_files; }

private:
  std::filesystem::path m_folder;
  std::vector<std::string> m_inputs;
  Output_files m_files;
  std::vector<std::pair<std::string, Output_file*>> m_named;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_FOLDER_OUTPUTS_H
