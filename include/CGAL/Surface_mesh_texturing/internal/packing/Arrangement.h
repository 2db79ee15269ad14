// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_ARRANGEMENT_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_ARRANGEMENT_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Place_search.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Silhouette.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The weights of the silhouettes over each cell of a rectangle, summed along its rows, so that
// the weighted overlap of a silhouette at many places is found quickly.
class Overlap_field
{
public:
  // The cells from (x, y) on; nothing is there.
  void reset(int x, int y, int width, int height)
  {
    m_x = x;
    m_y = y;
    m_width = width;
    m_height = height;
    m_sums.assign(std::size_t(width + 1) * height, 0);
  }

  void add(const Silhouette& s, int x, int y, int weight)
  {
    x -= m_x;
    y -= m_y;
    if(x >= m_width || x + s.width <= 0)
      return;
    for(int row = (std::max)(0, -y); row < s.height && row + y < m_height; ++row)
      for(int i = s.row_begin[row]; i < s.row_begin[row + 1]; ++i) {
        const int begin = (std::max)(0, s.runs[i].begin + x);
        const int end = (std::min)(m_width, s.runs[i].end + x);
        if(begin < end) {
          int* sums = m_sums.data() + std::size_t(m_width + 1) * (row + y);
          sums[begin] += weight;
          sums[end] -= weight;
        }
      }
  }

  // To be called between `add()` and `overlaps()`.
  void integrate()
  {
    for(int y = 0; y < m_height; ++y) {
      int* sums = m_sums.data() + std::size_t(m_width + 1) * y;
      int weight = 0, sum = 0;
      for(int x = 0; x <= m_width; ++x) {
        weight += sums[x];
        sums[x] = sum;
        sum += weight;
      }
    }
  }

  // Returns the least overlap at the places x, x + 1 ... x + n - 1 of row y, and the overlaps in
  // `result`; once all are known to be greater than `most`, they are no longer summed. Adds the number
  // of runs that were looked at to `runs`.
  int overlaps(const Silhouette& s, int x, int y, int n, int most, int* result, std::size_t& runs) const
  {
    constexpr std::size_t at_a_time = 4;
    std::fill_n(result, n, 0);
    int least = 0;
    const int* origin = m_sums.data() + std::ptrdiff_t(m_width + 1) * (y - m_y) + (x - m_x);
    for(std::size_t i = 0; i < s.longest_first.size() && least <= most;) {
      const std::size_t end = (std::min)(s.longest_first.size(), i + at_a_time);
      runs += end - i;
      for(; i < end; ++i) {
        const Cell_run& run = s.longest_first[i];
        const int* row = origin + std::ptrdiff_t(m_width + 1) * run.y;
        const int *from = row + run.begin, *to = row + run.end;
        for(int k = 0; k < n; ++k)
          result[k] += to[k] - from[k];
      }
      least = result[0];
      for(int k = 1; k < n; ++k) // some at a time, unlike std::min_element()
        least = (std::min)(least, result[k]);
    }
    return least;
  }

private:
  int m_x = 0, m_y = 0, m_width = 0, m_height = 0;
  std::vector<int> m_sums; // of each row, one more than it has cells
};

// Where the centre of a chart lies, on any raster.
struct Loose_place
{
  std::uint32_t page = 0;
  int rotation = 0;
  Vector_2d centre = {}; // in cells of the finest `Silhouette_raster`
};

// The silhouettes of all charts at one density on one raster, made when they are needed.
class Silhouettes
{
public:
  // The outlines and `work`, to which about the nanoseconds are added, must outlive this.
  Silhouettes(const std::vector<Chart_outline>& outlines, int rotations, double density,
              const Silhouette_raster& raster, double& work)
    : m_outlines(outlines), m_rotations(rotations), m_density(density), m_raster(raster),
      m_work(work), m_silhouettes(outlines.size() * rotations)
  {}

  const std::vector<Chart_outline>& outlines() const { return m_outlines; }
  const Silhouette_raster& raster() const { return m_raster; }
  std::size_t size() const { return m_outlines.size(); }
  int rotations() const { return m_rotations; }

  const Silhouette& operator()(std::size_t chart, int rotation)
  {
    std::unique_ptr<Silhouette>& s = m_silhouettes[chart * m_rotations + rotation];
    if(!s) {
      const Chart_outline& outline = m_outlines[chart];
      const double angle = outline.angle + 2. * CGAL_PI * rotation / m_rotations;
      s.reset(new Silhouette(silhouette(outline, angle, m_density, m_raster)));
      m_work += work_of(outline, *s);
    }
    return *s;
  }

  // The place nearest to another, within the page if the chart has a silhouette.
  Raster_place raster_place(std::size_t chart, const Loose_place& place)
  {
    const Silhouette& s = (*this)(chart, place.rotation);
    Raster_place result;
    result.page = place.page;
    result.rotation = place.rotation;
    constexpr double half = 0.5 - 1e-6; // halves are frequent, and must not depend on rounding
    const int x = int(std::floor(place.centre[0] / m_raster.ratio - s.centre[0] + half));
    const int y = int(std::floor(place.centre[1] / m_raster.ratio - s.centre[1] + half));
    result.x = (std::max)(0, (std::min)(m_raster.width - s.width, x));
    result.y = (std::max)(0, (std::min)(m_raster.height - s.height, y));
    return result;
  }

  Loose_place loose_place(std::size_t chart, const Raster_place& place)
  {
    const Silhouette& s = (*this)(chart, place.rotation);
    Loose_place result;
    result.page = place.page;
    result.rotation = place.rotation;
    result.centre = {m_raster.ratio * (place.x + s.centre[0]),
                     m_raster.ratio * (place.y + s.centre[1])};
    return result;
  }

private:
  // About the nanoseconds: each edge is drawn, each sample is read.
  double work_of(const Chart_outline& outline, const Silhouette& s) const
  {
    std::size_t edges = 0;
    for(const auto& part : outline.parts)
      edges += part.size();
    const double samples = m_raster.ratio == 1 ? 1. : 16.; // of a cell
    return 1e3 + 30. * double(edges) + samples * s.width * s.height;
  }

  const std::vector<Chart_outline>& m_outlines;
  int m_rotations;
  double m_density;
  Silhouette_raster m_raster;
  double& m_work;
  std::vector<std::unique_ptr<Silhouette>> m_silhouettes;
};

// Charts on pages of a raster, which may overlap.
class Arrangement
{
public:
  explicit Arrangement(Silhouettes& silhouettes) : m_silhouettes(silhouettes) {}

  std::size_t size() const { return m_places.size(); }
  Silhouettes& silhouettes() { return m_silhouettes; }
  const Raster_place& place(std::size_t chart) const { return m_places[chart]; }

  // Whether each chart is smaller than a page in the direction it was given.
  bool is_possible() const { return m_is_possible; }

  void set(const std::vector<Loose_place>& places)
  {
    const std::size_t n = places.size();
    m_places.resize(n);
    for(std::size_t i = 0; i < n; ++i)
      m_places[i] = m_silhouettes.raster_place(i, places[i]);
    m_overlaps.assign(n * n, 0);
    m_sums.assign(n, 0);
    m_is_possible = true;
    for(std::size_t i = 0; i < n; ++i)
      m_is_possible = m_is_possible && m_silhouettes(i, m_places[i].rotation).width > 0;
    for(std::size_t i = 0; i < n; ++i)
      update(i);
  }

  std::vector<Loose_place> loose_places()
  {
    std::vector<Loose_place> result(size());
    for(std::size_t i = 0; i < size(); ++i)
      result[i] = m_silhouettes.loose_place(i, m_places[i]);
    return result;
  }

  void move(std::size_t chart, const Raster_place& place)
  {
    m_places[chart] = place;
    update(chart);
  }

  // In cells.
  int overlap_of(std::size_t i, std::size_t j) const { return m_overlaps[i * size() + j]; }
  std::int64_t overlap_of(std::size_t i) const { return m_sums[i]; }

  // The charts whose bounding boxes are at most `reach` away from that of a chart.
  std::vector<std::size_t> neighbours(std::size_t i, int reach)
  {
    const Raster_place& p = m_places[i];
    const Silhouette& s = m_silhouettes(i, p.rotation);
    std::vector<std::size_t> result;
    for(std::size_t j = 0; j < size(); ++j) {
      const Raster_place& q = m_places[j];
      const Silhouette& t = m_silhouettes(j, q.rotation);
      if(j != i && q.page == p.page && q.x - reach < p.x + s.width && p.x - reach < q.x + t.width
         && q.y - reach < p.y + s.height && p.y - reach < q.y + t.height)
        result.push_back(j);
    }
    return result;
  }

  std::int64_t total_overlap() const
  {
    std::int64_t sum = 0;
    for(const std::int64_t s : m_sums)
      sum += s;
    return sum / 2;
  }

private:
  void update(std::size_t i)
  {
    const Raster_place& p = m_places[i];
    const Silhouette& s = m_silhouettes(i, p.rotation);
    for(std::size_t j = 0; j < size(); ++j) {
      const Raster_place& q = m_places[j];
      int& old = m_overlaps[i * size() + j];
      int now = 0;
      if(j != i && q.page == p.page)
        now = overlap(s, m_silhouettes(j, q.rotation), q.x - p.x, q.y - p.y);
      m_sums[i] += now - old;
      m_sums[j] += now - old;
      old = m_overlaps[j * size() + i] = now;
    }
  }

  Silhouettes& m_silhouettes;
  std::vector<Raster_place> m_places;
  std::vector<int> m_overlaps; // of each pair
  std::vector<std::int64_t> m_sums;
  bool m_is_possible = true;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_ARRANGEMENT_H
