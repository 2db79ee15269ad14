// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_CSV_FILE_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_CSV_FILE_H

#include "Comparison.h"
#include "machine.h"

#include <fstream>
#include <stdexcept>

namespace side_by_side {

// A CSV file: a comment line about the machine, a line of column names, one row for each run and
// one, with "median" as repetition, for all runs of a method on a chart. Unknown numbers are empty.
class Csv_file
{
public:
  explicit Csv_file(const std::string& path) : m_path(path), m_out(path)
  {
    m_out << "# " << description_of_machine() << "\nchart,method,repetition";
    for(const char* column : columns())
      m_out << ',' << column;
    m_out << ",status\n";
    flush();
  }

  void write(const Runs& runs)
  {
    for(std::size_t i = 0; i < runs.repetitions.size(); ++i)
      write_row(runs, std::to_string(i + 1), runs.repetitions[i]);
    write_row(runs, "median", median(runs.repetitions));
    flush();
  }

private:
  static const std::vector<const char*>& columns()
  {
    static const std::vector<const char*> names = {"faces",
                                                   "vertices",
                                                   "seconds_hierarchy",
                                                   "seconds_operators",
                                                   "seconds_solve",
                                                   "seconds_total",
                                                   "levels",
                                                   "iterations",
                                                   "converged",
                                                   "energy",
                                                   "exact_energy_gap",
                                                   "energy_cgal",
                                                   "energy_gap",
                                                   "energy_gap_estimate",
                                                   "flips",
                                                   "quasi_conformal_99",
                                                   "area_scale_range",
                                                   "residual",
                                                   "mesh_memory_mb",
                                                   "peak_memory_mb",
                                                   "bytes_per_face"};
    return names;
  }

  void write_row(const Runs& runs, const std::string& repetition, const Measurement& measurement)
  {
    m_out << runs.chart << ',' << runs.method << ',' << repetition;
    for(const char* column : columns()) {
      const double value = measurement.get(column);
      char text[40] = "";
      if(!std::isnan(value))
        std::snprintf(text, sizeof text, "%.9g", value);
      m_out << ',' << text;
    }
    std::string status = measurement.status;
    std::replace(status.begin(), status.end(), '"', '\'');
    m_out << ",\"" << status << "\"\n";
  }

  void flush()
  {
    m_out.flush();
    if(!m_out)
      throw std::runtime_error(m_path + ": cannot be written");
  }

  std::string m_path;
  std::ofstream m_out;
};

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_CSV_FILE_H
