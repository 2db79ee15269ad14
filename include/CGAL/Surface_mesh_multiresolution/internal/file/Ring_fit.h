// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_RING_FIT_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_RING_FIT_H

#include <CGAL/Surface_mesh_multiresolution/internal/file/Ring_sums.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Symbol_coder.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/split_prediction.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The affine map that fits a ring and its parent best in the sense of least squares: x, y and z as
// functions of two coordinates, the basis. It predicts the point of a new wedge whose basis is known.
//
// All is done in integers, or in floating point numbers by single operations that IEEE 754 rounds
// in one way: the reader has to find what the writer has found, whatever the compiler contracts.
// Differences from the mean are cut to 13 bits with their sign, so that sums of 25 products have 32.
class Ring_fit
{
public:
  typedef std::array<std::int32_t, 3> Offset;

  // `mean` is near the mean of the values.
  template <class Row>
  Ring_fit(const Split_ring& ring, Vertex_index parent, const Row* rows, const Wedge_values& mean);

  // The same, given its sums: a fit with u and v as its basis and no other.
  explicit Ring_fit(const Ring_sums& sums)
    : m_count(0), m_shift{}, m_extent(sums.squares[0] + sums.squares[1] + sums.squares[2])
    , m_uv_extent(sums.squares[3] + sums.vv), m_has_basis(true)
  {
    set_moments(sums.squares[3], sums.with_v[3], sums.vv, sums.with_u, sums.with_v);
  }

  // The steps of a factor sqrt(2) in which the extent of the ring grows: in space, in the texture.
  int spread_of_points() const { return bit_width(std::uint32_t(m_extent)) + 2 * m_shift[0]; }
  int spread_of_uv() const { return bit_width(std::uint32_t(m_uv_extent)) + 2 * m_shift[3]; }

  // The axis that is nearest to the normal of the ring, a polygon in space.
  int axis_of_polygon() const;

  // Fits with the coordinates a and b of x, y, z, u, v as the basis.
  void set_basis(int a, int b);

  // The point less the mean where the coordinates of the basis less theirs are these.
  Offset point_at(std::int32_t a, std::int32_t b) const;

  // The axis where the normal of the map, a plane in space, has its largest coordinate, and the
  // quotients of the coordinates and that one, in 4096ths.
  int axis_of_plane() const;
  Offset slopes(int axis) const;

private:
  typedef std::array<std::int32_t, 8> Lanes;
  typedef std::array<std::int64_t, 3> Normal;

  static constexpr int bits_kept = 12;

  static int largest(const Normal& n)
  {
    const auto size = [&n](int c) {
      const std::int64_t x = n[std::size_t(c)];
      return x < 0 ? -x : x;
    };
    const int larger = size(1) > size(0) ? 1 : 0;
    return size(2) > size(larger) ? 2 : larger;
  }

  template <class Sums>
  void set_moments(std::int32_t aa, std::int32_t ab, std::int32_t bb, const Sums& with_a,
                   const Sums& with_b);

  std::array<Lanes, Split_ring::most + 1> m_differences; // of x, y, z, u, v from the mean
  std::uint32_t m_count;
  std::array<int, 5> m_shift;                    // bits that the differences lack
  std::int32_t m_extent, m_uv_extent;            // sums of squares
  bool m_has_basis = false;
  int m_basis_shift = 0;
  std::int64_t m_aa = 0, m_ab = 0, m_bb = 0;     // moments of the basis
  Offset m_a = {}, m_b = {};                     // moments of x, y, z with the basis
  Normal m_normal = {};
};

template <class Row>
Ring_fit::Ring_fit(const Split_ring& ring, Vertex_index parent, const Row* rows,
                   const Wedge_values& mean)
  : m_count(ring.size() + 1)
{
  Lanes all = {};
  for(std::uint32_t i = 0; i < m_count; ++i) {
    const Row& row = rows[i < ring.size() ? ring[i] : parent];
    Lanes& d = m_differences[i];
    for(std::size_t c = 0; c < 8; ++c) {
      d[c] = std::int32_t(row[c] - mean[c]);
      all[c] |= d[c] ^ (d[c] >> 31);
    }
  }
  const int points = (std::max)(bit_width(std::uint32_t(all[0] | all[1] | all[2])) - bits_kept, 0);
  const int uv = (std::max)(bit_width(std::uint32_t(all[3] | all[4])) - bits_kept, 0);
  m_shift = {points, points, points, uv, uv};
  Lanes squares = {};
  for(std::uint32_t i = 0; i < m_count; ++i) {
    if(points + uv > 0)
      for(std::size_t c = 0; c < 5; ++c)
        m_differences[i][c] >>= m_shift[c];
    for(std::size_t c = 0; c < 8; ++c)
      squares[c] += m_differences[i][c] * m_differences[i][c];
  }
  m_extent = squares[0] + squares[1] + squares[2];
  m_uv_extent = squares[3] + squares[4];
}

inline int Ring_fit::axis_of_polygon() const
{
  Normal normal = {};
  for(std::uint32_t i = 0; i < m_count; ++i) {
    const Lanes &p = m_differences[i], &q = m_differences[i + 1 < m_count ? i + 1 : 0];
    for(std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
      normal[c] += p[d] * q[e] - p[e] * q[d];
    }
  }
  return largest(normal);
}

inline void Ring_fit::set_basis(int a, int b)
{
  if(m_has_basis)
    return;
  m_basis_shift = m_shift[std::size_t(a)];
  std::int32_t aa = 0, ab = 0, bb = 0;
  Lanes with_a = {}, with_b = {};
  for(std::uint32_t i = 0; i < m_count; ++i) {
    const Lanes& d = m_differences[i];
    const std::int32_t da = d[std::size_t(a)], db = d[std::size_t(b)];
    aa += da * da;
    ab += da * db;
    bb += db * db;
    for(std::size_t c = 0; c < 8; ++c) {
      with_a[c] += da * d[c];
      with_b[c] += db * d[c];
    }
  }
  set_moments(aa, ab, bb, with_a, with_b);
}

template <class Sums>
void Ring_fit::set_moments(std::int32_t aa, std::int32_t ab, std::int32_t bb, const Sums& with_a,
                           const Sums& with_b)
{
  // A little is added where the ring is so thin that it tells nothing about one direction
  const std::int32_t floor = ((aa + bb) >> 8) + 1;
  m_aa = aa + floor;
  m_ab = ab;
  m_bb = bb + floor;
  for(std::size_t c = 0; c < 3; ++c) {
    m_a[c] = with_a[c];
    m_b[c] = with_b[c];
  }
  for(std::size_t c = 0; c < 3; ++c) {
    const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
    m_normal[c] = std::int64_t(m_a[d]) * m_b[e] - std::int64_t(m_a[e]) * m_b[d];
  }
}

inline Ring_fit::Offset Ring_fit::point_at(std::int32_t a, std::int32_t b) const
{
  const auto bounded = [this](std::int32_t x) {
    constexpr std::int32_t farthest = 2 << bits_kept;
    return std::int64_t((std::max)((std::min)(x >> m_basis_shift, farthest), -farthest));
  };
  const std::int64_t p = bounded(a), q = bounded(b);
  // The weights of the basis, as integers in units of 2^-scale: the moments have at most 30 bits, the
  // numerators 45, the determinant 60, the weights 31, and the sums 61
  const int scale = bit_width(std::uint64_t(m_aa + m_bb)) + 8;
  const double unit = double(std::int64_t(1) << scale), det = double(m_aa * m_bb - m_ab * m_ab);
  const auto weight_a = std::int64_t(double(m_bb * p - m_ab * q) * unit / det);
  const auto weight_b = std::int64_t(double(m_aa * q - m_ab * p) * unit / det);
  Offset result;
  for(std::size_t c = 0; c < 3; ++c) {
    const std::int64_t sum = weight_a * m_a[c] + weight_b * m_b[c];
    const std::int64_t rounded = (sum + (std::int64_t(1) << (scale - 1))) >> scale;
    result[c] = std::int32_t(std::uint32_t(rounded) << m_shift[0]);
  }
  return result;
}

inline int Ring_fit::axis_of_plane() const { return largest(m_normal); }

inline Ring_fit::Offset Ring_fit::slopes(int axis) const
{
  Offset result = {};
  const double n = double(m_normal[std::size_t(axis)]);
  for(std::size_t c = 0; c < 3 && n != 0.; ++c)
    result[c] = std::int32_t(double(m_normal[c]) * 4096. / n);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_RING_FIT_H
