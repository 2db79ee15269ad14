// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_CSV_FILE_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_CSV_FILE_H

#include "../machine.h"
#include "Comparison.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace side_by_side {

// What to do with a file that an earlier call has left.
enum class Earlier_rows { DROP, KEEP };

// A CSV file: a comment line about the machine, a line of column names, one row for each run and
// one, with "median" as repetition, for all runs of a method on a chart. Unknown numbers are empty.
class Csv_file
{
public:
  // Throws if rows are to be kept that another machine, compiler or commit made.
  Csv_file(const std::string& path, Earlier_rows earlier) : m_path(path)
  {
    const bool is_continued = earlier == Earlier_rows::KEEP && std::ifstream(path).good();
    if(is_continued)
      read();
    m_out.open(path, is_continued ? std::ios::app : std::ios::trunc);
    if(!is_continued)
      m_out << header();
    flush();
  }

  // Whether the file has the median of a method on a chart, which is written last.
  bool has(const std::string& chart, const std::string& method) const
  {
    return m_status.count({chart, method}) > 0;
  }

  // Whether the file says that a run of the method on the chart was stopped.
  bool has_exceeded_time(const std::string& chart, const std::string& method) const
  {
    const auto found = m_status.find({chart, method});
    return found != m_status.end() && found->second == time_limit;
  }

  // Writes the runs of all methods on a chart.
  void write(const std::vector<Runs>& all)
  {
    std::ostringstream rows; // in one piece, lest an interruption leave half of them
    for(const Runs& runs : all) {
      for(std::size_t i = 0; i < runs.repetitions.size(); ++i)
        write_row(runs, std::to_string(i + 1), runs.repetitions[i], rows);
      write_row(runs, "median", median(runs.repetitions), rows);
    }
    m_out << rows.str();
    flush();
  }

private:
  static const std::vector<const char*>& columns()
  {
    // clang-format off
    static const std::vector<const char*> names = {
        "faces", "vertices",
        "seconds_hierarchy", "seconds_operators", "seconds_solve", "seconds_total",
        "seconds_system",
        "levels", "iterations", "tolerance", "converged",
        "energy", "energy_per_area", "exact_energy_gap", "energy_cgal", "energy_gap",
        "energy_gap_estimate",
        "flips", "degenerate", "quasi_conformal_mean", "quasi_conformal_99",
        "area_scale_range", "stretch_L2", "residual",
        "collapses", "coarse_vertices", "coarse_quality_mean", "coarse_distance_mean",
        "mesh_memory_mb", "peak_memory_mb", "bytes_per_face", "threads"};
    // clang-format on
    return names;
  }

  static std::string header()
  {
    std::string text = "# " + machine::description() + "\nchart,method,repetition";
    for(const char* column : columns())
      text += std::string(",") + column;
    return text + ",status\n";
  }

  void write_row(const Runs& runs, const std::string& repetition, const Measurement& measurement,
                 std::ostream& out)
  {
    out << runs.chart << ',' << runs.method << ',' << repetition;
    for(const char* column : columns()) {
      const double value = measurement.get(column);
      char text[40] = "";
      if(!std::isnan(value))
        std::snprintf(text, sizeof text, "%.9g", value);
      out << ',' << text;
    }
    std::string status = measurement.status;
    std::replace(status.begin(), status.end(), '"', '\'');
    out << ",\"" << status << "\"\n";
    if(repetition == "median")
      m_status[{runs.chart, runs.method}] = status;
  }

  void read()
  {
    std::ifstream in(m_path);
    std::string comment, names, row;
    std::getline(in, comment);
    std::getline(in, names);
    if(comment + '\n' + names + '\n' != header())
      throw std::runtime_error(m_path
                               + ": its rows are of another machine, compiler or commit; "
                                 "remove it, or do without --resume");
    while(std::getline(in, row)) {
      std::istringstream fields(row);
      std::string chart, method, repetition;
      std::getline(fields, chart, ',');
      std::getline(fields, method, ',');
      std::getline(fields, repetition, ',');
      const std::size_t quote = row.find(",\"");
      if(repetition == "median" && quote != std::string::npos && row.back() == '"')
        m_status[{chart, method}] = row.substr(quote + 2, row.size() - quote - 3);
    }
  }

  void flush()
  {
    m_out.flush();
    if(!m_out)
      throw std::runtime_error(m_path + ": cannot be written");
  }

  std::string m_path;
  std::ofstream m_out;
  std::map<std::pair<std::string, std::string>, std::string> m_status; // of (chart, method)
};

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_CSV_FILE_H
