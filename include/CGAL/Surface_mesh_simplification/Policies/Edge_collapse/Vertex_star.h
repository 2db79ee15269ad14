// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_VERTEX_STAR_H
#define CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_VERTEX_STAR_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/internal/Float_lanes.h>

#include <CGAL/assertions.h>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_simplification {

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
//         r3 --- p --- r0        After the collapse of p into r_k they are (r_k, r_i, r_i+1) for
//           \  /    \  /         i = k + 1, ..., k + d - 2, modulo d. At the border, where k is 0
//            or r4 ---- r5          d - 1, this leaves out the last one, which does not exist.
//
// Differences to p are taken in double precision and measured in a unit of local size, so that
// single precision is enough for all that follows, for coordinates of any size.
//
// Each lane has a target: step j looks at the triangle i = k + j of target k. The ring is stored as
// often as it takes to go on without modulo, so that the vertices of a step are consecutive, and no
// lane has to be left out.
class Vertex_star
{
public:
  static constexpr int max_degree = 14;

  // Starts a star of `degree` <= max_degree ring vertices.
  void reset(int degree, bool is_border)
  {
    m_degree = degree;
    m_is_border = is_border;
  }

  void set_ring_point(int i, float x, float y, float z) { m_x[i] = x; m_y[i] = y; m_z[i] = z; }

  // Measures the star and all its collapses, 70 flops a target and triangle; to be called once the
  // ring is complete.
  void prepare();

  int degree() const { return m_degree; }
  bool is_border() const { return m_is_border; }
  int number_of_triangles() const { return m_is_border ? m_degree - 1 : m_degree; }

  // Sum of the angles at the centre, in radians, within 1.5e-5 for each triangle.
  float angle_sum() const { return m_angle_sum; }

  // Smallest squared quality of the triangles before the collapse.
  float min_squared_quality() const { return m_min_squared_quality; }

  // The measures of the collapse of the centre into ring vertex `k`; a border vertex goes only to
  // the first or the last.
  Collapse_measure measure(int k) const
  {
    CGAL_precondition(!m_is_border || k == 0 || k == m_degree - 1);
    return {m_volume[k], m_border_area, m_length[k], m_least_q2[k], m_least_cosine[k]};
  }

private:
  typedef internal::Float_lanes Float_lanes;
  typedef internal::Vector_lanes Vector_lanes;

  static constexpr int lane_count = internal::lane_count;
  static constexpr int max_targets = 2 * lane_count;
  static constexpr int ring_size = max_targets + max_degree; // the last looks max_degree - 1 ahead
  static_assert(max_degree <= max_targets, "each target has a lane");

  int number_of_lanes() const { return m_degree > lane_count ? 2 * lane_count : lane_count; }
  void repeat_ring();
  void load_ring(int at, Vector_lanes& r) const
  {
    internal::load_lanes(m_x + at, r.x);
    internal::load_lanes(m_y + at, r.y);
    internal::load_lanes(m_z + at, r.z);
  }
  void measure_old_triangles(int at, Float_lanes& angles, Float_lanes& least_q2) const;
  void measure_targets(int at);
  float area_at_border() const;

  int m_degree = 0;
  bool m_is_border = false;
  float m_angle_sum = 0.f;
  float m_min_squared_quality = 0.f;
  float m_border_area = 0.f;
  float m_x[ring_size], m_y[ring_size], m_z[ring_size];
  float m_volume[max_targets], m_length[max_targets];
  float m_least_q2[max_targets], m_least_cosine[max_targets];
};

namespace internal {

// atan(y / x) for y >= 0 in [0, pi], lane by lane: Abramowitz and Stegun 4.4.49 on [0, 1],
// |error| < 1.2e-5, and reflections.
inline void lanes_angle(const Float_lanes& y, const Float_lanes& x, Float_lanes& angle)
{
  Float_lanes zero, tiny, ax, lo, hi;
  fill_lanes(0.f, zero);
  fill_lanes(1e-30f, tiny);
  absolute_lanes(x, ax);
  minimum_lanes(y, ax, lo);
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

} // namespace internal

inline void Vertex_star::prepare()
{
  using namespace internal;
  repeat_ring();
  m_border_area = m_is_border ? area_at_border() : 0.f;
  Float_lanes angles, least_q2;
  fill_lanes(0.f, angles);
  fill_lanes(1.f, least_q2);
  for(int at = 0; at < number_of_lanes(); at += lane_count) {
    measure_old_triangles(at, angles, least_q2);
    measure_targets(at);
  }
  m_angle_sum = sum_of_lanes(angles);
  m_min_squared_quality = minimum_of_lanes(least_q2);
}

// Goes round the ring until the last vertex that the last lane looks at.
inline void Vertex_star::repeat_ring()
{
  for(int i = m_degree; i < number_of_lanes() + m_degree - 1; ++i) {
    m_x[i] = m_x[i - m_degree];
    m_y[i] = m_y[i - m_degree];
    m_z[i] = m_z[i - m_degree];
  }
}

// Adds the angles of the triangles (p, r, s) from `at` on, and finds their least squared quality,
// in each lane.
inline void Vertex_star::measure_old_triangles(int at, Float_lanes& angles,
                                               Float_lanes& least_q2) const
{
  using namespace internal;
  Vector_lanes r, s, c;
  Float_lanes rr, ss, rs, cc, sine, angle, zero, count;
  load_ring(at, r);
  load_ring(at + 1, s);
  cross_lanes(r, s, c);
  dot_lanes(r, r, rr);
  dot_lanes(s, s, ss);
  dot_lanes(r, s, rs);
  dot_lanes(c, c, cc);
  const Float_lanes l2 = 2.f * (rr + ss - rs); // |r|^2 + |s|^2 + |s - r|^2
  const Float_lanes q2 = 12.f * cc / (l2 * l2 + 1e-30f);
  square_root_lanes(cc, sine);
  lanes_angle(sine, rs, angle);
  fill_lanes(0.f, zero);
  fill_lanes(float(number_of_triangles() - at), count);
  const Mask_lanes exists = Float_lanes{0.f, 1.f, 2.f, 3.f, 4.f, 5.f, 6.f, 7.f} < count;
  select_lanes(exists, angle, zero, angle);
  angles = angles + angle;
  select_lanes(exists & (q2 < least_q2), q2, least_q2, least_q2);
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

// Measures the collapses into the targets t from `at` on, which make triangles (t, r, s) of
// (p, r, s).
inline void Vertex_star::measure_targets(int at)
{
  using namespace internal;
  Vector_lanes t, s, b, c, n;
  Float_lanes bb, ab, cc, nn, tt, tc, nc, size, length;
  load_ring(at, t);
  load_ring(at + 1, s);
  subtract_lanes(s, t, b);
  dot_lanes(b, b, bb);
  Float_lanes six_volumes, least_q2, least_cosine;
  fill_lanes(0.f, six_volumes);
  fill_lanes(1.f, least_q2);
  fill_lanes(1.f, least_cosine);
  for(int i = at + 1; i < at + m_degree - 1; ++i) {
    const Vector_lanes r = s, a = b; // a = r - t, b = s - t
    const Float_lanes aa = bb;
    load_ring(i + 1, s);
    subtract_lanes(s, t, b);
    dot_lanes(b, b, bb);
    dot_lanes(a, b, ab);
    cross_lanes(r, s, c);
    cross_lanes(a, b, n);
    dot_lanes(c, c, cc);
    dot_lanes(n, n, nn);
    dot_lanes(n, c, nc);
    dot_lanes(t, c, tc);
    absolute_lanes(tc, size);
    six_volumes = six_volumes + size;
    const Float_lanes l2 = 2.f * (aa + bb - ab); // |a|^2 + |b|^2 + |b - a|^2
    const Float_lanes l4 = l2 * l2;
    minimum_lanes(12.f * nn / (l4 + 1e-30f), least_q2, least_q2);
    absolute_lanes(nc, size);
    const Float_lanes cosine = nc * size / (nn * cc + 1e-30f);
    // A triangle that had no area has no normal that could turn.
    select_lanes((1e-12f * l4 < cc) & (cosine < least_cosine), cosine, least_cosine, least_cosine);
  }
  dot_lanes(t, t, tt);
  square_root_lanes(tt, length);
  store_lanes(length, m_length + at);
  store_lanes((1.f / 6.f) * six_volumes, m_volume + at);
  store_lanes(least_q2, m_least_q2 + at);
  store_lanes(least_cosine, m_least_cosine + at);
}

} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_VERTEX_STAR_H
