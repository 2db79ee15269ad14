// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_COMPARISON_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_COMPARISON_H

#include "child_process.h"
#include "methods.h"

#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace side_by_side {

// What is compared, and how often.
struct Comparison_options
{
  std::vector<std::string> methods; // names
  int repetitions = 3;
  double slow_seconds = 60; // a method whose first run took longer is not repeated on that chart
  Limits limits;
  int cg_iterations = 10000; // the most that CGAL with conjugate gradients may take
};

// All runs of one method on one chart.
struct Runs
{
  std::string chart, method;
  std::vector<Measurement> repetitions;
};

inline std::string name_of_chart(const std::string& path)
{
  return std::filesystem::path(path).stem().string();
}

// Runs methods on charts in child processes and relates their energies to those of the direct
// solutions. A method that exceeded the time on a chart is not tried on larger ones.
class Comparison
{
public:
  explicit Comparison(const Comparison_options& options)
    : m_options(options), m_methods(all_methods())
  {}

  // The runs of each method, in the order of the list, with the numbers of add_gaps(). The
  // repetitions of the methods alternate, so that a noisy minute does not hit one method alone.
  std::vector<Runs> run(const std::string& chart)
  {
    std::vector<Runs> all;
    for(const std::string& name : m_options.methods)
      all.push_back({name_of_chart(chart), name, {}});
    for(int repetition = 0; repetition < m_options.repetitions; ++repetition)
      for(Runs& runs : all)
        if(repetition == 0 || is_repeated(runs.repetitions.front()))
          runs.repetitions.push_back(run_once(chart, runs.method));
    add_gaps(all);
    return all;
  }

  // Tells that a method exceeded the time on a chart in an earlier call.
  void note_too_slow(const std::string& chart, const std::string& method)
  {
    std::uintmax_t& size =
        m_too_slow_from.emplace(method, std::numeric_limits<std::uintmax_t>::max()).first->second;
    size = std::min(size, std::filesystem::file_size(chart));
  }

private:
  bool is_repeated(const Measurement& first) const
  {
    return first.is_ok() && first.get("seconds_total") <= m_options.slow_seconds;
  }

  Measurement run_once(const std::string& chart, const std::string& method)
  {
    const auto too_slow = m_too_slow_from.find(method);
    if(too_slow != m_too_slow_from.end() && std::filesystem::file_size(chart) >= too_slow->second) {
      Measurement skipped;
      skipped.status = "skipped: too slow on a smaller chart";
      return skipped;
    }
    std::cerr << chart << ' ' << method << std::flush;
    const Measurement measurement = measure_in_child(
        {"--run", method, chart, "--cg-iterations", std::to_string(m_options.cg_iterations)},
        m_options.limits);
    if(measurement.status == time_limit)
      note_too_slow(chart, method);
    std::cerr << ' ' << measurement.get("seconds_total") << " s " << measurement.status
              << std::endl;
    return measurement;
  }

  // The energy of a direct solution that was run on this chart; unknown if there is none.
  double minimum(const std::vector<Runs>& all, Energy energy, const std::string& column) const
  {
    for(const Method& method : m_methods) {
      if(method.energy != energy || !method.is_direct)
        continue;
      for(const Runs& runs : all)
        if(runs.method == method.name && runs.repetitions.front().is_ok())
          return runs.repetitions.front().get(column);
    }
    return unknown;
  }

  // E / Emin - 1 in the energy that the method minimises, the same in the exact energy, and bytes
  // per face.
  void add_gaps(std::vector<Runs>& all) const
  {
    const double exact = minimum(all, Energy::EXACT, "energy");
    const double cgal = minimum(all, Energy::CGAL_LSCM, "energy_cgal");
    for(Runs& runs : all) {
      const Method* method = find_method(m_methods, runs.method);
      for(Measurement& m : runs.repetitions) {
        if(!m.is_ok())
          continue;
        m.numbers["bytes_per_face"] = 1e6 * m.get("peak_memory_mb") / m.get("faces");
        if(method->energy == Energy::WITHOUT_PINS) // another minimum
          continue;
        m.numbers["exact_energy_gap"] = m.get("energy") / exact - 1;
        m.numbers["energy_gap"] = method->energy == Energy::CGAL_LSCM
                                      ? m.get("energy_cgal") / cgal - 1
                                      : m.get("energy") / exact - 1;
      }
    }
  }

  Comparison_options m_options;
  std::vector<Method> m_methods;
  std::map<std::string, std::uintmax_t> m_too_slow_from; // size of the file
};

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_COMPARISON_H
