// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_PROGRAM_RUNS_H
#define HLSCM_TEST_SUPPORT_PROGRAM_RUNS_H

// Mesh files, and runs of the program hlscm, whose path is HLSCM_PROGRAM.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace program_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Texts = std::vector<std::string>;
using Clock = std::chrono::steady_clock;

// ---------------------------------------------------------------------------------------------
// Meshes

struct Soup
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<std::size_t>> faces;
};

// n x n vertices over [0, 1]^2 with the height given.
inline Soup grid(std::size_t n, const std::function<double(double, double)>& height)
{
  Soup soup;
  for(std::size_t i = 0; i < n; ++i) {
    for(std::size_t j = 0; j < n; ++j) {
      const double x = double(i) / double(n - 1), y = double(j) / double(n - 1);
      soup.points.push_back({x, y, height(x, y)});
    }
  }
  for(std::size_t i = 0; i + 1 < n; ++i) {
    for(std::size_t j = 0; j + 1 < n; ++j) {
      const std::size_t a = i * n + j, b = a + n;
      soup.faces.push_back({a, b, b + 1});
      soup.faces.push_back({a, b + 1, a + 1});
    }
  }
  return soup;
}

inline double flat(double, double) { return 0; }

inline double hilly(double x, double y) { return 0.2 * std::sin(7 * x) * std::cos(5 * y); }

// A dented wall along most of a circle: its ends, which are close in space, are far in the map.
inline Soup wall(std::size_t n)
{
  Soup soup = grid(n, hilly);
  for(auto& p : soup.points) {
    p = {(1 + p[2]) * std::cos(5 * p[0]), (1 + p[2]) * std::sin(5 * p[0]), 2 * p[1]};
  }
  return soup;
}

// A band of n quads that closes after a turn; a half twist makes it a Moebius strip. All faces run
// alike within the band.
inline Soup band(std::size_t n, bool is_twisted)
{
  Soup soup;
  for(std::size_t i = 0; i < n; ++i) {
    const double a = 6.283185307179586 * double(i) / double(n), tilt = is_twisted ? a / 2 : 0.3;
    for(double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(tilt);
      soup.points.push_back({r * std::cos(a), r * std::sin(a), side * std::sin(tilt)});
    }
  }
  for(std::size_t i = 0; i < n; ++i) {
    const bool is_last = i + 1 == n;
    const std::size_t a = 2 * i, b = a + 1;
    const std::size_t c = is_last ? (is_twisted ? 1 : 0) : a + 2;
    const std::size_t d = is_last ? (is_twisted ? 0 : 1) : a + 3;
    soup.faces.push_back({a, c, b});
    soup.faces.push_back({b, c, d});
  }
  return soup;
}

// An n x n torus; without its first face if it shall have a border.
inline Soup torus(std::size_t n, bool has_border)
{
  Soup soup;
  for(std::size_t i = 0; i < n; ++i) {
    for(std::size_t j = 0; j < n; ++j) {
      const double a = 6.283185307179586 * double(i) / double(n);
      const double b = 6.283185307179586 * double(j) / double(n), r = 2 + std::cos(b);
      soup.points.push_back({r * std::cos(a), r * std::sin(a), std::sin(b)});
      const std::size_t i1 = (i + 1) % n, j1 = (j + 1) % n;
      soup.faces.push_back({i * n + j, i1 * n + j, i1 * n + j1});
      soup.faces.push_back({i * n + j, i1 * n + j1, i * n + j1});
    }
  }
  if(has_border) {
    soup.faces.erase(soup.faces.begin());
  }
  return soup;
}

// A cone with n triangles around vertex 0, and one triangle missing so that all share a border.
inline Soup fan(std::size_t n)
{
  Soup soup;
  soup.points.push_back({0, 0, 0.3});
  for(std::size_t i = 0; i < n; ++i) {
    const double a = 6.283185307179586 * double(i) / double(n);
    soup.points.push_back({std::cos(a), std::sin(a), 0});
    soup.faces.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return soup;
}

inline Soup moved(Soup soup, double scale, double shift)
{
  for(auto& p : soup.points) {
    p = {scale * p[0] + shift, scale * p[1] + shift, scale * p[2] + shift};
  }
  return soup;
}

inline Soup with_face(Soup soup, std::vector<std::size_t> face)
{
  soup.faces.push_back(std::move(face));
  return soup;
}

inline std::string off(const Soup& soup)
{
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n" << soup.points.size() << " " << soup.faces.size() << " 0\n";
  for(const auto& p : soup.points) {
    out << p[0] << " " << p[1] << " " << p[2] << "\n";
  }
  for(const auto& face : soup.faces) {
    out << face.size();
    for(std::size_t v : face) {
      out << " " << v;
    }
    out << "\n";
  }
  return out.str();
}

inline std::string obj(const Soup& soup)
{
  std::ostringstream out;
  out.precision(17);
  out << "# a comment\n";
  for(const auto& p : soup.points) {
    out << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
  }
  for(const auto& face : soup.faces) {
    out << "f";
    for(std::size_t v : face) {
      out << " " << v + 1;
    }
    out << "\n";
  }
  return out.str();
}

template <typename T>
inline void put(std::string& bytes, T value, bool is_big_endian = false)
{
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if(is_big_endian) {
    std::reverse(raw, raw + sizeof value);
  }
  bytes.append(raw, sizeof value);
}

inline std::string ply(const Soup& soup, const std::string& format)
{
  std::ostringstream out;
  out.precision(17);
  out << "ply\nformat " << format << " 1.0\ncomment none\nelement vertex " << soup.points.size()
      << "\nproperty uchar red\nproperty double x\nproperty double y\nproperty double z\n"
      << "element face " << soup.faces.size()
      << "\nproperty list uchar int vertex_indices\nproperty float quality\nend_header\n";
  if(format == "ascii") {
    for(const auto& p : soup.points) {
      out << "7 " << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
    for(const auto& face : soup.faces) {
      out << face.size();
      for(std::size_t v : face) {
        out << " " << v;
      }
      out << " 0.5\n";
    }
    return out.str();
  }
  std::string bytes = out.str();
  const bool is_big = format == "binary_big_endian";
  for(const auto& p : soup.points) {
    put(bytes, std::uint8_t(7));
    for(double x : p) {
      put(bytes, x, is_big);
    }
  }
  for(const auto& face : soup.faces) {
    put(bytes, std::uint8_t(face.size()));
    for(std::size_t v : face) {
      put(bytes, std::int32_t(v), is_big);
    }
    put(bytes, 0.5f, is_big);
  }
  return bytes;
}

inline std::string stl(const Soup& soup, bool is_binary)
{
  std::string bytes = is_binary ? std::string(80, ' ') : "solid mesh\n";
  if(is_binary) {
    put(bytes, std::uint32_t(soup.faces.size()));
  }
  for(const auto& face : soup.faces) {
    std::ostringstream text;
    text.precision(17);
    text << "facet normal 0 0 0\nouter loop\n";
    bytes += is_binary ? std::string(12, '\0') : "";
    for(std::size_t v : face) {
      text << "vertex";
      for(double x : soup.points[v]) {
        text << " " << x;
        is_binary ? put(bytes, float(x)) : void();
      }
      text << "\n";
    }
    text << "endloop\nendfacet\n";
    bytes += is_binary ? std::string(2, '\0') : text.str();
  }
  return is_binary ? bytes : bytes + "endsolid mesh\n";
}

// ---------------------------------------------------------------------------------------------
// Running the program

struct Outcome
{
  int exit_code = -1; // minus the signal if one ended it
  std::string out, err;
  double seconds = 0;           // by the clock, from finish() on
  double processor_seconds = 0; // the same, of its own work: what else runs does not count
};

// What a child has used until now.
inline double processor_seconds(pid_t child)
{
  clockid_t clock;
  timespec time{};
  if(clock_getcpuclockid(child, &clock) == 0)
    clock_gettime(clock, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

inline std::string read_file(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

class Program : public ::testing::Test
{
protected:
  Program()
  {
    std::string pattern = (fs::temp_directory_path() / "hlscm-test-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }

  ~Program() override { fs::remove_all(folder); }

  std::string path(const std::string& name) const { return (folder / name).string(); }

  std::string write(const std::string& name, const std::string& bytes) const
  {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return path(name);
  }

  // The names in the folder, without what the test's own running leaves.
  std::set<std::string> names() const
  {
    std::set<std::string> all;
    for(const auto& entry : fs::recursive_directory_iterator(folder)) {
      all.insert(fs::relative(entry.path(), folder).string());
    }
    all.erase("stdout");
    all.erase("stderr");
    return all;
  }

  pid_t start(
      const Texts& arguments, const std::function<void()>& prepare = [] {}) const
  {
    const pid_t child = fork();
    if(child != 0) {
      return child;
    }
    std::signal(SIGINT, SIG_DFL);
    unsetenv("OPENBLAS_NUM_THREADS"); // it is set for tests, not for people
    for(const auto& [name, descriptor] : {std::pair("stdout", 1), std::pair("stderr", 2)}) {
      dup2(open(path(name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), descriptor);
    }
    prepare();
    std::vector<char*> argv{const_cast<char*>("hlscm")};
    for(const std::string& argument : arguments) {
      argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    execv(HLSCM_PROGRAM, argv.data());
    _exit(127);
  }

  Outcome finish(pid_t child) const
  {
    const Clock::time_point begin = Clock::now();
    const double before = processor_seconds(child);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    Outcome outcome;
    for(const timeval& part : {usage.ru_utime, usage.ru_stime})
      outcome.processor_seconds += double(part.tv_sec) + 1e-6 * double(part.tv_usec);
    outcome.processor_seconds -= before;
    outcome.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    outcome.out = read_file(folder / "stdout");
    outcome.err = read_file(folder / "stderr");
    return outcome;
  }

  Outcome run(const Texts& arguments) const { return finish(start(arguments)); }

  Outcome parameterize(const std::string& input, const std::string& output,
                       const Texts& options = {}) const
  {
    Texts arguments{"parameterize", input, "-o", path(output)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments);
  }

  Json report(const std::string& input, const Texts& options = {}) const
  {
    Texts all{"--report", path("report.json")};
    all.insert(all.end(), options.begin(), options.end());
    const Outcome outcome = parameterize(input, "out.ply", all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? Json::parse(read_file(folder / "report.json")) : Json();
  }

  fs::path folder;
};

// Empty if `text` is one sentence that begins with "hlscm: error: FILE: " and holds all words.
inline std::string error_in_message(const std::string& text, const std::string& file, const Texts& words)
{
  if(text.rfind("hlscm: error: " + file + ": ", 0) != 0) {
    return "does not name the file: " + text;
  }
  if(text.find('\n') + 1 != text.size()) {
    return "is not one line: " + text;
  }
  for(const std::string& word : words) {
    if(text.find(word) == std::string::npos) {
      return "does not say \"" + word + "\": " + text;
    }
  }
  return "";
}

} // namespace program_test

#endif // HLSCM_TEST_SUPPORT_PROGRAM_RUNS_H
