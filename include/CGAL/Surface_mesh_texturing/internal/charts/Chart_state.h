// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_STATE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_STATE_H

#include <CGAL/Surface_mesh_texturing/internal/charts/Growth_surface.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_graph.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/trial_map.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A chart, or nothing if it has no triangles.
struct Chart_piece
{
  std::vector<std::uint32_t> triangles; // ascending
  Trial_map trial;
  double perimeter = 0.; // with cuts within the chart twice
  double area = 0.;
};

// Charts while they are merged: sets of triangles that form disks when cut along the seams. A chart
// has the index of one of the patches of which it was merged.
struct Chart_state
{
  typedef std::vector<std::uint32_t> Indices;
  typedef std::pair<std::uint32_t, std::uint32_t> Pair; // of charts, the smaller index first

  Seam_graph graph;
  Indices label; // of each triangle, an index into pieces
  std::vector<Chart_piece> pieces;
  std::size_t number_of_charts = 0;
  std::vector<std::size_t> charts_of_component;

  // Sets perimeter and area.
  void measure(const Growth_surface& surface, Chart_piece& piece) const;

  // The charts that have an edge in common with chart c, ascending.
  Indices neighbors(std::uint32_t c) const;

  // The triangles of both charts, ascending; (a, a) stands for chart a alone.
  Indices union_of(const Pair& pair) const;

  // Replaces the charts by pieces of `atoms`, of which they were merged; returns which pieces these
  // are now.
  std::vector<bool> take_apart(const Growth_surface& surface, const Chart_state& atoms,
                               const Indices& charts);

  double seam_length() const;
};

inline void Chart_state::measure(const Growth_surface& surface, Chart_piece& piece) const
{
  piece.perimeter = piece.area = 0.;
  for(const std::uint32_t t : piece.triangles) {
    piece.area += surface.area[t];
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      piece.perimeter += graph.is_seam(h) ? surface.length[h] : 0.;
  }
}

inline Chart_state::Indices Chart_state::union_of(const Pair& pair) const
{
  const Indices &s = pieces[pair.first].triangles, &t = pieces[pair.second].triangles;
  if(pair.first == pair.second)
    return s;
  Indices result(s.size() + t.size());
  std::merge(s.begin(), s.end(), t.begin(), t.end(), result.begin());
  return result;
}

inline Chart_state::Indices Chart_state::neighbors(std::uint32_t c) const
{
  Indices result;
  for(const std::uint32_t t : pieces[c].triangles)
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const std::uint32_t g = graph.opposite(h);
      if(!graph.is_border(h) && label[triangle_of(g)] != c)
        result.push_back(label[triangle_of(g)]);
    }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

inline std::vector<bool> Chart_state::take_apart(const Growth_surface& surface,
                                                 const Chart_state& atoms, const Indices& charts)
{
  std::vector<bool> is_apart(pieces.size(), false);
  for(const std::uint32_t c : charts) {
    is_apart[c] = true;
    --number_of_charts;
    --charts_of_component[surface.component[pieces[c].triangles[0]]];
  }
  Indices triangles;
  for(const std::uint32_t c : charts)
    triangles.insert(triangles.end(), pieces[c].triangles.begin(),
                     pieces[c].triangles.end());
  std::vector<bool> is_atom(pieces.size(), false);
  for(const std::uint32_t t : triangles)
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      if(!graph.is_border(h) && is_apart[label[triangle_of(graph.opposite(h))]]
         && atoms.graph.is_seam(h))
        graph.add_seam(h);
  for(const std::uint32_t c : charts)
    pieces[c] = Chart_piece();
  for(const std::uint32_t t : triangles) {
    label[t] = atoms.label[t];
    is_atom[atoms.label[t]] = true;
  }
  for(std::uint32_t c = 0; c < is_atom.size(); ++c)
    if(is_atom[c]) {
      pieces[c] = atoms.pieces[c];
      ++number_of_charts;
      ++charts_of_component[surface.component[pieces[c].triangles[0]]];
    }
  return is_atom;
}

inline double Chart_state::seam_length() const
{
  double sum = 0.;
  for(const Chart_piece& piece : pieces)
    sum += piece.perimeter;
  return 0.5 * sum;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_STATE_H
