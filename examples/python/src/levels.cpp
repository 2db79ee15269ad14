// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "arrays.h"
#include "module.h"
#include "options.h"
#include "running.h"

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/decimate.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>
#include <CGAL/Surface_mesh_texturing/IO/GLB.h>

#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hlscm_python {
namespace {

namespace SMM = CGAL::Surface_mesh_multiresolution;

std::vector<bool> to_locks(const py::array_t<std::int64_t>& locked, std::size_t n)
{
  std::vector<bool> is_locked(locked.size() > 0 ? n : 0, false);
  for(const std::size_t v : to_vertices(locked)) {
    if(v >= n)
      throw Bad_input(Mesh_status::BAD_OPTIONS,
                      "there is no vertex " + std::to_string(v) + " that could be locked");
    is_locked[v] = true;
  }
  return is_locked;
}

SMM::Collapse_order to_order(const std::string& name)
{
  return chosen<SMM::Collapse_order>("order", name,
    {{"batched", SMM::Collapse_order::BATCHED}, {"strict", SMM::Collapse_order::STRICT}});
}

py::tuple decimate(const py::array& points, const py::array& triangles, std::size_t faces,
                   std::size_t vertices, double max_cost, const std::string& order,
                   const py::array_t<std::int64_t>& locked, unsigned int threads,
                   const py::object& progress)
{
  Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  SMM::Decimation_options options;
  options.target_faces = faces;
  options.target_vertices = vertices;
  options.max_cost = max_cost;
  options.order = to_order(order);
  options.is_locked = to_locks(locked, mesh.points.size());
  // decimate() of the library takes one thread by default: here as many as are asked for.
  SMM::Decimation_result result = run(threads, progress, [&](const auto& function) {
    options.progress = function;
    return SMM::decimate(mesh, options);
  });
  check(result);
  return py::make_tuple(to_array(std::move(mesh.points)), to_array(std::move(mesh.triangles)),
                        to_array(std::move(result.source_vertex)), result.is_exhausted);
}

/// A progressive mesh; it does not change once it is there.
class Progressive
{
public:
  explicit Progressive(SMM::Textured_progressive_mesh mesh)
    : m_mesh(std::move(mesh)), m_levels(m_mesh)
  {}
  Progressive(const Progressive&) = delete;
  Progressive& operator=(const Progressive&) = delete;

  std::size_t number_of_faces() const { return m_mesh.progressive_mesh.triangles.size(); }
  std::size_t number_of_vertices() const { return m_mesh.points.size(); }
  std::size_t number_of_collapses() const { return m_mesh.number_of_collapses(); }
  std::size_t smallest_number_of_faces() const { return m_levels.smallest_number_of_triangles(); }
  bool has_texture() const { return m_mesh.has_texture(); }

  std::size_t position_of_faces(std::size_t n) const { return m_levels.position_of_triangles(n); }

  std::size_t position_within(const std::string& kind, double bound, unsigned int threads) const
  {
    const auto error = chosen<SMM::Level_error>("kind", kind,
      {{"distance", SMM::Level_error::DISTANCE},
       {"texture_deviation", SMM::Level_error::TEXTURE_DEVIATION}});
    if(!(bound >= 0.))
      throw Bad_input(Mesh_status::BAD_OPTIONS, "the bound of the error is not 0 or more");
    if(!has_texture())
      throw Bad_input(Mesh_status::BAD_OPTIONS, "errors are measured in the texture, and the mesh has none");
    return run(threads, [&] { return SMM::coarsest_level_within(m_mesh, error, bound); });
  }

  // Vertices, faces, uv, uv_faces, and the number of each vertex in the mesh it was built of.
  py::tuple level(std::size_t k) const
  {
    check_position(k);
    Textured_triangle_mesh mesh = run(1, [&] { return m_levels.mesh(k); });
    std::vector<std::uint32_t> source;
    if(!m_mesh.source_vertex.empty())
      source.assign(m_mesh.source_vertex.begin(),
                    m_mesh.source_vertex.begin() + std::ptrdiff_t(mesh.points.size()));
    return py::make_tuple(to_array(std::move(mesh.points)), to_array(std::move(mesh.triangles)),
                          to_array(std::move(mesh.uv)), to_array(std::move(mesh.wedges)),
                          to_array(std::move(source)));
  }

  py::dict deviation(std::size_t k, unsigned int threads) const
  {
    check_position(k);
    const SMM::Texture_deviation found
      = run(threads, [&] { return SMM::measure_texture_deviation(m_mesh, k); });
    check(found);
    py::dict d;
    const auto set = [&d](const char* name, const SMM::Surface_error& error) {
      d[name] = py::make_tuple(error.mean, error.maximum);
    };
    set("texture_deviation", found.deviation);
    set("uv_change", found.uv_change);
    set("distance", found.distance);
    d["outside"] = found.outside;
    d["unresolved"] = found.unresolved;
    d["diagonal"] = found.diagonal;
    d["faces"] = found.triangles;
    return d;
  }

  py::bytes bytes(bool is_lossless, int position_bits, int uv_bits) const
  {
    SMM::Progressive_mesh_write_options options;
    options.precision = is_lossless ? SMM::Progressive_mesh_precision::LOSSLESS
                                    : SMM::Progressive_mesh_precision::QUANTIZED;
    options.position_bits = position_bits;
    options.uv_bits = uv_bits;
    const SMM::Progressive_mesh_bytes file
      = run(1, [&] { return SMM::encode_progressive_mesh(m_mesh, options); });
    check(file);
    return py::bytes(file.bytes);
  }

  void write_levels(const std::string& path, const std::vector<std::size_t>& positions) const
  {
    if(!has_texture())
      throw Bad_input(Mesh_status::BAD_OPTIONS, "the levels have no uv, which the file needs");
    for(const std::size_t k : positions)
      check_position(k);
    const bool is_written = run(1, [&] {
      std::vector<std::vector<Triangle_indices>> levels;
      for(const std::size_t k : positions)
        levels.push_back(m_levels.triangles(k));
      return CGAL::Surface_mesh_texturing::IO::write_GLB(
        path, m_mesh, levels, CGAL::Surface_mesh_texturing::Texture_file());
    });
    check_written(is_written, path);
  }

private:
  void check_position(std::size_t k) const
  {
    if(k > m_mesh.number_of_collapses() || !m_mesh.is_whole(k))
      throw Bad_input(Mesh_status::BAD_OPTIONS,
                      "there is no whole level after " + std::to_string(k) + " collapses");
  }

  SMM::Textured_progressive_mesh m_mesh;
  SMM::Level_extractor m_levels;
};

std::unique_ptr<Progressive> build_textured(const py::array& points, const py::array& triangles,
                                            const py::array& uv, const py::array& uv_triangles,
                                            const py::array_t<std::int64_t>& locked,
                                            std::size_t vertices, unsigned int threads,
                                            const py::object& progress)
{
  const Textured_triangle_mesh mesh = to_textured(points, triangles, uv, uv_triangles);
  Mesh_outcome outcome;
  outcome.fail(Mesh_status::BAD_MESH, CGAL::Indexed_mesh::mesh_error(mesh));
  check(outcome);
  SMM::Textured_progressive_mesh_options options;
  options.target_vertices = vertices;
  options.is_locked = to_locks(locked, mesh.points.size());
  SMM::Textured_progressive_mesh_result result = run(threads, progress, [&](const auto& function) {
    options.progress = function;
    return SMM::build_textured_progressive_mesh(mesh, options);
  });
  check(result);
  return run(1, [&] { return std::make_unique<Progressive>(std::move(result.mesh)); });
}

std::unique_ptr<Progressive> build_plain(const py::array& points, const py::array& triangles,
                                         const py::array_t<std::int64_t>& locked,
                                         std::size_t vertices, unsigned int threads,
                                         const py::object& progress)
{
  const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  SMM::Progressive_mesh_options options;
  options.angular_defect_bound = 360.; // as with texture
  options.target_vertices = vertices;
  options.is_locked = to_locks(locked, mesh.points.size());
  const SMM::Progressive_surface surface = run(threads, progress, [&](const auto& function) {
    options.progress = function;
    return SMM::build_progressive_mesh(mesh, options);
  });
  check(surface);
  return run(1, [&] { return std::make_unique<Progressive>(SMM::coarse_first(surface)); });
}

// The mesh of a file, and whether the file was all there.
py::tuple from_bytes(const py::bytes& file)
{
  const std::string_view data = file;
  SMM::Read_progressive_mesh read
    = run(1, [&] { return SMM::decode_progressive_mesh(data.data(), data.size()); });
  const bool is_complete = read.status == SMM::Progressive_mesh_file_status::COMPLETE;
  if(!is_complete
     && (read.status != SMM::Progressive_mesh_file_status::TRUNCATED || read.mesh.points.empty()))
    throw Bad_input(Mesh_status::BAD_MESH, read.message);
  return py::make_tuple(std::make_unique<Progressive>(std::move(read.mesh)), is_complete, read.message);
}

} // namespace

void bind_levels(py::module_& m)
{
  using namespace py::literals;
  m.def("decimate", &decimate,
        "The vertices and faces that are left, the former numbers of these vertices, and whether no more "
        "could go.",
        "vertices"_a, "faces"_a, "target_faces"_a, "target_vertices"_a, "max_cost"_a, "order"_a,
        "locked"_a, "threads"_a, "progress"_a);
  py::class_<Progressive>(m, "Progressive", "A progressive mesh.")
    .def_property_readonly("number_of_faces", &Progressive::number_of_faces, "Of the finest level.")
    .def_property_readonly("number_of_vertices", &Progressive::number_of_vertices,
                           "Of the finest level.")
    .def_property_readonly("number_of_collapses", &Progressive::number_of_collapses,
                           "To the coarsest level; of wedges.")
    .def_property_readonly("smallest_number_of_faces", &Progressive::smallest_number_of_faces,
                           "Of the coarsest level.")
    .def_property_readonly("has_texture", &Progressive::has_texture, "Whether levels have uv.")
    .def("position_of_faces", &Progressive::position_of_faces,
         "After how many collapses there are at most so many faces.", "faces"_a)
    .def("position_within", &Progressive::position_within,
         "After how many collapses, about the most, an error is within a bound.", "kind"_a, "bound"_a,
         "threads"_a)
    .def("level", &Progressive::level,
         "The mesh after k collapses: vertices, faces, uv, uv_faces, source vertices.", "k"_a)
    .def("deviation", &Progressive::deviation, "The errors after k collapses.", "k"_a, "threads"_a)
    .def("bytes", &Progressive::bytes, "The mesh as a file in memory.", "lossless"_a,
         "position_bits"_a, "uv_bits"_a)
    .def("write_levels", &Progressive::write_levels,
         "Writes the levels after so many collapses, the finest first, as one GLB file.", "path"_a,
         "positions"_a);
  m.def("build_textured", &build_textured, "A progressive mesh the levels of which share their uv.",
        "vertices"_a, "faces"_a, "uv"_a, "uv_faces"_a, "locked"_a, "target_vertices"_a, "threads"_a,
        "progress"_a);
  m.def("build_plain", &build_plain, "A progressive mesh without uv.", "vertices"_a, "faces"_a,
        "locked"_a, "target_vertices"_a, "threads"_a, "progress"_a);
  m.def("from_bytes", &from_bytes, "A progressive mesh from a file in memory; whether it was all there; "
        "a sentence.", "file"_a);
}

} // namespace hlscm_python
