// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_PROGRESS_H
#define CGAL_BLOCKED_EXECUTION_PROGRESS_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Blocked_execution {

/// Measures seconds since it was made or since the last lap.
class Stopwatch
{
public:
  double lap()
  {
    const double result = seconds();
    m_start = std::chrono::steady_clock::now();
    return result;
  }

  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
  }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

/// Parts of the whole, in [0, 1], told to the user's function; remembers that it said stop.
class Progress
{
public:
  explicit Progress(const std::function<bool(double)>& function) : m_function(function) {}

  /// Whether the work, of which the stretch [begin, end] of the whole is done to `part`, goes on.
  bool operator()(double begin, double end, double part)
  {
    m_done = (std::max)(m_done, begin + (end - begin) * part); // estimates may go back
    if(m_function && !m_is_cancelled)
      m_is_cancelled = !m_function(m_done);
    return !m_is_cancelled;
  }

  bool is_cancelled() const { return m_is_cancelled; }

  void restart()
  {
    m_done = 0.;
    m_is_cancelled = false;
  }

private:
  const std::function<bool(double)>& m_function;
  double m_done = 0.;
  bool m_is_cancelled = false;
};

/// The sizes of the levels of a hierarchy, of meshes or of matrices, which print themselves:
///
///   level        rows    nonzeros        MB   ratio
///       1         257        1601      0.05    3.95
///       0          65         385      0.01
///   total         322        1986      0.06
///   complexity: rows 1.25, nonzeros 1.24
///
/// `ratio` is that of a level's rows to the next coarser one's, a complexity that of all levels' to
/// the finest one's (the second is the operator complexity of the literature).
class Level_table
{
public:
  /// What is counted of a level.
  struct Size
  {
    std::size_t rows = 0, entries = 0, bytes = 0;
  };

  Level_table(std::string name_of_rows, std::string name_of_entries)
    : m_name_of_rows(std::move(name_of_rows)), m_name_of_entries(std::move(name_of_entries))
  {}

  /// Adds a level that is finer than those before it.
  void add(const Size& level)
  {
    m_levels.push_back(level);
    m_total.rows += level.rows;
    m_total.entries += level.entries;
    m_total.bytes += level.bytes;
  }

  /// Prints the table, the finest level first; the flags of `out` stay as they are.
  friend std::ostream& operator<<(std::ostream& out, const Level_table& table)
  {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << "level" << std::setw(12) << table.m_name_of_rows
         << std::setw(12) << table.m_name_of_entries << std::setw(10) << "MB" << std::setw(8)
         << "ratio" << '\n';
    for(std::size_t l = table.m_levels.size(); l-- > 0;) {
      table.print_line(text, std::to_string(l), table.m_levels[l]);
      if(l > 0)
        text << std::setw(8) << quotient(table.m_levels[l].rows, table.m_levels[l - 1].rows);
      text << '\n';
    }
    table.print_line(text, "total", table.m_total);
    const Size finest = table.m_levels.empty() ? Size() : table.m_levels.back();
    text << "\ncomplexity: " << table.m_name_of_rows << ' '
         << quotient(table.m_total.rows, finest.rows) << ", " << table.m_name_of_entries << ' '
         << quotient(table.m_total.entries, finest.entries) << '\n';
    return out << text.str();
  }

private:
  static double quotient(std::size_t a, std::size_t b) { return b == 0 ? 0. : double(a) / double(b); }

  static void print_line(std::ostream& out, const std::string& name, const Size& size)
  {
    out << std::setw(5) << name << std::setw(12) << size.rows << std::setw(12) << size.entries
        << std::setw(10) << 1e-6 * double(size.bytes);
  }

  std::string m_name_of_rows, m_name_of_entries;
  std::vector<Size> m_levels;
  Size m_total;
};

} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_PROGRESS_H
