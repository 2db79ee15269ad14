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
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>
#include <CGAL/Surface_mesh_multiresolution/Selectively_refined_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/textured_progressive_mesh_of_chart.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
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

  // A row of something that is not a time.
  void add_value(const std::string& name, double value, const char* unit) const
  {
    std::cout << m_chart << ',' << m_faces << ',' << name << ",," << value << ',' << unit << ','
              << std::endl;
  }

private:
  std::string m_chart;
  std::size_t m_faces;
};

// What the price of texture deviation does to the levels with a tenth of the triangles.
void measure_deviation_term(const SMM::Textured_triangle_mesh& mesh, const Table& table)
{
  for(const double weight : {0., 1., 4.}) {
    SMM::Textured_progressive_mesh_options options;
    options.texture_deviation_weight = weight;
    SMM::Textured_progressive_mesh_result result;
    std::ostringstream name;
    name << "with texture deviation times " << weight;
    table.add("build " + name.str(), seconds_of([&] {
      result = SMM::build_textured_progressive_mesh(mesh, options);
    }), double(mesh.triangles.size()), "faces");
    const SMM::Level_extractor levels(result.mesh);
    const auto error = SMM::measure_texture_deviation(
      result.mesh, levels.position_of_triangles(mesh.triangles.size() / 10));
    table.add_value("deviation at 10 % " + name.str(), 1e6 * error.relative(error.deviation.mean),
                    "millionths of the diagonal on average");
    table.add_value("distance at 10 % " + name.str(), 1e6 * error.relative(error.distance.mean),
                    "millionths of the diagonal on average");
  }
}

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
  table.add("parameterize; build the progressive mesh", median_seconds_of(repetitions, [&] {
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
  measure_deviation_term(textured, table);
  const double seconds = median_seconds_of(repetitions, [&] {
    SMP::HLSCM_options options;
    options.keep_progressive_mesh = true;
    Parameterizer parameterizer(options);
    parameterize(parameterizer);
    result = SMP::build_textured_progressive_mesh(mesh, uv, parameterizer.progressive_mesh());
    SMM::encode_progressive_mesh(result.mesh);
  });
  table.add("parameterize; build and write the progressive mesh", seconds,
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
  std::vector<CGAL::Indexed_mesh::Triangle_indices> triangles;
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

// Binary PLY with floats, the vertices doubled at seams, and OBJ as the program writes it.
std::string as_ply(const SMM::Textured_progressive_mesh& pm)
{
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex "
                    + std::to_string(pm.number_of_wedges())
                    + "\nproperty float x\nproperty float y\nproperty float z\nproperty float s\n"
                      "property float t\nelement face "
                    + std::to_string(pm.progressive_mesh.triangles.size())
                    + "\nproperty list uchar int vertex_indices\nend_header\n";
  for(std::size_t w = 0; w < pm.number_of_wedges(); ++w) {
    const auto& p = pm.points[pm.vertex[w]];
    const float numbers[] = {float(p.x()), float(p.y()), float(p.z()), float(pm.uv[w].x()),
                             float(pm.uv[w].y())};
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
  }
  for(const auto& t : pm.progressive_mesh.triangles) {
    bytes.push_back(3);
    bytes.append(reinterpret_cast<const char*>(t.data()), 12);
  }
  return bytes;
}

std::string as_obj(const SMM::Textured_progressive_mesh& pm)
{
  std::ostringstream text;
  text.precision(9);
  for(const auto& p : pm.points)
    text << "v " << float(p.x()) << ' ' << float(p.y()) << ' ' << float(p.z()) << '\n';
  for(const auto& p : pm.uv)
    text << "vt " << float(p.x()) << ' ' << float(p.y()) << '\n';
  for(const auto& t : pm.progressive_mesh.triangles) {
    text << 'f';
    for(const auto w : t)
      text << ' ' << pm.vertex[w] + 1 << '/' << w + 1;
    text << '\n';
  }
  return text.str();
}

// The size of the same mesh in a Draco file of 16 bits, if there is an encoder.
void measure_draco(const std::string& obj, const Table& table)
{
  namespace fs = std::filesystem;
  const fs::path from = fs::temp_directory_path() / "hlscm_levels.obj",
                 to = fs::temp_directory_path() / "hlscm_levels.drc";
  std::ofstream(from, std::ios::binary) << obj;
  const std::string command = "draco_encoder -qp 16 -qt 16 -cl 7 -i '" + from.string() + "' -o '"
                            + to.string() + "' > /dev/null 2>&1";
  if(std::system(command.c_str()) == 0)
    table.add_value("Draco; 16 bits; one level only", double(fs::file_size(to)), "bytes");
  fs::remove(from);
  fs::remove(to);
}

void measure_files(const SMM::Textured_progressive_mesh& pm, const Table& table)
{
  const double splits = double(pm.number_of_collapses());
  for(const auto precision : {SMM::Progressive_mesh_precision::QUANTIZED,
                              SMM::Progressive_mesh_precision::LOSSLESS}) {
    SMM::Progressive_mesh_write_options options;
    options.precision = precision;
    const std::string kind
      = precision == SMM::Progressive_mesh_precision::LOSSLESS ? "lossless" : "16 bits";
    SMM::Progressive_mesh_bytes file;
    table.add("write a progressive mesh; " + kind, median_seconds_of(repetitions, [&] {
      file = SMM::encode_progressive_mesh(pm, options);
    }), splits, "splits");
    table.add("read a progressive mesh; " + kind, median_seconds_of(repetitions, [&] {
      const auto read = SMM::decode_progressive_mesh(file.bytes.data(), file.bytes.size());
      if(read.status != SMM::Progressive_mesh_file_status::COMPLETE)
        throw std::runtime_error(read.message);
    }), splits, "splits");
    table.add_value("progressive mesh; " + kind, double(file.bytes.size()), "bytes");
  }
  table.add_value("PLY; binary; floats; one level only", double(as_ply(pm).size()), "bytes");
  const std::string obj = as_obj(pm);
  table.add_value("OBJ; nine digits; one level only", double(obj.size()), "bytes");
  measure_draco(obj, table);
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
  const auto first = CGAL::Indexed_mesh::Vertex_index(pm.number_of_vertices_after(pm.number_of_collapses()));
  std::vector<double> up, down;
  for(int i = 0; i < repetitions; ++i) {
    up.push_back(seconds_of([&] {
      for(CGAL::Indexed_mesh::Vertex_index v = first; v < pm.points.size(); ++v)
        selective.refine(v);
    }));
    down.push_back(seconds_of([&] {
      for(auto v = CGAL::Indexed_mesh::Vertex_index(pm.points.size()); v-- > first;)
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
    const auto eye = pm.points[pm.points.size() - 1 - 10 * std::size_t(frame)];
    const auto needs = [&](CGAL::Indexed_mesh::Vertex_index v) {
      const double far = 1e-9 * size * size + squared_distance(eye, pm.points[v]);
      const double near = 0.01 * size * size / far;
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
  measure_files(pm, table);
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
