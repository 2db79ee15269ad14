// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SMS_INTERNAL_VERTEX_STAR_H
#define CGAL_SMS_INTERNAL_VERTEX_STAR_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/internal/Float_lanes.h>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_simplification {
namespace internal {

// What a halfedge collapse of the centre of a star into one of its ring vertices does to the
// surface. Lengths are in the star's unit.
struct Collapse_measure
{
  float volume;               // sum over the new triangles of the volume swept, unit^3
  float border_area;          // area cut off or added at the border, unit^2; 0 inside
  float length;               // length of the collapsed edge, unit
  float min_squared_quality;  // smallest q^2 of the new triangles, q = 4 sqrt(3) A / sum l^2
  float min_signed_squared_cosine; // smallest s|s| of the new triangles, s = cos of the turn
};

// The star of a vertex in coordinates relative to it, and the measures of the collapses into its
// ring vertices:
//
//            r2 ---- r1          The triangles are (p, r_i, r_i+1), counterclockwise. The last one,
//           /  \    /  \         (p, r_d-1, r_0), exists only if p is inside the surface.
//         r3 --- p --- r0        After the collapse of p into r_k the triangles are
//           \  /    \  /         (r_k, r_i, r_i+1) for i other than k - 1 and k.
//            r4 ---- r5
//
// Differences to p are taken in double precision and measured in a unit of local size, so that
// single precision is enough for all that follows, for coordinates of any size.
class Vertex_star
{
public:
  static constexpr int max_degree = 14;

  // Starts a star of `degree` <= max_degree ring vertices.
  void reset(int degree, bool is_border)
  {
    m_degree = degree;
    m_is_border = is_border;
    for(int b = 0; b < blocks() * lane_count; ++b)
      m_x[b] = m_y[b] = m_z[b] = 0.f;
  }

  void set_ring_point(int i, float x, float y, float z) { m_x[i] = x; m_y[i] = y; m_z[i] = z; }

  // Computes what all collapses share; to be called once the ring is complete.
  void prepare();

  int degree() const { return m_degree; }
  bool is_border() const { return m_is_border; }
  int number_of_triangles() const { return m_is_border ? m_degree - 1 : m_degree; }

  // Sum of the angles at the centre, in radians, within 1e-4.
  float angle_sum() const { return m_angle_sum; }

  // Smallest squared quality of the triangles before the collapse.
  float min_squared_quality() const { return m_min_squared_quality; }

  // The measures of the collapse of the centre into ring vertex `k`; 70 flops a triangle.
  Collapse_measure measure(int k) const;

private:
  int blocks() const { return m_degree > lane_count ? 2 : 1; }
  int next(int i) const { return i + 1 == m_degree ? 0 : i + 1; }
  float angle_of_block(int b, const Float_lanes& dot) const;
  float area_at_border() const;

  // The lanes, of those from `at` on, whose triangles survive the collapse into ring vertex k.
  void alive_lanes(int at, int k, int previous, Mask_lanes& alive) const
  {
    // Ones wherever a stretch of 16 begins at a lane to keep; a zero in the middle is the lane to
    // drop.
    static constexpr std::int32_t all_but_one[32] = {
      -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1,
      0,  -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    static constexpr std::int32_t first_ones[32] = {
      -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    Mask_lanes dead, dead_before;
    std::memcpy(&alive, first_ones + 16 - number_of_triangles() + at, sizeof(alive));
    std::memcpy(&dead, all_but_one + 16 - k + at, sizeof(dead));
    std::memcpy(&dead_before, all_but_one + 16 - previous + at, sizeof(dead_before));
    alive = alive & dead & dead_before;
  }

  int m_degree = 0;
  bool m_is_border = false;
  float m_angle_sum = 0.f;
  float m_min_squared_quality = 0.f;
  float m_border_area = 0.f;
  alignas(32) float m_x[16], m_y[16], m_z[16];
  // Lane i: r_i+1, the normal r_i x r_i+1 and its square, |r_i+1 - r_i|^2.
  Float_lanes m_nx[2], m_ny[2], m_nz[2], m_cx[2], m_cy[2], m_cz[2], m_cc[2], m_ee[2];
};

// atan(y / x) for y >= 0 in [0, pi], lane by lane: Abramowitz and Stegun 4.4.49 on [0, 1],
// |error| < 1.2e-5, and reflections.
inline void lanes_angle(const Float_lanes& y, const Float_lanes& x, Float_lanes& angle)
{
  Float_lanes zero, tiny, ax, lo, hi;
  fill_lanes(0.f, zero);
  fill_lanes(1e-30f, tiny);
  select_lanes(x < zero, -x, x, ax);
  select_lanes(y < ax, y, ax, lo);
  select_lanes(y < ax, ax, y, hi);
  const Float_lanes t = lo / (hi + tiny);
  const Float_lanes s = t * t;
  Float_lanes p = 0.0208351f * s - 0.0851330f;
  p = p * s + 0.1801410f;
  p = p * s - 0.3302995f;
  p = (p * s + 0.9998660f) * t;
  select_lanes(y < ax, p, -p + 1.57079633f, p);
  select_lanes(x < zero, -p + 3.14159265f, p, angle);
}

inline float Vertex_star::angle_of_block(int b, const Float_lanes& dot) const
{
  Float_lanes sine, angle;
  for(int i = 0; i < lane_count; ++i)
    sine[i] = std::sqrt(m_cc[b][i]);
  lanes_angle(sine, dot, angle);
  float sum = 0.f;
  const int count = number_of_triangles() - b * lane_count;
  for(int i = 0; i < lane_count && i < count; ++i)
    sum += angle[i];
  return sum;
}

inline void Vertex_star::prepare()
{
  m_angle_sum = 0.f;
  m_min_squared_quality = 1.f;
  m_border_area = m_is_border ? area_at_border() : 0.f;
  float nx[16] = {}, ny[16] = {}, nz[16] = {};
  for(int i = 0; i < number_of_triangles(); ++i) {
    nx[i] = m_x[next(i)];
    ny[i] = m_y[next(i)];
    nz[i] = m_z[next(i)];
  }
  for(int b = 0; b < blocks(); ++b) {
    const int at = b * lane_count;
    Float_lanes x, y, z;
    load_lanes(m_x + at, x);
    load_lanes(m_y + at, y);
    load_lanes(m_z + at, z);
    load_lanes(nx + at, m_nx[b]);
    load_lanes(ny + at, m_ny[b]);
    load_lanes(nz + at, m_nz[b]);
    const Float_lanes ex = m_nx[b] - x, ey = m_ny[b] - y, ez = m_nz[b] - z;
    m_cx[b] = y * m_nz[b] - z * m_ny[b];
    m_cy[b] = z * m_nx[b] - x * m_nz[b];
    m_cz[b] = x * m_ny[b] - y * m_nx[b];
    m_cc[b] = m_cx[b] * m_cx[b] + m_cy[b] * m_cy[b] + m_cz[b] * m_cz[b];
    m_ee[b] = ex * ex + ey * ey + ez * ez;
    const Float_lanes dot = x * m_nx[b] + y * m_ny[b] + z * m_nz[b];
    m_angle_sum += angle_of_block(b, dot);
    const Float_lanes l2 = m_ee[b] + m_ee[b] + 2.f * dot; // |r_i|^2 + |r_i+1|^2 + |e|^2
    const Float_lanes q2 = 12.f * m_cc[b] / (l2 * l2 + 1e-30f);
    for(int i = 0; i < lane_count && i < number_of_triangles() - at; ++i)
      m_min_squared_quality = q2[i] < m_min_squared_quality ? q2[i] : m_min_squared_quality;
  }
}

// Area of the triangle of the centre and its two border neighbours: what the border gains or loses.
inline float Vertex_star::area_at_border() const
{
  const int l = m_degree - 1;
  const float cx = m_y[0] * m_z[l] - m_z[0] * m_y[l];
  const float cy = m_z[0] * m_x[l] - m_x[0] * m_z[l];
  const float cz = m_x[0] * m_y[l] - m_y[0] * m_x[l];
  return 0.5f * std::sqrt(cx * cx + cy * cy + cz * cz);
}

inline Collapse_measure Vertex_star::measure(int k) const
{
  const float tx = m_x[k], ty = m_y[k], tz = m_z[k];
  const int previous = k == 0 ? m_degree - 1 : k - 1;
  Float_lanes one, zero;
  fill_lanes(1.f, one);
  fill_lanes(0.f, zero);
  Float_lanes volume = zero, least_q2 = one, least_cosine = one;
  for(int b = 0; b < blocks(); ++b) {
    const int at = b * lane_count;
    Float_lanes x, y, z;
    load_lanes(m_x + at, x);
    load_lanes(m_y + at, y);
    load_lanes(m_z + at, z);
    Mask_lanes alive;
    alive_lanes(at, k, previous, alive);
    const Float_lanes ax = x - tx, ay = y - ty, az = z - tz;
    const Float_lanes bx = m_nx[b] - tx, by = m_ny[b] - ty, bz = m_nz[b] - tz;
    const Float_lanes nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    const Float_lanes nn = nx * nx + ny * ny + nz * nz;
    const Float_lanes l2 = m_ee[b] + ax * ax + ay * ay + az * az + bx * bx + by * by + bz * bz;
    const Float_lanes six_volume = tx * m_cx[b] + ty * m_cy[b] + tz * m_cz[b];
    const Float_lanes dot = nx * m_cx[b] + ny * m_cy[b] + nz * m_cz[b];
    Float_lanes value, turn;
    select_lanes(six_volume < zero, -six_volume, six_volume, value);
    select_lanes(alive, value, zero, value);
    volume = volume + value;
    value = 12.f * nn / (l2 * l2 + 1e-30f);
    select_lanes(alive & (value < least_q2), value, least_q2, least_q2);
    select_lanes(dot < zero, -(dot * dot), dot * dot, turn);
    value = turn / (nn * m_cc[b] + 1e-30f);
    // A triangle that had no area has no normal that could turn.
    select_lanes(alive & (1e-12f * (l2 * l2) < m_cc[b]) & (value < least_cosine),
                 value, least_cosine, least_cosine);
  }
  Collapse_measure result;
  result.volume = sum_of_lanes(volume) * (1.f / 6.f);
  result.border_area = m_border_area;
  result.length = std::sqrt(tx * tx + ty * ty + tz * tz);
  result.min_squared_quality = minimum_of_lanes(least_q2);
  result.min_signed_squared_cosine = minimum_of_lanes(least_cosine);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SMS_INTERNAL_VERTEX_STAR_H
