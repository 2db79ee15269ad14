// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_ATLAS_OUTPUTS_H
#define HLSCM_PROGRAM_ATLAS_OUTPUTS_H

#include "commands/Atlas_building.h"
#include "pictures/Atlas_pictures.h"
#include "commands/Atlas_report.h"
#include "writing/Folder_outputs.h"
#include "writing/Textured_model.h"

#include <optional>
#include <string>
#include <vector>

namespace hlscm {

/// A model in the formats that are wanted: NAME.obj with NAME.mtl, NAME.glb, and perhaps NAME.ply.
class Model_outputs
{
public:
  /// With UDIM the pages are tiles of one plane, and .obj has one material for all.
  Model_outputs(Folder_outputs& folder, std::string name, bool has_ply, bool is_udim);

  /// Writes it. `faces`, if there are some, are what NAME.obj has in the place of the triangles.
  void write(Textured_model model, const Read_mesh* faces = nullptr);

private:
  std::string m_name;
  bool m_is_udim;
  Output_file& m_obj;
  Output_file& m_mtl;
  Output_file& m_glb;
  Output_file* m_ply;
};

/// What `atlas` and `bake` write: the report and, unless the options name a light model with a
/// texture of its own, the atlas: the model with a checkerboard, and pictures.
class Atlas_outputs
{
public:
  explicit Atlas_outputs(const Program_options& options);

  Folder_outputs& folder() { return m_folder; }

  /// Writes the model with its checkerboard; atlas.obj has the faces of the input.
  void write(const Input_surface& input, const CGAL::Surface_mesh_texturing::Texture_atlas& atlas,
             Progress_bar& progress, std::vector<std::string>& warnings);

  /// Draws, if pictures are wanted.
  void draw(const CGAL::Surface_mesh_texturing::Texture_atlas& atlas, Progress_bar& progress);

  /// Writes the report, puts all files in place, and tells the user.
  void finish(Atlas_report& report, Progress_bar& progress);

private:
  const Program_options& m_options;
  Folder_outputs m_folder;
  Output_file& m_report;
  std::optional<Model_outputs> m_model;
  Output_file* m_checker = nullptr;
  std::optional<Atlas_picture_files> m_pictures;
};

/// Reads the input, and fills what the report says about it.
Input_surface read_input(const Program_options& options, Progress_bar& progress,
                         Atlas_report& report);

/// Builds its atlas, and fills what the report says about that.
CGAL::Surface_mesh_texturing::Texture_atlas make_atlas(const Input_surface& surface,
                                                       const Program_options& options,
                                                       Progress_bar& progress,
                                                       Atlas_report& report);

} // namespace hlscm

#endif // HLSCM_PROGRAM_ATLAS_OUTPUTS_H
