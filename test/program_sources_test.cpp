// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Where the program hlscm, whose path is HLSCM_PROGRAM, takes its meshes from: files of all
// formats, packed ones, pipes and the standard input.

#include <support/program_runs.h>
#include <support/read_meshes.h>

#include <gtest/gtest.h>

#include <sys/stat.h>

namespace program_sources_test {

using namespace program_test;

class Program_sources : public Program
{
protected:
  // Runs with a file as the standard input.
  Outcome run_with_input(const Texts& arguments, const std::string& file) const
  {
    return finish(start(arguments, [&file] { dup2(open(file.c_str(), O_RDONLY), STDIN_FILENO); }));
  }

  // What `info` says of the mesh, but its name.
  static std::string without_name(const Outcome& outcome)
  {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    Json json = outcome.exit_code == 0 ? Json::parse(outcome.out) : Json();
    json.erase("file");
    return json.dump(1);
  }

  const Soup mesh = grid(7, hilly);
};

TEST_F(Program_sources, are_files_pipes_and_the_standard_input)
{
  const std::string in = write("m.obj", obj(mesh));
  const std::string expected = without_name(run({"info", in, "--json"}));
  EXPECT_NE(expected.find("\"faces\": 72"), std::string::npos) << expected;
  for(const auto& [name, bytes] :
      std::vector<std::pair<std::string, std::string>>{{"m.obj.gz", read_meshes::packed(obj(mesh))},
                                                       {"m.off", off(mesh)},
                                                       {"b.ply", ply(mesh, "binary_little_endian")},
                                                       {"m.PLY", ply(mesh, "ascii")}})
  {
    const std::string file = write(name, bytes);
    EXPECT_EQ(without_name(run({"info", file, "--json"})), expected) << name;
    EXPECT_EQ(without_name(run_with_input({"info", "-", "--json"}, file)), expected) << name;
    EXPECT_EQ(without_name(run_with_input({"info", "/dev/stdin", "--json"}, file)), expected)
        << name;
  }
}

TEST_F(Program_sources, are_named_pipes)
{
  const std::string in = write("m.obj", obj(mesh)), pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const pid_t child = start({"info", pipe, "--json"});
  std::ofstream(pipe, std::ios::binary) << obj(mesh);
  EXPECT_EQ(without_name(finish(child)), without_name(run({"info", in, "--json"})));
}

// One thread reads, and one waits for signals; the program's libraries have none, which would wait busily.
TEST_F(Program_sources, are_waited_for_by_two_threads)
{
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const pid_t child = start({"info", pipe});
  std::ofstream out(pipe, std::ios::binary); // when the program has opened it
  const fs::directory_iterator threads("/proc/" + std::to_string(child) + "/task");
  EXPECT_EQ(std::distance(begin(threads), end(threads)), 2);
  out << obj(mesh);
  out.close();
  EXPECT_EQ(finish(child).exit_code, 0);
}

TEST_F(Program_sources, are_parameterized_from_the_standard_input_too)
{
  const std::string in = write("m.obj", obj(mesh));
  EXPECT_EQ(parameterize(in, "a.obj").exit_code, 0);
  const Outcome outcome = run_with_input({"parameterize", "-", "-o", path("b.obj"), "--quiet"}, in);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_file(folder / "a.obj"), read_file(folder / "b.obj"));
}

TEST_F(Program_sources, name_the_standard_input_when_it_is_bad)
{
  const Outcome outcome = run_with_input({"info", "-"}, write("empty", ""));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, "standard input", {"empty"}), "");
  const Outcome zeros = run({"info", "/dev/zero"});
  EXPECT_EQ(zeros.exit_code, 1);
  EXPECT_EQ(error_in_message(zeros.err, "/dev/zero", {"all zero"}), "");
}

// What the program writes is what it reads.
TEST_F(Program_sources, are_models_that_it_wrote)
{
  const std::string in = write("m.obj", obj(mesh));
  const Outcome atlas = run({"atlas", in, "-o", path("atlas"), "--texture", "128"});
  ASSERT_EQ(atlas.exit_code, 0) << atlas.err;
  const Json json = Json::parse(run({"info", path("atlas/atlas.glb"), "--json"}).out);
  EXPECT_EQ(json["faces"], mesh.faces.size());
  EXPECT_EQ(json["vertices"], mesh.points.size());
  EXPECT_EQ(json["components"], 1);
}

} // namespace program_sources_test
