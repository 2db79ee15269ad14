// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_SORT_AND_SELECT_H
#define CGAL_BLOCKED_EXECUTION_SORT_AND_SELECT_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Blocked_execution/blocked_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Blocked_execution {

/// The parts one after the other.
template <class T>
std::vector<T> joined(const std::vector<std::vector<T>>& parts)
{
  std::vector<std::size_t> begin(1, 0);
  for(const auto& part : parts)
    begin.push_back(begin.back() + part.size());
  std::vector<T> result;
  resize_blocked(result, begin.back());
  blocked_for(parts.size(), 1, [&](std::size_t i, std::size_t) {
    std::copy(parts[i].begin(), parts[i].end(), result.begin() + begin[i]);
  });
  return result;
}

/// The indices below n for which `is_selected(i)`, ascending.
template <class Is_selected>
std::vector<std::uint32_t> select(std::size_t n, const Is_selected& is_selected)
{
  constexpr std::size_t block = 32768;
  std::vector<std::vector<std::uint32_t>> parts(number_of_blocks(n, block));
  blocked_for(n, block, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& part = parts[begin / block];
    part.resize(end - begin);
    std::size_t count = 0;
    for(std::size_t i = begin; i < end; ++i) {
      part[count] = std::uint32_t(i);
      count += is_selected(std::uint32_t(i)) ? 1 : 0;
    }
    part.resize(count);
  });
  return joined(parts);
}

/// Where the things of each key begin, and where those of the last one end.
typedef Uninitialized_vector<std::uint32_t> Key_begins;

/// Calls `use(low, size)` for stretches [low, low + size) that make up [0, n), one for each thread.
template <class Use>
void for_each_stretch_of_keys(std::size_t n, const Use& use)
{
  const std::size_t least = 16384, threads = Thread_scope::concurrency();
  const std::size_t size = (std::max)(least, number_of_blocks(n, threads));
  blocked_for(n, size, [&](std::size_t begin, std::size_t end) {
    use(std::uint32_t(begin), std::uint32_t(end - begin));
  });
}

/// A stable counting sort by keys below n. `for_each(use)` calls `use(key, thing)` for all things in
/// their order; `place(i, thing)` is told the place i of each thing. Returns the begin of each key,
/// n + 1 places. Each thread looks at all things and takes care of a stretch of the keys: things of
/// meshes in spatial order are nearly sorted already, so that the look is cheap.
template <class For_each, class Prepare, class Place>
Key_begins sort_by_key(std::size_t n, const For_each& for_each, const Prepare& prepare,
                       const Place& place)
{
  Key_begins begin(n + 2); // of key k at k + 1 until all are placed: then it is at k
  begin[0] = 0;
  begin[1] = 0;
  for_each_stretch_of_keys(n, [&](std::uint32_t low, std::uint32_t size) {
    std::uint32_t* count = begin.data() + low + 2;
    std::fill_n(count, size, 0u);
    for_each([=](std::uint32_t key, const auto&) {
      if(key - low < size)
        ++count[key - low];
    });
  });
  for(std::size_t k = 2; k < n + 2; ++k)
    begin[k] += begin[k - 1];
  prepare(std::size_t(begin[n + 1]));
  for_each_stretch_of_keys(n, [&](std::uint32_t low, std::uint32_t size) {
    std::uint32_t* next = begin.data() + low + 1;
    for_each([&](std::uint32_t key, const auto& thing) {
      if(key - low < size)
        place(next[key - low]++, thing);
    });
  });
  begin.pop_back();
  return begin;
}

} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_SORT_AND_SELECT_H
