// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What levels of detail under one texture cost, beside the parameterization that makes the texture:
// a CSV file on stdout.
//
// Usage: levels CHART...

#include "charts/chart_io.h"
#include "machine.h"
#include "timing.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_cursor.h>
#include <CGAL/Surface_mesh_multiresolution/Selectively_refined_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/build_textured_progressive_mesh.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMP = CGAL::Surface_mesh_parameterization;
typedef charts::Surface_mesh Mesh;
typedef SMP::HLSCM_parameterizer_3<Mesh> Parameterizer;
typedef Mesh::Property_map<Mesh::Vertex_index, Parameterizer::Point_2> Uv_map;
using timing::median_seconds_of;
using timing::seconds_of;

constexpr int repetitions = 5;

class Table
{
public:
  Table(std::string chart, std::size_t faces) : m_chart(std::move(chart)), m_faces(faces) {}

  // A row of a step that dealt with a number of things.
  void add(const std::string& step, double seconds, double number, const char* things) const
  {
    std::cout << m_chart << ',' << m_faces << ',' << step << ',' << seconds << ',' << number << ','
              << things << ',' << number / seconds << std::endl;
  }

private:
  std::string m_chart;
  std::size_t m_faces;
};

// The map, without and with the levels of detail.
SMM::Textured_progressive_mesh build(const Mesh& mesh, Uv_map uv, const Table& table)
{
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  const auto parameterize = [&](Parameterizer& parameterizer) {
    if(parameterizer.parameterize(mesh, border, uv) != SMP::OK)
      throw std::runtime_error(parameterizer.report().message);
  };
  table.add("parameterize", median_seconds_of(repetitions, [&] {
    Parameterizer parameterizer;
    parameterize(parameterizer);
  }), double(num_faces(mesh)), "faces");
  SMM::Textured_progressive_mesh_result result;
  table.add("parameterize and build the progressive mesh", median_seconds_of(repetitions, [&] {
    SMP::HLSCM_options options;
    options.keep_progressive_mesh = true;
    Parameterizer parameterizer(options);
    parameterize(parameterizer);
    result = SMP::build_textured_progressive_mesh(mesh, uv, parameterizer.progressive_mesh());
  }), double(num_faces(mesh)), "faces");
  const auto corner_uv = [&](const auto h) { return get(uv, target(h, mesh)); };
  const SMM::Textured_triangle_mesh textured = SMM::textured_triangle_mesh(mesh, corner_uv);
  SMM::Textured_progressive_mesh_result anew;
  table.add("build it without the collapses of the parameterization",
            seconds_of([&] { anew = SMM::build_textured_progressive_mesh(textured); }),
            double(num_faces(mesh)), "faces");
  for(const std::string& error : {result.error, anew.error})
    if(!error.empty())
      throw std::runtime_error(error);
  return std::move(result.mesh);
}

void measure_levels(const SMM::Textured_progressive_mesh& pm, const Table& table)
{
  SMM::Level_extractor levels(pm);
  const std::size_t fine = pm.progressive_mesh.triangles.size();
  table.add("prepare extraction", median_seconds_of(repetitions, [&] {
    const SMM::Level_extractor other(pm);
  }), double(fine), "triangles");
  std::vector<SMM::Triangle_indices> triangles;
  for(const int percent : {100, 70, 50, 25, 10, 4, 1}) {
    const std::size_t k = levels.position_of_triangles(fine * std::size_t(percent) / 100);
    levels.extract(k, triangles);
    const int rounds = 1 + int(1000000 / triangles.size()); // long enough for the clock
    const double seconds = median_seconds_of(repetitions, [&] {
      for(int i = 0; i < rounds; ++i)
        levels.extract(k, triangles);
    });
    table.add("extract " + std::to_string(percent) + " %", seconds,
              double(triangles.size()) * rounds, "triangles");
  }
}

void measure_walks(const SMM::Textured_progressive_mesh& pm, const Table& table)
{
  SMM::Progressive_mesh_cursor cursor(pm.progressive_mesh);
  const double n = double(pm.number_of_collapses());
  std::vector<double> down, up;
  for(int i = 0; i < repetitions; ++i) {
    down.push_back(seconds_of([&] { cursor.move_to(pm.number_of_collapses()); }));
    up.push_back(seconds_of([&] { cursor.move_to(0); }));
  }
  table.add("coarsen step by step", timing::median(down), n, "collapses");
  table.add("refine step by step", timing::median(up), n, "splits");
}

void measure_selection(const SMM::Textured_progressive_mesh& pm, const Table& table)
{
  SMM::Selectively_refined_mesh selective(pm);
  const SMM::Level_extractor levels(pm);
  const auto n = double(pm.points.size());
  const auto first = SMM::Vertex_index(pm.number_of_vertices_after(pm.number_of_collapses()));
  std::vector<double> up, down;
  for(int i = 0; i < repetitions; ++i) {
    up.push_back(seconds_of([&] {
      for(SMM::Vertex_index v = first; v < pm.points.size(); ++v)
        selective.refine(v);
    }));
    down.push_back(seconds_of([&] {
      for(auto v = SMM::Vertex_index(pm.points.size()); v-- > first;)
        selective.coarsen(v);
    }));
  }
  table.add("refine vertex by vertex", timing::median(up), n, "vertices");
  table.add("coarsen vertex by vertex", timing::median(down), n, "vertices");

  // A viewer that comes near and goes on: all vertices within a tenth of the size, fewer beyond
  CGAL::Bbox_3 box;
  for(const auto& p : pm.points)
    box += p.bbox();
  const double size = std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(),
                                box.zmax() - box.zmin()});
  std::vector<double> frames;
  std::size_t triangles = 0;
  for(int frame = 0; frame < 60; ++frame) {
    const SMM::Textured_progressive_mesh::Point_3 eye = pm.points[pm.points.size() - 1 - 10 * frame];
    const auto needs = [&](SMM::Vertex_index v) {
      const double near = 0.01 * size * size / (1e-9 * size * size + squared_distance(eye, pm.points[v]));
      return double(v) < n * std::min(1., 0.2 * near * near);
    };
    const double seconds = seconds_of([&] { selective.adapt(needs); });
    if(frame > 0) // the first one refines from the coarsest level
      frames.push_back(seconds);
    triangles = selective.number_of_triangles();
  }
  table.add("adapt to a new viewpoint (" + std::to_string(triangles) + " triangles)",
            timing::median(frames), n, "vertices");
}

void print_rows(const std::string& path)
{
  Mesh mesh = charts::make_surface_mesh(charts::read_chart(path));
  const Uv_map uv
    = mesh.add_property_map<Mesh::Vertex_index, Parameterizer::Point_2>("v:uv").first;
  const Table table(std::filesystem::path(path).stem().string(), num_faces(mesh));
  const SMM::Textured_progressive_mesh pm = build(mesh, uv, table);
  measure_levels(pm, table);
  measure_walks(pm, table);
  measure_selection(pm, table);
}

} // namespace

int main(int argc, char** argv)
{
  try {
    std::cout << "# " << machine::description()
              << "\nchart,faces,step,seconds,number,of,per_second\n";
    for(int i = 1; i < argc; ++i)
      print_rows(argv[i]);
  } catch(const std::exception& e) {
    std::cerr << "levels: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
