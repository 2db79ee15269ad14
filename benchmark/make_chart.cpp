// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Makes a large chart of a small mesh: make_chart IN -o OUT.ply --loop 2 --noise 0.1 --seed 1 --cut

#include "charts/Recipe.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>

int main(int argc, char** argv)
{
  charts::Recipe recipe;
  std::string output;
  CLI::App app{"Makes a benchmark chart (binary PLY, double coordinates) of a mesh."};
  app.add_option("input", recipe.input, "mesh (OFF, PLY, OBJ, STL), or grid:COLUMNSxROWS")
      ->required();
  app.add_option("-o,--output", output, "the chart, PLY")->required();
  app.add_flag("--cut", recipe.cut, "cut a closed mesh along a tree through its extremities");
  app.add_option("--extremities", recipe.extremities, "number of vertices the cut joins")
      ->check(CLI::Range(2, 1000));
  app.add_option("--loop", recipe.loop, "steps of Loop's subdivision")->check(CLI::Range(0, 8));
  app.add_option("--stretch", recipe.stretch,
                 "refine like scan lines, denser along z by this factor")
      ->check(CLI::Range(1., 100.));
  app.add_option("--faces", recipe.faces, "with --stretch: refine to at least; else decimate to");
  app.add_option("--jagged", recipe.jagged, "rounds of gnawing at the border")
      ->check(CLI::Range(0, 1000));
  app.add_option("--noise", recipe.noise, "standard deviation along the normal, in edge lengths")
      ->check(CLI::Range(0., 10.));
  app.add_flag("--shuffle", recipe.shuffle, "random order of vertices and triangles");
  app.add_option("--seed", recipe.seed, "of the noise, the border and the order");
  CLI11_PARSE(app, argc, argv);
  try {
    const charts::Chart chart = charts::make_chart(recipe);
    charts::write_ply(chart, output);
    std::cout << output << ": " << chart.points.size() << " vertices, " << chart.triangles.size()
              << " faces\n";
  } catch(const std::exception& error) {
    std::cerr << "make_chart: " << error.what() << '\n';
    return 1;
  }
}
