// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SMS_INTERNAL_FLOAT_LANES_H
#define CGAL_SMS_INTERNAL_FLOAT_LANES_H

// Eight floats that are computed with at once. GCC and Clang map the type to the widest vector
// registers of the target; elsewhere the operators are loops of eight. Every operation is the
// IEEE operation of its lane, so that the result does not depend on the target's vector width.

#include <cmath>
#include <cstdint>
#include <cstring>

namespace CGAL {
namespace Surface_mesh_simplification {
namespace internal {

constexpr int lane_count = 8;

#if defined(__GNUC__)

typedef float Float_lanes __attribute__((vector_size(32)));
typedef std::int32_t Mask_lanes __attribute__((vector_size(32)));  // 0 or -1 in each lane

inline void load_lanes(const float* from, Float_lanes& to) { std::memcpy(&to, from, sizeof(to)); }

inline bool any_lane(const Mask_lanes& mask)
{
  std::uint64_t word[4];
  std::memcpy(word, &mask, sizeof(word));
  return (word[0] | word[1] | word[2] | word[3]) != 0;
}

// `mask ? yes : no` in each lane
inline void select_lanes(const Mask_lanes& mask, const Float_lanes& yes, const Float_lanes& no,
                         Float_lanes& result)
{
  result = mask ? yes : no;
}

#else

template <class T>
struct Lanes
{
  T lane[lane_count];
  T& operator[](int i) { return lane[i]; }
  T operator[](int i) const { return lane[i]; }
};

typedef Lanes<float> Float_lanes;
typedef Lanes<std::int32_t> Mask_lanes;

template <class R, class A, class B, class Operation>
inline R map_lanes(const A& a, const B& b, Operation operation)
{
  R result;
  for(int i = 0; i < lane_count; ++i)
    result[i] = operation(a[i], b[i]);
  return result;
}

inline Float_lanes operator+(const Float_lanes& a, const Float_lanes& b)
{ return map_lanes<Float_lanes>(a, b, [](float x, float y) { return x + y; }); }
inline Float_lanes operator-(const Float_lanes& a, const Float_lanes& b)
{ return map_lanes<Float_lanes>(a, b, [](float x, float y) { return x - y; }); }
inline Float_lanes operator*(const Float_lanes& a, const Float_lanes& b)
{ return map_lanes<Float_lanes>(a, b, [](float x, float y) { return x * y; }); }
inline Float_lanes operator/(const Float_lanes& a, const Float_lanes& b)
{ return map_lanes<Float_lanes>(a, b, [](float x, float y) { return x / y; }); }
inline Float_lanes operator*(float s, const Float_lanes& b)
{ return map_lanes<Float_lanes>(b, b, [s](float x, float) { return s * x; }); }
inline Float_lanes operator-(const Float_lanes& a, float s)
{ return map_lanes<Float_lanes>(a, a, [s](float x, float) { return x - s; }); }
inline Float_lanes operator+(const Float_lanes& a, float s)
{ return map_lanes<Float_lanes>(a, a, [s](float x, float) { return x + s; }); }
inline Float_lanes operator-(const Float_lanes& a)
{ return map_lanes<Float_lanes>(a, a, [](float x, float) { return -x; }); }
inline Mask_lanes operator<(const Float_lanes& a, const Float_lanes& b)
{ return map_lanes<Mask_lanes>(a, b, [](float x, float y) { return x < y ? -1 : 0; }); }
inline Mask_lanes operator<=(const Float_lanes& a, const Float_lanes& b)
{ return map_lanes<Mask_lanes>(a, b, [](float x, float y) { return x <= y ? -1 : 0; }); }
inline Mask_lanes operator>(const Float_lanes& a, const Float_lanes& b) { return b < a; }
inline Mask_lanes operator&(const Mask_lanes& a, const Mask_lanes& b)
{ return map_lanes<Mask_lanes>(a, b, [](std::int32_t x, std::int32_t y) { return x & y; }); }
inline Mask_lanes operator|(const Mask_lanes& a, const Mask_lanes& b)
{ return map_lanes<Mask_lanes>(a, b, [](std::int32_t x, std::int32_t y) { return x | y; }); }

inline void load_lanes(const float* from, Float_lanes& to) { std::memcpy(&to, from, sizeof(to)); }

inline bool any_lane(const Mask_lanes& mask)
{
  for(int i = 0; i < lane_count; ++i)
    if(mask[i] != 0)
      return true;
  return false;
}

inline void select_lanes(const Mask_lanes& mask, const Float_lanes& yes, const Float_lanes& no,
                         Float_lanes& result)
{
  for(int i = 0; i < lane_count; ++i)
    result[i] = mask[i] != 0 ? yes[i] : no[i];
}

#endif

inline void fill_lanes(float value, Float_lanes& to)
{
  for(int i = 0; i < lane_count; ++i)
    to[i] = value;
}

// Sums in a fixed tree, so that the order of additions is part of the definition.
inline float sum_of_lanes(const Float_lanes& a)
{
  return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

inline float minimum_of_lanes(const Float_lanes& a)
{
  const auto least = [](float x, float y) { return x < y ? x : y; };
  return least(least(least(a[0], a[4]), least(a[2], a[6])),
               least(least(a[1], a[5]), least(a[3], a[7])));
}

// Cube root of a non-negative finite float, within 2 ulp or so: a first guess from the exponent
// (divided by three) and two steps of Halley's iteration, which triples the digits each time.
inline float fast_cbrt(float a)
{
  if(!(a > 1e-36f))
    return 0.f;
  std::uint32_t bits;
  std::memcpy(&bits, &a, sizeof(bits));
  bits = bits / 3 + 709921077u;
  float x;
  std::memcpy(&x, &bits, sizeof(x));
  for(int step = 0; step < 2; ++step) {
    const float cube = x * x * x;
    x *= (cube + 2.f * a) / (2.f * cube + a);
  }
  return x;
}

} // namespace internal
} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SMS_INTERNAL_FLOAT_LANES_H
