// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_FINISHED_LEVELS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_FINISHED_LEVELS_H

#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_levels.h>

#include <cstdint>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What a run knows beside files when a phase is finished.
struct Run_state
{
  std::size_t blocks = 0, mollified_faces = 0; // of the finest level
  Pins pins;                                   // as vertices of the level

  std::vector<std::uint32_t> pinned() const
  {
    std::vector<std::uint32_t> result;
    for(const Pin& pin : pins)
      result.push_back(pin.vertex);
    return result;
  }

  friend std::ostream& operator<<(std::ostream& out, const Run_state& state)
  {
    out << state.blocks << ' ' << state.mollified_faces << ' ' << state.pins.size();
    for(const Pin& pin : state.pins)
      out << ' ' << pin.vertex << ' ' << pin.value.real() << ' ' << pin.value.imag(); // 0 or 1
    return out;
  }

  friend std::istream& operator>>(std::istream& in, Run_state& state)
  {
    std::size_t count = 0;
    in >> state.blocks >> state.mollified_faces >> count;
    state.pins.resize(in ? count : 0);
    for(Pin& pin : state.pins) {
      double u = 0., v = 0.;
      in >> pin.vertex >> u >> v;
      pin.value = {u, v};
    }
    return in;
  }
};

// The files of levels in a work folder, and the phases that leave them: "mesh<k>", a sorted mesh
// and the way from it to the finer one, and "level<k>", its matrix and what its blocks were
// decimated to. Level 0 is the finest.
class Finished_levels
{
public:
  explicit Finished_levels(Work_folder& folder) : m_folder(folder) {}

  static std::string mesh_name(std::size_t k) { return "mesh" + std::to_string(k); }
  static std::string level_name(std::size_t k) { return "level" + std::to_string(k); }

  bool has_mesh(std::size_t k) const { return m_folder.has_finished(mesh_name(k)); }
  bool has_level(std::size_t k) const { return m_folder.has_finished(level_name(k)); }

  // `from`: the way to the finer mesh; empty for the finest.
  void finish_mesh(std::size_t k, Streamed_mesh& mesh, const Mapped_array<Streamed_stencil>& from,
                   const Run_state& state)
  {
    std::vector<const Mapped_file*> files;
    mesh.for_each_array([&files](auto& array, const char*) { files.push_back(&array.file()); });
    if(!from.empty())
      files.push_back(&from.file());
    std::ostringstream text;
    text << mesh.block_size << ' ' << state;
    m_folder.finish(mesh_name(k), text.str(), files);
  }

  void finish_level(std::size_t k, Streamed_level& level, const Decimated_level& coarse,
                    const Run_state& state)
  {
    std::vector<const Mapped_file*> files
      = {&coarse.stencils.file(), &coarse.triangles.file(), &coarse.cotangents.file(),
         &level.border_mass.file()};
    level.matrix.for_each_array([&files](auto& array, const char*) {
      files.push_back(&array.file());
    });
    std::ostringstream text;
    text << state;
    m_folder.finish(level_name(k), text.str(), files);
  }

  // Removes what only led to the mesh of level k: all of the finer mesh, but for what is needed to
  // write the map.
  void remove_before(std::size_t k)
  {
    for(const char* file : {"_stencils", "_coarse_triangles", "_coarse_cotangents"})
      m_folder.remove(level_name(k - 1) + file);
    Streamed_mesh names;
    names.for_each_array([&](auto&, const std::string& array) {
      if(k > 1 || (array != "rank" && array != "triangles"))
        m_folder.remove(mesh_name(k - 1) + "_" + array);
    });
  }

  Streamed_mesh open_mesh(std::size_t k, Run_state& state)
  {
    Streamed_mesh mesh;
    auto values = m_folder.values(mesh_name(k));
    values >> mesh.block_size >> state;
    mesh.for_each_array([&](auto& array, const char* name) { open(mesh_name(k), name, array); });
    return mesh;
  }

  // Its stencils only if the next mesh is finished, too.
  Streamed_level open_level(std::size_t k, Run_state& state)
  {
    Streamed_level level;
    level.matrix.open(m_folder, level_name(k) + "_");
    open(level_name(k), "border_mass", level.border_mass);
    if(has_mesh(k + 1))
      open(level_name(k), "prolongation", level.stencils);
    auto values = m_folder.values(level_name(k));
    values >> state;
    level.pins = state.pinned();
    return level;
  }

  Decimated_level open_decimated(std::size_t k)
  {
    Decimated_level result;
    open(level_name(k), "stencils", result.stencils);
    open(level_name(k), "coarse_triangles", result.triangles);
    open(level_name(k), "coarse_cotangents", result.cotangents);
    return result;
  }

  template <class Array>
  void open(const std::string& phase, const std::string& name, Array& array)
  {
    array = m_folder.open<typename Array::value_type>(phase + "_" + name);
  }

private:
  Work_folder& m_folder;
};

// What is left of a level as the mesh that the next one is made of.
struct Coarse_source
{
  const Streamed_mesh& fine;
  const Decimated_level& level;

  std::size_t number_of_vertices() const { return fine.number_of_vertices(); }
  std::size_t number_of_triangles() const { return level.triangles.size(); }
  bool is_used(std::size_t v) const { return level.is_kept(v); }
  Three_numbers point(std::size_t v) const { return fine.points[v]; }
  Streamed_mesh::Triangle_indices triangle(std::size_t t) const { return level.triangles[t]; }
  bool has_cotangents() const { return true; }
  Three_numbers cotangents(std::size_t t) const { return level.cotangents[t]; }
  void release_vertices(std::size_t begin, std::size_t end) const
  {
    level.stencils.release(begin, end);
    fine.points.release(begin, end);
  }
  void release_triangles(std::size_t begin, std::size_t end) const
  {
    level.triangles.release(begin, end);
    level.cotangents.release(begin, end);
  }
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_FINISHED_LEVELS_H
