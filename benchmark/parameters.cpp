// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Varies one option of HLSCM_options at a time, the others as they are by default: a CSV file on
// stdout with time, iterations and quality for each value.

#include "machine.h"
#include "side_by_side/library_methods.h"

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>

#include <CLI/CLI.hpp>

#include <exception>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace side_by_side;
typedef CGAL::Multigrid::Schedule Schedule;

struct Value
{
  std::string text;
  std::function<void(SMP::HLSCM_options&)> set;
};

struct Parameter
{
  std::string name;
  std::string default_value; // the text of one of the values
  std::vector<Value> values;
};

// A number of HLSCM_options.
template <class Number>
Parameter number(const std::string& name, Number SMP::HLSCM_options::*member, Number default_value,
                 std::initializer_list<Number> values)
{
  const auto text = [](Number value) {
    std::ostringstream out;
    out << value;
    return out.str();
  };
  Parameter result{name, text(default_value), {}};
  for(const Number value : values)
    result.values.push_back(
        {text(value), [member, value](SMP::HLSCM_options& options) { options.*member = value; }});
  return result;
}

// A choice of HLSCM_options; the first value is the default.
template <class Member, class Choice>
Parameter choice(const std::string& name, Member SMP::HLSCM_options::*member,
                 std::initializer_list<std::pair<const char*, Choice>> values)
{
  Parameter result{name, values.begin()->first, {}};
  for(const auto& named : values)
    result.values.push_back({named.first, [member, value = named.second](auto& options) {
                               options.*member = value;
                             }});
  return result;
}

std::vector<Parameter> all_parameters()
{
  typedef SMP::HLSCM_options Options;
  const Options defaults;
  return {
      number("tolerance", &Options::tolerance, defaults.tolerance,
             {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8}),
      number("level_ratio", &Options::level_ratio, 4., {2.5, 3., 4., 6., 8., 10.}), // 0 means 4
      number<std::size_t>("coarsest_size", &Options::coarsest_size, defaults.coarsest_size,
                          {250, 500, 1000, 2000, 4000, 8000, 16000}),
      choice<std::optional<Schedule>, Schedule>("smoothing_steps", &Options::schedule,
                                                {{"2", Schedule::k_cycle(2, 2)},
                                                 {"1", Schedule::k_cycle(1, 1)},
                                                 {"3", Schedule::k_cycle(3, 3)},
                                                 {"4", Schedule::k_cycle(4, 4)}}),
      choice<std::optional<Schedule>, Schedule>("cycle", &Options::schedule,
                                                {{"K", Schedule::k_cycle(2, 2)},
                                                 {"V", Schedule::v_cycle(2, 2)},
                                                 {"W", Schedule::w_cycle(2, 2)}}),
      number("angular_defect_bound", &Options::angular_defect_bound, defaults.angular_defect_bound,
             {20., 35., 50., 70., 90., 120., 180.}),
      choice<SMP::Prolongation_rule, SMP::Prolongation_rule>(
          "prolongation", &Options::prolongation,
          {{"WALK", SMP::Prolongation_rule::WALK}, {"VSPLIT", SMP::Prolongation_rule::VSPLIT}}),
      choice<SMP::Decimation_engine, SMP::Decimation_engine>(
          "engine", &Options::engine,
          {{"FLAT", SMP::Decimation_engine::FLAT},
           {"FLAT_STRICT", SMP::Decimation_engine::FLAT_STRICT}}),
      number("threads", &Options::threads, 1u, {1u, 2u}), // 1: without Parallel_tag
  };
}

// A chart, and the minimum of its energy.
class Measured_chart
{
public:
  explicit Measured_chart(const std::string& path)
    : m_name(std::filesystem::path(path).stem().string())
    , m_mesh(charts::make_surface_mesh(charts::read_chart(path)))
    , m_uvmap(m_mesh.add_property_map<Vertex, Kernel::Point_2>("v:uv").first)
    , m_pins(far_border_pins(m_mesh))
  {
    SMP::HLSCM_options direct;
    direct.method = SMP::Conformal_method::DIRECT;
    m_minimum = 0;
    const Measurement solution = run(direct);
    if(!solution.is_ok())
      throw std::runtime_error(path + ": " + solution.status);
    m_minimum = solution.get("energy");
  }

  const std::string& name() const { return m_name; }
  std::size_t number_of_faces() const { return m_mesh.number_of_faces(); }

  Measurement run(const SMP::HLSCM_options& options)
  {
    Measurement result = run_library(m_mesh, m_pins, m_uvmap, options);
    if(!result.is_ok())
      return result;
    const SMP::Distortion_measures distortion = SMP::measure_distortion(m_mesh, m_uvmap);
    result.numbers.insert({{"energy", distortion.conformal_energy},
                           {"energy_gap", distortion.conformal_energy / m_minimum - 1},
                           {"flips", double(distortion.flipped_faces)}});
    return result;
  }

private:
  std::string m_name;
  Surface_mesh m_mesh;
  Uv_map m_uvmap;
  Pins m_pins;
  double m_minimum;
};

const std::vector<const char*>& columns()
{
  static const std::vector<const char*> names = {
      "seconds_hierarchy", "seconds_operators", "seconds_solve", "seconds_total", "levels",
      "coarse_vertices",   "iterations",        "energy_gap",    "flips"};
  return names;
}

void print_header()
{
  std::cout << "# " << machine::description() << "\nchart,faces,parameter,value,is_default";
  for(const char* column : columns())
    std::cout << ',' << column;
  std::cout << ",status\n";
}

// A row of medians for each value. The repetitions of the values alternate, so that a noisy minute
// does not hit one value alone.
void print_rows(Measured_chart& chart, const Parameter& parameter, int repetitions)
{
  std::vector<std::vector<Measurement>> runs(parameter.values.size());
  for(int repetition = 0; repetition < repetitions; ++repetition)
    for(std::size_t i = 0; i < runs.size(); ++i) {
      SMP::HLSCM_options options;
      parameter.values[i].set(options);
      runs[i].push_back(chart.run(options));
    }
  for(std::size_t i = 0; i < runs.size(); ++i) {
    const std::string& value = parameter.values[i].text;
    const Measurement row = median(runs[i]);
    std::cout << chart.name() << ',' << chart.number_of_faces() << ',' << parameter.name << ','
              << value << ',' << (value == parameter.default_value);
    for(const char* column : columns()) {
      std::cout << ',';
      if(!std::isnan(row.get(column)))
        std::cout << row.get(column);
    }
    std::cout << ",\"" << row.status << '"' << std::endl;
  }
}

} // namespace

int main(int argc, char** argv)
{
  std::vector<std::string> paths;
  int repetitions = 3;
  CLI::App app{"Varies one option at a time around the defaults; a CSV file on stdout."};
  app.add_option("charts", paths, "meshes with a border")->required();
  app.add_option("--repeat", repetitions, "runs of each value")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    print_header();
    for(const std::string& path : paths) {
      Measured_chart chart(path);
      for(const Parameter& parameter : all_parameters())
        print_rows(chart, parameter, repetitions);
    }
  } catch(const std::exception& error) {
    std::cerr << "parameters: " << error.what() << '\n';
    return 1;
  }
}
