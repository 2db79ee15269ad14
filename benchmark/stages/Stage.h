// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_STAGES_STAGE_H
#define HLSCM_BENCHMARK_STAGES_STAGE_H

#include "../side_by_side/Measurement.h"
#include "../timing.h"
#include "../traffic.h"

#include <deque>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace stages {

// What bounds the time of a stage from below: so much of something, each of which takes so long.
struct Bound
{
  std::string by; // empty: none is known
  double amount = 0, seconds_each = 0;

  double seconds() const { return amount * seconds_each; }
};

// The time in which memory is copied with as much traffic.
inline Bound copying(double bytes)
{
  return {"bytes copied", bytes, 1 / traffic::copy_bandwidth()};
}

struct Stage
{
  std::string name;
  double seconds = 0;
  double page_faults = 0; // pages that the system had to give, and to clear
  double count = 0;       // what it works through
  std::string of;         // the name of that
  Bound bound;
};

inline double page_faults_so_far()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_minflt);
}

// The seconds of a page fault, the best of three: each page of 256 MB of new memory is touched.
inline double page_fault_seconds()
{
  static const double best = [] {
    constexpr std::size_t bytes = std::size_t(1) << 28, page = 4096;
    double result = 1;
    for(int i = 0; i < 3; ++i) {
      const std::unique_ptr<char[]> memory(new char[bytes]);
      volatile char* byte = memory.get();
      const double before = page_faults_so_far();
      const timing::Stopwatch stopwatch;
      for(std::size_t at = 0; at < bytes; at += page)
        byte[at] = 1;
      result = std::min(result, stopwatch.seconds() / (page_faults_so_far() - before));
    }
    return result;
  }();
  return best;
}

// The stages of a run, in their order. They stay where they are.
class Stage_list
{
public:
  // Runs `work` as a stage, whose other members the caller fills in.
  template <class Work>
  Stage& run(const std::string& name, const Work& work)
  {
    const double faults = page_faults_so_far();
    const timing::Stopwatch stopwatch;
    work();
    Stage stage;
    stage.seconds = stopwatch.seconds();
    stage.page_faults = page_faults_so_far() - faults;
    stage.name = name;
    m_stages.push_back(stage);
    return m_stages.back();
  }

  void add(const Stage& stage) { m_stages.push_back(stage); }
  std::vector<Stage> stages() const { return {m_stages.begin(), m_stages.end()}; }

private:
  std::deque<Stage> m_stages;
};

// The medians of the times and page faults of runs that have the same stages.
inline std::vector<Stage> median(const std::vector<std::vector<Stage>>& runs)
{
  std::vector<Stage> result = runs.front();
  for(std::size_t s = 0; s < result.size(); ++s) {
    std::vector<double> seconds, faults;
    for(const std::vector<Stage>& run : runs) {
      seconds.push_back(run[s].seconds);
      faults.push_back(run[s].page_faults);
    }
    result[s].seconds = side_by_side::median(seconds);
    result[s].page_faults = side_by_side::median(faults);
  }
  return result;
}

inline void write_header(std::ostream& out)
{
  out << "chart,faces,threads,stage,seconds,part,count,of,per_second,bound_by,amount,bound_seconds,ratio,"
         "page_faults,page_fault_seconds\n";
}

// A row; `whole` is the seconds of which the stage's are a part.
inline void write_row(const std::string& chart, std::size_t faces, unsigned int threads,
                      const Stage& stage, double whole, std::ostream& out)
{
  out << chart << ',' << faces << ',' << threads << ',' << stage.name << ',' << stage.seconds << ','
      << stage.seconds / whole << ',';
  if(!stage.of.empty())
    out << stage.count;
  out << ',' << stage.of << ',';
  if(!stage.of.empty())
    out << stage.count / stage.seconds;
  out << ',' << stage.bound.by << ',';
  if(stage.bound.by.empty())
    out << ",,";
  else
    out << stage.bound.amount << ',' << stage.bound.seconds() << ','
        << stage.seconds / stage.bound.seconds();
  out << ',' << stage.page_faults << ',' << stage.page_faults * page_fault_seconds() << '\n';
}

} // namespace stages

#endif // HLSCM_BENCHMARK_STAGES_STAGE_H
