// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_MAP_SURFACE_H
#define CGAL_SURFACE_MESH_TEXTURING_MAP_SURFACE_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/surface_of_soup.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_texturing/cut_to_disks.h>
#include <CGAL/Surface_mesh_texturing/segment_coarse_to_fine.h>
#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
#include <CGAL/Surface_mesh_texturing/internal/charts/Closed_mesh_cutter.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/lay_side_by_side.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// Maps the mesh of a component that is connected, of genus 0 and has a border, with pins, by the indices
/// of its vertices, or without, and with the options that `map_surface()` has for it.
typedef std::function<Surface_mesh_parameterization::Conformal_map(
  const Chart_mesh& component,
  const std::vector<Surface_mesh_parameterization::HLSCM_pin>& pins,
  const Surface_mesh_parameterization::HLSCM_options& options)>
  Component_map_function;

/// \ingroup PkgHLSCMTexturing
/// The options of `map_surface()`.
struct Surface_map_options
{
  /// How each component is mapped. Progress is that of the whole. Where the method is `HLSCM`, what
  /// was cut and has no pins is mapped by `SPECTRAL` all the same: the surfaces of bodies have limbs,
  /// which two pins make very small.
  Surface_mesh_parameterization::HLSCM_options solver;
  /// Of several components, those with fewer triangles are mapped by a direct solver where the method
  /// is `HLSCM`.
  std::size_t direct_faces = 20000;
  /// What maps them in the place of `conformal_map()`; nothing by default.
  Component_map_function map;
  /// Vertices of the mesh with given parameters. A component with pins stays where they put it; the
  /// others lie to the right of it, at its density.
  std::vector<Surface_mesh_parameterization::HLSCM_pin> pins;
  /// Edges that shall not be seams, three bits for each triangle as in `Face_charts::seams`, such as
  /// `Surface_of_soup::diagonals`; empty for none.
  std::vector<std::uint8_t> no_seams;
  /// How closed components, and those with handles, are cut.
  Disk_cut_options cut;
  /// A closed component has seams along its handles alone, or seams to extremities as `cut` says, or
  /// to half as many more that may be half as far: more of them only where that makes the stretch
  /// \f$ L^2 \f$ of its map at least so many times as small. 0: as `cut` says, without trials.
  double least_gain = 1.25;
};

/// \ingroup PkgHLSCMTexturing
/// What became of one connected component.
struct Mapped_component
{
  std::size_t faces = 0;   ///< its triangles
  std::size_t borders = 0; ///< before it was cut
  std::size_t genus = 0;   ///< its handles
  bool is_cut = false;     ///< whether it had to be cut to a disk
  bool is_mapped = true;   ///< otherwise its texture coordinates are one point
  /// Of its map, by the vertices and triangles of the whole mesh, in the units of the whole map.
  Surface_mesh_parameterization::HLSCM_report report;
};

/// \ingroup PkgHLSCMTexturing
/// What `map_surface()` returns.
struct Surface_map
  : Indexed_mesh::Mesh_outcome
{
  Textured_triangle_mesh mesh; ///< the surface with its texture coordinates
  Face_charts charts;          ///< the components of its triangles, and the seams that were cut
  std::vector<Mapped_component> components; ///< in the order of their first triangles
};

namespace internal {

CGAL_HLSCM_INLINE Surface_map map_surface_of_arrays(const Indexed_triangle_mesh& mesh,
                                                    const Surface_map_options& options);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS

// Maps the components of one mesh, and lays them side by side.
class Surface_mapper
{
public:
  Surface_mapper(const Indexed_triangle_mesh& mesh, const Surface_map_options& options)
    : m_mesh(mesh), m_options(options), m_solver(options.solver)
  {
    m_solver.metric.clear();
  }

  Surface_map run()
  {
    if(m_result.fail(Mesh_status::BAD_MESH, manifold_error(m_mesh))
       || m_result.fail(Mesh_status::BAD_OPTIONS, options_error()))
      return m_result;
    const Triangle_adjacency adjacency(m_mesh.triangles);
    cut(adjacency);
    if(m_result.components.size() == 1 && !m_result.components[0].is_cut)
      m_parts = {whole_as_chart(m_mesh)};
    else
      m_parts = cut_out_charts(m_mesh, adjacency, m_result.charts);
    for(std::size_t c = 0; c < m_parts.size() && m_result.is_ok(); ++c)
      map(c);
    if(m_result.is_ok() && m_parts.size() > 1)
      lay_out();
    if(m_result.is_ok())
      write();
    return std::move(m_result);
  }

private:
  static constexpr std::size_t large = 80000; // triangles

  typedef Simple_cartesian<double>::Point_2 Point_2;
  typedef Surface_mesh_parameterization::Conformal_map Conformal_map;
  typedef Surface_mesh_parameterization::HLSCM_pin Pin;

  std::string options_error() const
  {
    for(const Pin& pin : m_options.pins)
      if(pin.vertex >= m_mesh.points.size())
        return "there is no vertex " + std::to_string(pin.vertex) + " that could be pinned";
    const auto& metric = m_options.solver.metric;
    if(!metric.empty() && metric.size() != m_mesh.triangles.size())
      return Indexed_mesh::metric_size_error(metric.size(), m_mesh.triangles.size());
    const std::vector<std::uint8_t>& no_seams = m_options.no_seams;
    return no_seams.empty() ? std::string() : foreign_seams_error(m_mesh.triangles.size(), no_seams).error;
  }

  // Cuts what cannot be laid out in the plane.
  void cut(const Triangle_adjacency& adjacency)
  {
    const auto needs_cut = [](const Chart_topology& t) { return t.borders == 0 || t.genus() > 0; };
    Face_charts& charts = m_result.charts;
    charts = charts_between(adjacency, std::vector<std::uint8_t>(m_mesh.triangles.size()));
    for(const Chart_topology& t : chart_topologies(adjacency, charts))
      m_result.components.push_back({t.faces, t.borders, t.genus(), needs_cut(t), true, {}});
    cut_by_trial(adjacency);
    charts = cut_charts(m_mesh, adjacency, std::move(charts), m_options.cut, m_options.no_seams,
                        needs_cut);
  }

  // Cuts closed components, and those of many triangles.
  void cut_by_trial(const Triangle_adjacency& adjacency)
  {
    Face_charts& charts = m_result.charts;
    std::vector<std::uint8_t> is_wanted(m_result.components.size());
    for(std::size_t c = 0; c < is_wanted.size(); ++c)
      is_wanted[c] = m_result.components[c].is_cut && (is_large(c) || is_tried(c));
    if(std::find(is_wanted.begin(), is_wanted.end(), 1) == is_wanted.end())
      return;
    const std::vector<Chart_mesh> parts = cut_out_charts(m_mesh, adjacency, charts);
    for(std::size_t c = 0; c < parts.size(); ++c) {
      if(!is_wanted[c])
        continue;
      const std::vector<std::uint8_t> avoided = parts[c].entries_of(m_options.no_seams);
      const std::vector<std::uint8_t> seams = is_large(c)
        ? coarse_seams_of(c, parts[c].mesh, avoided) : seams_of(c, parts[c].mesh, avoided);
      for(std::size_t t = 0; t < seams.size(); ++t)
        charts.seams[parts[c].triangles[t]] |= seams[t];
    }
  }

  bool is_large(std::size_t c) const { return m_result.components[c].faces > large; }

  bool is_tried(std::size_t c) const
  {
    return m_result.components[c].borders == 0 && m_options.cut.extremities > 0
        && m_options.least_gain > 0.;
  }

  // The seams that make a disk of a component, of which `mesh` may be a coarser one.
  std::vector<std::uint8_t> seams_of(std::size_t c, const Indexed_triangle_mesh& mesh,
                                     const std::vector<std::uint8_t>& avoided) const
  {
    if(!is_tried(c))
      return Disk_cutter(mesh, m_options.cut, avoided).cut();
    return Closed_mesh_cutter(mesh, m_options.cut, avoided, m_options.solver.progress)
      .cut(m_result.components[c].genus > 0, m_options.least_gain);
  }

  // The same, found on a coarser mesh, from where they are carried back: that takes linear time. None
  // if that fails: then it is cut as the others are.
  std::vector<std::uint8_t> coarse_seams_of(std::size_t c, const Indexed_triangle_mesh& mesh,
                                            const std::vector<std::uint8_t>& avoided) const
  {
    Segmentation_options options;
    options.coarse_faces = large / 4;
    options.cut = m_options.cut;
    options.no_seams = avoided;
    const Segmentation_result cut = segment_coarse_to_fine(
      mesh, options, [this, c](const Indexed_triangle_mesh& coarse) {
        return charts_between(coarse.triangles, seams_of(c, coarse, {}));
      });
    return cut.is_ok() && cut.charts.number_of_charts == 1 ? cut.charts.seams
                                                           : std::vector<std::uint8_t>();
  }

  // The pins of a component, in their order: of several vertices on a seam the first has the pin.
  std::vector<Pin> pins_of(const Chart_mesh& part)
  {
    std::vector<Pin> result;
    if(m_options.pins.empty())
      return result;
    m_place.resize(m_mesh.points.size(), no_vertex); // once: it is as before again at the end
    for(Vertex_index v = Vertex_index(part.vertices.size()); v-- > 0;)
      m_place[part.vertices[v]] = v;
    for(const Pin& pin : m_options.pins)
      if(m_place[pin.vertex] != no_vertex)
        result.push_back({m_place[pin.vertex], pin.u, pin.v});
    for(const Vertex_index v : part.vertices)
      m_place[v] = no_vertex;
    return result;
  }

  Surface_mesh_parameterization::HLSCM_options options_of(std::size_t c, bool has_pins) const
  {
    typedef Surface_mesh_parameterization::Conformal_method Method;
    const std::size_t faces = m_parts[c].triangles.size();
    Surface_mesh_parameterization::HLSCM_options options = m_solver;
    options.metric = m_parts[c].entries_of(m_options.solver.metric);
    if(options.method == Method::HLSCM && m_result.components[c].is_cut && !has_pins)
      options.method = Method::SPECTRAL;
    else if(options.method == Method::HLSCM && m_parts.size() > 1 && faces < m_options.direct_faces)
      options.method = Method::DIRECT;
    if(m_options.solver.progress)
      options.progress = [this, faces](double done) {
        return m_options.solver.progress((double(m_faces_done) + done * double(faces))
                                         / double(m_mesh.triangles.size()));
      };
    return options;
  }

  Conformal_map solve(std::size_t c, const std::vector<Pin>& pins) const
  {
    const auto options = options_of(c, !pins.empty());
    if(m_options.map)
      return m_options.map(m_parts[c], pins, options);
    const Indexed_triangle_mesh& mesh = m_parts[c].mesh;
    return pins.empty() ? Surface_mesh_parameterization::conformal_map(mesh, options)
                        : Surface_mesh_parameterization::conformal_map(mesh, pins, options);
  }

  void map(std::size_t c)
  {
    const Chart_mesh& part = m_parts[c];
    const std::vector<Pin> pins = pins_of(part);
    Conformal_map map = solve(c, pins);
    Mapped_component& component = m_result.components[c];
    m_faces_done += part.triangles.size();
    component.report = std::move(map.report);
    for(Pin& pin : component.report.pins)
      pin.vertex = part.vertices[pin.vertex];
    if(component.report.flip_repair)
      for(std::size_t& face : component.report.flip_repair->unmended_faces)
        face = part.triangles[face];
    component.is_mapped = map.uv.size() == part.mesh.points.size();
    if(component.report.cancelled)
      m_result.cancel();
    else if(!component.is_mapped && (m_parts.size() == 1 || !pins.empty()))
      m_result.fail(map.is_ok() ? Mesh_status::FAILED : map.status, component.report.message);
    if(!component.is_mapped)
      map.uv.assign(part.mesh.points.size(), Point_2(0., 0.));
    m_uv.push_back(std::move(map.uv));
    m_is_pinned.push_back(!pins.empty());
  }

  void lay_out()
  {
    std::vector<Laid_component> all;
    for(std::size_t c = 0; c < m_parts.size(); ++c)
      all.push_back({m_parts[c].mesh, m_uv[c], m_is_pinned[c]});
    lay_side_by_side(all);
    for(std::size_t c = 0; c < m_parts.size(); ++c)
      Surface_mesh_parameterization::move_report(m_result.components[c].report, all[c].scale,
                                                 all[c].x, all[c].y);
  }

  void write()
  {
    Textured_triangle_mesh& mesh = m_result.mesh;
    mesh = {m_mesh.points, m_mesh.triangles, {}, m_mesh.triangles};
    for(std::size_t c = 0; c < m_parts.size(); ++c) {
      const Vertex_index first = Vertex_index(mesh.uv.size());
      mesh.uv.insert(mesh.uv.end(), m_uv[c].begin(), m_uv[c].end());
      for(std::size_t i = 0; i < m_parts[c].triangles.size(); ++i)
        for(std::size_t k = 0; k < 3; ++k)
          mesh.wedges[m_parts[c].triangles[i]][k] = first + m_parts[c].mesh.triangles[i][k];
    }
  }

  const Indexed_triangle_mesh& m_mesh;
  const Surface_map_options& m_options;
  Surface_mesh_parameterization::HLSCM_options m_solver; // but for the metric, of which each gets a part
  Surface_map m_result;
  std::vector<Chart_mesh> m_parts;
  std::vector<std::vector<Point_2>> m_uv; // of each part
  std::vector<bool> m_is_pinned;          // each part
  std::vector<Vertex_index> m_place;      // of each vertex in the part, if there are pins
  std::size_t m_faces_done = 0;
};

CGAL_HLSCM_INLINE Surface_map map_surface_of_arrays(const Indexed_triangle_mesh& mesh,
                                                    const Surface_map_options& options)
{
  return Surface_mapper(mesh, options).run();
}

#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Maps a whole surface to the plane, whatever it is: closed components, and those with handles, are
cut to disks first along short seams that prefer creases; each component is mapped by
`Surface_mesh_parameterization::conformal_map()`, in one piece and with a free border; all are
scaled to the same texels for a unit of area and laid side by side, if there are several. For charts
of bounded distortion that do not overlap see `build_texture_atlas()`.

Of several components those that cannot be mapped, such as one whose vertices all have the same
place, get one point. Errors: a `manifold_error()`, pins of vertices that do not exist, a single or
pinned component that cannot be mapped, and cancelling.

Time of the maps, and expected linear time for the cuts. The tag is that of `conformal_map()`.
*/
template <class ConcurrencyTag = Default>
Surface_map map_surface(const Indexed_triangle_mesh& mesh,
                        const Surface_map_options& options = Surface_map_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.solver.threads);
  return internal::map_surface_of_arrays(mesh, options);
}

/*!
\ingroup PkgHLSCMTexturing

Maps a mesh of any type, whose faces may have any number of corners: they are cut into triangles for
the computation (see `Indexed_mesh::surface_of_soup()`), and no seam runs along such a cut unless
there is no other way.

\param mesh a model of `FaceListGraph`; it is not changed
\param uvmap a model of `WritablePropertyMap` with the halfedge descriptor as key and a point with
       two coordinates as value: gets for each halfedge of a face the texture coordinate of the
       corner at its target. If there is an error, it is left as it is.
\param options the options; `no_seams` is that of the triangles, and does not count
\param np optional named parameters: `vertex_point_map` and `geom_traits`; see
       `Indexed_mesh::copy_points()`
*/
template <class ConcurrencyTag = Default, class FaceGraph, class HalfedgeUVMap,
          class NamedParameters = parameters::Default_named_parameters,
          class = typename boost::property_traits<HalfedgeUVMap>::key_type>
Surface_map map_surface(const FaceGraph& mesh, HalfedgeUVMap uvmap,
                        Surface_map_options options = Surface_map_options(),
                        const NamedParameters& np = parameters::default_values())
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Uv;
  const Indexed_mesh::Polygon_soup soup = Indexed_mesh::copy_soup(mesh, np);
  const Indexed_mesh::Surface_of_soup surface = Indexed_mesh::surface_of_soup(soup);
  Surface_map result;
  if(result.fail(surface))
    return result;
  options.no_seams = surface.diagonals;
  for(auto& pin : options.pins)
    pin.vertex = Indexed_mesh::vertex_of_surface(surface, pin.vertex);
  result = map_surface<ConcurrencyTag>(surface.mesh, options);
  if(!result.is_ok())
    return result;
  const std::vector<std::uint32_t> uv
    = Indexed_mesh::uv_corners_of_soup(soup, surface, result.mesh.wedges);
  std::size_t corner = 0;
  for(const auto f : faces(mesh))
    for(const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      const std::uint32_t i = uv[corner++];
      if(i != Indexed_mesh::no_vertex)
        put(uvmap, h, Uv(result.mesh.uv[i].x(), result.mesh.uv[i].y()));
    }
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_MAP_SURFACE_H
