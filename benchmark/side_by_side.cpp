// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Parameterizes charts by all methods and peers, each in a process of its own, and writes time,
// memory and quality side by side as CSV. See README.md.

#include "side_by_side/Csv_file.h"
#include "side_by_side/standard_charts.h"
#include "side_by_side/tables.h"

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>

namespace {

using namespace side_by_side;

struct Settings
{
  std::vector<std::string> charts;
  Comparison_options comparison;
  std::string output = "side_by_side.csv";
  std::string data_dir, chart_dir = "charts";
  std::size_t max_faces = 2000000;
  bool table_1 = false, decimation = false;
  std::string method; // of a child process
};

// The entry of the child process.
int run_child(const Settings& settings)
{
  conjugate_gradient_run().maximal_iterations = settings.comparison.cg_iterations;
  Measurement measurement;
  try {
    const std::vector<Method> methods = all_methods();
    measurement = run_method(*find_method(methods, settings.method), settings.charts.at(0));
  } catch(const std::bad_alloc&) {
    measurement.status = "out of memory";
  } catch(const std::exception& error) {
    measurement.status = error.what();
  }
  send(measurement, stdout);
  return 0;
}

// One print for each chart, given or made; `print` gets the runs and the number of the chart.
template <class Print>
void compare(const Settings& settings, const std::vector<Standard_chart>& standard,
             const std::vector<std::string>& default_methods, const Print& print)
{
  Settings used = settings;
  if(used.comparison.methods.empty())
    used.comparison.methods = default_methods;
  if(used.charts.empty())
    for(const Standard_chart& chart : standard)
      used.charts.push_back(chart_file(chart, settings.chart_dir));
  for(const std::string& chart : used.charts)
    if(!std::filesystem::is_regular_file(chart))
      throw std::runtime_error(chart + ": no such file");
  std::cout << "# " << description_of_machine() << std::endl;
  Comparison comparison(used.comparison);
  Csv_file csv(used.output);
  for(std::size_t i = 0; i < used.charts.size(); ++i) {
    const std::vector<Runs> all = comparison.run(used.charts[i]);
    for(const Runs& runs : all)
      csv.write(runs);
    print(all, i);
  }
}

void run_all_methods(const Settings& settings)
{
  compare(settings, growing_charts(settings.data_dir, settings.max_faces),
          {"direct", "cgal_lscm_cholmod", "cgal_lscm_default", "cgal_lscm_cg", "lscm_jacobi",
           "lscm_sgs", "cascadic", "hlscm_1e-2", "hlscm_1e-4"},
          [](const std::vector<Runs>& all, std::size_t) { print_comparison(all); });
}

void run_table_1(const Settings& settings)
{
  compare(settings, table_1_charts(settings.data_dir),
          {"direct", "cascadic", "hlscm_1e-2", "hlscm_1e-4", "lscm_jacobi"},
          [](const std::vector<Runs>& all, std::size_t i) {
            const auto& rows = paper_table_1();
            if(i == 0)
              print_table_1_header();
            print_table_1_rows(rows[std::min(i, rows.size() - 1)], all);
          });
}

void run_decimation(const Settings& settings)
{
  compare(settings, growing_charts(settings.data_dir, settings.max_faces),
          {"direct", "hlscm_flat", "hlscm_flat_strict", "hlscm_cgal_engine"},
          [](const std::vector<Runs>& all, std::size_t) { print_decimation(all); });
}

} // namespace

int main(int argc, char** argv)
{
  Settings settings;
  if(const char* folder = std::getenv("HLSCM_DATA_DIR"))
    settings.data_dir = folder;
  CLI::App app{"Compares methods and peers on charts: time, memory and quality side by side."};
  app.add_option("charts", settings.charts, "meshes with a border; default: made from --data");
  app.add_option("--methods", settings.comparison.methods, "names, separated by commas")
      ->delimiter(',');
  app.add_option("--repeat", settings.comparison.repetitions, "runs of each method")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--limit", settings.comparison.limits.seconds, "seconds for a run")
      ->capture_default_str();
  app.add_option("--memory-limit", settings.comparison.limits.gigabytes, "GB for a run, 0: none")
      ->capture_default_str();
  app.add_option("--cg-iterations", settings.comparison.cg_iterations,
                 "most iterations of CGAL's LSCM with conjugate gradients")
      ->capture_default_str();
  app.add_option("-o,--output", settings.output, "the CSV file")->capture_default_str();
  app.add_option("--data", settings.data_dir, "folder of Debian's CGAL meshes [HLSCM_DATA_DIR]");
  app.add_option("--chart-dir", settings.chart_dir, "where charts are made")->capture_default_str();
  app.add_option("--max-faces", settings.max_faces, "of the charts made")->capture_default_str();
  app.add_flag("--table1", settings.table_1,
               "charts as in the paper's table 1, beside its seconds");
  app.add_flag("--decimation", settings.decimation, "the decimation engines");
  app.add_option("--run", settings.method)->group(""); // how it calls itself
  CLI11_PARSE(app, argc, argv);
  try {
    if(!settings.method.empty())
      return run_child(settings);
    const std::vector<Method> methods = all_methods();
    for(const std::string& name : settings.comparison.methods)
      if(find_method(methods, name) == nullptr)
        throw std::runtime_error("no method " + name);
    if(settings.charts.empty() && settings.data_dir.empty())
      throw std::runtime_error("no charts: name some, or the folder of CGAL's meshes by --data");
    settings.table_1      ? run_table_1(settings)
    : settings.decimation ? run_decimation(settings)
                          : run_all_methods(settings);
  } catch(const std::exception& error) {
    std::cerr << "side_by_side: " << error.what() << '\n';
    return 1;
  }
}
