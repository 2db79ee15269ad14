// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_PAGE_FILLER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_PAGE_FILLER_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Chart_parts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Cuts charts where that lets them be packed more densely. Their maps are kept.
class Page_filler
{
public:
  static constexpr double poor = 0.7; // of the pages: where less is used, more is tried

  // What a cut must gain.
  struct Terms
  {
    double seam_price;  // part of the pages for a cut as long as a page's side
    double least_gain;  // part of the pages beyond that; less than 0 to go on through what is worse
    double enough;      // no cut is needed once this part of the pages is used
    std::size_t most_cuts;
    std::size_t most_charts; // 0 for any number
    double most_work;        // see `Packing_estimate::work()`
  };

  // All of these must outlive this. `is_over()` says when to stop.
  Page_filler(std::vector<Mapped_chart>& charts, const Packing_options& packing,
              const Chart_mapping& mapping);

  // Cuts until no cut is worth while; returns the number of cuts.
  std::size_t run(const Terms& terms);

  // The part of the pages that is used, about: final packings are denser.
  double used() const { return Packing_estimate::used(m_level); }

private:
  struct Candidate
  {
    std::size_t chart, cut;
    int level = 0;    // of the packing with this cut
    double gain = 0.; // beyond the price
  };

  bool cut_once(const Terms& terms);
  bool cut_twice(const Terms& terms);
  std::vector<Candidate> candidates();
  void estimate(const Terms& terms, std::vector<Candidate>& candidates) const;
  std::vector<Mapped_chart> parts_of(const Cut_sides& sides, const Mapped_chart& whole,
                                     const Triangle_adjacency& adjacency) const;
  std::vector<Packable> shapes_with(std::size_t chart, const std::vector<Packable>& parts) const;
  bool apply(const Terms& terms, const Candidate& candidate);

  bool may_go_on() const { return m_mapping.has_time() && m_estimate.work() < m_most_work; }

  // The length of a cut in sides of a page.
  double in_sides(double length) const { return length * m_estimate.density(m_level) / m_side; }

  std::vector<Mapped_chart>& m_charts;
  const Chart_mapping& m_mapping;
  double m_unit, m_side; // of the outlines; of a page, in texels
  std::vector<Packable> m_shapes;
  struct Cuts
  {
    std::vector<Chart_cut> cuts;
    std::unique_ptr<Triangle_adjacency> adjacency; // of the chart, if there are any
    bool are_known = false;
  };
  std::vector<Cuts> m_cuts; // of each chart
  Packing_estimate m_estimate;
  int m_level = 0;      // of the packing so far
  double m_most_work = 0.;
  double m_paid = 0.;   // for seams, in parts of the pages
};

// The largest extent of a chart.
inline double extent_of(const std::vector<Mapped_chart>& charts)
{
  double result = 0.;
  for(const Mapped_chart& map : charts)
    for(int c = 0; c < 2; ++c) {
      const auto less = [c](const Point_2& p, const Point_2& q) { return p[c] < q[c]; };
      const auto ends = std::minmax_element(map.uv.begin(), map.uv.end(), less);
      if(!map.uv.empty())
        result = (std::max)(result, (*ends.second)[c] - (*ends.first)[c]);
    }
  return result > 0. ? result : 1.;
}

inline Packable shape_of(const Mapped_chart& chart, double unit)
{
  const std::vector<Vector_2d> polygon = Chart_cut_finder(chart, {}, unit).polygon();
  return std::make_shared<Packable_shape>(polygon.empty() ? Chart_outline()
                                                          : polygon_outline(polygon, unit));
}

inline std::vector<Packable> shapes_of(const std::vector<Mapped_chart>& charts, double unit)
{
  std::vector<Packable> result(charts.size());
  Blocked_execution::blocked_for(charts.size(), 1, [&](std::size_t i, std::size_t) {
    result[i] = shape_of(charts[i], unit);
  });
  return result;
}

inline std::size_t number_of_triangles(const std::vector<Mapped_chart>& charts)
{
  std::size_t sum = 0;
  for(const Mapped_chart& map : charts)
    sum += map.chart.mesh.triangles.size();
  return sum;
}

inline double area_of(const std::vector<Packable>& shapes)
{
  double sum = 0.;
  for(const Packable& shape : shapes)
    sum += shape->outline().area;
  return sum;
}

inline Page_filler::Page_filler(std::vector<Mapped_chart>& charts, const Packing_options& packing,
                                const Chart_mapping& mapping)
  : m_charts(charts), m_mapping(mapping), m_unit(extent_of(charts)),
    m_side(std::sqrt(double(packing.width) * double(packing.height))),
    m_shapes(shapes_of(charts, m_unit)), m_cuts(charts.size()),
    m_estimate(packing, area_of(m_shapes), charts.size(), number_of_triangles(charts))
{
  constexpr int lowest = -64 * 8, step = 16;
  for(m_level = -step; m_level > lowest; m_level -= step) {
    const int found = m_estimate.highest_level(m_shapes, m_level);
    if(found >= m_level) {
      m_level = found;
      return;
    }
  }
}

inline std::size_t Page_filler::run(const Terms& terms)
{
  std::size_t cuts = 0;
  m_most_work = m_estimate.work() + terms.most_work;
  const auto may_cut = [&](std::size_t more) {
    return cuts + more <= terms.most_cuts && used() < terms.enough
        && (terms.most_charts == 0 || m_charts.size() + more <= terms.most_charts) && may_go_on();
  };
  while(may_cut(1))
    if(cut_once(terms))
      ++cuts;
    else if(terms.least_gain > 0. && used() < poor && may_cut(2) && cut_twice(terms))
      cuts += 2;
    else
      break;
  return cuts;
}

// Makes two cuts that gain enough together where one alone does not; else the charts are as before.
inline bool Page_filler::cut_twice(const Terms& terms)
{
  constexpr double most_lost = 0.04; // by the first one, of the pages
  const std::vector<Mapped_chart> charts = m_charts;
  const std::vector<Packable> shapes = m_shapes;
  const double paid = m_paid, before = used();
  const int level = m_level;
  Terms first = terms, second = terms;
  first.least_gain = -most_lost;
  if(cut_once(first)) {
    second.least_gain = 2. * terms.least_gain + before - used() + m_paid - paid;
    if(cut_once(second))
      return true;
  }
  m_charts = charts;
  m_shapes = shapes;
  m_cuts.clear();
  m_cuts.resize(charts.size());
  m_paid = paid;
  m_level = level;
  return false;
}

// The cuts of the charts with the largest diameters.
inline std::vector<Page_filler::Candidate> Page_filler::candidates()
{
  constexpr std::size_t most_charts = 4;
  std::vector<std::size_t> largest(m_charts.size());
  std::iota(largest.begin(), largest.end(), std::size_t(0));
  std::stable_sort(largest.begin(), largest.end(), [this](std::size_t i, std::size_t j) {
    return m_shapes[i]->outline().diameter > m_shapes[j]->outline().diameter;
  });
  largest.resize((std::min)(largest.size(), most_charts));
  Blocked_execution::blocked_for(largest.size(), 1, [&](std::size_t i, std::size_t) {
    const std::size_t chart = largest[i];
    if(std::exchange(m_cuts[chart].are_known, true))
      return;
    Chart_cut_finder finder(m_charts[chart], m_charts[chart].chart.entries_of(m_mapping.no_seams), m_unit);
    m_cuts[chart].cuts = finder.find();
    m_cuts[chart].adjacency = finder.take_adjacency();
  });
  std::vector<Candidate> result;
  for(const std::size_t chart : largest)
    for(std::size_t cut = 0; cut < m_cuts[chart].cuts.size(); ++cut)
      if(!m_cuts[chart].cuts[cut].is_rejected)
        result.push_back({chart, cut});
  return result;
}

// Finds what each cut gains, some at a time; those that gain less than the best so far are known no
// better than that.
inline void Page_filler::estimate(const Terms& terms, std::vector<Candidate>& candidates) const
{
  constexpr std::size_t at_a_time = 4;
  double best = terms.least_gain;
  for(std::size_t begin = 0; begin < candidates.size() && may_go_on();
      begin += at_a_time) {
    const std::size_t end = (std::min)(candidates.size(), begin + at_a_time);
    Blocked_execution::blocked_for(end - begin, 1, [&](std::size_t i, std::size_t) {
      Candidate& c = candidates[begin + i];
      const Chart_cut& cut = m_cuts[c.chart].cuts[c.cut];
      const double price = terms.seam_price * in_sides(cut.length);
      const double needed = used() + price + best;
      c.gain = terms.least_gain - 1.;
      const int least = needed < 1. ? Packing_estimate::level_of(needed) : 1;
      if(least > 0)
        return;
      c.level = m_estimate.highest_level(shapes_with(c.chart, {cut.sides[0], cut.sides[1]}), least);
      if(c.level >= least)
        c.gain = Packing_estimate::used(c.level) - used() - price;
    });
    for(std::size_t i = begin; i < end; ++i)
      best = (std::max)(best, candidates[i].gain);
  }
}

// Makes the cut that gains the most, and whose parts can be mapped.
inline bool Page_filler::cut_once(const Terms& terms)
{
  std::vector<Candidate> all = candidates();
  estimate(terms, all);
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  for(const Candidate& c : all) {
    if(!(c.gain >= terms.least_gain))
      return false;
    if(apply(terms, c))
      return true;
  }
  return false;
}

// The parts on both sides of a cut, with the map of the chart at the scales of the sides. A part that is
// beyond the bound alone is mapped anew, or cut further if that is not enough. Nothing if that takes too
// many parts.
inline std::vector<Mapped_chart> Page_filler::parts_of(const Cut_sides& sides, const Mapped_chart& whole,
                                                       const Triangle_adjacency& adjacency) const
{
  constexpr std::size_t most_parts = 5;
  std::array<Mapped_chart, 2> both;
  Blocked_execution::blocked_for(2, 1, [&](std::size_t k, std::size_t) {
    both[k] = part_of(whole, adjacency, sides.triangles[k]);
  });
  const auto is_within = [&](const Chart_distortion& d) { return d.is_within(m_mapping.bound); };
  const bool may_stay = !m_mapping.is_bounded
                     || (!(is_within(both[0].report.distortion) && is_within(both[1].report.distortion))
                         && !is_within(measure_chart_distortion(whole.chart.mesh, whole.uv)));
  std::vector<Mapped_chart> result;
  for(Mapped_chart& part : both) {
    const bool is_good = is_within(part.report.distortion);
    part.report.is_rough = whole.report.is_rough && !is_good;
    if(is_good || may_stay) {
      result.push_back(std::move(part));
      continue;
    }
    Chart_mapping mapping = m_mapping;
    mapping.most_charts = most_parts - result.size() - (&part == &both[0] ? 1 : 0); // another one comes
    std::vector<Mapped_chart> smaller = map_anew(std::move(part.chart), mapping);
    if(smaller.empty())
      return {};
    std::move(smaller.begin(), smaller.end(), std::back_inserter(result));
  }
  for(Mapped_chart& part : result) {
    Chart_distortion& after = part.report.distortion;
    const double scale = std::sqrt(sides.density * (after.area / after.uv_area));
    if(!(scale > 0.) || !std::isfinite(scale))
      return {};
    for(Point_2& p : part.uv)
      p = Point_2(scale * p.x(), scale * p.y());
    after.uv_area *= scale * scale;
  }
  result[0].report.repaired_flips += whole.report.repaired_flips;
  return result;
}

// All shapes where some take the place of a chart's.
inline std::vector<Packable> Page_filler::shapes_with(std::size_t chart,
                                                      const std::vector<Packable>& parts) const
{
  std::vector<Packable> shapes = m_shapes;
  shapes[chart] = parts[0];
  shapes.insert(shapes.end(), parts.begin() + 1, parts.end());
  return shapes;
}

// Makes a cut, if it gains enough with the parts as they are; all but the first become the last charts.
inline bool Page_filler::apply(const Terms& terms, const Candidate& candidate)
{
  Chart_cut& cut = m_cuts[candidate.chart].cuts[candidate.cut];
  cut.is_rejected = true;
  const Mapped_chart& whole = m_charts[candidate.chart];
  const Triangle_adjacency& adjacency = *m_cuts[candidate.chart].adjacency;
  const Cut_sides sides = sides_of(cut, whole, adjacency);
  if(!sides.are_valid())
    return false;
  const double price = terms.seam_price * in_sides(cut.length);
  const int least = Packing_estimate::level_of(used() + price + terms.least_gain);
  std::vector<Packable> of_parts;
  for(int k = 0; k < 2; ++k)
    of_parts.push_back(
      std::make_shared<Packable_shape>(scaled(cut.sides[k]->outline(), sides.scale[k])));
  if(!m_estimate.fits(shapes_with(candidate.chart, of_parts), least))
    return false; // most cuts end here, before the parts are made
  std::vector<Mapped_chart> parts = parts_of(sides, whole, adjacency);
  if(parts.empty())
    return false;
  of_parts.clear();
  for(const Mapped_chart& part : parts)
    of_parts.push_back(shape_of(part, m_unit));
  std::vector<Packable> shapes = shapes_with(candidate.chart, of_parts);
  const int level = m_estimate.highest_level(shapes, least);
  if(level < least)
    return false;
  m_paid += price;
  m_level = level;
  m_shapes = std::move(shapes);
  m_charts[candidate.chart] = std::move(parts[0]);
  std::move(parts.begin() + 1, parts.end(), std::back_inserter(m_charts));
  m_cuts[candidate.chart] = Cuts();
  m_cuts.resize(m_charts.size());
  for(const Packable& shape : m_shapes)
    shape->forget_below(m_level);
  return true;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_PAGE_FILLER_H
