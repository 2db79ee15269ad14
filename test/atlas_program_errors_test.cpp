// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs `hlscm atlas` and `hlscm bake` where they must refuse or fail: options, outputs, full disks,
// interrupts.

#include <support/program_atlases.h>
#include <support/textured_soups.h>

#include <sys/resource.h>

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace program_test {

// What options do is in the other tests; here, that each that is listed is known.
TEST_F(Atlas, has_the_options_that_help_lists)
{
  const Textured_soup torus = cut_torus(8, 2);
  const std::string in = write("in.obj", "g all\n" + obj(torus));
  std::string ones;
  for(std::size_t f = 0; f < torus.surface.faces.size(); ++f) {
    ones += "1\n";
  }
  const std::string density = write("density.txt", ones);
  ASSERT_EQ(call("atlas", in, "first", {"--texture", "64"}).exit_code, 0);
  const std::vector<Texts> of_both{
      {"--texture", "32", "--padding", "0", "--mip-levels", "1", "--max-area-scale", "2",
       "--max-quasi-conformal", "1.5", "--max-charts", "3", "--seam-price", "0.1",
       "--min-used", "20", "--bend", "0", "--cutting-time", "0.01", "--pages", "2", "--aspect", "2", "--packer",
       "horizon", "--method", "spectral", "--threads", "1", "--ply", "--pictures", path("pictures"),
       "--signal", "normals", "--signal-weight", "2", "--symmetric", "--hide-seams"},
      {"--texture", "64", "--charts", "uv", "--packer", "raster", "--packing-time", "0.001",
       "--method", "border-first", "--report", path("other.json"), "--limits", "groups",
       "--separate", "groups", "--density", density},
      {"--texture", "64", "--one-disk", "--method", "cascadic", "--smooth-seams", "--quiet", "--strict", "--weld", "0",
       "--time-limit", "1000"},
      {"--texture", "64", "--repack", "--keep-scale", "--align", "--udim", "--importance",
       path("first/checker.png")},
      {"--texture", "64", "--padding", "1"}};
  const std::vector<Texts> of_atlas{{"--stack"}, {}, {}, {"--lightmap"}, {}};
  const std::vector<Texts> of_bake{
      {"--faces", "50", "--samples", "3", "--space", "object", "--bits", "16", "--displacement"},
      {"--error", "1%", "--space", "tangent", "--bits", "8", "--colors", path("first/checker.png")},
      {"--faces", "50"},
      {"--faces", "50"},
      {"--target", path("first/atlas.obj")}};
  for(const std::string command : {"atlas", "bake"}) {
    std::set<std::string> listed, known{"--help", "--output"};
    for(std::size_t i = 0; i < of_both.size(); ++i) {
      Texts options = of_both[i];
      const Texts& more = command == "bake" ? of_bake[i] : of_atlas[i];
      options.insert(options.end(), more.begin(), more.end());
      const Outcome outcome = call(command, in, "out", options);
      EXPECT_EQ(outcome.exit_code, 0) << command << " " << i << ": " << outcome.err;
      EXPECT_EQ(outcome.out.empty(), options[2] == "--one-disk") << outcome.out;
      std::copy_if(options.begin(), options.end(), std::inserter(known, known.end()),
                   [](const std::string& text) { return text.rfind("--", 0) == 0; });
    }
    std::istringstream help(run({command, "--help"}).out);
    for(std::string line; std::getline(help, line);) {
      const std::size_t option = line.find("--");
      if(line.rfind("  -", 0) == 0 && option != std::string::npos) {
        listed.insert(line.substr(option, line.find_first_of(" \n", option) - option));
      }
    }
    EXPECT_EQ(listed, known) << command;
  }
}

TEST_F(Atlas, refuses_what_it_cannot_do)
{
  const std::string good = write("in.off", off(cube()));
  const std::vector<std::pair<std::string, Texts>> all_wrong
      = {{"atlas", {"--texture", "0"}},       {"atlas", {"--texture", "x"}},
         {"atlas", {"--pages", "0"}},         {"atlas", {"--max-area-scale", "1"}},
         {"atlas", {"--method", "best"}},     {"atlas", {"--one-disk", "--charts", "uv"}},
         {"atlas", {"--cutting-time", "-1"}}, {"atlas", {"--one-disk", "--cutting-time", "1"}},
         {"atlas", {"--repack", "--cutting-time", "1"}},
         {"atlas", {"--bend", "21"}},         {"atlas", {"--bend", "3", "--align"}},
         {"atlas", {"--bend", "3", "--method", "border-first"}},
         {"atlas", {"--faces", "7"}},         {"bake", {}},
         {"bake", {"--faces", "0"}},          {"bake", {"--faces", "7", "--error", "1%"}},
         {"bake", {"--error", "-1"}},         {"bake", {"--faces", "7", "--bits", "12"}},
         {"bake", {"--faces", "7", "--space", "world"}},
         {"bake", {"--faces", "7", "--samples", "0"}}};
  for(const auto& [command, options] : all_wrong) {
    const Outcome outcome = call(command, good, "none", options);
    EXPECT_EQ(outcome.exit_code, 2) << command << (options.empty() ? "" : " " + options[0]);
    EXPECT_EQ(outcome.err.rfind("hlscm: usage: ", 0), 0u) << outcome.err;
  }
  EXPECT_EQ(run({"atlas", good}).exit_code, 2);
  const Soup square = grid(3, flat);
  const std::map<std::string, std::string> bad
      = {{off(with_face(square, {0, 3, 4})), "same vertices"},
         {off(with_face(with_face(cube(), {0, 1, 7}), {1, 0, 6})), "more than two faces"},
         {off(with_face(Soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                             {{0, 1, 2}}}, {0, 3, 4})), "separate fans"},
         {off(band(7, true)), "one side only"},
         {off(moved(cube(), 1e39, 0)), "too large for the numbers of 32 bits"},
         {off(Soup{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}}), "corners"},
         {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n", "not finite"},
         {"", "empty"}};
  for(const auto& [bytes, what] : bad) {
    for(const char* command : {"atlas", "bake"}) {
      const std::string in = write("bad.off", bytes);
      const Outcome outcome
          = call(command, in, "none",
                 std::string(command) == "bake" ? Texts{"--faces", "2", "--strict"}
                                                : Texts{"--strict"});
      EXPECT_EQ(outcome.exit_code, 1) << what;
      EXPECT_EQ(error_in_message(outcome.err, in, {}), "") << what;
    }
  }
  EXPECT_EQ(call("bake", good, "none", {"--faces", "2", "--colors", good}).exit_code, 1);
  const std::string textured = write("textured.obj", obj(cut_torus(6, 2)));
  const Outcome no_picture
      = call("bake", textured, "none", {"--faces", "50", "--colors", good, "--texture", "64"});
  EXPECT_EQ(no_picture.exit_code, 1);
  EXPECT_EQ(error_in_message(no_picture.err, good, {"cannot be read as a picture"}), "");
  const Outcome missing = call("atlas", path("missing.off"), "none");
  EXPECT_EQ(error_in_message(missing.err, path("missing.off"), {"no such file"}), "");
  EXPECT_EQ(names(), (std::set<std::string>{"bad.off", "in.off", "textured.obj"}));
}

TEST_F(Atlas, loses_no_file_when_it_fails)
{
  fs::create_directory(folder / "out");
  write("out/atlas.obj", "was here before");
  write("out/mine", "and so was this");
  const Outcome failed = call("bake", write("bad.off", off(band(7, true))), "out",
                              {"--faces", "3", "--strict"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_EQ(read_file(folder / "out/atlas.obj"), "was here before");
  EXPECT_EQ(names(), (std::set<std::string>{"bad.off", "out", "out/atlas.obj", "out/mine"}));
  // The input is never an output
  const std::string in = write("out/light.obj", obj(cube()));
  const Outcome over_itself = call("bake", in, "out", {"--faces", "3"});
  EXPECT_EQ(over_itself.exit_code, 1);
  EXPECT_EQ(error_in_message(over_itself.err, in, {"the output is the input"}), "");
  EXPECT_EQ(read_file(in), obj(cube()));
  EXPECT_EQ(call("atlas", in, "out").exit_code, 0);
  EXPECT_NE(read_file(folder / "out/atlas.obj"), "was here before");
  EXPECT_EQ(read_file(folder / "out/mine"), "and so was this");
}

TEST_F(Atlas, refuses_unwritable_outputs_before_it_begins)
{
  const std::string in = write("in.off", off(cube()));
  const std::string file = write("file", "was here before");
  const std::string patches = write("out.patches", std::string(24, '1'));
  struct Case
  {
    std::string folder;
    Texts options;
    std::string name, words;
  };
  const std::vector<Case> cases{
      {file, {}, file, "this is a file"},
      {path("file/out"), {}, path("file/out"), "cannot be created"},
      {"/proc/none", {}, "/proc/none", "cannot be created"},
      {path("out"), {"--report", path("no/r.json")}, path("no/r.json"), "cannot be written"},
      {path("out"), {"--report", path("out/atlas.obj")}, path("out/atlas.obj"), "two outputs"},
      {path("out"), {"--report", in}, in, "the output is the input"},
      {path("out"), {"--charts", patches, "--report", patches}, patches, "the output is the input"},
      {path("out"), {"--pictures", file}, file, "this is a file"},
      {path("out"), {"--pictures", path("file/p")}, path("file/p"), "cannot be created"}};
  for(const Case& c : cases) {
    for(const std::string command : {"atlas", "bake"}) {
      Texts arguments{command, in, "-o", c.folder};
      arguments.insert(arguments.end(), c.options.begin(), c.options.end());
      if(command == "bake") {
        arguments.insert(arguments.end(), {"--faces", "4"});
      }
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exit_code, 1) << c.name;
      EXPECT_EQ(error_in_message(outcome.err, c.name, {c.words}), "");
    }
  }
  EXPECT_EQ(names(), (std::set<std::string>{"file", "in.off", "out.patches"}));
  EXPECT_EQ(read_file(in), off(cube()));
  EXPECT_EQ(read_file(file), "was here before");
}

TEST_F(Atlas, leaves_nothing_when_the_disk_is_full)
{
  const std::string in = write("in.off", off(wavy_torus(20)));
  const auto limit_file_size = [] {
    const rlimit limit{20000, 20000};
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  for(Texts arguments : {Texts{"atlas"}, Texts{"bake", "--faces", "400"}}) {
    arguments.insert(arguments.end(), {in, "-o", path("out"), "--texture", "128"});
    const Outcome outcome = finish(start(arguments, limit_file_size));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(error_in_message(outcome.err, path("out/atlas.obj"), {"writing failed"}), "");
    EXPECT_EQ(names(), std::set<std::string>{"in.off"});
  }
}

TEST_F(Atlas, leaves_nothing_when_it_is_interrupted)
{
  const std::string in = write("in.off", off(wavy_torus(250)));
  for(const Texts& command : {Texts{"atlas"}, Texts{"bake", "--faces", "2000"}}) {
    for(const int milliseconds : {20, 300, 1500}) {
      Texts arguments = command;
      arguments.insert(arguments.end(), {in, "-o", path("out"), "--pictures", path("pictures")});
      const pid_t child = start(arguments);
      usleep(useconds_t(1000 * milliseconds));
      kill(child, milliseconds == 300 ? SIGTERM : SIGINT);
      const Outcome outcome = finish(child);
      if(outcome.exit_code == -SIGINT) {
        continue; // before the program listened
      }
      EXPECT_EQ(outcome.exit_code, 1) << milliseconds;
      EXPECT_EQ(outcome.err, "hlscm: cancelled\n");
      EXPECT_LT(outcome.processor_seconds, 1.5);
      EXPECT_EQ(names(), std::set<std::string>{"in.off"}) << command[0] << " " << milliseconds;
    }
  }
}

TEST_F(Atlas, is_finished_at_once_when_that_is_asked_for)
{
  const std::string in = write("in.off", off(wavy_torus(20)));
  Outcome outcome;
  outcome.exit_code = -SIGUSR1;
  for(useconds_t wait = 200000; outcome.exit_code == -SIGUSR1 && wait < 100000000; wait *= 2) {
    const pid_t child = start({"atlas", in, "-o", path("out"), "--packing-time", "3600"});
    usleep(wait); // until it listens
    kill(child, SIGUSR1);
    outcome = finish(child);
  }
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("the time was up"), std::string::npos) << outcome.err;
  const Json report = Json::parse(read_file(folder / "out/report.json"), nullptr, false);
  EXPECT_EQ(report["stopped_early"], true);
  EXPECT_EQ(report["flips"], 0);
  EXPECT_EQ(error_in_texture(read_model(folder / "out/atlas.obj"), 1024), "");
}

} // namespace program_test
