// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_FILLED_PACKING_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_FILLED_PACKING_H

#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Page_filler.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Packs the charts of an atlas, cut where that fills the pages better, and bent.
class Filled_packing
{
public:
  typedef std::function<Packing_result(const std::vector<Chart_shape>&, const Packing_options&)> Pack;
  typedef std::function<double(std::vector<Mapped_chart>&, Packing_result&, double fineness, bool is_wary)>
    Bend;

  // All of these must outlive this. `pack` gets the options of `pages`, not always as a draft where that is
  // one, and with more or less time.
  // `bend`, which may be empty, is told in how many times finer detail than usual it shall be done, and
  // whether it shall be wary of invalid maps, and returns how much it did; the bounds of charts are those of
  // bent ones then.
  Filled_packing(const Texture_atlas_options& options, const Packing_options& pages,
                 const Chart_mapping& mapping, const Pack& pack, const Bend& bend,
                 std::vector<Mapped_chart>& charts)
    : m_options(options), m_pages(pages), m_mapping(mapping), m_pack(pack), m_bend(bend)
    , m_charts(charts)
  {}

  Packing_result run(bool may_cut)
  {
    m_why_not_used = reason_for_no_cuts(may_cut);
    if(m_why_not_used.empty() && (std::isfinite(m_options.seam_price) || m_options.min_used > 0.))
      cut_and_pack();
    else
      m_packing = pack();
    Packed rigid;
    if(m_pages.is_draft && m_packing.is_ok() && m_packing.utilisation < Page_filler::poor
       && !(m_options.min_used > 0.))
      rigid = copy();
    if(m_bend && m_packing.is_ok())
      bend_until_used();
    if(m_pages.is_draft && m_packing.is_ok() && m_mapping.has_time()) {
      if(!m_is_bent)
        search_in_full();
      else if(m_packing.utilisation < Page_filler::poor && !rigid.charts.empty())
        bend_from_full_search(std::move(rigid));
    }
    if(missing() <= 0.)
      m_why_not_used.clear();
    else if(m_why_not_used.empty())
      m_why_not_used = reason_for_no_more_cuts();
    return std::move(m_packing);
  }

  std::size_t number_of_cuts() const { return m_number_of_cuts; }

  // Why less than `Texture_atlas_options::min_used` of the pages of these charts is used, after `run()`;
  // empty if it is used.
  const std::string& why_not_used() const { return m_why_not_used; }

private:
  static constexpr double little = 0.02; // of the pages, for which much is tried
  static constexpr double much = 0.1;    // of the pages, which a longer search does not find
  static constexpr double finest = 4.;   // of the finenesses of bending

  // What is done in so many seconds, beyond which charts are not bent once more. It is counted in steps, so
  // that the result does not depend on the machine.
  double most_work() const
  {
    constexpr double in_a_second = 5e4, seconds = 50.; // on a usual machine
    return in_a_second * (seconds + m_pages.time_budget);
  }
  bool has_time() const { return m_mapping.has_time() && m_work < most_work(); }

  // Of the pages, to what shall be used.
  double missing() const { return m_options.min_used - m_packing.utilisation; }

  std::string reason_for_no_cuts(bool may_cut) const
  {
    constexpr std::size_t most_charts = 200; // with more there is dust for all gaps
    if(!may_cut)
      return "charts that are given are not cut";
    if(m_charts.size() > most_charts)
      return "more than " + std::to_string(most_charts) + " charts are not cut";
    return m_pages.texels_per_unit > 0. ? "the density of texels is given" : "";
  }

  std::string reason_for_no_more_cuts() const
  {
    if(!m_mapping.has_time())
      return "the time was up";
    if(!has_time())
      return "charts were bent for as long as they may be, which is longer with more time for packing";
    if(m_options.max_charts > 0 && m_charts.size() >= m_options.max_charts)
      return "there are as many charts as there may be";
    return "no further cut of a chart that is tried lets them be packed more densely";
  }

  Packing_result pack(bool may_be_draft = true)
  {
    std::vector<Chart_shape> shapes;
    for(const Mapped_chart& map : m_charts)
      shapes.push_back({map.uv, map.chart.mesh.triangles});
    m_is_bent = false;
    constexpr double moment = 0.05; // seconds, which hardly make drafts better
    Packing_options options = m_pages;
    options.is_draft = m_pages.is_draft && may_be_draft && !(m_more_time > 0.);
    options.time_budget
      = options.is_draft ? (std::max)(0., m_pages.time_budget - moment) : m_pages.time_budget + m_more_time;
    return m_pack(shapes, options);
  }

  // Takes a packing that is no draft, if it is denser.
  void search_in_full()
  {
    Packing_result packing = pack(false);
    if(!packing.is_ok() || packing.utilisation > m_packing.utilisation)
      m_packing = std::move(packing);
  }

  void cut_and_pack()
  {
    constexpr std::size_t most_cuts = 16;
    constexpr double least_gain = 0.005, all = 1.;
    constexpr double safe = 0.06; // gains that are not lost to what the estimate does not know
    const double most_work = 1e8 + 2e4 * double(number_of_triangles(m_charts)); // a tenth of a second, and more
    Page_filler filler(m_charts, m_pages, m_mapping);
    if(std::isfinite(m_options.seam_price)) {
      const double used = filler.used();
      std::vector<Mapped_chart> whole = m_charts;
      m_number_of_cuts
        = filler.run({m_options.seam_price, least_gain, all, most_cuts, m_options.max_charts, most_work});
      m_packing = pack();
      if(m_number_of_cuts > 0 && filler.used() < used + safe && m_packing.is_ok())
        take_if_better(std::move(whole));
    } else {
      m_packing = pack();
    }
    if(m_bend || !m_packing.is_ok() || missing() <= 0.)
      return; // charts that bend are cut for that only where bending does not do
    if(m_number_of_cuts > 0) {
      cut_until_used(filler, m_options.min_used);
    } else { // the charts are not those of the filler any more
      Page_filler anew(m_charts, m_pages, m_mapping);
      cut_until_used(anew, m_options.min_used);
    }
  }

  struct Packed
  {
    std::vector<Mapped_chart> charts;
    Packing_result packing;
    std::size_t cuts = 0;
    bool is_bent = false;
  };

  Packed copy() const { return {m_charts, m_packing, m_number_of_cuts, m_is_bent}; }
  Packed release() { return {std::move(m_charts), std::move(m_packing), m_number_of_cuts, m_is_bent}; }

  void take(Packed packed)
  {
    m_charts = std::move(packed.charts);
    m_packing = std::move(packed.packing);
    m_number_of_cuts = packed.cuts;
    m_is_bent = packed.is_bent;
  }

  // Charts that were packed as a draft, and bent, are packed in full and bent from there; what is denser remains.
  void bend_from_full_search(Packed rigid)
  {
    Packed bent = release();
    take(std::move(rigid));
    m_packing = pack(false);
    if(m_packing.is_ok())
      bend_until_used();
    if(!m_packing.is_ok() || m_packing.utilisation < bent.packing.utilisation)
      take(std::move(bent));
  }

  // Bends and cuts the charts; if then less is used than shall be, but not by much, does so once more from a
  // packing that is searched for longer. The best of all remains.
  void bend_until_used()
  {
    constexpr std::size_t most_charts = 64; // with more, it hardly becomes denser
    constexpr double seconds = 2.;
    if(!(m_options.min_used > 0.))
      return bend_and_cut();
    Packed start = copy();
    bend_and_cut();
    if(!m_packing.is_ok() || missing() <= 0. || missing() > much || !m_why_not_used.empty()
       || start.charts.size() > most_charts || !has_time())
      return;
    Packed best = release();
    take(std::move(start));
    m_more_time = seconds;
    m_packing = pack();
    if(m_packing.is_ok())
      bend_and_cut();
    if(m_packing.is_ok() && m_packing.utilisation < best.packing.utilisation)
      take(std::move(best));
  }

  // Bends the charts; if then less is used than shall be, cuts them as they were before to where they are
  // fuller by what is missing, and bends these. Where little is missing they are bent warily before they are cut.
  // The best of all remains.
  void bend_and_cut()
  {
    const int most_cut = m_why_not_used.empty() && m_options.min_used > 0. ? 2 : 0; // times
    bool is_wary = false;
    Packed best;
    for(int times_cut = 0; m_packing.is_ok();) {
      Packed rigid;
      if(m_options.min_used > 0.)
        rigid = copy();
      set_bounds();
      bend_again(is_wary);
      if(!m_packing.is_ok())
        return;
      if(m_packing.utilisation < best.packing.utilisation)
        take(std::move(best));
      const double more = missing();
      is_wary = !is_wary && more < little;
      if(more <= 0. || !has_time() || (!is_wary && times_cut == most_cut))
        return;
      best = release();
      const double before = rigid.packing.utilisation;
      take(std::move(rigid));
      if(is_wary)
        continue;
      ++times_cut;
      Page_filler filler(m_charts, m_pages, m_mapping);
      cut_until_used(filler, before + more);
      if(m_packing.is_ok() && m_packing.utilisation <= before)
        return take(std::move(best));
    }
  }

  // Bent charts stay within the bound, or hardly further beyond it than they were.
  void set_bounds()
  {
    constexpr double any = (std::numeric_limits<double>::infinity)(), beyond = 1.05;
    const auto most = [](double bound, double before) { return before > bound ? beyond * before : bound; };
    for(Mapped_chart& map : m_charts) {
      const Chart_distortion& d = map.report.distortion;
      map.bound = {any, any};
      if(m_mapping.is_bounded)
        map.bound = {most(m_mapping.bound.area_scale, d.area_scale),
                     most(m_mapping.bound.quasi_conformal, d.quasi_conformal)};
    }
  }

  // Details are finer on larger pages, of which all else takes longer, too.
  double usual_fineness() const
  {
    constexpr double usual_side = 1024.;
    const double side = double((std::max)(m_pages.width, m_pages.height));
    return std::clamp(std::sqrt(side / usual_side), 1., finest);
  }

  // Bent charts are bent again, from where they are then, while that helps and less is used than shall be. In
  // finer detail charts fill more, but thin triangles can do less; so where it does not help they go on in
  // still finer detail, and from the finest one in the coarsest; where little is missing, the other way about
  // being wary. Where nothing is missing they are bent once, and in the coarsest detail if that does not help.
  void bend_again(bool is_wary)
  {
    constexpr double least_gain = 0.001;
    constexpr int most_bendings = 32, ways = 3; // one way for each fineness
    double fineness = usual_fineness();
    for(int i = 0, in_vain = 0; i < most_bendings && has_time(); ++i) {
      const double before = m_packing.utilisation;
      m_work += m_bend(m_charts, m_packing, fineness, is_wary != (in_vain >= ways));
      m_is_bent = m_is_bent || m_packing.utilisation > before;
      in_vain = m_packing.utilisation < before + least_gain ? in_vain + 1 : 0;
      for(Mapped_chart& map : m_charts) // may bend again where stretching some of them came to nothing
        map.is_affine = map.is_affine && in_vain == 0;
      if(!m_packing.is_ok())
        return;
      if(missing() <= 0.) {
        if(in_vain == 0 || i > 0 || fineness <= 1.)
          return;
        fineness = 1.;
        continue;
      }
      if(in_vain >= (missing() < little ? 2 * ways : ways))
        return;
      if(in_vain == 0)
        fineness = (std::max)(fineness, 2.);
      else
        fineness = fineness < finest ? (std::min)(finest, 2. * fineness) : 1.;
    }
  }

  // The charts without cuts, if they fill the pages as well.
  void take_if_better(std::vector<Mapped_chart> whole)
  {
    whole.swap(m_charts);
    Packing_result packing = pack();
    if(packing.is_ok() && packing.utilisation < m_packing.utilisation) {
      whole.swap(m_charts);
      return;
    }
    m_packing = std::move(packing);
    m_number_of_cuts = 0;
  }

  // Some cuts, which only help together, and a packing, until so much is used or no more of it is.
  void cut_until_used(Page_filler& filler, double goal)
  {
    constexpr int failures_allowed = 3;
    constexpr std::size_t most_cuts = 4;
    constexpr double least_gain = -0.02, clearly_more = 0.002;
    constexpr double any_work = (std::numeric_limits<double>::infinity)();
    std::vector<Mapped_chart> best = m_charts;
    std::size_t number = m_number_of_cuts;
    for(int failures = 0; failures < failures_allowed && m_mapping.has_time()
                          && m_packing.utilisation < goal;) {
      const std::size_t cuts
        = filler.run({0., least_gain, 1., most_cuts, m_options.max_charts, any_work});
      if(cuts == 0)
        break;
      number += cuts;
      Packing_result packing = pack();
      if(!packing.is_ok()) {
        m_packing = std::move(packing);
        return;
      }
      failures = packing.utilisation > m_packing.utilisation + clearly_more ? 0 : failures + 1;
      if(packing.utilisation <= m_packing.utilisation)
        continue;
      m_packing = std::move(packing);
      best = m_charts;
      m_number_of_cuts = number;
    }
    m_charts = std::move(best);
  }

  const Texture_atlas_options& m_options;
  const Packing_options& m_pages;
  const Chart_mapping& m_mapping;
  const Pack& m_pack;
  const Bend& m_bend;
  std::vector<Mapped_chart>& m_charts;
  Packing_result m_packing;
  std::size_t m_number_of_cuts = 0;
  bool m_is_bent = false;
  double m_more_time = 0.; // for packings, in seconds
  double m_work = 0.;      // of bending
  std::string m_why_not_used;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_FILLED_PACKING_H
