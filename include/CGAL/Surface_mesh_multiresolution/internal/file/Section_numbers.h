// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SECTION_NUMBERS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SECTION_NUMBERS_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Code_column.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Corner_lists.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/split_prediction.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The numbers of a section of version 1 or 2, and of the base of later ones, read in loops that a
// processor can run ahead in. What is not sound in itself is refused; what they say of the mesh is for
// others to check.
struct Section_numbers
{
  // How reading keeps within the bytes: by a look at each number, or by what can be read behind.
  enum class Bounds { LOOK, SLACK };

  explicit Section_numbers(bool has_uv_columns = true) : has_uv(has_uv_columns) {}

  // Read the next columns: pairs first, which say how many wedges there are. Splits lack their
  // kinds; the first makes the given wedge. Low words are there if values have more than 32 bits.
  bool read_pairs(std::size_t count, const char*& from, const char* end);
  bool read_splits(Vertex_index wedge, Parent_prediction& prediction, const char*& from,
                   const char* end);
  template <Bounds bounds>
  bool read_values(bool has_low, const char*& from, const char* end);

  bool has_uv;                                   // or no texture, and no pairs
  std::vector<std::uint8_t> is_second;           // of two wedges of a vertex
  std::vector<Ring_split> splits;
  Uninitialized_vector<Wedge_values> residuals;  // of predictions
  std::vector<std::array<std::uint32_t, 5>> low; // if there are

private:
  typedef std::array<Column_reader, 5> Value_columns;

  bool open(Value_columns& columns, const char*& from, const char* end) const;
  template <Bounds bounds>
  void read_residuals(Value_columns& columns);
};

inline bool Section_numbers::read_pairs(std::size_t count, const char*& from, const char* end)
{
  Column_reader pairs(from, end, 0);
  if(!pairs.is_sound())
    return false;
  is_second.assign(count, 0);
  std::uint32_t all = 0;
  if(!pairs.is_empty())
    for(std::uint8_t& flag : is_second) {
      const std::uint32_t code = pairs.next<Column_code::RICE>();
      flag = std::uint8_t(code);
      all |= code;
    }
  return pairs.is_sound() && all <= (has_uv ? 1u : 0u) && is_second[0] == 0;
}

inline bool Section_numbers::read_splits(Vertex_index wedge, Parent_prediction& prediction,
                                         const char*& from, const char* end)
{
  const std::size_t count = is_second.size();
  Column_reader ranges(from, end, count), deltas(from, end, count);
  Column_reader skipped(from, end, count), moved(from, end, count);
  if(!ranges.is_sound() || !deltas.is_sound() || !skipped.is_sound() || !moved.is_sound())
    return false;
  splits.resize(count);
  bool has_parents = true;
  for(Ring_split& split : splits) {
    prediction.advance_to(wedge);
    const Parent_prediction::Code code = {ranges.next_unbounded<Column_code::RICE>(),
                                          deltas.next_unbounded<Column_code::EXP_GOLOMB>()};
    split.parent = prediction.parent_of(code);
    split.kind = Split_kind::INSIDE;
    split.skipped = skipped.next_unbounded<Column_code::RICE>();
    split.moved = unzigzag(moved.next_unbounded<Column_code::RICE>()) + expected_moved;
    has_parents = has_parents && split.parent < wedge++;
  }
  return has_parents && ranges.is_sound() && deltas.is_sound() && skipped.is_sound()
      && moved.is_sound();
}

inline bool Section_numbers::open(Value_columns& columns, const char*& from, const char* end) const
{
  const std::size_t wedges = is_second.size();
  const std::size_t seconds = std::size_t(std::count(is_second.begin(), is_second.end(), 1));
  bool is_sound = true;
  for(int c = 0; c < (has_uv ? 5 : 3); ++c) {
    columns[c] = Column_reader(from, end, c < 3 ? wedges - seconds : wedges);
    is_sound = is_sound && columns[c].is_sound();
  }
  return is_sound;
}

// Copies of the readers stay in registers, and the steps of several, which depend on each other in
// each, overlap.
template <Section_numbers::Bounds bounds>
void Section_numbers::read_residuals(Value_columns& columns)
{
  const auto next = [](Column_reader& column) {
    return unzigzag(bounds == Bounds::LOOK ? column.next<Column_code::RICE>()
                                           : column.next_unbounded<Column_code::RICE>());
  };
  Column_reader x = columns[0], y = columns[1], z = columns[2], u = columns[3], v = columns[4];
  for(std::size_t i = 0; i < residuals.size(); ++i)
    if(is_second[i] == 0) {
      Wedge_values& row = residuals[i];
      row[0] = next(x);
      row[1] = next(y);
      row[2] = next(z);
    }
  for(Wedge_values& row : residuals) {
    row[3] = has_uv ? next(u) : 0;
    row[4] = has_uv ? next(v) : 0;
  }
  columns = {x, y, z, u, v};
}

template <Section_numbers::Bounds bounds>
bool Section_numbers::read_values(bool has_low, const char*& from, const char* end)
{
  const int count = has_uv ? 5 : 3;
  const auto are_sound = [count](const Value_columns& columns) {
    return std::all_of(columns.begin(), columns.begin() + count,
                       [](const Column_reader& c) { return c.is_sound(); });
  };
  Value_columns high, rest;
  if(!open(high, from, end) || (has_low && !open(rest, from, end)))
    return false;
  residuals.resize(is_second.size());
  read_residuals<bounds>(high);
  if(!has_low)
    return are_sound(high);
  low.resize(is_second.size());
  for(std::size_t i = 0; i < low.size(); ++i)
    for(int c = is_second[i] == 0 ? 0 : 3; c < count; ++c)
      low[i][c] = rest[c].next<Column_code::RICE>();
  return are_sound(high) && are_sound(rest);
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SECTION_NUMBERS_H
