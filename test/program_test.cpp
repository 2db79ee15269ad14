// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs the program hlscm, whose path is HLSCM_PROGRAM, on generated files: how it is used, its pictures, what it
// leaves behind, and what it says of a mesh.

#include <support/program_runs.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace program_test {

// ---------------------------------------------------------------------------------------------
// Usage

TEST_F(Program, explains_itself)
{
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  EXPECT_NE(run({"parameterize", "--help"}).out.find("--tolerance"), std::string::npos);
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out.rfind("hlscm ", 0), 0u);
}

TEST_F(Program, refuses_wrong_usage)
{
  const std::string in = write("in.off", off(grid(4, flat)));
  const std::string out = path("out.obj");
  const std::vector<Texts> wrong{
      {},
      {"frobnicate"},
      {"info"},
      {"parameterize", in},
      {"parameterize", in, "-o", path("out.txt")},
      {"parameterize", in, "-o", out, "--unknown"},
      {"parameterize", in, "-o", out, "--method", "magic"},
      {"parameterize", in, "-o", out, "--weights", "magic"},
      {"parameterize", in, "-o", out, "--engine", "magic"},
      {"parameterize", in, "-o", out, "--prolongation", "magic"},
      {"parameterize", in, "-o", out, "--tolerance", "0"},
      {"parameterize", in, "-o", out, "--tolerance", "-1"},
      {"parameterize", in, "-o", out, "--tolerance", "nan"},
      {"parameterize", in, "-o", out, "--schedule", "1,2"},
      {"parameterize", in, "-o", out, "--schedule", "0,0,1"},
      {"parameterize", in, "-o", out, "--schedule", "1,1,0"},
      {"parameterize", in, "-o", out, "--ratio", "1"},
      {"parameterize", in, "-o", out, "--coarsest", "-5"},
      {"parameterize", in, "-o", out, "--iterations", "0"},
      {"parameterize", in, "-o", out, "--pin", "0=0,0"},
      {"parameterize", in, "-o", out, "--pin", "0=0", "--pin", "1=1,0"},
      {"parameterize", in, "-o", out, "--pin", "x=0,0", "--pin", "1=1,0"},
      {"parameterize", in, "-o", out, "--pin", "-1=0,0", "--pin", "1=1,0"},
      {"parameterize", in, "-o", out, "--pin", "0=nan,0", "--pin", "1=1,0"},
      {"parameterize", in, "-o", out, "--method", "spectral", "--pin", "0=0,0", "--pin", "1=1,0"}};
  for(const Texts& arguments : wrong) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << ::testing::PrintToString(arguments);
    EXPECT_EQ(outcome.err.rfind("hlscm: usage: ", 0), 0u) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
  }
  EXPECT_EQ(names(), std::set<std::string>{"in.off"});
}

// ---------------------------------------------------------------------------------------------
// Pictures

// Empty if the file is a PNG picture with something on it.
std::string error_in_picture(const fs::path& path)
{
  int width = 0, height = 0, channels = 0;
  unsigned char* pixels = stbi_load(path.c_str(), &width, &height, &channels, 3);
  if(pixels == nullptr) {
    return path.string() + " cannot be read";
  }
  constexpr std::size_t enough = 50;
  std::set<int> colours;
  std::size_t drawn = 0;
  for(int i = 0; i < width * height; ++i) {
    const int c = pixels[3 * i] << 16 | pixels[3 * i + 1] << 8 | pixels[3 * i + 2];
    drawn += c != 0xffffff;
    if(colours.size() < enough) {
      colours.insert(c);
    }
  }
  stbi_image_free(pixels);
  const double part = double(drawn) / (double(width) * double(height));
  if(width < 400 || height < 400 || part < 0.2 || part > 0.99 || colours.size() < enough) {
    return path.string() + " is " + std::to_string(width) + " x " + std::to_string(height)
           + ", drawn on " + std::to_string(part) + " of it in " + std::to_string(colours.size())
           + " colours";
  }
  return "";
}

TEST_F(Program, draws_pictures_and_repeats_itself_exactly)
{
  const std::string in = write("in.off", off(grid(60, hilly)));
  const Texts names{"out.obj",          "out.ply",         "a/b/domain.png",
                    "a/b/isolines.png", "a/b/checker.png", "a/b/levels.png"};
  const Texts coarse{"--coarsest", "200"};
  Texts first;
  for(int i = 0; i < 2; ++i) {
    const Outcome outcome =
        parameterize(in, "out.obj", {"--pictures", path("a/b"), coarse[0], coarse[1]});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_EQ(parameterize(in, "out.ply", coarse).exit_code, 0);
    for(std::size_t k = 0; k < names.size(); ++k) {
      const std::string bytes = read_file(folder / names[k]);
      if(i == 0) {
        first.push_back(bytes);
        EXPECT_EQ(k < 2 ? "" : error_in_picture(folder / names[k]), "");
      }
      EXPECT_TRUE(first[k] == bytes) << names[k];
    }
  }
}

// ---------------------------------------------------------------------------------------------
// Files that cannot be written, and interruptions

TEST_F(Program, refuses_unwritable_outputs_before_it_begins)
{
  const std::string in = write("in.off", off(grid(4, flat)));
  write("file", "was here before");
  fs::create_directory(folder / "folder.obj");
  const std::string good = path("out.obj");
  struct Case
  {
    Texts arguments;
    std::string file, words;
  };
  const std::vector<Case> cases{
      {{"-o", path("no/out.obj")}, path("no/out.obj"), "cannot be written"},
      {{"-o", path("file/out.obj")}, path("file/out.obj"), "cannot be written"},
      {{"-o", path("folder.obj")}, path("folder.obj"), "folder"},
      {{"-o", good, "--report", path("no/r.json")}, path("no/r.json"), "cannot be written"},
      {{"-o", good, "--report", path("./out.obj")}, good, "two outputs"},
      {{"-o", good, "--report", in}, in, "the output is the input"},
      {{"-o", good, "--pictures", path("file")}, path("file"), "file"},
      {{"-o", good, "--pictures", path("file/p")}, path("file/p"), "folder"}};
  for(const Case& c : cases) {
    Texts arguments{"parameterize", in};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(error_in_message(outcome.err, c.file, {c.words}), "");
  }
  const std::string over_itself = write("in.obj", obj(grid(4, flat)));
  const Outcome outcome = run({"parameterize", over_itself, "-o", over_itself});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, over_itself, {"the output is the input"}), "");
  EXPECT_EQ(names(), (std::set<std::string>{"file", "folder.obj", "in.obj", "in.off"}));
  EXPECT_EQ(read_file(folder / "in.obj"), obj(grid(4, flat)));
}

TEST_F(Program, leaves_nothing_when_the_disk_is_full)
{
  const std::string in = write("in.off", off(grid(60, hilly)));
  write("out.obj", "was here before");
  const auto limit_file_size = [] {
    const rlimit limit{20000, 20000};
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  const Outcome outcome =
      finish(start({"parameterize", in, "-o", path("out.obj")}, limit_file_size));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, path("out.obj"), {"writing failed"}), "");
  EXPECT_EQ(names(), (std::set<std::string>{"in.off", "out.obj"}));
  EXPECT_EQ(read_file(folder / "out.obj"), "was here before");
}

TEST_F(Program, stops_within_a_second)
{
  const std::string in = write("in.off", off(grid(500, hilly)));
  write("out.ply", "was here before");
  std::size_t stopped = 0;
  for(const Texts& options : {Texts{}, Texts{"--method", "direct"}, Texts{"--engine", "cgal"}}) {
    for(int milliseconds : {1, 150, 400, 800}) {
      Texts arguments{
          "parameterize",     in, "-o", path("out.ply"), "--pictures", path("pictures"), "--report",
          path("report.json")};
      arguments.insert(arguments.end(), options.begin(), options.end());
      const pid_t child = start(arguments);
      const Clock::time_point begin = Clock::now();
      while(!fs::exists(folder / "pictures") && Clock::now() - begin < std::chrono::seconds(60)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // until it has begun
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      kill(child, milliseconds == 150 ? SIGTERM : SIGINT);
      const Outcome outcome = finish(child);
      if(outcome.exit_code == 0) {
        continue; // it was faster
      }
      ++stopped;
      EXPECT_LT(outcome.processor_seconds, 1) << milliseconds;
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_EQ(outcome.err, "hlscm: cancelled\n");
      EXPECT_EQ(outcome.out, "");
      EXPECT_EQ(names(), (std::set<std::string>{"in.off", "out.ply"})) << milliseconds;
      EXPECT_EQ(read_file(folder / "out.ply"), "was here before");
    }
  }
  EXPECT_GE(stopped, 6u);
}

// A script that reads what was printed must not take nothing for all of it.
TEST_F(Program, fails_when_nobody_takes_what_it_prints)
{
  if(!fs::exists("/dev/full")) {
    GTEST_SKIP() << "there is no /dev/full";
  }
  const std::string in = write("in.off", off(grid(6, flat)));
  const auto fill = [] { dup2(open("/dev/full", O_WRONLY), 1); };
  for(const Texts& arguments : {Texts{"info", in}, Texts{"info", in, "--json"}, Texts{"--help"},
                                Texts{"parameterize", in, "-o", path("out.obj")}}) {
    const Outcome outcome = finish(start(arguments, fill));
    EXPECT_EQ(outcome.exit_code, 1) << arguments[0];
    EXPECT_NE(outcome.err.find("hlscm: error: "), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
    EXPECT_EQ(run(arguments).exit_code, 0) << arguments[0];
  }
  const Texts quiet{"parameterize", in, "-o", path("out.obj"), "--quiet"};
  EXPECT_EQ(finish(start(quiet, fill)).exit_code, 0); // it prints nothing
}

// ---------------------------------------------------------------------------------------------
// info

TEST_F(Program, knows_what_a_mesh_is)
{
  struct Case
  {
    std::string name;
    Soup soup;
    Json expected;
  };
  Soup two = grid(3, flat);
  two.points.push_back({9, 9, 9});
  two.faces.push_back({0, 1, 2});
  const std::vector<Case> cases{
      {"grid",
       grid(9, hilly),
       {{"components", 1},
        {"borders", 1},
        {"euler_characteristic", 1},
        {"genus", 0},
        {"orientable", true},
        {"manifold", true},
        {"is_chart", true},
        {"can_be_parameterized", true},
        {"can_have_an_atlas", true}}},
      {"band",
       band(20, false),
       {{"components", 1},
        {"borders", 2},
        {"euler_characteristic", 0},
        {"genus", 0},
        {"is_chart", true}}},
      {"moebius",
       band(20, true),
       {{"components", 1},
        {"borders", 1},
        {"euler_characteristic", 0},
        {"genus", nullptr},
        {"orientable", false},
        {"is_chart", false},
        {"can_be_parameterized", true},
        {"can_have_an_atlas", true}}},
      {"torus",
       torus(9, false),
       {{"components", 1},
        {"borders", 0},
        {"euler_characteristic", 0},
        {"genus", 1},
        {"is_chart", false},
        {"can_be_parameterized", true},
        {"can_have_an_atlas", true}}},
      {"open_torus", torus(9, true), {{"borders", 1}, {"euler_characteristic", -1}, {"genus", 1}}},
      {"fan", fan(100), {{"vertices", 101}, {"edges", 200}, {"faces", 100}, {"borders", 1}}}};
  for(const Case& c : cases) {
    const Outcome outcome = run({"info", write(c.name + ".off", off(c.soup)), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    for(const auto& [key, value] : c.expected.items()) {
      EXPECT_EQ(json[key], value) << c.name << " " << key;
    }
    EXPECT_EQ(json["is_chart"].get<bool>(), json["obstacles"].empty());
  }
}

} // namespace program_test
