// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_VIEW_PAGE_H
#define HLSCM_PROGRAM_VIEW_PAGE_H

#include "writing/Level_of_detail.h"
#include "writing/Textured_model.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hlscm {

/// A picture on one page of the texture.
struct Viewed_picture
{
  std::string sheet; ///< "normals" or "colours": what the pictures of all pages show
  std::size_t page = 0;
  std::string png; ///< the bytes of the file
};

/// A mesh with normals and tangents, to be drawn with a normal map.
struct Framed_mesh
{
  Textured_triangle_mesh mesh;
  CGAL::Surface_mesh_texturing::Tangent_frames frames; ///< of `mesh`
};

/// What a page shows. Several pages of a texture lie side by side, as tiles of UDIM.
struct Viewed_model
{
  std::string name;
  std::optional<Progressive_model> original; ///< with texture; or else there is `light`
  std::optional<Framed_mesh> light;
  std::vector<Viewed_picture> pictures;
  bool is_object_space = false; ///< the normal map
  nlohmann::ordered_json report; ///< of the program, on the model; may be null
  std::vector<std::string> notes;
};

/// Returns a page made of `page`, which has `view_page_mark` once, and the model.
std::string fill_view_page(const std::string& page, const Viewed_model& model);

/// Where the model goes.
inline constexpr char view_page_mark[] = "<!-- hlscm: the model -->";

} // namespace hlscm

#endif // HLSCM_PROGRAM_VIEW_PAGE_H
