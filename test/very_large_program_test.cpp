// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// `parameterize --memory`: the map of `parameterize`, and what is left when it does not come to an end.

#include <support/is_sanitized.h>
#include <support/program_runs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace very_large_program_test {

using namespace program_test;

// Hills for which a megabyte of memory is not enough: two levels in files.
std::string hills() { return ply(grid(60, hilly), "binary_little_endian"); }

// Of the texture coordinates of two files of so many vertices.
double largest_difference(const std::string& a, const std::string& b, std::size_t vertices)
{
  EXPECT_EQ(a.size(), b.size());
  const std::size_t begin = a.find("end_header\n") + 11;
  double most = a.size() == b.size() ? 0. : 1.;
  for(std::size_t v = 0; v < vertices && a.size() == b.size(); ++v) {
    double uv[2], others[2];
    std::memcpy(uv, a.data() + begin + 48 * v + 24, sizeof(uv));
    std::memcpy(others, b.data() + begin + 48 * v + 24, sizeof(uv));
    most = std::max({most, std::abs(uv[0] - others[0]), std::abs(uv[1] - others[1])});
  }
  return most;
}

class Very_large_program : public Program
{
};

TEST_F(Very_large_program, writes_the_map_of_the_one_in_memory)
{
  const std::string in = write("in.ply", hills());
  const Json expected = report(in, {"--tolerance", "1e-9"});
  const std::string in_memory = read_file(path("out.ply"));
  const Json found = report(in, {"--tolerance", "1e-9", "--memory", "1M"});
  const std::string out = read_file(path("out.ply"));
  EXPECT_EQ(found["flips"], expected["flips"]);
  EXPECT_EQ(found["borders"], expected["borders"]);
  EXPECT_EQ(found["vertices"], expected["vertices"]);
  EXPECT_GE(found["levels_in_files"], 1);
  EXPECT_GE(found["blocks"], 3);
  EXPECT_EQ(found["pins"].size(), 2u);
  EXPECT_NEAR(double(found["energy"]), double(expected["energy"]), 1e-6 * double(expected["energy"]));
  ASSERT_EQ(out.size(), in_memory.size());
  const std::size_t begin = out.find("end_header\n") + 11;
  EXPECT_EQ(out.substr(0, begin), in_memory.substr(0, begin));
  const std::size_t vertices = found["vertices"];
  EXPECT_LT(largest_difference(out, in_memory, vertices), 1e-5);
  EXPECT_TRUE(out.substr(begin + 48 * vertices) == in_memory.substr(begin + 48 * vertices));
  EXPECT_EQ(names(), (std::set<std::string>{"in.ply", "out.ply", "report.json"}));
}

TEST_F(Very_large_program, refuses_what_it_cannot_do)
{
  const std::string in = write("in.ply", hills());
  for(const Texts& options :
      {Texts{"--memory", "1M", "--pin", "0=0,0", "--pin", "1=1,1"}, Texts{"--memory", "1M", "--strict"},
       Texts{"--memory", "1M", "--method", "direct"}, Texts{"--memory", "lots"}, Texts{"--resume"},
       Texts{"--memory", "1M", "--pictures", path("p")}}) {
    const Outcome outcome = parameterize(in, "out.ply", options);
    EXPECT_EQ(outcome.exit_code, 2) << options.back() << outcome.err;
    EXPECT_EQ(outcome.err.rfind("hlscm: usage: ", 0), 0u) << outcome.err;
  }
  EXPECT_EQ(parameterize(in, "out.obj", {"--memory", "1M"}).exit_code, 2);
  const std::string text = write("text.ply", ply(grid(5, flat), "ascii"));
  const Outcome outcome = parameterize(text, "out.ply", {"--memory", "1M"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, text, {"convert it to binary PLY"}), "");
  EXPECT_EQ(names(), (std::set<std::string>{"in.ply", "text.ply"}));
}

// OBJ files are read piece by piece: what is in two of them, and lines that are longer than one.
TEST_F(Very_large_program, takes_obj_files)
{
  const Soup soup = grid(60, hilly);
  ASSERT_EQ(parameterize(write("in.ply", ply(soup, "binary_little_endian")), "expected.ply",
                         {"--memory", "1M"}).exit_code, 0);
  const std::string expected = read_file(path("expected.ply"));
  std::string text = obj(soup);
  const std::size_t middle = text.find('\n', text.size() / 3), last = text.rfind("f ");
  std::string relative = "f";
  std::istringstream corners(text.substr(last + 2));
  for(std::string corner; corners >> corner;) {
    relative += " \\\r\n -" + std::to_string(soup.points.size() + 1 - std::stoul(corner)) + "//";
  }
  text = text.substr(0, middle + 1) + "# " + std::string(9 << 20, 'x') + "\r\nvt 1 2\nvn 0 0 1\ng a\n"
         + text.substr(middle + 1, last - middle - 1) + relative;
  const Outcome outcome = parameterize(write("in.obj", text), "out.ply", {"--memory", "1M"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(read_file(path("out.ply")) == expected);
  EXPECT_EQ(names(), (std::set<std::string>{"in.ply", "in.obj", "out.ply", "expected.ply"}));
}

TEST_F(Very_large_program, refuses_damaged_obj_files)
{
  const std::string text = obj(grid(30, hilly)), far = "# " + std::string(5 << 20, 'x') + "\n";
  const std::vector<std::pair<std::string, std::string>> cases
    = {{far + text + "v 1 2\n", "line "
          + std::to_string(std::count(text.begin(), text.end(), '\n') + 2)
          + " should hold the coordinates of vertex 900"},
       {text + "f 1 2 x\n", "should hold the corners of face 1682"},
       {text + "f 1 2 3 4\n", "face 1682 is not a triangle; triangulate"},
       {text + "f 1 2 901\n", "face 1682 names vertex 900 but there are 900 vertices"},
       {text + std::string(1, '\0'), " is zero, this is no OBJ text"},
       {"\x1f\x8b\x08" + text, "packed by gzip"},
       {"v 1 2 3\n", "no faces"},
       {"", "no faces"}};
  for(const auto& [bytes, words] : cases) {
    const std::string in = write("in.obj", bytes);
    const Outcome outcome = parameterize(in, "out.ply", {"--memory", "1M"});
    EXPECT_EQ(outcome.exit_code, 1) << words;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("hlscm: error: " + in + ": ", 0), 0u) << outcome.err;
    EXPECT_EQ(names(), std::set<std::string>{"in.obj"});
  }
}

TEST_F(Very_large_program, maps_without_pins)
{
  const std::string in = write("in.ply", hills());
  const Texts options = {"--tolerance", "1e-9", "--method", "spectral"};
  const Json expected = report(in, options);
  const std::string in_memory = read_file(path("out.ply"));
  Texts out_of_core = options;
  out_of_core.insert(out_of_core.end(), {"--memory", "1M"});
  const Json found = report(in, out_of_core);
  EXPECT_GE(found["levels_in_files"], 1);
  EXPECT_EQ(found["method"], "spectral");
  EXPECT_EQ(found["pins"].size(), 0u);
  EXPECT_LT(largest_difference(read_file(path("out.ply")), in_memory, found["vertices"]), 1e-5);
  const Outcome outcome = parameterize(in, "out.ply", out_of_core);
  EXPECT_EQ(outcome.out.find("\npins"), std::string::npos) << outcome.out;
}

// The peak is that of --memory, of what passes through, and of the program itself; the manual says
// how much that is. It has nothing to do with time.
TEST_F(Very_large_program, keeps_to_its_memory)
{
  if(test_support::is_sanitized) { // what they need has no bound
    return;
  }
  // A shell in between: a process starts with the peak of the one that it comes from.
  const auto peak_mb = [this](const std::string& in, const std::string& options) {
    const std::string command = "'" HLSCM_PROGRAM "' parameterize '" + in + "' -o '" + path("out.ply")
                                + "' --report '" + path("report.json") + "' --quiet --threads 2 "
                                + options + "; exit $?";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return double(Json::parse(read_file(path("report.json")))["peak_memory_mb"]);
  };
  const double itself = peak_mb(write("small.ply", ply(grid(12, hilly), "binary_little_endian")),
                                "--memory 16M");
  const std::string in = write("in.ply", ply(grid(700, hilly), "binary_little_endian"));
  constexpr double memory = 16, passing = 40;
  for(const char* method : {"hlscm", "spectral"}) {
    EXPECT_LT(peak_mb(in, std::string("--memory 16M --method ") + method), itself + memory + passing)
      << method;
  }
  EXPECT_GT(peak_mb(in, "--method spectral"), itself + 4 * (memory + passing)); // it would need more
}

// SIGKILL at some moment, and the same run again; what was there before is there until it is done.
TEST_F(Very_large_program, is_resumed)
{
  const std::string in = write("in.ply", ply(grid(250, hilly), "binary_little_endian"));
  const Texts options = {"--memory", "2M", "--tolerance", "1e-6"};
  const Outcome whole = parameterize(in, "out.ply", options);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const std::string expected = read_file(path("out.ply"));
  for(const double part : {0.3, 0.6, 0.9}) {
    write("out.ply", "old");
    Texts arguments = {"parameterize", in, "-o", path("out.ply")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const pid_t child = start(arguments);
    std::this_thread::sleep_for(std::chrono::duration<double>(part * whole.seconds));
    kill(child, SIGKILL);
    const Outcome killed = finish(child);
    const std::string left = read_file(path("out.ply"));
    EXPECT_TRUE(left == "old" || left == expected) << left.size() << " bytes";
    if(killed.exit_code == 0) { // it was faster than before
      continue;
    }
    arguments.push_back("--resume");
    const Outcome resumed = finish(start(arguments));
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_TRUE(read_file(path("out.ply")) == expected);
    EXPECT_FALSE(fs::exists(path("out.ply.work")));
  }
}

} // namespace very_large_program_test
