// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_UDIM_H
#define CGAL_SURFACE_MESH_TEXTURING_UDIM_H

#include <CGAL/Surface_mesh_texturing/IO/Textured_model.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTextureFiles
/// Returns the number of the UDIM tile of a page: 1001 for the first one. Ten tiles make a row, so
/// that of the square with the lower left corner (u, v) is 1001 + u + 10 v.
inline std::size_t udim_tile(std::size_t page) { return 1001 + page; }

/// \ingroup PkgHLSCMTextureFiles
/// Returns the lower left corner of the tile of a page.
inline Textured_triangle_mesh::Point_2 udim_corner(std::size_t page)
{
  return {double(page % 10), double(page / 10)};
}

/// \ingroup PkgHLSCMTextureFiles
/// Returns the name of the picture of a page: "color.1001.png" for the first one of "color".
inline std::string udim_file_name(const std::string& name, std::size_t page)
{
  return name + "." + std::to_string(udim_tile(page)) + ".png";
}

/// \ingroup PkgHLSCMTextureFiles
/// Returns the name that stands for all of them: "color.<UDIM>.png".
inline std::string udim_file_name(const std::string& name) { return name + ".<UDIM>.png"; }

/*!
\ingroup PkgHLSCMTextureFiles

Returns `mesh` with its texture coordinates moved from \f$ [0, 1]^2 \f$ of their pages to the tiles of
these, so that all pages lie side by side in one plane. Linear time.

\param mesh a mesh whose triangles on different pages have no texture coordinate in common
\param page for each triangle its page

\return the mesh as it is if it has a `texture_error()`, or `page` has another length
*/
inline Textured_triangle_mesh with_udim_coordinates(Textured_triangle_mesh mesh,
                                                    const std::vector<std::uint32_t>& page)
{
  if(page.size() != mesh.wedges.size() || !texture_error(mesh).empty())
    return mesh;
  std::vector<std::uint8_t> is_done(mesh.uv.size(), 0);
  for(std::size_t t = 0; t < page.size(); ++t)
    for(const Vertex_index w : mesh.wedges[t])
      if(is_done[w] == 0) {
        const auto corner = udim_corner(page[t]);
        mesh.uv[w] = {mesh.uv[w].x() + corner.x(), mesh.uv[w].y() + corner.y()};
        is_done[w] = 1;
      }
  return mesh;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_UDIM_H
