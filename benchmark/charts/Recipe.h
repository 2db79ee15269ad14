// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_RECIPE_H
#define HLSCM_BENCHMARK_CHARTS_RECIPE_H

#include "Loop_subdivision.h"
#include "chart_io.h"
#include "cut_to_disk.h"
#include "decimate.h"
#include "scan_noise.h"
#include "terrain.h"
#include "variants.h"

#include <sstream>
#include <string>

namespace charts {

// How a benchmark chart is made of a mesh; the steps in this order.
struct Recipe
{
  std::string input;           // mesh file, or grid:COLUMNSxROWS for a terrain
  bool cut = false;            // cut a closed mesh open to a disk
  std::size_t extremities = 6; // number of vertices the cut joins
  int loop = 0;                // steps of Loop's subdivision
  double stretch = 0;          // > 0: refine like scan lines, this much denser along z ...
  std::size_t faces = 0;       // ... to this number of faces; else decimate to it (0: neither)
  int jagged = 0;              // rounds of gnawing at the border
  double noise = 0;            // standard deviation along the normal, in local edge lengths
  bool shuffle = false;        // random order of vertices and triangles
  std::uint64_t seed = 1;
};

namespace internal {

inline Chart read_base(const std::string& input)
{
  Index columns = 0, rows = 0;
  if(std::sscanf(input.c_str(), "grid:%ux%u", &columns, &rows) == 2 && columns > 0 && rows > 0)
    return make_terrain(columns, rows);
  return read_chart(input);
}

} // namespace internal

// Throws std::runtime_error if the input cannot be read or the result is not one piece with a
// border.
inline Chart make_chart(const Recipe& recipe)
{
  Chart chart = internal::read_base(recipe.input);
  if(recipe.cut)
    cut_to_disk(chart, recipe.extremities);
  for(int i = 0; i < recipe.loop; ++i)
    chart = Loop_subdivision(chart);
  if(recipe.stretch > 0)
    refine_like_scan_lines(chart, recipe.stretch, recipe.faces);
  else if(recipe.faces > 0 && recipe.faces < chart.triangles.size())
    chart = decimated(chart, recipe.faces);
  make_border_jagged(chart, recipe.jagged, recipe.seed);
  if(recipe.noise > 0)
    add_scan_noise(chart, recipe.noise, recipe.seed);
  if(recipe.shuffle)
    shuffle_order(chart, recipe.seed);

  const Topology topology = measure_topology(chart, opposite_halfedges(chart));
  if(topology.components == 1 && topology.borders >= 1)
    return chart;
  std::ostringstream message;
  message << recipe.input << ": not one piece with a border: " << topology.components
          << " components, " << topology.borders << " borders";
  throw std::runtime_error(message.str());
}

} // namespace charts
#endif
