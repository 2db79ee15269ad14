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
  std::vector<Word> m_free; // positions of a row
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
  m_free.resize(page.words());
  Texel_mask all(page.width(), 1);
  all.add({0, left, right + 1});
  Raster_place place = centre;
  for(place.y = bottom; place.y <= top; ++place.y) {
    if(m_criterion == Place_criterion::LOW && place.y + chart.height > m_score.first)
      return;
    int begin = left >> 6, end = (right >> 6) + 1;
    std::copy(all.row(0) + begin, all.row(0) + end, m_free.begin() + begin);
    if(!page.restrict_to_free(chart.probes, place.y, m_free.data(), begin, end))
      continue;
    if(m_criterion == Place_criterion::LOW) {
      place.x = 64 * begin + lowest_bit(m_free[begin]);
      keep(place, {place.y + chart.height, place.x});
      continue;
    }
    // Only the ends of the runs of free positions: elsewhere the chart can move to both sides
    for(int i = begin; i < end; ++i) {
      const Word before = m_free[i] << 1 | (i > begin ? m_free[i - 1] >> 63 : 0);
      const Word after = m_free[i] >> 1 | (i + 1 < end ? m_free[i + 1] << 63 : 0);
      for(Word ends = m_free[i] & ~(before & after); ends != 0; ends &= ends - 1) {
        place.x = 64 * i + lowest_bit(ends);
        rank_snug(chart, page, place);
      }
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
  std::int64_t free = 0;
  const int *offset = chart.rim.data(), *end = offset + chart.rim.size();
  for(int block; offset != end; offset += block) {
    block = int((std::min)(std::ptrdiff_t(16), end - offset));
    free += block - page.number_of_taken(offset, offset + block, place.x, place.y);
    if(free > allowed)
      return;
  }
  const std::int64_t right = std::int64_t(place.x + chart.width) * page.height();
  const std::int64_t top = std::int64_t(place.y + chart.height) * page.width();
  keep(place, {free * all / n, (std::max)(right, top)});
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PLACE_SEARCH_H
