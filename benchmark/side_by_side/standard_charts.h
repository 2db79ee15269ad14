// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_STANDARD_CHARTS_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_STANDARD_CHARTS_H

#include "../charts/Recipe.h"
#include "tables.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace side_by_side {

// A chart of a name that a recipe makes.
struct Standard_chart
{
  std::string name;
  charts::Recipe recipe;
};

// Charts from 20K to 6M faces of two of the meshes of Debian's libcgal-demo, each four times as
// large as the one before, scan-like noise on those that were subdivided.
inline std::vector<Standard_chart> growing_charts(const std::string& data_dir,
                                                  std::size_t max_faces)
{
  std::vector<Standard_chart> result;
  const auto add = [&](const char* name, const char* mesh, std::size_t faces, bool cut) {
    for(int loop = 0; loop <= 4 && faces <= max_faces; ++loop, faces *= 4) {
      const std::string thousands = std::to_string((faces + 500) / 1000);
      charts::Recipe recipe;
      recipe.input = data_dir + '/' + mesh + ".off";
      recipe.cut = cut;
      recipe.loop = loop;
      recipe.noise = loop > 0 ? 0.1 : 0;
      result.push_back({std::string(name) + '_' + thousands + 'k', recipe});
    }
  };
  add("devil", "mannequin-devil", 25888, false);
  add("camel", "camel", 19536, true);
  return result;
}

// Charts of as many faces as those of the paper's table 1: a head, an animal on four legs, and a
// figure with noise like a scanner's.
inline std::vector<Standard_chart> table_1_charts(const std::string& data_dir,
                                                  std::size_t max_faces)
{
  charts::Recipe head, animal, scan;
  head.input = data_dir + "/mannequin-devil.off";
  head.loop = 1;
  animal.input = data_dir + "/camel.off";
  animal.cut = true;
  animal.loop = 1;
  scan.input = data_dir + "/bunny00.off";
  scan.cut = true;
  scan.loop = 2;
  scan.noise = 0.1;
  std::vector<Standard_chart> result = {
      {"devil_37k", head}, {"camel_72k", animal}, {"bunny_1120k", scan}};
  for(std::size_t i = 0; i < result.size(); ++i)
    result[i].recipe.faces = paper_table_1()[i].faces;
  while(!result.empty() && result.back().recipe.faces > max_faces)
    result.pop_back();
  return result;
}

// The file of the chart in a folder, made if it is not there.
inline std::string chart_file(const Standard_chart& chart, const std::filesystem::path& folder)
{
  const std::filesystem::path path = folder / (chart.name + ".ply");
  if(std::filesystem::exists(path))
    return path.string();
  std::filesystem::create_directories(folder);
  const std::filesystem::path unfinished = folder / (chart.name + ".unfinished");
  charts::write_ply(charts::make_chart(chart.recipe), unfinished.string());
  std::filesystem::rename(unfinished, path);
  return path.string();
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_STANDARD_CHARTS_H
