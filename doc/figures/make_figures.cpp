// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Draws the figures of the manual and writes their captions with the measured energies.
//
// Usage: hlscm_figures FOLDER [MESH]
//
// MESH: a surface with a border, or a closed one of genus 0, which is cut open. By default
// bunny00.off, and lion-head.off for maps adapted to a signal, of Debian's libcgal-demo in the folder
// HLSCM_DATA_DIR; hills if they are not there.

#include "Figures.h"
#include "surfaces.h"

#include <charts/chart_io.h>
#include <charts/cut_to_disk.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace {

figures::Chart read_chart(const std::filesystem::path& file)
{
  charts::Chart chart = charts::read_chart(file.string());
  figures::Chart result{file.filename().string(), {}};
  if(charts::measure_topology(chart, charts::opposite_halfedges(chart)).is_sphere()) {
    charts::cut_to_disk(chart);
    result.name += ", cut open along a tree of edges";
  }
  for(const charts::Point& p : chart.points)
    result.mesh.points.emplace_back(p[0], p[1], p[2]);
  result.mesh.triangles = chart.triangles;
  return result;
}

figures::Chart choose_chart(int argc, char** argv, const char* name)
{
  if(argc > 2)
    return read_chart(argv[2]);
  if(const char* folder = std::getenv("HLSCM_DATA_DIR"); folder != nullptr) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if(std::filesystem::exists(file))
      return read_chart(file);
  }
  return {"generated hills", figures::hills(160)};
}

// A caption in its own marks, by which the manual includes it.
void write_caption(std::ostream& out, const std::string& name, const std::string& text)
{
  out << "\n<!-- [" << name << "] -->\n" << text << "\n<!-- [" << name << "] -->\n";
  std::cout << name << ".png: " << text << "\n\n";
}

void make_figures(const std::filesystem::path& folder, const figures::Chart& chart,
                  const figures::Chart& uneven)
{
  std::filesystem::create_directories(folder);
  std::ofstream captions(folder / "captions.md");
  captions << "<!-- Written by hlscm_figures, together with the pictures. -->\n";
  write_caption(captions, "bump", figures::draw_bump_figure(folder / "bump.png"));
  write_caption(captions, "monogrid",
                figures::draw_monogrid_figure(chart, folder / "monogrid.png"));
  write_caption(captions, "levels", figures::draw_levels_figure(chart, folder / "levels.png"));
  write_caption(captions, "checker", figures::draw_checker_figure(chart, folder / "checker.png"));
  write_caption(captions, "signal", figures::draw_signal_figure(uneven, folder / "signal.png"));
  captions.close();
  if(!captions)
    throw std::runtime_error("cannot write " + (folder / "captions.md").string());
}

} // namespace

int main(int argc, char** argv)
{
  if(argc != 2 && argc != 3) {
    std::cerr << "usage: hlscm_figures FOLDER [MESH]\n";
    return 2;
  }
  try {
    make_figures(argv[1], choose_chart(argc, argv, "bunny00.off"),
                 choose_chart(argc, argv, "lion-head.off"));
  } catch(const std::exception& error) {
    std::cerr << "hlscm_figures: " << error.what() << '\n';
    return 1;
  }
}
