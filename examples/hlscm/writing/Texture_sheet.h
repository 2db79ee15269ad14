// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_TEXTURE_SHEET_H
#define HLSCM_PROGRAM_TEXTURE_SHEET_H

#include "writing/Textured_model.h"

#include <CGAL/Surface_mesh_texturing/Texture_image.h>

#include <algorithm>
#include <vector>

namespace hlscm {

// A sheet is a texture with all pages of an atlas side by side in the unit square: what knows of
// one texture only works on it. With one page it is that page, to the bit.

/// Moves the texture coordinates of a mesh from its pages to the sheet.
inline Textured_triangle_mesh to_sheet(Textured_triangle_mesh mesh,
                                       const std::vector<std::uint32_t>& page, std::size_t pages)
{
  std::vector<std::uint32_t> page_of_wedge(mesh.uv.size(), 0);
  for(std::size_t t = 0; t < mesh.wedges.size(); ++t) {
    for(const std::uint32_t w : mesh.wedges[t]) {
      page_of_wedge[w] = page[t];
    }
  }
  for(std::size_t w = 0; pages > 1 && w < mesh.uv.size(); ++w) {
    mesh.uv[w] = {(mesh.uv[w].x() + page_of_wedge[w]) / double(pages), mesh.uv[w].y()};
  }
  return mesh;
}

/// Returns the page of each triangle.
inline std::vector<std::uint32_t> pages_on_sheet(const Textured_triangle_mesh& mesh,
                                                 std::size_t pages)
{
  std::vector<std::uint32_t> page;
  for(const auto& t : mesh.wedges) {
    const double u = (mesh.uv[t[0]].x() + mesh.uv[t[1]].x() + mesh.uv[t[2]].x()) / 3;
    page.push_back(std::uint32_t(std::clamp(u * double(pages), 0., double(pages - 1))));
  }
  return page;
}

/// Moves the texture coordinates of a mesh back from the sheet.
inline Textured_triangle_mesh from_sheet(Textured_triangle_mesh mesh,
                                         const std::vector<std::uint32_t>& page, std::size_t pages)
{
  std::vector<char> is_done(mesh.uv.size(), 0);
  for(std::size_t t = 0; pages > 1 && t < mesh.wedges.size(); ++t) {
    for(const std::uint32_t w : mesh.wedges[t]) {
      if(!is_done[w]) {
        const double u = mesh.uv[w].x() * double(pages) - double(page[t]);
        mesh.uv[w] = {std::clamp(u, 0., 1.), mesh.uv[w].y()};
        is_done[w] = 1;
      }
    }
  }
  return mesh;
}

/// Cuts a page out of the image of a sheet.
inline CGAL::Surface_mesh_texturing::Texture_image
page_of_sheet(const CGAL::Surface_mesh_texturing::Texture_image& sheet, std::size_t page,
              std::size_t pages)
{
  CGAL::Surface_mesh_texturing::Texture_image image;
  image.width = sheet.width / pages;
  image.height = sheet.height;
  image.channels = sheet.channels;
  for(std::size_t y = 0; y < image.height; ++y) {
    const float* row = sheet.texel(page * image.width, y);
    image.texels.insert(image.texels.end(), row, row + image.width * image.channels);
  }
  return image;
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_TEXTURE_SHEET_H
