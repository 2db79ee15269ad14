// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs the program hlscm, whose path is HLSCM_PROGRAM, on a hostile machine: signals at any moment,
// little memory, small files, streams that are closed, folders that vanish, damaged pictures. Each
// run ends with a result or with one sentence, and then leaves nothing new behind.

#include <support/textured_soups.h>

#include <sys/resource.h>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace program_test {

namespace {

constexpr int cpu_seconds = 20; // to end what runs for ever

void limit(int resource, rlim_t value)
{
  const rlimit both{value, value};
  setrlimit(__rlimit_resource_t(resource), &both);
}

// Its soft limit the program notices, its hard one it does not survive.
void limit_time()
{
  const rlimit seconds{cpu_seconds, cpu_seconds + 2};
  setrlimit(RLIMIT_CPU, &seconds);
}

// A program's run and the file that it must not ruin.
struct Faulty_run
{
  Texts arguments;
  std::string old_file;
};

// A hilly square with a texture.
Textured_soup textured_hills(std::size_t n)
{
  Textured_soup result;
  result.surface = grid(n, hilly);
  for(const auto& p : result.surface.points) {
    result.uv.push_back({p[0], p[1]});
  }
  result.uv_faces = result.surface.faces;
  return result;
}

bool is_listening(pid_t child)
{
  std::ifstream status("/proc/" + std::to_string(child) + "/status");
  for(std::string word; status >> word;) {
    if(word == "State:" && status >> word && word == "Z") {
      return true; // it is over
    }
    if(word == "SigCgt:" && status >> word) {
      return (std::stoull(word, nullptr, 16) >> (SIGXCPU - 1) & 1) != 0;
    }
  }
  return true;
}

void wait_until_listening(pid_t child)
{
  while(!is_listening(child)) {
    usleep(200);
  }
}

} // namespace

class Faults : public Program
{
protected:
  // One of each kind.
  std::vector<Faulty_run> runs(std::size_t n)
  {
    const std::string open = write("open.off", off(grid(n, hilly)));
    const std::string textured = write("textured.obj", obj(textured_hills(n)));
    return {{{"info", open}, ""},
            {{"parameterize", open, "-o", path("a.obj"), "--report", path("a.json")}, "a.obj"},
            {{"parameterize", open, "-o", path("a.ply"), "--method", "direct"}, "a.ply"},
            {{"levels", open, "-o", path("b"), "--format", "obj,pm"}, "b/mesh.pm"},
            {{"levels", textured, "-o", path("c"), "--format", "glb"}, "c/levels.glb"},
            {{"atlas", open, "-o", path("d"), "--texture", "64", "--pictures", path("d/p")},
             "d/atlas.obj"},
            {{"bake", textured, "-o", path("e"), "--texture", "64", "--faces", "100"},
             "e/light.obj"}};
  }

  void put_old_file(const Faulty_run& run)
  {
    if(!run.old_file.empty()) {
      fs::create_directories((folder / run.old_file).parent_path());
      write(run.old_file, "was here before");
    }
  }

  // What is wrong with a run that may have failed in a sentence; `before` was there.
  std::string error_in(const Faulty_run& run, const Outcome& outcome,
                       const std::set<std::string>& before) const
  {
    const std::string what = run.arguments[0] + " (" + outcome.err + ")";
    for(const std::string& name : names()) {
      if(name.find("/.") != std::string::npos || name[0] == '.') {
        return what + " leaves " + name;
      }
    }
    const bool is_in_place = outcome.err.find("in place") != std::string::npos;
    if(outcome.exit_code == 0 || is_in_place) {
      return run.old_file.empty() || read_file(folder / run.old_file) != "was here before"
                 ? "" : what + " writes nothing";
    }
    if(outcome.exit_code != 1) {
      return what + " ends with " + std::to_string(outcome.exit_code);
    }
    if(outcome.err.find("hlscm: ") == std::string::npos || outcome.err.back() != '\n') {
      return what + " has no sentence";
    }
    if(names() != before) {
      return what + " leaves files";
    }
    return run.old_file.empty() || read_file(folder / run.old_file) == "was here before"
               ? "" : what + " ruins an old file";
  }

  // Removes what a run has written.
  void clear(const std::vector<Faulty_run>& all)
  {
    for(const std::string& name : names()) {
      const fs::path top = folder / *fs::path(name).begin();
      if(top.filename() != "open.off" && top.filename() != "textured.obj") {
        fs::remove_all(top);
      }
    }
    for(const Faulty_run& run : all) {
      put_old_file(run);
    }
  }
};

TEST_F(Faults, signals_leave_nothing)
{
  const unsigned int seed = std::random_device()();
  std::printf("seed %u\n", seed);
  std::mt19937 random(seed);
  const std::vector<Faulty_run> all = runs(40);
  std::vector<double> seconds;
  for(const Faulty_run& run : all) {
    const pid_t child = start(run.arguments);
    wait_until_listening(child);
    seconds.push_back(finish(child).seconds);
  }
  const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
  std::size_t stopped = 0;
  for(int i = 0; i < 100; ++i) {
    const Faulty_run& run = all[std::size_t(i) % all.size()];
    clear(all);
    const std::set<std::string> before = names();
    const pid_t child = start(run.arguments, limit_time);
    wait_until_listening(child);
    const double moment
        = std::uniform_real_distribution<>(0, 1.1 * seconds[std::size_t(i) % all.size()])(random);
    std::this_thread::sleep_for(std::chrono::duration<double>(moment));
    kill(child, signals[random() % 4]);
    const Outcome outcome = finish(child);
    stopped += outcome.exit_code == 1 ? 1 : 0;
    ASSERT_EQ(error_in(run, outcome, before), "") << i << ", after " << moment << " s";
    if(outcome.exit_code == 1) {
      EXPECT_EQ(outcome.err.rfind("hlscm: cancelled", 0), 0u) << outcome.err;
    }
  }
  EXPECT_GE(stopped, 10u);
}

// Also where a library gives up, and where it would ask for memory for ever.
TEST_F(Faults, little_memory_is_an_error)
{
  const std::vector<Faulty_run> all = runs(50);
  std::size_t failed = 0;
  for(const Faulty_run& run : all) {
    clear(all);
    const Outcome whole = this->run(run.arguments);
    const std::string right
        = run.old_file.empty() ? whole.out : read_file(folder / run.old_file);
    for(const int megabytes : {50, 90, 110, 125, 140, 170, 220, 400}) {
      clear(all);
      const std::set<std::string> before = names();
      const Outcome outcome = finish(start(run.arguments, [megabytes] {
        limit_time();
        limit(RLIMIT_CORE, 0);
        limit(RLIMIT_AS, rlim_t(megabytes) << 20);
      }));
      if(outcome.exit_code == 127) {
        continue; // the program could not be loaded
      }
      EXPECT_EQ(error_in(run, outcome, before), "") << megabytes;
      failed += outcome.exit_code == 1 ? 1 : 0;
      if(outcome.exit_code == 0 && run.old_file.empty()) {
        EXPECT_EQ(outcome.out, right) << megabytes;
      } else if(outcome.exit_code == 0 && run.old_file != "d/atlas.obj") {
        EXPECT_EQ(read_file(folder / run.old_file), right) << megabytes;
      }
    }
  }
  EXPECT_GE(failed, 1u);
}

TEST_F(Faults, small_files_are_an_error)
{
  const std::vector<Faulty_run> all = runs(30);
  for(const Faulty_run& run : all) {
    std::size_t failed = 0;
    for(const rlim_t bytes : {0, 1, 4096, 30000, 100000}) {
      clear(all);
      const std::set<std::string> before = names();
      const Outcome outcome = finish(start(run.arguments, [bytes] {
        dup2(open("/dev/null", O_WRONLY), 1); // the limit holds for files only
        limit(RLIMIT_FSIZE, (std::max)(bytes, rlim_t(400))); // what it says goes to a file, too
      }));
      EXPECT_EQ(error_in(run, outcome, before), "") << bytes;
      failed += outcome.exit_code == 1 ? 1 : 0;
    }
    EXPECT_EQ(failed > 0, !run.old_file.empty()) << run.arguments[0];
  }
}

TEST_F(Faults, folder_that_vanishes_is_an_error)
{
  const std::string in = write("in.off", off(grid(200, hilly)));
  const pid_t child = start({"parameterize", in, "-o", path("out/a.obj"), "--pictures",
                             path("out")});
  wait_until_listening(child);
  for(int i = 0; i < 5000 && !fs::exists(folder / "out"); ++i) {
    usleep(200);
  }
  kill(child, SIGSTOP);
  fs::remove_all(folder / "out");
  kill(child, SIGCONT);
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err.rfind("hlscm: error: " + path("out"), 0), 0u) << outcome.err;
  EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
  EXPECT_EQ(names(), std::set<std::string>{"in.off"});
}

TEST_F(Faults, closed_streams_change_no_file)
{
  const std::string in = write("in.off", off(grid(20, hilly)));
  ASSERT_EQ(parameterize(in, "right.obj").exit_code, 0);
  for(int closed = 1; closed < 8; ++closed) {
    const Outcome outcome = finish(start({"parameterize", in, "-o", path("out.obj")}, [closed] {
      for(int stream = 0; stream < 3; ++stream) {
        if((closed >> stream & 1) != 0) {
          close(stream);
        }
      }
    }));
    const bool is_table_lost = (closed & 2) != 0;
    EXPECT_EQ(outcome.exit_code, is_table_lost ? 1 : 0) << closed;
    EXPECT_EQ(read_file(folder / "out.obj"), read_file(folder / "right.obj")) << closed;
    fs::remove(folder / "out.obj");
  }
  EXPECT_EQ(names(), (std::set<std::string>{"in.off", "right.obj"}));
}

TEST_F(Faults, reader_that_has_gone_is_an_error)
{
  const std::string in = write("in.off", off(grid(6, flat)));
  const Outcome outcome = finish(start({"info", in}, [] {
    int ends[2];
    if(pipe(ends) == 0) {
      close(ends[0]);
      dup2(ends[1], 1);
    }
  }));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("could not be written"), std::string::npos) << outcome.err;
}

TEST_F(Faults, more_threads_than_processors_are_no_warning)
{
  const std::string in = write("in.off", off(grid(100, hilly)));
  const Outcome outcome = parameterize(in, "out.obj", {"--threads", "64"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Faults, link_to_nothing_gets_its_file)
{
  const std::string in = write("in.off", off(grid(6, flat)));
  fs::create_directory(folder / "place");
  fs::create_symlink("place/new.obj", folder / "inner.obj");
  fs::create_symlink(path("inner.obj"), folder / "link.obj");
  EXPECT_EQ(parameterize(in, "link.obj").exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(folder / "link.obj"));
  EXPECT_TRUE(fs::is_symlink(folder / "inner.obj"));
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "place/new.obj")));
  const std::string pipe = path("pipe.obj");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const Outcome outcome = parameterize(in, "pipe.obj");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, pipe, {"not a regular file"}), "");
}

TEST_F(Faults, damaged_pictures_are_refused)
{
  const std::string in = write("in.obj", obj(textured_hills(12)));
  ASSERT_EQ(parameterize(in, "out.obj", {"--pictures", path("p")}).exit_code, 0);
  const std::string picture = read_file(folder / "p/checker.png");
  ASSERT_GT(picture.size(), 1000u);
  const auto bake = [&](const std::string& bytes) {
    const std::string colors = write("colors.png", bytes);
    return run({"bake", in, "-o", path("light"), "--faces", "50", "--texture", "32", "--colors",
                colors});
  };
  ASSERT_EQ(bake(picture).exit_code, 0);
  fs::remove_all(folder / "light");
  std::mt19937 random(1);
  for(int i = 0; i < 25; ++i) {
    std::string damaged = picture;
    damaged[8 + random() % (damaged.size() - 8)] ^= char(1 << random() % 8);
    const Outcome outcome = bake(damaged);
    EXPECT_EQ(outcome.exit_code, 1) << i;
    EXPECT_EQ(error_in_message(outcome.err, path("colors.png"), {"picture"}), "");
    EXPECT_FALSE(fs::exists(folder / "light"));
  }
}

// --- Maps that are hard to find, or no maps

// A strip that winds around a helix.
Soup helix(std::size_t n)
{
  Soup soup;
  for(std::size_t i = 0; i < n; ++i) {
    for(const double y : {0., 1.}) {
      const double x = 200 * double(i) / double(n - 1), r = 1 + 0.1 * y;
      soup.points.push_back({r * std::cos(x), r * std::sin(x), 0.2 * x});
    }
    if(i > 0) {
      soup.faces.push_back({2 * i - 2, 2 * i, 2 * i + 1});
      soup.faces.push_back({2 * i - 2, 2 * i + 1, 2 * i - 1});
    }
  }
  return soup;
}

TEST_F(Faults, direct_method_helps_where_the_default_one_fails)
{
  const std::string in = write("in.off", off(helix(20000)));
  const Outcome asked = parameterize(in, "out.obj", {"--method", "hlscm", "--iterations", "40"});
  EXPECT_EQ(asked.exit_code, 1);
  EXPECT_EQ(error_in_message(asked.err, in, {"not met after", "--method direct"}), "");
  const Json json = report(in);
  EXPECT_EQ(json["method"], "direct");
  EXPECT_EQ(json["converged"], true);
  ASSERT_EQ(json["warnings"].size(), 1u);
  EXPECT_NE(json["warnings"][0].get<std::string>().find("--method direct"), std::string::npos);
  EXPECT_LT(json["distortion"]["area_scale_range"].get<double>(), 1.1); // it can be unrolled
  const Outcome levels = run({"levels", in, "-o", path("levels"), "--format", "obj"});
  EXPECT_EQ(levels.exit_code, 0) << levels.err;
  EXPECT_NE(levels.err.find("--method direct"), std::string::npos) << levels.err;
}

TEST_F(Faults, map_without_area_is_told)
{
  const std::string in = write("in.off", off({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  const Texts pins{"--pin", "0=0,0", "--pin", "1=1,0", "--pin", "2=2,0"};
  const Json json = report(in, pins);
  EXPECT_EQ(json["converged"], false);
  EXPECT_EQ(json["warnings"].size(), 2u);
  const Outcome outcome = parameterize(in, "out.obj", pins);
  EXPECT_NE(outcome.err.find("triangles without area in the map: 1 of 1"), std::string::npos);
  EXPECT_NE(outcome.out.find("1 more have no area"), std::string::npos) << outcome.out;
}

TEST_F(Faults, end_of_the_time_is_told)
{
  const std::string in = write("in.off", off(grid(60, hilly)));
  const Outcome outcome
      = parameterize(in, "out.obj", {"--method", "lscm", "--time-limit", "1e-9"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("the time was up"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("the time was up"), std::string::npos) << outcome.out;
}

TEST_F(Faults, largest_meshes_are_mapped)
{
  for(const char* method : {"hlscm", "spectral", "direct"}) {
    const Json right
        = report(write("in.off", off(grid(12, hilly))), {"--method", method});
    for(const double unit : {1e-290, 1e307, 1e308}) {
      const Json json
          = report(write("large.off", off(moved(grid(12, hilly), unit, 0))), {"--method", method});
      EXPECT_EQ(json["converged"], true) << method << " " << unit;
      EXPECT_EQ(json["flips"], 0);
      for(const char* measure :
          {"quasi_conformal_mean", "quasi_conformal_max", "area_scale_range"}) {
        EXPECT_NEAR(json["distortion"][measure].get<double>(),
                    right["distortion"][measure].get<double>(), 1e-4)
            << method << " " << unit << " " << measure;
      }
      EXPECT_NEAR(json["energy"].get<double>(), right["energy"].get<double>(), 1e-6);
    }
  }
}

TEST_F(Faults, texture_without_squares_is_refused)
{
  Textured_soup soup = textured_hills(12);
  for(auto& uv : soup.uv) {
    uv = {1e155 * uv[0], 1e155 * uv[1]};
  }
  const std::string in = write("in.obj", obj(soup));
  const Outcome outcome = run({"levels", in, "-o", path("out"), "--format", "obj"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, in, {"texture coordinate", "so large"}), "");
  EXPECT_EQ(names(), std::set<std::string>{"in.obj"});
}

} // namespace program_test
