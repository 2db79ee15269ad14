// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The reader of progressive mesh files for a browser: functions of C around `Progressive_mesh_stream`,
// which is that of the library. There is one file at a time. Pointers are good until the next push().

#include "exported.h"

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_stream.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace {

typedef CGAL::Surface_mesh_multiresolution::Progressive_mesh_stream Stream;

struct Reader
{
  Stream stream;
  std::vector<char> piece;      // the bytes that come next
  std::vector<float> positions; // three of each wedge
  std::vector<float> uv;        // two of each wedge, 0 without texture
  std::string message;
};

Reader reader;

void append_coordinates()
{
  const std::size_t begin = reader.uv.size() / 2, end = reader.stream.number_of_wedges();
  if(begin == end)
    return;
  reader.positions.resize(3 * end);
  reader.uv.resize(2 * end);
  reader.stream.visit_coordinates(begin, end, [](std::size_t w, const std::array<double, 5>& x) {
    for(std::size_t c = 0; c < 3; ++c)
      reader.positions[3 * w + c] = float(x[c]);
    for(std::size_t c = 0; c < 2; ++c)
      reader.uv[2 * w + c] = float(x[3 + c]);
  });
}

} // namespace

// Begins anew.
EXPORTED void begin() { reader = Reader(); }

// Where the next bytes go, so many.
EXPORTED char* room(std::size_t size)
{
  reader.piece.resize(size);
  return reader.piece.data();
}

// Takes these bytes and returns the status, a `Progressive_mesh_file_status`.
EXPORTED int push()
{
  reader.stream.push(reader.piece.data(), reader.piece.size());
  append_coordinates();
  reader.message = reader.stream.message();
  return int(reader.stream.status());
}

EXPORTED const char* message() { return reader.message.c_str(); }
EXPORTED std::size_t number_of_splits() { return reader.stream.number_of_splits(); }
EXPORTED std::size_t number_of_splits_in_file() { return reader.stream.number_of_splits_in_file(); }
EXPORTED std::size_t number_of_wedges() { return reader.stream.number_of_wedges(); }
EXPORTED std::size_t number_of_triangles() { return reader.stream.number_of_triangles(); }
EXPORTED int has_texture() { return reader.stream.has_texture() ? 1 : 0; }
EXPORTED const float* positions() { return reader.positions.data(); }
EXPORTED const float* texture_coordinates() { return reader.uv.data(); }
EXPORTED const std::uint32_t* triangles()
{
  return reinterpret_cast<const std::uint32_t*>(reader.stream.triangles());
}
EXPORTED const std::uint32_t* vertices() { return reader.stream.vertices(); }
EXPORTED const std::uint32_t* parents() { return reader.stream.parents(); }

#if !defined(__EMSCRIPTEN__)

// The same by a native compiler, to compare: reads the file MODEL.pm and prints the numbers of wedges
// and triangles and the hash of all arrays, which is FNV-1a, word by word. With a number of ROUNDS
// the splits a second of the fastest, too, by the time of the processor.

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iostream>
#include <iterator>

namespace {

std::uint32_t hash_of_words(std::uint32_t hash, const void* words, std::size_t count)
{
  for(std::size_t i = 0; i < count; ++i) {
    std::uint32_t word;
    std::memcpy(&word, static_cast<const char*>(words) + 4 * i, 4);
    hash = (hash ^ word) * 16777619u;
  }
  return hash;
}

} // namespace

int main(int argc, char** argv)
{
  std::ifstream file(argc > 1 ? argv[1] : "", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  double fastest = 0.;
  for(int round = 0; round < (argc > 2 ? std::atoi(argv[2]) : 1); ++round) {
    begin();
    std::copy(bytes.begin(), bytes.end(), room(bytes.size()));
    const std::clock_t start = std::clock();
    push();
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    fastest = (std::max)(fastest, double(number_of_splits()) / seconds);
  }
  std::uint32_t hash = hash_of_words(2166136261u, positions(), 3 * number_of_wedges());
  hash = hash_of_words(hash, texture_coordinates(), 2 * number_of_wedges());
  hash = hash_of_words(hash, triangles(), 3 * number_of_triangles());
  std::cout << number_of_wedges() << ' ' << number_of_triangles() << ' ' << hash;
  if(argc > 2)
    std::cout << ' ' << fastest;
  std::cout << '\n';
  return 0;
}

#endif
