// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_INTERNAL_SELECT_H
#define CGAL_BLOCKED_EXECUTION_INTERNAL_SELECT_H

#include <CGAL/Blocked_execution/internal/Uninitialized_vector.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Blocked_execution {
namespace internal {

// The parts one after the other.
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

// The indices below n for which `is_selected(i)`, ascending.
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

} // namespace internal
} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_INTERNAL_SELECT_H
