// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_OVERLAP_SEARCH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_OVERLAP_SEARCH_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Arrangement.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_outline.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What a cell counts in which two charts overlap: the more, the longer they have done so.
class Pair_weights
{
public:
  explicit Pair_weights(std::size_t charts) : m_size(charts), m_weights(charts * charts, unit) {}

  int operator()(std::size_t i, std::size_t j) const { return m_weights[i * m_size + j]; }

  void reset() { std::fill(m_weights.begin(), m_weights.end(), int(unit)); }

  // The pair that overlaps the most becomes twice as heavy.
  void raise(const Arrangement& a)
  {
    constexpr int heaviest_allowed = 2000; // sums of weights over all cells must be integers
    int most = 0, heaviest = 0;
    for(std::size_t i = 0; i < m_size; ++i)
      for(std::size_t j = 0; j < i; ++j)
        most = (std::max)(most, a.overlap_of(i, j));
    for(std::size_t i = 0; i < m_size; ++i)
      for(std::size_t j = 0; j < i; ++j) {
        int& w = m_weights[i * m_size + j];
        const std::int64_t cells = a.overlap_of(i, j);
        w = cells > 0 ? int(w * 6 / 5 + 4 * w * cells / (5 * most)) + 1
                      : (std::max)(int(unit), w * 19 / 20);
        m_weights[j * m_size + i] = w;
        heaviest = (std::max)(heaviest, w);
      }
    if(heaviest > heaviest_allowed)
      for(int& w : m_weights)
        w = (std::max)(1, w / 4);
  }

private:
  static constexpr int unit = 16;

  std::size_t m_size;
  std::vector<int> m_weights; // of each pair, twice
};

// What searches at all densities share.
struct Overlap_search_base
{
  Silhouettes coarse;   // of about the densities that are searched
  Packing_raster exact;
  std::size_t pages;
  Xorshift random;
  double& work;         // counts about the nanoseconds; must outlive this
};

// Moves charts at a fixed density, one at a time to where it overlaps the others the least, until
// none overlap. Overlaps that remain get heavier (guided local search: Egeblad, Nielsen and
// Odgaard, Fast neighborhood search for two- and three-dimensional nesting problems, EJOR 2007).
class Overlap_search
{
public:
  // `base` must outlive this. On its coarse raster all places are looked at.
  Overlap_search(Overlap_search_base& base, double density)
    : m_base(base), m_middle(silhouettes(density, (std::max)(1, base.coarse.raster().ratio / 4))),
      m_half(silhouettes(density, 2)), m_exact(silhouettes(density, 1)),
      m_weights(base.coarse.size())
  {}

  Silhouettes& exact() { return m_exact; }

  // Moves charts until none overlap on the middle raster, with any moves; returns whether there is
  // such a state, and otherwise leaves that with the least overlap. Gives up when
  // `may_go_on()` says no.
  template <class May_go_on>
  bool separate(std::vector<Loose_place>& places, const May_go_on& may_go_on)
  {
    return settle(m_middle, places, 40, may_go_on, &Overlap_search::move_anywhere);
  }

  // The same on the exact raster, with small moves only: the charts are then far enough from each
  // other.
  template <class May_go_on>
  bool finish(std::vector<Loose_place>& places, const May_go_on& may_go_on)
  {
    if(m_middle.raster().ratio > 2)
      settle(m_half, places, 10, may_go_on, &Overlap_search::slide);
    return settle(m_exact, places, 10, may_go_on, &Overlap_search::slide);
  }

private:
  typedef void (Overlap_search::*Move)(Arrangement&, std::size_t);

  Silhouettes silhouettes(double density, int ratio) const
  {
    return Silhouettes(m_base.coarse.outlines(), m_base.coarse.rotations(), density,
                       Silhouette_raster(m_base.exact, ratio), m_base.work);
  }

  struct Candidate
  {
    int overlap;
    Raster_place place;
    bool operator<(const Candidate& o) const { return overlap < o.overlap; }
  };

  template <class May_go_on>
  bool settle(Silhouettes& silhouettes, std::vector<Loose_place>& places, int patience,
              const May_go_on& may_go_on, Move move);
  template <class May_go_on>
  void sweep(Arrangement& a, const May_go_on& may_go_on, Move move);

  void move_anywhere(Arrangement& a, std::size_t chart);
  std::vector<Candidate> coarse_candidates(Arrangement& a, std::size_t chart, int most);
  void add_others(std::size_t chart, std::uint32_t page, Arrangement& a, Silhouettes& s);
  void search(const Silhouette& s, Raster_place place, int right, int top, Candidate& best);
  void search_near(std::size_t chart, const Raster_place& centre, int radius, Arrangement& a,
                   Candidate& best);

  void slide(Arrangement& a, std::size_t chart);
  std::int64_t weighted_overlap(Arrangement& a, std::size_t chart, const Raster_place& place,
                                const std::vector<std::size_t>& others);

  Overlap_search_base& m_base;
  Silhouettes m_middle, m_half, m_exact;
  Pair_weights m_weights;
  Overlap_field m_field;
  std::vector<int> m_row;
};

// Gives up after `patience` sweeps without less overlap than ever before.
template <class May_go_on>
bool Overlap_search::settle(Silhouettes& silhouettes, std::vector<Loose_place>& places,
                            int patience, const May_go_on& may_go_on, Move move)
{
  Arrangement arrangement(silhouettes);
  m_weights.reset();
  arrangement.set(places);
  if(!arrangement.is_possible())
    return false;
  std::int64_t best = arrangement.total_overlap();
  if(best == 0)
    places = arrangement.loose_places();
  for(int idle = 0; best > 0 && idle < patience && may_go_on(); ++idle) {
    sweep(arrangement, may_go_on, move);
    if(arrangement.total_overlap() < best) {
      best = arrangement.total_overlap();
      places = arrangement.loose_places();
      idle = 0;
    }
  }
  return best == 0;
}

// Moves each chart that overlaps others, in any order.
template <class May_go_on>
void Overlap_search::sweep(Arrangement& a, const May_go_on& may_go_on, Move move)
{
  std::vector<std::size_t> order;
  for(std::size_t i = 0; i < a.size(); ++i)
    if(a.overlap_of(i) > 0)
      order.push_back(i);
  for(std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[m_base.random.index(i)]);
  for(const std::size_t i : order)
    if(a.overlap_of(i) > 0 && may_go_on())
      (this->*move)(a, i);
  m_weights.raise(a);
}

inline void Overlap_search::add_others(std::size_t chart, std::uint32_t page, Arrangement& a,
                                       Silhouettes& s)
{
  const bool is_same = &a.silhouettes() == &s;
  for(std::size_t j = 0; j < a.size(); ++j) {
    if(j == chart || a.place(j).page != page)
      continue;
    const Raster_place p
      = is_same ? a.place(j) : s.raster_place(j, a.silhouettes().loose_place(j, a.place(j)));
    const Silhouette& other = s(j, p.rotation);
    m_field.add(other, p.x, p.y, m_weights(chart, j));
    m_base.work += double(other.runs.size());
  }
  m_field.integrate();
}

// Looks at the places from `place` to (right, top); keeps one that is better.
inline void Overlap_search::search(const Silhouette& s, Raster_place place, int right, int top,
                                   Candidate& best)
{
  const int left = place.x, n = right - left + 1;
  m_row.resize(n);
  std::size_t runs = 0;
  for(; place.y <= top; ++place.y) {
    if(m_field.overlaps(s, left, place.y, n, best.overlap - 1, m_row.data(), runs) >= best.overlap)
      continue;
    for(int k = 0; k < n; ++k)
      if(m_row[k] < best.overlap) {
        place.x = left + k;
        best = {m_row[k], place};
      }
  }
  m_base.work += 0.25 * n * double(runs);
}

// The best place for each of the best directions, at which less than `most` overlaps. Of many directions
// every eighth is tried, others each time.
inline std::vector<Overlap_search::Candidate>
Overlap_search::coarse_candidates(Arrangement& a, std::size_t chart, int most)
{
  constexpr std::size_t number = 6;
  constexpr int many = 24;
  const std::size_t apart = m_base.coarse.rotations() < many ? 1 : 8;
  std::vector<Candidate> result;
  const Silhouette_raster& raster = m_base.coarse.raster();
  for(std::size_t page = 0; page < m_base.pages; ++page) {
    m_field.reset(0, 0, raster.width, raster.height);
    m_base.work += double(raster.width) * raster.height;
    add_others(chart, std::uint32_t(page), a, m_base.coarse);
    for(int r = int(m_base.random.index(apart)); r < m_base.coarse.rotations(); r += int(apart)) {
      const Silhouette& s = m_base.coarse(chart, r);
      if(s.width == 0 || s.width > raster.width || s.height > raster.height)
        continue;
      Candidate best = {most, Raster_place()};
      if(result.size() == number)
        best.overlap = (std::min)(most, result.back().overlap);
      search(s, {std::uint32_t(page), r, 0, 0}, raster.width - s.width, raster.height - s.height,
             best);
      if(!best.place.is_found())
        continue;
      result.insert(std::upper_bound(result.begin(), result.end(), best), best);
      if(result.size() > number)
        result.pop_back();
    }
  }
  return result;
}

inline void Overlap_search::search_near(std::size_t chart, const Raster_place& centre, int radius,
                                        Arrangement& a, Candidate& best)
{
  Silhouettes& all = a.silhouettes();
  const Silhouette& s = all(chart, centre.rotation);
  const int left = (std::max)(0, centre.x - radius), bottom = (std::max)(0, centre.y - radius);
  const int right = (std::min)(all.raster().width - s.width, centre.x + radius);
  const int top = (std::min)(all.raster().height - s.height, centre.y + radius);
  if(s.width == 0 || left > right || bottom > top)
    return;
  const int width = right - left + s.width, height = top - bottom + s.height;
  m_field.reset(left, bottom, width, height);
  m_base.work += double(width) * height;
  add_others(chart, centre.page, a, all);
  search(s, {centre.page, centre.rotation, left, bottom}, right, top, best);
}

inline void Overlap_search::move_anywhere(Arrangement& a, std::size_t chart)
{
  constexpr int reach = 6;
  constexpr int rounding = 30; // in about two cells of the coarse raster
  const int radius = m_base.coarse.raster().ratio / m_middle.raster().ratio;
  Candidate best = {(std::numeric_limits<int>::max)() / 2, a.place(chart)};
  search_near(chart, a.place(chart), reach, a, best);
  const int most = best.overlap / (radius * radius) + rounding; // others are no better than that nearby
  for(const Candidate& c : coarse_candidates(a, chart, most)) {
    const Loose_place place = m_base.coarse.loose_place(chart, c.place);
    search_near(chart, m_middle.raster_place(chart, place), radius, a, best);
  }
  a.move(chart, best.place);
}

inline std::int64_t Overlap_search::weighted_overlap(Arrangement& a, std::size_t chart,
                                                     const Raster_place& place,
                                                     const std::vector<std::size_t>& others)
{
  std::int64_t sum = 0;
  const Silhouette& s = a.silhouettes()(chart, place.rotation);
  for(const std::size_t j : others) {
    const Raster_place& q = a.place(j);
    const int cells = overlap(s, a.silhouettes()(j, q.rotation), q.x - place.x, q.y - place.y);
    sum += std::int64_t(m_weights(chart, j)) * cells;
    m_base.work += 0.5 * s.height;
  }
  return sum;
}

// Moves a chart cell by cell as long as it overlaps less.
inline void Overlap_search::slide(Arrangement& a, std::size_t chart)
{
  constexpr int most = 8;
  const Raster_place from = a.place(chart);
  const Silhouette& s = a.silhouettes()(chart, from.rotation);
  const Silhouette_raster& raster = a.silhouettes().raster();
  const std::vector<std::size_t> others = a.neighbours(chart, most);
  Raster_place best = from;
  std::int64_t least = weighted_overlap(a, chart, best, others);
  for(int steps = 0; steps < most && least > 0; ++steps) {
    const Raster_place centre = best;
    for(int i = 0; i < 9; ++i) {
      Raster_place place = centre;
      place.x += i % 3 - 1;
      place.y += i / 3 - 1;
      if(i == 4 || place.x < 0 || place.y < 0 || place.x + s.width > raster.width
         || place.y + s.height > raster.height)
        continue;
      const std::int64_t here = weighted_overlap(a, chart, place, others);
      if(here < least) {
        least = here;
        best = place;
      }
    }
    if(best.x == centre.x && best.y == centre.y)
      break;
  }
  a.move(chart, best);
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_OVERLAP_SEARCH_H
