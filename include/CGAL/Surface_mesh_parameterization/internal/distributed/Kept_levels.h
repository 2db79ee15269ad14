// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_KEPT_LEVELS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_KEPT_LEVELS_H

#include <CGAL/Surface_mesh_parameterization/Very_large_chart_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/distributed/Distributed_mesh.h>
#include <CGAL/Surface_mesh_parameterization/internal/stored/Work_folder.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/decimate_blocks.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The meshes of levels, and the ways between them, in a folder of each rank: a later run of as many
// ranks goes on from the last one that all of them have. What is decimated and sorted is kept;
// matrices are made again from it. Without a folder nothing is kept.
class Kept_levels
{
public:
  typedef std::vector<Streamed_stencil> Stencils;

  // `part`: what this rank has of the input, by which it is known.
  Kept_levels(Ranks& ranks, const Very_large_chart_options& options, const Mesh_part& part)
    : m_ranks(ranks), m_path(options.work_folder)
  {
    if(m_path.empty())
      return;
    constexpr int format = 1;
    std::ostringstream text;
    text.precision(17);
    text << format << ' ' << ranks.size() << ' ' << checksum_of(part.points) << ' '
         << checksum_of(part.triangles) << ' ' << options.block_vertices << ' '
         << options.gathered_vertices << ' ' << options.memory << ' ' << options.solver.level_ratio
         << ' ' << options.solver.angular_defect_bound;
    std::size_t number = 0;
    ranks.together([&] {
      if(ranks.rank() == 0 && !options.resumes)
        remove_more_ranks();
      m_folder.emplace(folder_of(ranks.rank()), text.str(), options.resumes);
      while(m_folder->has_finished(name(number)))
        ++number;
    });
    m_number = std::size_t(ranks.least(double(number)));
    ranks.together([&] {
      std::vector<std::string> others;
      for(std::size_t k = m_number; k < number; ++k)
        others.push_back(name(k));
      if(!others.empty())
        m_folder->forget(others);
    });
  }

  std::size_t number_of_meshes() const { return m_number; } // of an earlier run

  // `stencils`: the way from mesh k to the finer one; empty for the finest.
  void put(std::size_t k, Distributed_mesh& mesh, Stencils& stencils)
  {
    if(!m_folder)
      return;
    m_ranks.together([&] {
      std::vector<Mapped_file> files;
      for_each_array(mesh, stencils, [&](auto& values, const std::string& array) {
        typedef typename std::decay_t<decltype(values)>::value_type Value;
        Mapped_file file
          = Mapped_file::create(m_folder->path_of(name(k) + array), values.size() * sizeof(Value));
        std::copy(values.begin(), values.end(), reinterpret_cast<Value*>(file.data()));
        file.release(0, file.bytes());
        files.push_back(std::move(file));
      });
      std::vector<const Mapped_file*> all;
      for(const Mapped_file& file : files)
        all.push_back(&file);
      std::ostringstream text;
      text << mesh.block_size << ' ' << mesh.first;
      m_folder->finish(name(k), text.str(), all);
    });
  }

  // A mesh of an earlier run.
  Distributed_mesh mesh(std::size_t k, Stencils& stencils)
  {
    Distributed_mesh result;
    m_ranks.together([&] {
      auto values = m_folder->values(name(k));
      values >> result.block_size >> result.first;
      for_each_array(result, stencils, [&](auto& values_of, const std::string& array) {
        typedef typename std::decay_t<decltype(values_of)>::value_type Value;
        const auto file = m_folder->open<Value>(name(k) + array);
        values_of.assign(file.begin(), file.end());
      });
    });
    return result;
  }

  // On all ranks, when nothing is to be resumed.
  void remove()
  {
    if(!m_folder)
      return;
    m_folder->remove_all();
    m_folder.reset();
    MPI_Barrier(m_ranks.comm());
    std::error_code ignored; // somebody else's files stay
    std::filesystem::remove(m_path, ignored);
  }

private:
  static std::string name(std::size_t k) { return "mesh" + std::to_string(k); }
  std::string folder_of(std::size_t rank) const
  {
    return (m_path / ("rank" + std::to_string(rank))).string();
  }

  // Those of an earlier run that had more of them.
  void remove_more_ranks() const
  {
    std::error_code ignored;
    for(std::size_t r = m_ranks.size(); std::filesystem::exists(folder_of(r), ignored); ++r)
      Work_folder(folder_of(r), "", false).remove_all();
  }

  template <class Use>
  static void for_each_array(Distributed_mesh& mesh, Stencils& stencils, const Use& use)
  {
    mesh.for_each_array([&use](auto& values, const std::string& array) {
      use(values, "_" + array);
    });
    use(stencils, std::string("_stencils"));
  }

  Ranks& m_ranks;
  std::filesystem::path m_path;
  std::optional<Work_folder> m_folder;
  std::size_t m_number = 0;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_KEPT_LEVELS_H
