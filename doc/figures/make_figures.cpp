// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Figures.h"
#include "surfaces.h"
#include <CGAL/IO/polygon_soup_io.h>
#include <iostream>
int main(int argc, char** argv)
{
  using namespace figures;
  const std::filesystem::path out = argv[1];
  Chart chart;
  std::vector<std::vector<std::size_t>> polygons;
  if(argc > 2) {
    CGAL::IO::read_polygon_soup(argv[2], chart.mesh.points, polygons);
    for(auto& p : polygons) chart.mesh.triangles.push_back({unsigned(p[0]), unsigned(p[1]), unsigned(p[2])});
  } else chart.mesh = hills(160);
  std::cout << draw_bump_figure(out / "bump.png") << std::endl;
  std::cout << draw_monogrid_figure(chart, out / "monogrid.png") << std::endl;
  std::cout << draw_levels_figure(chart, out / "levels.png") << std::endl;
  std::cout << draw_checker_figure(chart, out / "checker.png") << std::endl;
}
