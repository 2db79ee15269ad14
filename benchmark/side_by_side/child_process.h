// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_CHILD_PROCESS_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_CHILD_PROCESS_H

#include "Measurement.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace side_by_side {

// What a run may use before it is stopped.
struct Limits
{
  double seconds = 600; // of wall time, reading the chart included
  double gigabytes = 0; // of address space; 0: no limit
};

// The status of a run that was stopped.
constexpr const char* time_limit = "time limit";

// The largest amount of physical memory that this process has had so far, in MB (1e6 bytes).
inline double peak_memory_mb()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024e-6;
}

// The seconds that the system has worked for this process so far, mostly to give it memory.
inline double system_seconds()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_stime.tv_sec) + 1e-6 * double(usage.ru_stime.tv_usec);
}

// The number of threads that this process has.
inline double number_of_threads()
{
  std::ifstream status("/proc/self/status");
  for(std::string line; std::getline(status, line);)
    if(line.compare(0, 8, "Threads:") == 0)
      return std::strtod(line.c_str() + 8, nullptr);
  return unknown;
}

namespace internal {

// Becomes another run of this program, which ends with its parent at the latest. All libraries get
// one thread: CHOLMOD asks for four of OpenMP's, whatever OMP_NUM_THREADS says.
[[noreturn]] inline void become(std::vector<std::string> arguments, int output,
                                const Limits& limits)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(output, STDOUT_FILENO);
  for(const char* variable :
      {"OMP_NUM_THREADS", "OMP_THREAD_LIMIT", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"})
    setenv(variable, "1", 1);
  if(limits.gigabytes > 0) {
    const rlim_t bytes = rlim_t(limits.gigabytes * 1e9);
    const rlimit limit = {bytes, bytes};
    setrlimit(RLIMIT_AS, &limit);
  }
  std::vector<char*> argv;
  for(std::string& argument : arguments)
    argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv("/proc/self/exe", argv.data());
  _exit(127);
}

// Reads until the end of the stream or until the deadline; false in the second case.
inline bool read_until(std::chrono::steady_clock::time_point deadline, int input, std::string& text)
{
  while(true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if(left.count() <= 0)
      return false;
    pollfd request = {input, POLLIN, 0};
    const int ready = poll(&request, 1, int(std::min<long long>(left.count(), 1000)));
    if(ready <= 0)
      continue;
    char buffer[4096];
    const ssize_t count = read(input, buffer, sizeof buffer);
    if(count > 0)
      text.append(buffer, std::size_t(count));
    else if(count == 0 || errno != EINTR)
      return true;
  }
}

} // namespace internal

// Runs this program again with other arguments, in a process of its own, so that neither memory
// nor caches pass from one measurement to the next, and returns what it sends.
inline Measurement measure_in_child(const std::vector<std::string>& arguments, const Limits& limits)
{
  int ends[2];
  if(pipe(ends) != 0)
    throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if(child < 0)
    throw std::runtime_error("no process");
  if(child == 0) {
    close(ends[0]);
    std::vector<std::string> argv{"side_by_side"};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    internal::become(argv, ends[1], limits);
  }
  close(ends[1]);
  const auto deadline = std::chrono::steady_clock::now()
                        + std::chrono::milliseconds((long long)(1000 * limits.seconds));
  std::string text;
  const bool in_time = internal::read_until(deadline, ends[0], text);
  if(!in_time)
    kill(child, SIGKILL);
  close(ends[0]);
  int state = 0;
  waitpid(child, &state, 0);

  Measurement measurement = receive(text);
  if(!in_time)
    measurement.status = time_limit;
  else if(WIFSIGNALED(state))
    measurement.status = "ended by signal " + std::to_string(WTERMSIG(state));
  return measurement;
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_CHILD_PROCESS_H
