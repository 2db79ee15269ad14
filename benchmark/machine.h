// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_MACHINE_H
#define HLSCM_BENCHMARK_MACHINE_H

#include <CGAL/version.h>

#include <Eigen/Core>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#ifndef HLSCM_SOURCE_DIR
#define HLSCM_SOURCE_DIR "."
#endif
#ifndef HLSCM_COMPILE_FLAGS
#define HLSCM_COMPILE_FLAGS "unknown flags"
#endif

namespace machine {
namespace internal {

inline std::string cpu_model()
{
  std::ifstream info("/proc/cpuinfo");
  for(std::string line; std::getline(info, line);)
    if(line.compare(0, 10, "model name") == 0)
      return line.substr(line.find(':') + 2);
  return "unknown processor";
}

inline std::string first_line_of(const std::string& command)
{
  std::FILE* pipe = popen(command.c_str(), "r");
  if(pipe == nullptr)
    return {};
  char line[200] = {};
  const bool is_read = std::fgets(line, sizeof line, pipe) != nullptr;
  pclose(pipe);
  const std::string text = is_read ? line : "";
  return text.substr(0, text.find('\n'));
}

// HLSCM_COMMIT of the environment, or what git says about the source folder.
inline std::string commit()
{
  if(const char* given = std::getenv("HLSCM_COMMIT"))
    return given;
  const std::string described =
      first_line_of("git -C '" HLSCM_SOURCE_DIR "' describe --always --dirty 2>/dev/null");
  return described.empty() ? "unknown commit" : described;
}

} // namespace internal

// Machine, compiler, libraries and commit, in one line.
inline std::string description()
{
  return internal::cpu_model() + ", " + std::to_string(std::thread::hardware_concurrency())
         + " processors, one thread used unless a row says otherwise; compiler " + __VERSION__
         + ", " + HLSCM_COMPILE_FLAGS + "; CGAL " CGAL_VERSION_STR + "; Eigen " + std::to_string(EIGEN_WORLD_VERSION) + '.'
         + std::to_string(EIGEN_MAJOR_VERSION) + '.' + std::to_string(EIGEN_MINOR_VERSION)
         + "; commit " + internal::commit();
}

} // namespace machine

#endif // HLSCM_BENCHMARK_MACHINE_H
