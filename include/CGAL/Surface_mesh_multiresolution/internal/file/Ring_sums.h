// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_RING_SUMS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_RING_SUMS_H

#include <CGAL/Surface_mesh_multiresolution/internal/file/split_prediction.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The neighbours of a wedge that a split makes, in the order of its ring, without the parent. A ring
// is cut off behind as many as a fit takes.
class Split_ring
{
public:
  static constexpr std::uint32_t most = 24;
  static constexpr std::uint32_t few = 7;

  // The parent stands in for neighbours that are not there, up to one more than `few`.
  explicit Split_ring(Vertex_index parent = 0) { std::fill_n(m_wedges.begin(), few + 1, parent); }

  // Takes a neighbour. To be copied: what is stored is elsewhere.
  class Listing
  {
  public:
    explicit Listing(Split_ring& ring) : m_ring(&ring) {}
    void operator()(Vertex_index w)
    {
      m_ring->m_wedges[(std::min)(m_count, most - 1)] = w;
      m_ring->m_count = (std::min)(++m_count, most);
    }

  private:
    Split_ring* m_ring;
    std::uint32_t m_count = 0;
  };

  std::uint32_t size() const { return m_count; }
  Vertex_index operator[](std::uint32_t i) const { return m_wedges[i]; }
  Vertex_index back() const { return m_wedges[m_count - 1]; } // the last, even of a long ring

private:
  std::array<Vertex_index, most> m_wedges;
  std::uint32_t m_count = 0;
};

// The sums that `Ring_fit` makes of a ring and its parent, with u and v as the basis.
struct Ring_sums
{
  typedef std::array<std::int32_t, 4> Sums;

  Sums squares;        // of x, y, z and u less their means
  Sums with_u, with_v; // of the products of x, y, z and u with u and v
  std::int32_t vv;
};

#if defined(__SSE2__)

// A row: all bits where a ring of so many wedges has one.
constexpr std::array<std::array<std::int16_t, 8>, 2 * Split_ring::few + 2> make_presence_masks()
{
  std::array<std::array<std::int16_t, 8>, 2 * Split_ring::few + 2> masks = {};
  for(std::size_t i = 0; i <= Split_ring::few; ++i)
    for(std::size_t c = 0; c < 8; ++c)
      masks[i][c] = -1;
  return masks;
}
alignas(16) inline constexpr auto presence_masks = make_presence_masks();

// 2^20 over the number of neighbours and two
constexpr std::array<std::int32_t, Split_ring::few + 1> make_mean_factors()
{
  std::array<std::int32_t, Split_ring::few + 1> factors = {};
  for(std::size_t i = 0; i < factors.size(); ++i)
    factors[i] = std::int32_t((1u << 20) / (i + 2));
  return factors;
}
inline constexpr auto mean_factors = make_mean_factors();

// The mean of a ring inside and its sums, or false, which says nothing, if that is not as simple as
// this: a few wedges, whose differences have 12 bits and a sign. Then products have room in 32 bits
// and a processor makes eight at a time, of which it adds two and two: so two wedges go side by side.
inline bool sum_ring(const Split_ring& ring, Vertex_index parent, const Short_wedge_values* rows,
                     Wedge_values& mean, Ring_sums& sums)
{
  if(ring.size() > Split_ring::few)
    return false;
  const auto row_at = [rows](Vertex_index w) { // as signed numbers, for differences that saturate
    return _mm_xor_si128(_mm_load_si128(reinterpret_cast<const __m128i*>(&rows[w])),
                         _mm_set1_epi16(std::int16_t(-32768)));
  };
  constexpr int n = int(Split_ring::few) + 1;
  const __m128i center = row_at(parent);
  __m128i d[n], sum = _mm_setzero_si128(), least = sum, largest = sum;
  for(int i = 0; i < n; ++i) {
    d[i] = _mm_subs_epi16(row_at(ring[std::uint32_t(i)]), center);
    sum = _mm_add_epi16(sum, d[i]);
    least = _mm_min_epi16(least, d[i]);
    largest = _mm_max_epi16(largest, d[i]);
  }
  const std::int64_t factor = mean_factors[ring.size()];
  const auto rounded = [factor](int x) {
    return std::int32_t((std::int16_t(x) * factor + (1 << 19)) >> 20);
  };
  const std::array<std::int32_t, 5> move
    = {rounded(_mm_extract_epi16(sum, 0)), rounded(_mm_extract_epi16(sum, 1)),
       rounded(_mm_extract_epi16(sum, 2)), rounded(_mm_extract_epi16(sum, 3)),
       rounded(_mm_extract_epi16(sum, 4))};
  const __m128i moved = _mm_set_epi16(0, 0, 0, std::int16_t(move[4]), std::int16_t(move[3]),
                                      std::int16_t(move[2]), std::int16_t(move[1]),
                                      std::int16_t(move[0]));
  // Sums of up to seven differences are right if these are in range, and the mean then is
  const __m128i bound = _mm_set1_epi16(4096);
  const auto is_beyond = [&bound](const __m128i& low, const __m128i& high) {
    return _mm_or_si128(_mm_cmpgt_epi16(_mm_sub_epi16(_mm_setzero_si128(), bound), low),
                        _mm_cmpgt_epi16(high, _mm_sub_epi16(bound, _mm_set1_epi16(1))));
  };
  if(_mm_movemask_epi8(_mm_or_si128(
       is_beyond(least, largest),
       is_beyond(_mm_sub_epi16(least, moved), _mm_sub_epi16(largest, moved)))) != 0)
    return false;
  for(std::size_t c = 0; c < 5; ++c)
    mean[c] = rows[parent][c] + std::uint32_t(move[c]);
  mean[5] = mean[6] = mean[7] = 0;
  const auto* present = reinterpret_cast<const __m128i*>(presence_masks.data()) + n - 1 - ring.size();
  __m128i squares = _mm_setzero_si128(), with_u = squares, with_v = squares, vv = squares;
  for(int i = 0; i < n; i += 2) {
    const __m128i a = _mm_and_si128(_mm_sub_epi16(d[i], moved), _mm_load_si128(present + i));
    const __m128i b = _mm_and_si128(_mm_sub_epi16(d[i + 1], moved), _mm_load_si128(present + i + 1));
    const __m128i xyzu = _mm_unpacklo_epi16(a, b), v = _mm_unpackhi_epi16(a, b);
    squares = _mm_add_epi32(squares, _mm_madd_epi16(xyzu, xyzu));
    with_u = _mm_add_epi32(with_u, _mm_madd_epi16(xyzu, _mm_shuffle_epi32(xyzu, 0xFF)));
    with_v = _mm_add_epi32(with_v, _mm_madd_epi16(xyzu, _mm_shuffle_epi32(v, 0)));
    vv = _mm_add_epi32(vv, _mm_madd_epi16(v, v));
  }
  _mm_storeu_si128(reinterpret_cast<__m128i*>(sums.squares.data()), squares);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(sums.with_u.data()), with_u);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(sums.with_v.data()), with_v);
  sums.vv = _mm_cvtsi128_si32(vv);
  return true;
}

#endif

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_RING_SUMS_H
