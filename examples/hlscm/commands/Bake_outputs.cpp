// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Bake_outputs.h"

#include "writing/Png_file.h"
#include "writing/Texture_sheet.h"

#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/udim.h>

#include <utility>

namespace hlscm {

namespace SMT = CGAL::Surface_mesh_texturing;

namespace {

// NAME.png, NAME_2.png ...; or NAME.1001.png, NAME.1002.png ...
std::string page_name(const std::string& name, std::size_t page, bool is_udim)
{
  return is_udim ? SMT::udim_file_name(name, page)
                 : name + (page == 0 ? "" : "_" + std::to_string(page + 1)) + ".png";
}

template <typename Integer>
std::string png_of(const SMT::Texture_image& image, double lowest, double highest)
{
  return encode_png(SMT::encode_values<Integer>(image, lowest, highest), image.width,
                    image.channels);
}

} // namespace

Bake_outputs::Bake_outputs(Folder_outputs& folder, const Program_options& options)
  : m_folder(folder), m_options(options),
    m_model(folder, "light", options.atlas.writes_ply, options.atlas.layout.is_udim)
{}

SMT::Texture_image Bake_outputs::write(const Baking_input& input, const Baked_images& images,
                                       Progress_bar& progress)
{
  progress.start_stage("writing");
  Textured_model model = light_model(input, images);
  put_normal_maps(images.normals, model);
  put_displacement(images, input.pages);
  if(images.colours) {
    put_colours(*images.colours, model);
  }
  m_model.write(std::move(model));
  return m_options.bake.bits == 16
             ? SMT::decode_values(SMT::encode_unit_vectors<std::uint16_t>(images.normals),
                                  images.normals, -1, 1)
             : SMT::decode_values(SMT::encode_unit_vectors<std::uint8_t>(images.normals),
                                  images.normals, -1, 1);
}

Texture_file Bake_outputs::put(const std::string& name, std::size_t page, std::string png)
{
  const bool is_udim = m_options.atlas.layout.is_udim;
  const std::string file = page_name(name, page, is_udim);
  m_folder.create(file).put(png);
  return {is_udim ? SMT::udim_file_name(name) : file, std::move(png)};
}

Textured_model Bake_outputs::light_model(const Baking_input& input,
                                         const Baked_images& images) const
{
  Textured_model model;
  model.page = pages_on_sheet(input.light, input.pages);
  model.mesh = from_sheet(input.light, model.page, input.pages);
  model.frames = images.frames;
  model.materials.resize(input.pages);
  return model;
}

// GLB files get 8 bits, which is all that their viewers keep.
void Bake_outputs::put_normal_maps(const Image& normals, Textured_model& model)
{
  const std::size_t pages = model.materials.size();
  for(std::size_t page = 0; page < pages; ++page) {
    const Image image = page_of_sheet(normals, page, pages);
    const std::string png = png_of<std::uint8_t>(image, -1, 1);
    const Texture_file file = put(
        "normal", page, m_options.bake.bits == 16 ? png_of<std::uint16_t>(image, -1, 1) : png);
    if(!m_options.bake.is_object_space) {
      model.materials[page].normal_map = model.textures.size();
      model.textures.push_back({file.name, png});
    }
  }
}

void Bake_outputs::put_colours(const Image& colours, Textured_model& model)
{
  const std::size_t pages = model.materials.size();
  for(std::size_t page = 0; page < pages; ++page) {
    const Image image = page_of_sheet(colours, page, pages);
    model.materials[page].color = model.textures.size();
    model.textures.push_back(put("color", page, png_of<std::uint8_t>(image, 0, 1)));
  }
}

void Bake_outputs::put_displacement(const Baked_images& images, std::size_t pages)
{
  for(std::size_t page = 0; images.displacement && page < pages; ++page) {
    const Image image = page_of_sheet(*images.displacement, page, pages);
    put("displacement", page,
        png_of<std::uint16_t>(image, images.lowest, images.highest));
  }
}

} // namespace hlscm
