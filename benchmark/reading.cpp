// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Reads a terrain of a million triangles from files of all formats, with the readers of the program
// hlscm, and with those of CGAL and of Assimp that know the format: processor seconds, medians of runs
// in turn, as a CSV file on stdout.
//
// Usage: reading [REPETITIONS]

#include "charts/terrain.h"
#include "machine.h"
#include "timing.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_texturing/IO/GLB.h>

#include <common/Progress_bar.h>
#include <reading/Mesh_reading.h>

#ifdef HLSCM_WITH_ASSIMP
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#endif

#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
typedef CGAL::Simple_cartesian<double>::Point_3 Point;
typedef std::vector<Point> Points;
typedef std::vector<std::vector<std::size_t>> Faces;

// Each returns the number of faces read.
struct Reader
{
  std::string name;
  std::function<std::size_t(const std::string&)> read;
  std::vector<std::string> formats;
};

const std::vector<std::string> all_formats = {"ply", "glb", "obj", "off", "stl"};

std::vector<Reader> readers()
{
  std::vector<Reader> result;
  result.push_back({"hlscm",
                    [](const std::string& name) {
                      hlscm::Progress_bar progress(false);
                      return hlscm::read_mesh(name, progress).soup.number_of_faces();
                    },
                    all_formats});
  result.push_back({"cgal",
                    [](const std::string& name) {
                      Points points;
                      Faces faces;
                      CGAL::IO::read_polygon_soup(name, points, faces);
                      return faces.size();
                    },
                    {"ply", "obj", "off", "stl"}});
#ifdef HLSCM_WITH_ASSIMP
  result.push_back({"assimp",
                    [](const std::string& name) {
                      Assimp::Importer importer;
                      const aiScene* scene = importer.ReadFile(name, 0);
                      return scene != nullptr && scene->mNumMeshes > 0
                                 ? std::size_t(scene->mMeshes[0]->mNumFaces) : 0;
                    },
                    all_formats});
#endif
  return result;
}

void write_files(const fs::path& folder)
{
  const charts::Chart chart = charts::make_terrain(708, 708);
  Points points;
  Faces faces;
  CGAL::Surface_mesh_texturing::Indexed_triangle_mesh mesh;
  std::vector<CGAL::Simple_cartesian<double>::Point_2> uv;
  for(const charts::Point& p : chart.points) {
    points.emplace_back(p[0], p[1], p[2]);
    uv.emplace_back(p[0], p[1]);
  }
  for(const auto& t : chart.triangles) {
    faces.push_back({t[0], t[1], t[2]});
    mesh.triangles.push_back({t[0], t[1], t[2]});
  }
  mesh.points = points;
  for(const std::string& format : all_formats) {
    std::ofstream file(folder / ("mesh." + format), std::ios::binary);
    file.precision(9);
    bool is_written = false;
    if(format == "glb")
      is_written = CGAL::Surface_mesh_texturing::IO::write_GLB(file, mesh, uv);
    else if(format == "obj")
      is_written = CGAL::IO::write_OBJ(file, points, faces, CGAL::parameters::stream_precision(9));
    else if(format == "off")
      is_written = CGAL::IO::write_OFF(file, points, faces, CGAL::parameters::stream_precision(9));
    else if(format == "ply") {
      CGAL::IO::set_binary_mode(file);
      is_written = CGAL::IO::write_PLY(file, points, faces);
    } else {
      CGAL::IO::set_binary_mode(file);
      is_written = CGAL::IO::write_STL(file, points, faces);
    }
    if(!is_written || !file.flush())
      throw std::runtime_error("cannot write the file of " + format);
  }
}

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

void measure(const fs::path& folder, int repetitions)
{
  const std::vector<Reader> all = readers();
  std::cout << "format,bytes,faces,reader,seconds_cpu\n";
  for(const std::string& format : all_formats) {
    const fs::path path = folder / ("mesh." + format);
    std::vector<std::vector<double>> seconds(all.size());
    std::vector<std::size_t> faces(all.size());
    for(int i = 0; i < repetitions; ++i)
      for(std::size_t r = 0; r < all.size(); ++r) {
        const auto& formats = all[r].formats;
        if(std::find(formats.begin(), formats.end(), format) == formats.end())
          continue;
        const double begin = processor_seconds();
        faces[r] = all[r].read(path.string());
        seconds[r].push_back(processor_seconds() - begin);
      }
    for(std::size_t r = 0; r < all.size(); ++r)
      if(!seconds[r].empty())
        std::cout << format << ',' << fs::file_size(path) << ',' << faces[r] << ',' << all[r].name
                  << ',' << timing::median(seconds[r]) << '\n';
  }
}

} // namespace

int main(int argc, char** argv)
{
  try {
    const int repetitions = argc > 1 ? std::stoi(argv[1]) : 5;
    const fs::path folder = fs::temp_directory_path() / "hlscm_benchmark_reading";
    fs::create_directories(folder);
    write_files(folder);
    std::cout << "# " << machine::description() << "\n";
    measure(folder, repetitions);
    fs::remove_all(folder);
  } catch(const std::exception& e) {
    std::cerr << "reading: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
