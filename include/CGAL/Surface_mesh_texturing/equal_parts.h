// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_EQUAL_PARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_EQUAL_PARTS_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
#include <CGAL/Surface_mesh_texturing/internal/mapped_charts/Mirror_finder.h>
#include <CGAL/Surface_mesh_texturing/internal/mapped_charts/Part_matcher.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// Whether a component that is its own mirror image counts as one part, or each half as a part.
enum class Mirror_halves {
  TOGETHER, ///< as one part
  APART     ///< as two equal parts, with a seam between them
};

/*!
\ingroup PkgHLSCMTexturing

The struct `Equal_parts` says which connected components of a surface are equal to others, moved,
turned or mirrored, so that they can share their place in a texture: `find_equal_parts()` finds them,
an atlas is built of `representatives`, and `stacked_atlas()` gives it to the whole surface.
*/
struct Equal_parts
  : Indexed_mesh::Mesh_outcome
{
  /// The surface with only the first one of each kind of components.
  Indexed_triangle_mesh representatives;
  /// For each triangle of `representatives` the one of the surface. Ascending.
  std::vector<Triangle_index> triangle;
  /// For each triangle of the surface the one of `representatives` that is itself or stands for it.
  std::vector<Triangle_index> stand_in;
  /// For each corner of a triangle of the surface the corner of its stand-in.
  std::vector<std::array<std::uint8_t, 3>> corner;
  /// For each triangle of the surface its component, or half of one.
  std::vector<std::uint32_t> part;
  std::size_t number_of_parts = 0; ///< components of the surface; halves count as two
  std::size_t copies = 0;          ///< of these, those that have a stand-in
  std::size_t mirrored_copies = 0; ///< of these, those that are mirrored
  std::size_t halved_components = 0; ///< components of which each half is a part

  /// Returns those entries of an array of the surface's triangles that are of `representatives`. Empty
  /// if the array is.
  template <class Value>
  std::vector<Value> of_representatives(const std::vector<Value>& of_surface) const
  {
    std::vector<Value> result;
    for(std::size_t i = 0; i < triangle.size() && !of_surface.empty(); ++i)
      result.push_back(of_surface[triangle[i]]);
    return result;
  }
};

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
namespace internal {

// The components of a surface, in the order of their first triangles; sets the component of each
// triangle and the distance of each vertex from the centre of its component.
inline std::vector<Surface_part> surface_parts(const Indexed_triangle_mesh& mesh,
                                               const Triangle_adjacency& adjacency,
                                               std::vector<std::uint32_t>& part,
                                               std::vector<double>& distance)
{
  const std::uint32_t n = std::uint32_t(mesh.triangles.size());
  part = charts_between(adjacency, std::vector<std::uint8_t>(n, 0)).chart;
  typedef Simple_cartesian<double>::Vector_3 Vector;
  std::vector<Surface_part> parts;
  for(std::uint32_t t = 0; t < n; ++t) {
    if(part[t] == parts.size())
      parts.emplace_back();
    parts[part[t]].triangles.push_back(t);
    for(int c = 0; c < 3; ++c)
      parts[part[t]].border_edges += adjacency.opposite(t, c) == no_halfedge ? 1 : 0;
  }
  distance.assign(mesh.points.size(), -1.);
  for(Surface_part& p : parts) {
    const auto& origin = mesh.points[mesh.triangles[p.triangles[0]][0]];
    Vector sum(0., 0., 0.), mean = sum;
    double area = 0.;
    for(const std::uint32_t t : p.triangles) {
      const Triangle_indices& v = mesh.triangles[t];
      const double a
        = std::sqrt(squared_area(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
      Vector middle(0., 0., 0.);
      for(const Vertex_index w : v)
        middle = middle + (mesh.points[w] - origin) / 3.;
      area += a;
      sum = sum + a * middle;
      mean = mean + middle / double(p.triangles.size());
    }
    const auto centre = origin + (area > 0. ? sum / area : mean);
    for(const std::uint32_t t : p.triangles)
      for(const Vertex_index v : mesh.triangles[t])
        if(distance[v] < 0.) {
          distance[v] = std::sqrt(squared_distance(mesh.points[v], centre));
          p.radius = (std::max)(p.radius, distance[v]);
          ++p.vertices;
        }
  }
  return parts;
}

// The triangles of `representatives`, with their vertices.
inline void fill_representatives(const Indexed_triangle_mesh& mesh, Equal_parts& result)
{
  std::vector<Vertex_index> number(mesh.points.size(), no_vertex);
  for(const Triangle_index t : result.triangle)
    for(const Vertex_index v : mesh.triangles[t])
      number[v] = 0;
  for(std::size_t v = 0; v < number.size(); ++v)
    if(number[v] != no_vertex) {
      number[v] = Vertex_index(result.representatives.points.size());
      result.representatives.points.push_back(mesh.points[v]);
    }
  for(const Triangle_index t : result.triangle) {
    const Triangle_indices& v = mesh.triangles[t];
    result.representatives.triangles.push_back({number[v[0]], number[v[1]], number[v[2]]});
  }
}

// Makes parts of the halves that are mirror images of others, `half`, and of the copies of these;
// what stood for a triangle of such a half then has the stand-in of that.
inline void part_halves(const std::vector<Triangle_match>& half, std::vector<Triangle_match>& match,
                        Equal_parts& result)
{
  const std::uint32_t none = std::uint32_t(-1);
  std::vector<std::uint32_t> part_of_half(result.number_of_parts, none);
  for(Triangle_index t = 0; t < match.size(); ++t) {
    const Triangle_match model = match[t], mirrored = half[model.triangle];
    if(mirrored.triangle == model.triangle)
      continue;
    match[t] = {mirrored.triangle, model.corners.then(mirrored.corners)};
    const std::uint32_t component = result.part[t];
    if(part_of_half[component] == none) {
      part_of_half[component] = std::uint32_t(result.number_of_parts++);
      ++result.copies;
      ++result.halved_components;
      result.mirrored_copies += match[t].corners.is_mirrored ? 1 : 0;
    }
    result.part[t] = part_of_half[component];
  }
}

} // namespace internal
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

/*!
\ingroup PkgHLSCMTexturing

Finds the components of a surface that are equal to others: their triangles stand for each other so
that neighbours are neighbours, and lengths of edges and distances of vertices from the centre of the
component differ by at most `tolerance` times the radius around the centre.

A component that is equal to an earlier one may be missed if it is nearly symmetric in very many
ways; no two are taken for equal that are not. Mirrored copies count. Errors: those of
`manifold_error()`.

With `Mirror_halves::APART` a component of 32 triangles or more that a plane mirrors onto itself,
vertices onto vertices within the tolerance and triangles onto triangles, is two parts, of which the
second one is a mirrored copy; triangles that are mirrored to themselves are in the first. Planes are
looked for through the centre of the area, across the axes of space and the principal axes; of
several that do it, that with the shortest cut is taken.

Expected time \f$ O(n \log n) \f$, for parts of few symmetries.
*/
CGAL_HLSCM_INLINE Equal_parts find_equal_parts(const Indexed_triangle_mesh& mesh,
                                               double tolerance = 1e-4,
                                               Mirror_halves halves = Mirror_halves::TOGETHER);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE Equal_parts find_equal_parts(const Indexed_triangle_mesh& mesh, double tolerance,
                                               Mirror_halves halves)
{
  constexpr std::size_t least_triangles = 32; // of what is worth a seam
  Equal_parts result;
  if(result.fail(Mesh_status::BAD_MESH, manifold_error(mesh)))
    return result;
  const Triangle_adjacency adjacency(mesh.triangles);
  std::vector<double> distance;
  const std::vector<internal::Surface_part> parts
    = internal::surface_parts(mesh, adjacency, result.part, distance);
  result.number_of_parts = parts.size();
  internal::Part_matcher matcher(mesh, adjacency, distance, tolerance);
  // The representatives by their numbers of triangles and vertices, and by their radius
  std::map<std::array<std::size_t, 3>, std::multimap<double, std::size_t>> kinds;
  std::vector<internal::Triangle_match> match, half;
  for(Triangle_index t = 0; t < mesh.triangles.size(); ++t)
    match.push_back({t, {}});
  half = match;
  std::vector<std::uint8_t> is_copy(parts.size(), 0);
  for(std::size_t i = 0; i < parts.size(); ++i) {
    const internal::Surface_part& part = parts[i];
    auto& models = kinds[{part.triangles.size(), part.vertices, part.border_edges}];
    const double off = 2. * tolerance * part.radius;
    std::vector<std::size_t> candidates;
    for(auto m = models.lower_bound(part.radius - off);
        m != models.end() && m->first <= part.radius + off; ++m)
      candidates.push_back(m->second);
    std::sort(candidates.begin(), candidates.end());
    for(const std::size_t model : candidates) {
      const auto found = matcher.match(part, parts[model]);
      if(found.empty())
        continue;
      for(std::size_t k = 0; k < found.size(); ++k)
        match[part.triangles[k]] = found[k];
      is_copy[i] = 1;
      ++result.copies;
      result.mirrored_copies += found[0].corners.is_mirrored ? 1 : 0;
      break;
    }
    if(is_copy[i] != 0)
      continue;
    models.insert({part.radius, i});
    if(halves == Mirror_halves::APART && part.triangles.size() >= least_triangles)
      for(const auto& mirrored : internal::Mirror_finder(mesh, part, tolerance).half())
        half[mirrored.first] = mirrored.second;
  }
  internal::part_halves(half, match, result);
  std::vector<Triangle_index> number(mesh.triangles.size());
  for(Triangle_index t = 0; t < mesh.triangles.size(); ++t)
    if(match[t].triangle == t) {
      number[t] = Triangle_index(result.triangle.size());
      result.triangle.push_back(t);
    }
  for(const internal::Triangle_match& m : match) {
    result.stand_in.push_back(number[m.triangle]);
    result.corner.push_back({{std::uint8_t(m.corners(0)), std::uint8_t(m.corners(1)),
                              std::uint8_t(m.corners(2))}});
  }
  internal::fill_representatives(mesh, result);
  return result;
}
#endif

namespace internal {

// What keeps an atlas of the representatives of some parts from being stacked for a surface.
inline Mesh_outcome stacking_error(const Indexed_triangle_mesh& mesh, const Equal_parts& parts,
                                   const Texture_atlas_result& result)
{
  const Texture_atlas& atlas = result.atlas;
  const std::size_t n = mesh.triangles.size(), models = parts.triangle.size();
  Mesh_outcome outcome;
  if(outcome.fail(Mesh_status::BAD_MESH, surface_error(mesh)))
    return outcome;
  bool fits = parts.part.size() == n && parts.stand_in.size() == n && parts.corner.size() == n;
  for(std::size_t t = 0; t < n && fits; ++t)
    fits = parts.part[t] < parts.number_of_parts && parts.stand_in[t] < models
        && *std::max_element(parts.corner[t].begin(), parts.corner[t].end()) < 3;
  if(!fits)
    outcome.fail(Mesh_status::BAD_OPTIONS, "the parts are not those of this mesh");
  const std::size_t charts = atlas.charts.number_of_charts;
  if(atlas.mesh.triangles.size() != models || atlas.page.size() != charts
     || result.report.charts.size() != charts || !texture_error(atlas.mesh).empty()
     || !charts_error({atlas.mesh.points, atlas.mesh.triangles}, atlas.charts).is_ok())
    outcome.fail(Mesh_status::BAD_OPTIONS, "the atlas is not one of the representatives");
  return outcome;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns the atlas of a surface some of whose components share their place with others.

\param mesh the surface
\param parts what `find_equal_parts()` returned for it
\param atlas an atlas of `parts.representatives`, without an error and without smooth seams

The invariants of `Texture_atlas` hold but for the last one: triangles overlap if, and only if, they
have the same stand-in; those of mirrored copies are mirrored. The report has each chart as often as
it is there, and all seams; its distortion, texels and utilisation are those of `atlas`. Linear time.

Errors: that of `atlas`, indices out of range, coordinates that are not finite, a triangle that has a
vertex twice, parts of another mesh, an atlas of another one.
*/
inline Texture_atlas_result stacked_atlas(const Indexed_triangle_mesh& mesh,
                                          const Equal_parts& parts, Texture_atlas_result atlas)
{
  if(parts.copies == 0 || !atlas.is_ok())
    return atlas;
  Texture_atlas_result result;
  if(result.fail(internal::stacking_error(mesh, parts, atlas)))
    return result;
  result.report = atlas.report;
  result.atlas.number_of_pages = atlas.atlas.number_of_pages;
  result.atlas.width = atlas.atlas.width;
  result.atlas.height = atlas.atlas.height;
  Textured_triangle_mesh& whole = result.atlas.mesh;
  const Textured_triangle_mesh& model = atlas.atlas.mesh;
  whole.points = mesh.points;
  whole.triangles = mesh.triangles;
  std::vector<std::vector<Triangle_index>> triangles(parts.number_of_parts);
  for(Triangle_index t = 0; t < parts.part.size(); ++t)
    triangles[parts.part[t]].push_back(t);
  whole.wedges.resize(mesh.triangles.size());
  std::vector<Vertex_index> number(model.uv.size());
  std::vector<std::size_t> last_part(model.uv.size(), parts.number_of_parts);
  for(std::size_t p = 0; p < triangles.size(); ++p) // a wedge belongs to one vertex
    for(const Triangle_index t : triangles[p])
      for(int c = 0; c < 3; ++c) {
        const Vertex_index w = model.wedges[parts.stand_in[t]][parts.corner[t][c]];
        if(last_part[w] != p) {
          last_part[w] = p;
          number[w] = Vertex_index(whole.uv.size());
          whole.uv.push_back(model.uv[w]);
        }
        whole.wedges[t][c] = number[w];
      }
  const Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint8_t> seams(mesh.triangles.size(), 0);
  for(Triangle_index t = 0; t < seams.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const int a = parts.corner[t][c], b = parts.corner[t][(c + 1) % 3];
      const int side = (a + 1) % 3 == b ? a : b;
      const Halfedge o = adjacency.opposite(t, c);
      if(atlas.atlas.charts.is_seam(parts.stand_in[t], side)
         || (o != no_halfedge && parts.part[triangle_of(o)] != parts.part[t]))
        seams[t] |= std::uint8_t(1u << c);
    }
  result.atlas.charts = charts_between(adjacency, std::move(seams));
  result.report.charts.clear();
  result.report.seams = measure_seams(mesh, adjacency, result.atlas.charts);
  result.report.seam_length = result.report.seams.length;
  for(Triangle_index t = 0; t < mesh.triangles.size(); ++t)
    if(result.atlas.charts.chart[t] == result.atlas.page.size()) {
      const std::uint32_t chart = atlas.atlas.charts.chart[parts.stand_in[t]];
      result.atlas.page.push_back(atlas.atlas.page[chart]);
      result.report.charts.push_back(atlas.report.charts[chart]);
      result.report.charts.back().faces = 0;
    }
  for(const std::uint32_t chart : result.atlas.charts.chart)
    ++result.report.charts[chart].faces;
  return result;
}

/*!
\ingroup PkgHLSCMTexturing

Returns how many charts have an equal one: there is a chart whose triangles have the same stand-ins.
None if these are not charts of the surface whose parts these are.

Time \f$ O(n \log n) \f$.
*/
inline std::size_t number_of_charts_with_equals(const Equal_parts& parts, const Face_charts& charts)
{
  if(charts.chart.size() != parts.stand_in.size()
     || std::any_of(charts.chart.begin(), charts.chart.end(),
                    [&charts](std::size_t chart) { return chart >= charts.number_of_charts; }))
    return 0;
  std::vector<std::vector<Triangle_index>> models(charts.number_of_charts);
  for(Triangle_index t = 0; t < parts.stand_in.size(); ++t)
    models[charts.chart[t]].push_back(parts.stand_in[t]);
  std::map<std::vector<Triangle_index>, std::size_t> number;
  for(std::vector<Triangle_index>& model : models) {
    std::sort(model.begin(), model.end());
    ++number[model];
  }
  std::size_t result = 0;
  for(const auto& of_model : number)
    result += of_model.second > 1 ? of_model.second : 0;
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_EQUAL_PARTS_H
