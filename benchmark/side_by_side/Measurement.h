// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_MEASUREMENT_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_MEASUREMENT_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace side_by_side {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// What one run of one method on one chart tells: numbers under the names of the CSV's columns, and
// a status, "ok" or one sentence. A number that the method does not know is absent.
struct Measurement
{
  std::map<std::string, double> numbers;
  std::string status = "ok";

  bool is_ok() const { return status == "ok"; }
  double get(const std::string& name) const
  {
    const auto found = numbers.find(name);
    return found == numbers.end() ? unknown : found->second;
  }
};

// A measurement passes from the child process to its parent as lines "@name=value".
inline void send(const Measurement& measurement, std::FILE* out)
{
  for(const auto& [name, value] : measurement.numbers)
    std::fprintf(out, "@%s=%.17g\n", name.c_str(), value);
  std::fprintf(out, "@status=%s\n", measurement.status.c_str());
  std::fflush(out);
}

// The status of a text without a status line is that of a child that ended too early.
inline Measurement receive(const std::string& text)
{
  Measurement measurement;
  measurement.status = "ended without a result";
  std::size_t begin = 0;
  while(begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t equals = line.find('=');
    if(line.empty() || line[0] != '@' || equals == std::string::npos)
      continue; // what a library printed
    const std::string name = line.substr(1, equals - 1), value = line.substr(equals + 1);
    if(name == "status")
      measurement.status = value;
    else
      measurement.numbers[name] = std::strtod(value.c_str(), nullptr);
  }
  return measurement;
}

inline double median(std::vector<double> values)
{
  if(values.empty())
    return unknown;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

// The median of each number over the runs that succeeded; if none did over all, with the status of
// the first.
inline Measurement median(const std::vector<Measurement>& runs)
{
  const bool is_any_ok =
      std::any_of(runs.begin(), runs.end(), [](const Measurement& run) { return run.is_ok(); });
  std::map<std::string, std::vector<double>> values;
  for(const Measurement& run : runs)
    if(run.is_ok() || !is_any_ok)
      for(const auto& [name, value] : run.numbers)
        values[name].push_back(value);
  Measurement result;
  if(!is_any_ok)
    result.status = runs.empty() ? "not run" : runs.front().status;
  for(const auto& [name, list] : values)
    result.numbers[name] = median(list);
  return result;
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_MEASUREMENT_H
