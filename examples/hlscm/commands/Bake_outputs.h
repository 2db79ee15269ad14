// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_BAKE_OUTPUTS_H
#define HLSCM_PROGRAM_BAKE_OUTPUTS_H

#include "commands/Atlas_outputs.h"
#include "commands/Baking.h"

#include <string>
#include <vector>

namespace hlscm {

/// The light model and its textures: light.obj, light.mtl, light.glb, normal.png and what else the
/// options ask for. Pages beyond the first are numbered: normal.png, normal_2.png ...; or as tiles of
/// UDIM, normal.1001.png, normal.1002.png ...
class Bake_outputs
{
public:
  Bake_outputs(Folder_outputs& folder, const Program_options& options);

  /// Writes all, and returns the normal map as the file has it.
  CGAL::Surface_mesh_texturing::Texture_image
  write(const Baking_input& input, const Baked_images& images, Progress_bar& progress);

private:
  using Image = CGAL::Surface_mesh_texturing::Texture_image;

  Texture_file put(const std::string& name, std::size_t page, std::string png);
  Textured_model light_model(const Baking_input& input, const Baked_images& images) const;
  void put_normal_maps(const Image& normals, Textured_model& model);
  void put_colours(const Image& colours, Textured_model& model);
  void put_displacement(const Baked_images& images, std::size_t pages);

  Folder_outputs& m_folder;
  const Program_options& m_options;
  Model_outputs m_model;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_BAKE_OUTPUTS_H
