// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_source.h"

namespace hlscm {

namespace {

template <typename Value>
void check(const std::string& kind, std::size_t corners, std::vector<Value>& values,
           std::vector<std::uint32_t>& of_corners, std::vector<std::string>& warnings)
{
  const bool is_bad = std::any_of(of_corners.begin(), of_corners.end(),
                                  [&](std::uint32_t i) { return i >= values.size(); });
  if(!is_bad && !of_corners.empty() && of_corners.size() == corners) {
    return;
  }
  if(is_bad) {
    warnings.push_back("a face names a " + kind + " that is not among the "
                       + std::to_string(values.size()) + "; all are left out");
  } else if(!of_corners.empty()) {
    warnings.push_back("not all corners have " + kind + "s; all are left out");
  }
  values.clear();
  of_corners.clear();
}

} // namespace

void check_corner_data(Read_mesh& mesh)
{
  Polygon_soup& soup = mesh.soup;
  const std::size_t corners = soup.corners.size();
  check("texture coordinate", corners, soup.uv, soup.uv_corners, mesh.warnings);
  check("normal", corners, mesh.normals, mesh.normal_corners, mesh.warnings);
}

} // namespace hlscm
