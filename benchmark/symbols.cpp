// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What decoding the symbols of a progressive mesh costs without the mesh: for each split eight, by the
// coders that a textured model has, of numbers that take about as many bits. streams.mjs compiles it for
// WebAssembly and for this machine: no reader of the format is faster than that.

#include "../examples/web/stream/decoder/exported.h"

#include <CGAL/Surface_mesh_multiresolution/internal/file/Residual_coder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace CGAL::Surface_mesh_multiresolution::internal;

constexpr std::uint32_t splits_of_section = 4096;

struct Split
{
  std::uint32_t way, skipped, moved, corners, spread;
  std::array<std::uint32_t, 5> residuals;
};

// The models of all symbols of a split of a wedge inside, as in Split_coder.h.
struct Split_symbols
{
  template <class Coder>
  void code(Coder& coder, Split& split)
  {
    split.way = coder.symbol(way, split.way);
    split.skipped = code_small(coder, skipped[split.corners], split.skipped);
    split.moved = code_small(coder, moved[split.corners], split.moved);
    constexpr std::array<Residual_kind, 5> kinds
      = {Residual_kind::UV, Residual_kind::UV, Residual_kind::NORMAL, Residual_kind::TANGENT,
         Residual_kind::TANGENT};
    for(std::size_t c = 0; c < 5; ++c)
      split.residuals[c] = residuals.code(coder, kinds[c], int(split.spread), split.residuals[c]);
  }

  Symbol_model way;
  std::array<Symbol_model, 16> skipped, moved;
  Residual_coder residuals;
};

std::uint32_t state = 1;

double random_part() // in [0, 1)
{
  state = state * 1664525u + 1013904223u;
  return double(state >> 8) / double(1 << 24);
}

// Numbers with a geometric distribution of this mean
std::uint32_t random_size(double mean)
{
  return std::uint32_t(-std::log(1. - random_part()) * mean);
}

Split random_split()
{
  Split split = {};
  split.way = (std::min)(random_size(1.2), 11u);
  split.skipped = std::uint32_t(6. * random_part());
  split.moved = 1 + (std::min)(std::uint32_t(2. + 2. * (random_part() + random_part() - 1.)), 9u);
  split.corners = 5 + std::uint32_t(3. * random_part());
  split.spread = 10 + std::uint32_t(4. * random_part());
  constexpr std::array<double, 5> means = {7., 7., 9., 3.5, 3.5};
  for(std::size_t c = 0; c < 5; ++c)
    split.residuals[c] = random_size(means[c]) * (random_part() < 0.5 ? 1u : 0u - 1u);
  return split;
}

std::vector<Split> splits;
std::vector<std::string> sections; // with the bytes behind that may be read
std::size_t number_of_bytes = 0;

} // namespace

// Codes so many splits; returns their bytes.
EXPORTED std::size_t prepare(std::size_t count)
{
  splits.resize(count);
  Split_symbols symbols;
  for(std::size_t i = 0; i < count;) {
    Symbol_encoder encoder;
    for(const std::size_t end = (std::min)(count, i + splits_of_section); i < end; ++i) {
      splits[i] = random_split();
      symbols.code(encoder, splits[i]);
    }
    sections.push_back(encoder.take_bytes(0));
    number_of_bytes += sections.back().size();
    sections.back().resize(sections.back().size() + 64, '\0');
  }
  return number_of_bytes;
}

// Decodes them; returns the number of those that are what they were, which is all of them.
EXPORTED std::size_t decode()
{
  Split_symbols symbols;
  std::size_t equal = 0, i = 0;
  for(const std::string& section : sections) {
    Symbol_decoder decoder(section.data(), section.size() - 64);
    for(const std::size_t end = (std::min)(splits.size(), i + splits_of_section); i < end; ++i) {
      Split split = {};
      split.corners = splits[i].corners;
      split.spread = splits[i].spread;
      symbols.code(decoder, split);
      equal += split.residuals[4] == splits[i].residuals[4] ? 1 : 0;
    }
  }
  return equal;
}

#if !defined(__EMSCRIPTEN__)

#include <cstdlib>
#include <ctime>
#include <iostream>

int main(int argc, char** argv)
{
  const std::size_t count = argc > 1 ? std::size_t(std::atoi(argv[1])) : 500000;
  prepare(count);
  const std::clock_t start = std::clock();
  const bool is_right = decode() == count;
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  std::cout << double(count) / seconds << '\n'; // a second of the processor
  return is_right ? 0 : 1;
}

#endif
