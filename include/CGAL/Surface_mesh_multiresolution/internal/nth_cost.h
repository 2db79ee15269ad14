// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_NTH_COST_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_NTH_COST_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The highest bits of a number, ordered as the numbers are.
inline std::uint32_t class_of_cost(float cost)
{
  std::uint32_t bits;
  std::memcpy(&bits, &cost, sizeof(bits));
  return ((bits >> 31) != 0 ? ~bits : bits | (1u << 31)) >> 19;
}

// How many costs of a block there are in each class.
typedef std::array<std::uint32_t, 8192> Cost_histogram;

// The cost of the members that is at the place `rank(n)` of the n finite ones in their order;
// infinity if none is finite. Counts classes of costs first, so that few remain to be compared.
template <class Rank>
float nth_cost(const std::vector<Vertex_index>& members, const std::vector<float>& cost,
               const Rank& rank)
{
  constexpr float infinity = (std::numeric_limits<float>::infinity)();
  constexpr std::size_t block = 65536;
  std::vector<Cost_histogram> counts(
    Blocked_execution::number_of_blocks(members.size(), block));
  Blocked_execution::blocked_for(members.size(), block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      if(cost[members[i]] < infinity)
        ++counts[begin / block][class_of_cost(cost[members[i]])];
  });
  Cost_histogram total = {};
  std::size_t number = 0;
  for(const Cost_histogram& of_block : counts)
    for(std::size_t c = 0; c < total.size(); ++c) {
      total[c] += of_block[c];
      number += of_block[c];
    }
  if(number == 0)
    return infinity;
  std::size_t place = rank(number);
  std::uint32_t its_class = 0;
  while(place >= total[its_class])
    place -= total[its_class++];
  std::vector<float> candidates;
  candidates.reserve(total[its_class]);
  for(const Vertex_index v : members)
    if(cost[v] < infinity && class_of_cost(cost[v]) == its_class)
      candidates.push_back(cost[v]);
  std::nth_element(candidates.begin(), candidates.begin() + place, candidates.end());
  return candidates[place];
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_NTH_COST_H
