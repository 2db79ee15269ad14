// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BEND_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BEND_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Elastic_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Roomy_places.h>
#include <CGAL/Surface_mesh_texturing/internal/mapped_charts/Straight_chains.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Page_check.h>

#include <algorithm>
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

// How far charts are bent.
struct Bending
{
  double change;       // of lengths, as a root mean square
  double squares = 7.; // along a page, of the grid of control points
  bool is_wary = false; // whether maps are checked before charts are pressed apart, too
  std::size_t most_charts = 100; // more are bent hardly at all, and that takes seconds
  double most_work = (std::numeric_limits<double>::infinity)(); // of growing: control points times steps
};

// Whether `bend_charts()` can do anything for these charts, of which there are not too many.
inline bool can_be_bent(const std::vector<Mapped_chart>& maps, std::size_t most_charts)
{
  const auto is_valid = [](const Mapped_chart& map) {
    return map.report.is_one_to_one && !map.chart.mesh.triangles.empty()
        && map.report.distortion.flipped_faces + map.report.distortion.degenerate_faces == 0;
  };
  return !maps.empty() && maps.size() <= most_charts && std::all_of(maps.begin(), maps.end(), is_valid);
}

// Lets charts grow and bend on their pages; see `bend_charts()`.
class Chart_bending
{
public:
  // As `bend_charts()`; all of these must outlive this.
  Chart_bending(const Bending& amount, const Packing_options& options, const Chart_mapping& mapping,
                const std::function<bool()>& goes_on, std::vector<Mapped_chart>& maps,
                Packing_result& packing)
    : m_strain(2. * amount.change * amount.change), m_is_wary(amount.is_wary)
    , m_most_work(amount.most_work), m_options(options), m_mapping(mapping)
    , m_goes_on(goes_on), m_maps(maps), m_packing(packing)
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
    m_square = side / amount.squares;
  }

  double run()
  {
    m_is_affine.clear();
    for(const Mapped_chart& map : m_maps)
      m_is_affine.push_back(is_at_its_bound(map) || map.is_affine ? 1 : 0);
    m_rest.assign(m_maps.size(), {});
    for(std::size_t i = 0; i < m_maps.size(); ++i)
      for(const Point_2& p : m_maps[i].uv)
        m_rest[i].push_back(m_packing.placements[i](p));
    move_to_room(m_maps, m_packing.placements, exact_raster(m_options), small * m_sizes.unit, m_sizes.gap,
                 m_rest);
    // Those that became invalid where they bent are only stretched in the next round, and when they are bent
    // once more
    for(int round = 0; round < rounds; ++round) {
      m_has_more_affine = false;
      bend_all();
      if(!m_has_more_affine)
        break;
    }
    for(std::size_t i = 0; i < m_maps.size(); ++i)
      m_maps[i].is_affine = m_is_affine[i] != 0;
    return m_work;
  }

private:
  static constexpr double margin = 0.4; // of gaps, in units: for what samples of borders do not tell
  static constexpr double small = 20.;  // extents of charts, in units: they go to where there is room first
  static constexpr int rounds = 5;
  static constexpr double most_strain = 2.7; // to that at which charts stop growing
  static constexpr double first_stiffness = 40., harder = 1.3; // of contacts, and with each attempt

  // Then it can hardly bend.
  static bool is_at_its_bound(const Mapped_chart& map)
  {
    constexpr double near = 0.98;
    const Chart_distortion& d = map.report.distortion;
    return d.area_scale > near * map.bound.area_scale
        || d.quasi_conformal > near * map.bound.quasi_conformal;
  }

  void bend_all();
  void add_nets(std::vector<Plane_vector_d>& points, Border_contacts& contacts);
  bool grow(Elastic_charts& charts) const;
  void try_to_take(Elastic_charts& charts);
  bool settle(Elastic_charts& charts) const;
  // What speaks against bent charts: places where they are no packing, or charts whose maps are not valid.
  struct Faults
  {
    std::size_t places, charts;
  };
  Faults take(Elastic_charts& charts, bool checks_maps);
  bool bend(std::size_t i, const Elastic_charts& charts, std::vector<Point_2>& places,
            Chart_distortion& distortion) const;
  double changes_of_length(std::size_t i, const std::vector<Point_2>& places, double scale) const;

  double m_strain; // see `Elastic_charts::strain()`
  bool m_is_wary;
  double m_most_work;
  const Packing_options& m_options;
  const Chart_mapping& m_mapping;
  const std::function<bool()>& m_goes_on;
  std::vector<Mapped_chart>& m_maps;
  Packing_result& m_packing;
  Contact_sizes m_sizes;
  double m_square;
  std::vector<std::vector<Point_2>> m_rest; // in texels on the page
  std::vector<Control_net> m_nets;
  std::vector<char> m_is_affine; // of the maps of each chart
  bool m_has_more_affine = false;
  double m_work = 0.;
};

inline void Chart_bending::bend_all()
{
  std::vector<Plane_vector_d> points;
  Border_contacts contacts(m_sizes);
  add_nets(points, contacts);
  Elastic_charts charts(std::move(points), std::move(contacts), m_sizes);
  for(const Control_net& net : m_nets)
    charts.add_chart(net.elements(), net.differences());
  if(grow(charts) && charts.scale() > 1.)
    try_to_take(charts);
  m_work += charts.work();
}

// Adds the control points and borders of the charts.
inline void Chart_bending::add_nets(std::vector<Plane_vector_d>& points, Border_contacts& contacts)
{
  m_nets.clear();
  m_nets.reserve(m_maps.size());
  for(std::size_t i = 0; i < m_maps.size(); ++i) {
    const Chart_mesh& chart = m_maps[i].chart;
    m_nets.emplace_back(m_rest[i], chart.mesh.triangles, m_square, m_is_affine[i] != 0, points);
    for(const auto& loop : border_loops(chart.border_edges(), m_rest[i].size()))
      contacts.add_loop(std::uint32_t(i), m_packing.placements[i].page, loop, m_rest[i], m_nets[i]);
  }
}

// Until they are bent so much, or fill the pages. Returns whether there was time for it.
inline bool Chart_bending::grow(Elastic_charts& charts) const
{
  constexpr double fewest_steps = 16., most_steps = 100.;
  constexpr int patience = 4, steps_to_relax = 2;    // without better gaps
  constexpr int most_halvings = 2;                   // of a growth that entangles charts
  constexpr double least_gain = 0.2;                 // of the scale, to what it should be
  constexpr double most_bent = 1.5, stiffer = 2.;    // a ratio of lengths, and what comes of it
  constexpr double any = (std::numeric_limits<double>::infinity)(), better = 0.98;
  constexpr double far = 12., near = 3.;             // for a step, in units
  const double loose = 3. * m_sizes.unit;
  const double largest = (std::min)(0.03, std::sqrt(0.5 * m_strain)); // growth
  double growth = 0., before = 1., best_gap = any;
  int halvings = 0;
  bool is_careful = false;
  charts.set_stiffness_of_contacts(first_stiffness);
  charts.set_farthest(far * m_sizes.unit);
  Elastic_charts::State last = charts.state(); // before they grew further
  const int steps
    = int(std::clamp(m_most_work / double(charts.points().size()), fewest_steps, most_steps));
  for(int i = 0, since = 0, in_vain = 0; i < steps; ++i) {
    if(!m_goes_on())
      return false;
    const bool is_moved = charts.step();
    ++since;
    charts.stiffen_bent(most_bent, stiffer);
    if(charts.worst_gap() >= loose) {
      in_vain = charts.worst_gap() < better * best_gap ? 0 : in_vain + 1;
      best_gap = (std::min)(best_gap, charts.worst_gap());
      if(is_moved && in_vain <= patience)
        continue;
      // Some charts are entangled
      charts.restore(last);
      if(is_careful && (growth == 0. || ++halvings > most_halvings))
        break;
      if(is_careful)
        growth *= 0.5;
      is_careful = true;
      charts.set_farthest(near * m_sizes.unit);
    } else {
      const double left = 1. - charts.strain() / m_strain;
      if(left <= 0. && since < steps_to_relax)
        continue;
      if(left <= 0. || (growth > 0. && charts.scale() < before * (1. + least_gain * growth)))
        break;
      before = charts.scale();
      growth = largest * (std::max)(0.25, left);
      last = charts.state();
    }
    charts.grow(1. + growth);
    since = in_vain = 0;
    best_gap = any;
  }
  if(charts.worst_gap() >= loose)
    charts.restore(last);
  return true;
}

// Presses the charts apart until they are a packing, which then is taken, or one of them can only be stretched.
inline void Chart_bending::try_to_take(Elastic_charts& charts)
{
  constexpr int attempts = 20, patience = 8;
  double stiffness = first_stiffness;
  constexpr std::size_t any = (std::numeric_limits<std::size_t>::max)();
  std::size_t fewest = any;
  charts.set_stiffness_of_contacts(stiffness);
  for(int i = 0, in_vain = 0; i < attempts && in_vain < patience; ++i) {
    if(!settle(charts) || charts.strain() > most_strain * m_strain)
      return;
    const Faults faults = take(charts, m_is_wary && i == 0);
    if(faults.places + faults.charts == 0 || m_has_more_affine)
      return;
    in_vain = faults.charts > 0 || faults.places < fewest ? 0 : in_vain + 1;
    fewest = faults.charts > 0 ? any : (std::min)(fewest, faults.places); // stiffer ones need other places
    stiffness *= harder;
    charts.set_stiffness_of_contacts(stiffness);
  }
}

// Until gaps are about what they shall be; returns whether there was time for it.
inline bool Chart_bending::settle(Elastic_charts& charts) const
{
  constexpr int most_steps = 2;
  const double small = 0.15 * m_sizes.unit;
  for(int i = 0; i < most_steps && charts.step() && charts.worst_gap() > small; ++i)
    if(!m_goes_on())
      return false;
  return true;
}

// Computes the map of a bent chart, and what it is like; returns whether it is one-to-one, and within its
// bound.
inline bool Chart_bending::bend(std::size_t i, const Elastic_charts& charts, std::vector<Point_2>& places,
                                Chart_distortion& distortion) const
{
  for(std::uint32_t v = 0; v < m_rest[i].size(); ++v) {
    const Plane_vector_d p = m_nets[i].place(v, charts.points());
    places.emplace_back(p.x, p.y);
  }
  const Chart_mesh& chart = m_maps[i].chart;
  return mend_map(chart.mesh, chart.border_edges(), m_maps[i].bound, places, distortion);
}

// The squares of the relative changes of length of a chart with these places, along both principal directions
// of its triangles, integrated over it at rest: those of thin triangles can be more than those of elements.
inline double Chart_bending::changes_of_length(std::size_t i, const std::vector<Point_2>& places,
                                               double scale) const
{
  double sum = 0.;
  for(const auto& t : m_maps[i].chart.mesh.triangles) {
    const auto side = [&t](const std::vector<Point_2>& p, int k) {
      return vector_of(p[t[k]]) - vector_of(p[t[0]]);
    };
    const Plane_vector_d a = side(m_rest[i], 1), b = side(m_rest[i], 2);
    const double twice = a.cross(b);
    if(!(twice > 0.))
      continue;
    const double factor = 1. / (scale * twice);
    const Plane_vector_d p = side(places, 1) * factor, q = side(places, 2) * factor;
    // Twice alpha and beta, see `Plane_jacobian`
    const Plane_vector_d x = p * b.y - q * a.y, y = q * a.x - p * b.x;
    const double alpha = std::hypot(x.x + y.y, x.y - y.x), beta = std::hypot(x.x - y.y, x.y + y.x);
    const double larger = 0.5 * (alpha + beta) - 1., smaller = 0.5 * (alpha - beta) - 1.;
    sum += 0.5 * twice * (larger * larger + smaller * smaller);
  }
  return sum;
}

// Where bent charts are no packing they give way, and become stiffer or rigid if their maps are not valid, which
// is found out where they are a packing, or if that is asked for. If all is right, they are those of the packing,
// unless that uses more of the pages already.
inline Chart_bending::Faults Chart_bending::take(Elastic_charts& charts, bool checks_maps)
{
  constexpr double stiffer = 8.;
  Page_check check(m_options, m_packing.pages);
  for(std::size_t i = 0; i < m_maps.size(); ++i) { // border vertices stay there when flips are repaired
    const auto place = [&](Vertex_index v) { return m_nets[i].place(v, charts.points()); };
    check.add(outline_at(m_maps[i], place), m_packing.placements[i].page);
  }
  charts.widen_gaps(check.faults(), 0.5 * m_sizes.unit);
  if(!check.faults().empty() && !checks_maps)
    return {check.faults().size(), 0};
  std::vector<std::vector<Point_2>> places(m_maps.size());
  std::vector<Chart_distortion> distortions(m_maps.size());
  std::vector<double> changes(m_maps.size());
  std::vector<char> is_valid(m_maps.size(), 0);
  Blocked_execution::blocked_for(m_maps.size(), 1, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      is_valid[i] = bend(i, charts, places[i], distortions[i]) ? 1 : 0;
      changes[i] = changes_of_length(i, places[i], charts.scale());
    }
  });
  const double all = m_sizes.page.x * m_sizes.page.y * double(m_packing.pages);
  const double before = m_packing.utilisation * all;
  double area = 0., changed = 0.;
  std::size_t invalid = 0;
  const auto spare = [&](std::size_t i) {
    if(!m_nets[i].make_rigid()) {
      m_has_more_affine = m_has_more_affine || m_is_affine[i] == 0;
      m_is_affine[i] = 1;
    }
    charts.stiffen(i, stiffer);
    ++invalid;
  };
  for(std::size_t i = 0; i < m_maps.size(); ++i) {
    area += distortions[i].uv_area;
    changed += changes[i];
    if(!is_valid[i])
      spare(i);
  }
  const double mean = changed / before;
  for(std::size_t i = 0; i < m_maps.size() && mean > most_strain * m_strain; ++i)
    if(is_valid[i] && changes[i] / distortions[i].uv_area * (area / before) >= mean)
      spare(i);
  if(check.faults().size() + invalid > 0)
    return {check.faults().size(), invalid};
  if(area <= before)
    return {0, 0}; // nothing is gained
  const double texels = m_packing.texels_per_unit * std::sqrt(area / before);
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
  return {0, 0};
}

// Bends the charts of a packing so that they are larger, until their lengths are changed by that amount, or
// the pages are full; changes nothing if that comes to nothing. The packing stays one, charts one-to-one and
// within the bound of each. `goes_on` is asked from time to time, and all stays as it was if it says no.
// Returns how much was done: control points times steps.
//
// Complexity: some 30 steps of Newton's method for control points, whose number does not depend on the mesh,
// and linear time for the maps.
inline double bend_charts(const Bending& amount, const Packing_options& options, const Chart_mapping& mapping,
                          const std::function<bool()>& goes_on, std::vector<Mapped_chart>& maps,
                          Packing_result& packing)
{
  return can_be_bent(maps, amount.most_charts)
       ? Chart_bending(amount, options, mapping, goes_on, maps, packing).run() : 0.;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BEND_CHARTS_H
