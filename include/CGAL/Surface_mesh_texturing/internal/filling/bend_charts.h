// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BEND_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BEND_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Elastic_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/mapped_charts/Straight_chains.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Puts charts on the raster of a page each, and finds where they are not a packing: beyond the sides, or
// without their padding between them.
class Page_check
{
public:
  Page_check(const Packing_options& options, std::size_t pages)
    : m_raster(exact_raster(options)), m_pages(pages, Texel_mask(m_raster.width, m_raster.height))
  {}

  // `outline` is relative to its centre, which is in texels on the page.
  void add(const Chart_outline& outline, std::size_t page)
  {
    const double cells = 1. / m_raster.cell;
    const auto box = bounding_box(outline, Rotation_and_scale(0., cells));
    std::array<int, 2> low, high;
    Vector_2d centre;
    for(int c = 0; c < 2; ++c) {
      centre[c] = (outline.centre[c] - m_raster.origin[c]) * cells;
      low[c] = int(std::floor(centre[c] + box[0][c] - touching_tolerance));
      high[c] = int(std::floor(centre[c] + box[1][c] + touching_tolerance)) + 1;
      centre[c] -= low[c];
    }
    Texel_mask mask(high[0] - low[0], high[1] - low[1]);
    add_outline(outline, Rotation_and_scale(0., cells), centre, mask);
    const int padding = m_raster.padding;
    for(const Cell_run& run : dilated(mask, padding).runs())
      if(const int x = first_in_page(page, run, low[0] - padding, low[1] - padding); x >= 0)
        add_fault(page, x, run.y + low[1] - padding);
    for(const Cell_run& run : mask.runs()) {
      const Cell_run moved = {run.y + low[1], run.begin + low[0], run.end + low[0]};
      m_pages[page].add(moved);
      if(moved.y < 0 || moved.y >= m_raster.height || moved.begin < 0)
        add_fault(page, moved.begin, moved.y);
      if(moved.y < 0 || moved.y >= m_raster.height || moved.end > m_raster.width)
        add_fault(page, moved.end, moved.y);
    }
  }

  const std::vector<Page_place>& faults() const { return m_faults; }

  // The part of all texels of the pages that charts touch.
  double texel_utilisation(const Packing_options& options) const
  {
    double touched = 0.;
    for(const Texel_mask& page : m_pages)
      touched += double(page.count()) * m_raster.cell * m_raster.cell;
    return touched / (double(options.width) * double(options.height) * double(m_pages.size()));
  }

private:
  // The first cell of a run, moved by (x, y), that a chart has already, or -1.
  int first_in_page(std::size_t page, const Cell_run& run, int x, int y) const
  {
    const int row = run.y + y, end = (std::min)(m_raster.width, run.end + x);
    if(row < 0 || row >= m_raster.height)
      return -1;
    for(int i = (std::max)(0, run.begin + x); i < end; i = (i | 63) + 1) {
      const Word word = m_pages[page].row(row)[i >> 6] & ~Word(0) << (i & 63);
      if(word != 0)
        return (i & ~63) + lowest_bit(word) < end ? (i & ~63) + lowest_bit(word) : -1;
    }
    return -1;
  }

  void add_fault(std::size_t page, int x, int y)
  {
    m_faults.push_back({page, {m_raster.origin[0] + (x + 0.5) * m_raster.cell,
                               m_raster.origin[1] + (y + 0.5) * m_raster.cell}});
  }

  Packing_raster m_raster;
  std::vector<Texel_mask> m_pages;
  std::vector<Page_place> m_faults;
};

// Lets charts grow and bend on their pages; see `bend_charts()`.
class Chart_bending
{
public:
  // As `bend_charts()`; all of these must outlive this.
  Chart_bending(double bending, const Packing_options& options, const Chart_mapping& mapping,
                const std::function<bool()>& goes_on, std::vector<Mapped_chart>& maps,
                Packing_result& packing)
    : m_strain(2. * bending * bending), m_options(options), m_mapping(mapping), m_goes_on(goes_on)
    , m_maps(maps), m_packing(packing)
  {
    const Packing_raster raster = exact_raster(options);
    const double side = double((std::max)(options.width, options.height));
    m_sizes.unit = (std::max)(1., side / 1024.);
    const double more = margin * m_sizes.unit;
    m_sizes.page = {double(options.width), double(options.height)};
    m_sizes.low = Plane_vector_d{raster.origin[0], raster.origin[1]} + Plane_vector_d{more, more};
    m_sizes.high = Plane_vector_d{raster.origin[0], raster.origin[1]}
                 + Plane_vector_d{double(raster.width), double(raster.height)} * raster.cell
                 - Plane_vector_d{more, more};
    m_sizes.gap = raster.cell * (raster.padding + 1.) + more;
    m_square = side / squares;
  }

  void run()
  {
    if(m_maps.empty() || m_maps.size() > most_charts
       || !std::all_of(m_maps.begin(), m_maps.end(), is_bendable))
      return;
    Elastic_charts charts = elastic_charts();
    if(!grow(charts))
      return;
    double stiffness = first_stiffness;
    for(int i = 0; i < attempts && charts.scale() > 1.; ++i) {
      if(!settle(charts) || take(charts))
        return;
      stiffness *= harder;
      charts.set_stiffness_of_contacts(stiffness);
      if(i > attempts / 2)
        charts.grow(less);
    }
  }

private:
  static constexpr double margin = 0.4; // of gaps, in units: for what samples of borders do not tell
  static constexpr double squares = 10.; // along a page
  static constexpr int attempts = 16;
  static constexpr double less = 0.99; // growth after half of them
  static constexpr double first_stiffness = 40., harder = 1.3; // of contacts, and with each attempt
  static constexpr std::size_t most_charts = 100; // more are bent hardly at all, and that takes seconds

  static bool is_bendable(const Mapped_chart& map)
  {
    return map.report.is_one_to_one && !map.chart.mesh.triangles.empty()
        && map.report.distortion.flipped_faces + map.report.distortion.degenerate_faces == 0;
  }

  Elastic_charts elastic_charts();
  bool grow(Elastic_charts& charts) const;
  bool settle(Elastic_charts& charts) const;
  bool take(Elastic_charts& charts);
  bool bend(std::size_t i, const Elastic_charts& charts, std::vector<Point_2>& places,
            Chart_distortion& distortion) const;
  Chart_outline outline(std::size_t i, const Elastic_charts& charts) const;

  double m_strain; // see `Elastic_charts::strain()`
  const Packing_options& m_options;
  const Chart_mapping& m_mapping;
  const std::function<bool()>& m_goes_on;
  std::vector<Mapped_chart>& m_maps;
  Packing_result& m_packing;
  Contact_sizes m_sizes;
  double m_square;
  std::vector<std::vector<Point_2>> m_rest; // in texels on the page
  std::vector<Control_net> m_nets;
};

inline Elastic_charts Chart_bending::elastic_charts()
{
  std::vector<Plane_vector_d> points;
  Border_contacts contacts(m_sizes);
  m_rest.resize(m_maps.size());
  m_nets.reserve(m_maps.size());
  for(std::size_t i = 0; i < m_maps.size(); ++i) {
    const Mapped_chart& map = m_maps[i];
    for(const Point_2& p : map.uv)
      m_rest[i].push_back(m_packing.placements[i](p));
    m_nets.emplace_back(m_rest[i], map.chart.mesh.triangles, m_square, points);
    for(const auto& loop : border_loops(map.chart.border_edges(), m_rest[i].size()))
      contacts.add_loop(std::uint32_t(i), m_packing.placements[i].page, loop, m_rest[i], m_nets[i]);
  }
  Elastic_charts charts(std::move(points), std::move(contacts), m_sizes);
  for(const Control_net& net : m_nets)
    charts.add_chart(net.elements(), net.differences());
  return charts;
}

// Until they are bent so much, or fill the pages; returns whether there was time for it.
inline bool Chart_bending::grow(Elastic_charts& charts) const
{
  constexpr int most_steps = 100;
  constexpr double largest = 0.03, least_gain = 0.2; // of the scale, and to what it should be
  constexpr double most_bent = 1.5, stiffer = 2.;    // a ratio of lengths, and what comes of it
  const double loose = 3. * m_sizes.unit;
  double growth = 0., before = 1.;
  charts.set_stiffness_of_contacts(first_stiffness);
  for(int i = 0; i < most_steps; ++i) {
    if(!m_goes_on())
      return false;
    const bool is_moved = charts.step();
    charts.stiffen_bent(most_bent, stiffer);
    if(!is_moved && charts.worst_gap() >= loose)
      break;
    if(charts.worst_gap() >= loose)
      continue;
    const double left = 1. - charts.strain() / m_strain;
    if(left <= 0. || (growth > 0. && charts.scale() < before * (1. + least_gain * growth)))
      break;
    before = charts.scale();
    growth = largest * (std::max)(0.25, left);
    charts.grow(1. + growth);
  }
  return true;
}

// Until gaps are about what they shall be; returns whether there was time for it.
inline bool Chart_bending::settle(Elastic_charts& charts) const
{
  constexpr int most_steps = 3;
  const double small = 0.15 * m_sizes.unit;
  for(int i = 0; i < most_steps && charts.step() && charts.worst_gap() > small; ++i)
    if(!m_goes_on())
      return false;
  return true;
}

// Computes the map of a bent chart, and what it is like; returns whether it is one-to-one, and within the
// bound or not beyond what it was.
inline bool Chart_bending::bend(std::size_t i, const Elastic_charts& charts, std::vector<Point_2>& places,
                                Chart_distortion& distortion) const
{
  constexpr double any = (std::numeric_limits<double>::infinity)();
  for(std::uint32_t v = 0; v < m_rest[i].size(); ++v) {
    const Plane_vector_d p = m_nets[i].place(v, charts.points());
    places.emplace_back(p.x, p.y);
  }
  const Chart_distortion& given = m_maps[i].report.distortion;
  const auto most = [](double bound, double before) { return before > bound ? 1.05 * before : bound; };
  Distortion_bound allowed = {any, any};
  if(m_mapping.is_bounded)
    allowed = {most(m_mapping.bound.area_scale, given.area_scale),
               most(m_mapping.bound.quasi_conformal, given.quasi_conformal)};
  const Chart_mesh& chart = m_maps[i].chart;
  return mend_map(chart.mesh, chart.border_edges(), allowed, places, distortion);
}

// That of a bent chart, whose border vertices stay where they are when flipped triangles are repaired.
inline Chart_outline Chart_bending::outline(std::size_t i, const Elastic_charts& charts) const
{
  std::vector<std::array<Vector_2d, 2>> edges;
  for(const Border_edge& e : m_maps[i].chart.border_edges()) {
    edges.emplace_back();
    for(int end = 0; end < 2; ++end) {
      const Plane_vector_d p = m_nets[i].place(e[end], charts.points());
      edges.back()[end] = {p.x, p.y};
    }
  }
  Vector_2d low = edges[0][0], high = low;
  for(const auto& e : edges)
    for(int c = 0; c < 2; ++c) {
      low[c] = (std::min)(low[c], e[0][c]);
      high[c] = (std::max)(high[c], e[0][c]);
    }
  Chart_outline result;
  result.centre = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
  result.diameter = std::hypot(high[0] - low[0], high[1] - low[1]);
  const auto relative = [&](const Vector_2d& p) {
    return Vector_2d{p[0] - result.centre[0], p[1] - result.centre[1]};
  };
  result.parts.emplace_back();
  for(const auto& e : edges)
    result.parts[0].push_back({relative(e[0]), relative(e[1]), 1});
  return result;
}

// Returns whether the bent charts are a packing, which then is that of the charts. Otherwise they give way
// where they are not.
inline bool Chart_bending::take(Elastic_charts& charts)
{
  constexpr double stiffer = 4., most = 2.; // of the strain at which charts stopped growing
  Page_check check(m_options, m_packing.pages);
  for(std::size_t i = 0; i < m_maps.size(); ++i)
    check.add(outline(i, charts), m_packing.placements[i].page);
  charts.widen_gaps(check.faults(), 0.5 * m_sizes.unit);
  if(!check.faults().empty() || charts.strain() > most * m_strain)
    return false;
  std::vector<std::vector<Point_2>> places(m_maps.size());
  std::vector<Chart_distortion> distortions(m_maps.size());
  std::vector<char> is_valid(m_maps.size(), 0);
  Blocked_execution::blocked_for(m_maps.size(), 1, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      is_valid[i] = bend(i, charts, places[i], distortions[i]) ? 1 : 0;
  });
  double area = 0.;
  bool are_valid = true;
  for(std::size_t i = 0; i < m_maps.size(); ++i) {
    area += distortions[i].uv_area;
    are_valid = are_valid && is_valid[i];
    if(!is_valid[i])
      charts.stiffen(i, stiffer);
  }
  if(!are_valid)
    return false;
  const double all = m_sizes.page.x * m_sizes.page.y * double(m_packing.pages);
  if(area <= m_packing.utilisation * all)
    return true; // nothing is gained
  const double texels = m_packing.texels_per_unit * std::sqrt(area / (m_packing.utilisation * all));
  for(std::size_t i = 0; i < m_maps.size(); ++i) {
    Mapped_chart& map = m_maps[i];
    map.uv.clear();
    for(const Point_2& p : places[i])
      map.uv.emplace_back(p.x() / texels, p.y() / texels);
    if(m_mapping.is_bounded) {
      distortions[i].uv_area = map.report.distortion.uv_area;
      map.report.distortion = distortions[i];
    }
    Chart_placement& placement = m_packing.placements[i];
    placement.angle = 0.;
    placement.scale = texels;
    placement.offset = Point_2(0., 0.);
  }
  m_packing.texels_per_unit = texels;
  m_packing.utilisation = area / all;
  m_packing.texel_utilisation = check.texel_utilisation(m_options);
  return true;
}

// Bends the charts of a packing so that they are larger, until their lengths are changed by `bending`, as a
// root mean square, or the pages are full; changes nothing if that comes to nothing. The packing stays one,
// charts one-to-one and within their bound, or hardly further beyond it than they were. `goes_on` is asked
// from time to time, and all stays as it was if it says no.
//
// Complexity: some 50 steps of Newton's method for control points on a grid of ten squares a page, which do
// not depend on the mesh, and linear time for the maps.
inline void bend_charts(double bending, const Packing_options& options, const Chart_mapping& mapping,
                        const std::function<bool()>& goes_on, std::vector<Mapped_chart>& maps,
                        Packing_result& packing)
{
  Chart_bending(bending, options, mapping, goes_on, maps, packing).run();
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BEND_CHARTS_H
