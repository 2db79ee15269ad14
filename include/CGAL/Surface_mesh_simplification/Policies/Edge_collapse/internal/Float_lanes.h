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

#if defined(__GNUC__) && defined(__SSE__)
#include <immintrin.h>
#endif

namespace CGAL {
namespace Surface_mesh_simplification {
namespace internal {

constexpr int lane_count = 8;

#if defined(__GNUC__)

typedef float Float_lanes __attribute__((vector_size(32)));
typedef std::int32_t Mask_lanes __attribute__((vector_size(32)));  // 0 or -1 in each lane

// `mask ? yes : no` in each lane
inline void select_lanes(const Mask_lanes& mask, const Float_lanes& yes, const Float_lanes& no,
                         Float_lanes& result)
{
  result = mask ? yes : no;
}

inline void absolute_lanes(const Float_lanes& a, Float_lanes& result)
{
  result = Float_lanes(Mask_lanes(a) & 0x7fffffff); // without the sign bit
}

// By intrinsics, because std::sqrt() may have to set errno, which vector instructions do not do.
inline void square_root_lanes(const Float_lanes& a, Float_lanes& result)
{
#if defined(__AVX__)
  result = Float_lanes(_mm256_sqrt_ps(__m256(a)));
#elif defined(__SSE__)
  __m128 half[2];
  std::memcpy(half, &a, sizeof(a));
  half[0] = _mm_sqrt_ps(half[0]);
  half[1] = _mm_sqrt_ps(half[1]);
  std::memcpy(&result, half, sizeof(a));
#else
  for(int i = 0; i < lane_count; ++i)
    result[i] = std::sqrt(a[i]);
#endif
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
inline Mask_lanes operator&(const Mask_lanes& a, const Mask_lanes& b)
{ return map_lanes<Mask_lanes>(a, b, [](std::int32_t x, std::int32_t y) { return x & y; }); }

inline void select_lanes(const Mask_lanes& mask, const Float_lanes& yes, const Float_lanes& no,
                         Float_lanes& result)
{
  for(int i = 0; i < lane_count; ++i)
    result[i] = mask[i] != 0 ? yes[i] : no[i];
}

inline void absolute_lanes(const Float_lanes& a, Float_lanes& result)
{
  for(int i = 0; i < lane_count; ++i)
    result[i] = std::abs(a[i]);
}

inline void square_root_lanes(const Float_lanes& a, Float_lanes& result)
{
  for(int i = 0; i < lane_count; ++i)
    result[i] = std::sqrt(a[i]);
}

#endif

inline void load_lanes(const float* from, Float_lanes& to) { std::memcpy(&to, from, sizeof(to)); }

inline void store_lanes(const Float_lanes& from, float* to)
{
  std::memcpy(to, &from, sizeof(from));
}

inline void fill_lanes(float value, Float_lanes& to)
{
  to = Float_lanes{value, value, value, value, value, value, value, value};
}

// `b` where it is equal, or `a` is not a number
inline void minimum_lanes(const Float_lanes& a, const Float_lanes& b, Float_lanes& result)
{
  select_lanes(a < b, a, b, result);
}

// Eight vectors of space
struct Vector_lanes
{
  Float_lanes x, y, z;
};

inline void subtract_lanes(const Vector_lanes& a, const Vector_lanes& b, Vector_lanes& result)
{
  result = {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline void dot_lanes(const Vector_lanes& a, const Vector_lanes& b, Float_lanes& result)
{
  result = a.x * b.x + a.y * b.y + a.z * b.z;
}

inline void cross_lanes(const Vector_lanes& a, const Vector_lanes& b, Vector_lanes& result)
{
  result = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Folds the lanes in a fixed tree: ((0 4) (2 6)) ((1 5) (3 7)), so that the order of additions is
// part of the definition.
template <class Operation>
inline float fold_lanes(const Float_lanes& a, const Operation& operation)
{
  float folded[lane_count];
  store_lanes(a, folded);
  for(int distance = lane_count / 2; distance > 0; distance /= 2)
    for(int i = 0; i < distance; ++i)
      folded[i] = operation(folded[i], folded[i + distance]);
  return folded[0];
}

inline float sum_of_lanes(const Float_lanes& a)
{
  return fold_lanes(a, [](float x, float y) { return x + y; });
}

inline float minimum_of_lanes(const Float_lanes& a)
{
  return fold_lanes(a, [](float x, float y) { return x < y ? x : y; });
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
