// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_TABLES_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_TABLES_H

#include "Comparison.h"

#include <cstdio>

namespace side_by_side {

// The median of a method among the runs on a chart.
inline Measurement median_of(const std::vector<Runs>& all, const std::string& method)
{
  for(const Runs& runs : all)
    if(runs.method == method)
      return median(runs.repetitions);
  return {};
}

// A number for a table; "-" if unknown.
inline std::string cell(double value, const char* format = "%.3g")
{
  char text[40] = "-";
  if(!std::isnan(value))
    std::snprintf(text, sizeof text, format, value);
  return text;
}

// What a reader of the numbers must know.
inline std::string remark(const Measurement& m)
{
  if(!m.is_ok())
    return m.status;
  if(m.get("energy_gap") > m.get("tolerance"))
    return "the gap is above the tolerance";
  return m.get("converged") == 0 ? "not converged" : "";
}

inline void print_comparison(const std::vector<Runs>& all)
{
  std::printf("\n%-20s %9s %9s %9s %9s %9s %6s %10s %7s %8s %9s %7s\n", all.front().chart.c_str(),
              "hierarchy", "operators", "solve", "total s", "slower", "its", "E/Emin-1", "flips",
              "qc mean", "peak MB", "B/face");
  const double fastest = median_of(all, "hlscm_1e-2").get("seconds_total");
  for(const Runs& runs : all) {
    const Measurement m = median(runs.repetitions);
    std::printf("%-20s %9s %9s %9s %9s %9s %6s %10s %7s %8s %9s %7s  %s\n", runs.method.c_str(),
                cell(m.get("seconds_hierarchy")).c_str(), cell(m.get("seconds_operators")).c_str(),
                cell(m.get("seconds_solve")).c_str(), cell(m.get("seconds_total")).c_str(),
                cell(m.get("seconds_total") / fastest, "%.2fx").c_str(),
                cell(m.get("iterations"), "%.0f").c_str(),
                cell(m.get("energy_gap"), "%.2e").c_str(), cell(m.get("flips"), "%.0f").c_str(),
                cell(m.get("quasi_conformal_mean"), "%.5g").c_str(),
                cell(m.get("peak_memory_mb"), "%.0f").c_str(),
                cell(m.get("bytes_per_face"), "%.0f").c_str(), remark(m).c_str());
  }
  std::fflush(stdout);
}

// The decimation engines with the same policies. "faster" is against CGAL's edge_collapse(); the
// coarsest mesh has its quality and its distance from the fine vertices, in fine edges; "its" and
// what follows come from parameterizing with that hierarchy.
inline void print_decimation(const std::vector<Runs>& all)
{
  std::printf("\n%-20s %9s %11s %9s %9s %9s %9s %9s %6s %10s %7s\n", all.front().chart.c_str(),
              "seconds", "collapses/s", "faster", "vertices", "quality", "distance", "peak MB",
              "its", "E/Emin-1", "flips");
  const double slowest = median_of(all, "decimate_cgal").get("seconds_total");
  for(const std::string engine : {"flat", "flat_strict", "cgal"}) {
    const Measurement alone = median_of(all, "decimate_" + engine);
    const Measurement map = median_of(all, "hlscm_" + engine);
    const double seconds = alone.get("seconds_total");
    std::printf("%-20s %9s %11s %9s %9s %9s %9s %9s %6s %10s %7s  %s\n", engine.c_str(),
                cell(seconds).c_str(), cell(alone.get("collapses") / seconds, "%.0f").c_str(),
                cell(slowest / seconds, "%.1fx").c_str(),
                cell(alone.get("coarse_vertices"), "%.0f").c_str(),
                cell(alone.get("coarse_quality_mean")).c_str(),
                cell(alone.get("coarse_distance_mean")).c_str(),
                cell(alone.get("peak_memory_mb"), "%.0f").c_str(),
                cell(map.get("iterations"), "%.0f").c_str(),
                cell(map.get("energy_gap"), "%.2e").c_str(), cell(map.get("flips"), "%.0f").c_str(),
                remark(alone.is_ok() ? map : alone).c_str());
  }
  std::fflush(stdout);
}

// One line of table 1 of Ray and Lévy 2003: seconds on a 1.2 GHz Pentium 4.
struct Paper_row
{
  const char* model;
  std::size_t faces;
  double construction, multigrid, total, monogrid;
};

inline const std::vector<Paper_row>& paper_table_1()
{
  static const std::vector<Paper_row> rows = {{"Venus", 37000, 10, 8, 18, 50},
                                              {"Horse", 72000, 20, 11, 31, 390},
                                              {"Scanned", 1120000, 285, 415, 704, unknown}};
  return rows;
}

inline void print_table_1_line(const std::string& name, double faces, double construction,
                               double multigrid, double total, double gap,
                               const std::string& remark)
{
  std::printf("%-36s %9s %10s %10s %8s %10s  %s\n", name.c_str(), cell(faces, "%.0f").c_str(),
              cell(construction).c_str(), cell(multigrid).c_str(), cell(total).c_str(),
              cell(gap, "%.2e").c_str(), remark.c_str());
}

inline void print_table_1_header()
{
  std::printf("\n%-36s %9s %10s %10s %8s %10s\n", "seconds", "triangles", "PM constr.", "multigrid",
              "total", "E/Emin-1");
}

// The seconds of the paper, then those measured on a chart of as many faces.
inline void print_table_1_rows(const Paper_row& paper, const std::vector<Runs>& all)
{
  const std::string model = std::string("paper, ") + paper.model;
  print_table_1_line(model + ", HLSCM", double(paper.faces), paper.construction, paper.multigrid,
                     paper.total, unknown, "");
  print_table_1_line(model + ", LSCM", double(paper.faces), unknown, unknown, paper.monogrid,
                     unknown, std::isnan(paper.monogrid) ? "?? in the paper" : "");
  for(const Runs& runs : all) {
    const Measurement m = median(runs.repetitions);
    print_table_1_line(runs.chart + ", " + runs.method, m.get("faces"), m.get("seconds_hierarchy"),
                       m.get("seconds_operators") + m.get("seconds_solve"), m.get("seconds_total"),
                       m.get("energy_gap"), remark(m));
  }
  std::fflush(stdout);
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_TABLES_H
