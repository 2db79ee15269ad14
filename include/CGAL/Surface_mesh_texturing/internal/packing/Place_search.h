// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PLACE_SEARCH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PLACE_SEARCH_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Where the lower left corner of a chart lies.
struct Raster_place
{
  std::uint32_t page = 0;
  int rotation = -1; // -1: nowhere
  int x = 0, y = 0;  // in cells

  bool is_found() const { return rotation >= 0; }
};

// What makes a place better than others.
enum class Place_criterion
{
  SNUG, // the most of the rim of the chart is taken; among these the one nearest to the corner
  LOW   // its top is the lowest; among these the leftmost
};

// The best place found so far, and the search for a better one.
class Place_search
{
  typedef std::pair<std::int64_t, std::int64_t> Score; // lower is better

public:
  explicit Place_search(Place_criterion criterion) : m_criterion(criterion) {}

  const Raster_place& best() const { return m_best; }

  // Looks at all places on a page.
  void search(const Chart_raster& chart, const Page_raster& page, std::uint32_t page_index,
              int rotation)
  {
    search_near(chart, page, {page_index, rotation, 0, 0}, page.width() + page.height());
  }

  // Looks at the places up to `radius` away from `centre` along rows and columns.
  void search_near(const Chart_raster& chart, const Page_raster& page, const Raster_place& centre,
                   int radius);

private:
  void rank_row(const Chart_raster& chart, const Page_raster& page, const Word* free, int begin, int end,
                Raster_place place);
  void rank_snug(const Chart_raster& chart, const Page_raster& page, Raster_place place);

  void keep(const Raster_place& place, const Score& score)
  {
    if(score < m_score) {
      m_score = score;
      m_best = place;
    }
  }

  Place_criterion m_criterion;
  Raster_place m_best;
  Score m_score = {(std::numeric_limits<std::int64_t>::max)(), 0};
  std::vector<Word> m_free; // positions of some rows
};

inline void Place_search::search_near(const Chart_raster& chart, const Page_raster& page,
                                      const Raster_place& centre, int radius)
{
  if(chart.width == 0)
    return;
  const int left = (std::max)(0, centre.x - radius), bottom = (std::max)(0, centre.y - radius);
  const int right = (std::min)(page.width() - chart.width, centre.x + radius);
  const int top = (std::min)(page.height() - chart.height, centre.y + radius);
  if(left > right)
    return;
  const int words = page.words(), first = left >> 6, last = right >> 6;
  // Rows half of whose words are looked at are compared many at a time, and with all their words.
  constexpr int words_at_a_time = 32;
  const bool are_whole = 2 * (last + 1 - first) >= words && words <= words_at_a_time;
  const int rows = are_whole ? words_at_a_time / words : 1;
  m_free.resize(std::size_t(words) * rows);
  Texel_mask all(page.width(), 1);
  all.add({0, left, right + 1});
  Raster_place place = centre;
  for(int y = bottom; y <= top; y += rows) {
    if(m_criterion == Place_criterion::LOW && y + chart.height > m_score.first)
      return;
    const int end = (std::min)(top + 1, y + rows);
    for(int k = 0; k < end - y; ++k)
      std::copy_n(all.row(0), words, m_free.begin() + std::ptrdiff_t(words) * k);
    if(are_whole && !page.restrict_to_free(chart.probes, y, end, m_free.data()))
      continue;
    for(place.y = y; place.y < end; ++place.y) {
      int from = first, to = last + 1;
      if(are_whole || page.restrict_to_free(chart.probes, y, m_free.data(), from, to))
        rank_row(chart, page, m_free.data() + std::ptrdiff_t(words) * (place.y - y), from, to, place);
    }
  }
}

// Ranks the places of a row of which the words [begin, end) may have some that are free.
inline void Place_search::rank_row(const Chart_raster& chart, const Page_raster& page, const Word* free,
                                   int begin, int end, Raster_place place)
{
  for(int i = begin; i < end; ++i) {
    if(free[i] == 0)
      continue;
    if(m_criterion == Place_criterion::LOW) {
      place.x = 64 * i + lowest_bit(free[i]);
      return keep(place, {place.y + chart.height, place.x});
    }
    // Only the ends of the runs of free positions: elsewhere the chart can move to both sides
    const Word before = free[i] << 1 | (i > begin ? free[i - 1] >> 63 : 0);
    const Word after = free[i] >> 1 | (i + 1 < end ? free[i + 1] << 63 : 0);
    for(Word ends = free[i] & ~(before & after); ends != 0; ends &= ends - 1) {
      place.x = 64 * i + lowest_bit(ends);
      rank_snug(chart, page, place);
    }
  }
}

inline void Place_search::rank_snug(const Chart_raster& chart, const Page_raster& page,
                                    Raster_place place)
{
  constexpr std::int64_t all = 1 << 20;
  const std::int64_t n = std::int64_t(chart.rim.size());
  // More free cells than this are worse, as a part of the rim, than the best
  const std::int64_t allowed = m_best.is_found() ? (m_score.first + 1) * n / all : n;
  constexpr int block = 16;
  std::int64_t free = 0;
  for(std::size_t i = 0; i < chart.rim.size() && free <= allowed; i += block) {
    const int* offsets = chart.rim.data() + i;
    const int left = int((std::min)(chart.rim.size() - i, std::size_t(block)));
    // a fixed number is unrolled
    free += left - (left == block ? page.number_of_taken(offsets, block, place.x, place.y)
                                  : page.number_of_taken(offsets, left, place.x, place.y));
  }
  if(free > allowed)
    return;
  const std::int64_t right = std::int64_t(place.x + chart.width) * page.height();
  const std::int64_t top = std::int64_t(place.y + chart.height) * page.width();
  keep(place, {free * all / n, (std::max)(right, top)});
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PLACE_SEARCH_H
