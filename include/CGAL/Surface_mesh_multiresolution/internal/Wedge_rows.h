// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_WEDGE_ROWS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_WEDGE_ROWS_H

#include <CGAL/Blocked_execution/internal/Uninitialized_vector.h>
#include <CGAL/Surface_mesh_multiresolution/internal/split_prediction.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The integers of wedges, in rows of 16 bits if these are enough and of 32 otherwise.
class Wedge_rows
{
public:
  explicit Wedge_rows(bool is_short = false) : m_is_short(is_short) {}

  bool is_short() const { return m_is_short; }

  // The rows, of the type that there is.
  template <class Row>
  Uninitialized_vector<Row>& rows()
  {
    if constexpr(std::is_same<Row, Wedge_values>::value)
      return m_long_rows;
    else
      return m_short_rows;
  }

  template <class Row>
  void set(std::size_t w, const Wedge_values& from)
  {
    std::copy(from.begin(), from.end(), rows<Row>()[w].begin());
  }

  void reserve(std::size_t wedges)
  {
    m_long_rows.reserve(m_is_short ? 0 : wedges);
    m_short_rows.reserve(m_is_short ? wedges : 0);
  }

  void resize(std::size_t wedges)
  {
    m_long_rows.resize(m_is_short ? 0 : wedges);
    m_short_rows.resize(m_is_short ? wedges : 0);
  }

private:
  bool m_is_short;
  Uninitialized_vector<Short_wedge_values> m_short_rows;
  Uninitialized_vector<Wedge_values> m_long_rows;
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_WEDGE_ROWS_H
