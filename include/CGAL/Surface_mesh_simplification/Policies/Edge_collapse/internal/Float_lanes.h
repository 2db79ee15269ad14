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

// Folds the lanes in a fixed tree: ((0 4) (2 6)) ((1 5) (3 7)), so that the order of additions is
// part of the definition.
template <class Operation>
inline float fold_lanes(const Float_lanes& a, const Operation& operation)
{
#if defined(__GNUC__) && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define CGAL_SMS_HAS_SHUFFLE
#endif
#endif
#ifdef CGAL_SMS_HAS_SHUFFLE
#undef CGAL_SMS_HAS_SHUFFLE
  Float_lanes half, quarter, whole;
  operation(a, Float_lanes(__builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3)), half);
  operation(half, Float_lanes(__builtin_shufflevector(half, half, 2, 3, 0, 1, 6, 7, 4, 5)),
            quarter);
  operation(quarter, Float_lanes(__builtin_shufflevector(quarter, quarter, 1, 0, 3, 2, 5, 4, 7, 6)),
            whole);
  return whole[0];
#else
  Float_lanes folded = a;
  for(const int distance : {4, 2, 1}) {
    Float_lanes moved;
    for(int i = 0; i < lane_count; ++i)
      moved[i] = folded[i ^ distance];
    Float_lanes result;
    operation(folded, moved, result);
    folded = result;
  }
  return folded[0];
#endif
}

inline float sum_of_lanes(const Float_lanes& a)
{
  return fold_lanes(a, [](const Float_lanes& x, const Float_lanes& y, Float_lanes& result) {
    result = x + y;
  });
}

inline float minimum_of_lanes(const Float_lanes& a)
{
  return fold_lanes(a, [](const Float_lanes& x, const Float_lanes& y, Float_lanes& result) {
    select_lanes(x < y, x, y, result);
  });
}

// Cube root of a non-negative finite float, within 5e-5 of it: a first guess from the exponent
// divided by three, which is 3 % off, and one step of Halley's iteration, which cubes the error.
inline float fast_cbrt(float a)
{
  if(!(a > 1e-36f))
    return 0.f;
  std::uint32_t bits;
  std::memcpy(&bits, &a, sizeof(bits));
  bits = bits / 3 + 709921077u;
  float x;
  std::memcpy(&x, &bits, sizeof(x));
  const float cube = x * x * x;
  return x * ((cube + 2.f * a) / (2.f * cube + a));
}

} // namespace internal
} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SMS_INTERNAL_FLOAT_LANES_H
