// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Parameterizes charts by all methods and peers, each in a process of its own, and writes time,
// memory and quality side by side as CSV. See README.md.

#include "side_by_side/Csv_file.h"
#include "side_by_side/standard_charts.h"
#include "side_by_side/tables.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>

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
  Earlier_rows earlier_rows = Earlier_rows::DROP;
  std::string method; // of a child process
};

// The entry of the child process.
int run_child(const Settings& settings)
{
  conjugate_gradient_run().maximal_iterations = settings.comparison.cg_iterations;
  Measurement measurement;
  try {
    const std::vector<Method> methods = all_methods();
    measurement = find_method(methods, settings.method)->run(settings.charts.at(0));
    measurement.numbers["threads"] = number_of_threads();
  } catch(const std::bad_alloc&) {
    measurement.status = "out of memory";
  } catch(const std::exception& error) {
    measurement.status = error.what();
  }
  send(measurement, stdout);
  return 0;
}

// Whether an earlier call has compared all methods on the chart.
bool is_known(const Csv_file& csv, const std::string& chart,
              const std::vector<std::string>& methods)
{
  return std::all_of(methods.begin(), methods.end(), [&](const std::string& method) {
    return csv.has(name_of_chart(chart), method);
  });
}

// The charts given, or the standard ones, which are made where they are missing.
std::vector<std::string> chart_files(const Settings& settings,
                                     const std::vector<Standard_chart>& standard)
{
  std::vector<std::string> files = settings.charts;
  if(files.empty())
    for(const Standard_chart& chart : standard)
      files.push_back(chart_file(chart, settings.chart_dir));
  for(const std::string& file : files)
    if(!std::filesystem::is_regular_file(file))
      throw std::runtime_error(file + ": no such file");
  return files;
}

// Compares the methods on each chart; `print` gets the runs and the number of the chart.
template <class Print>
void compare(const Settings& settings, const std::vector<Standard_chart>& standard,
             const std::vector<std::string>& default_methods, const Print& print)
{
  Comparison_options options = settings.comparison;
  if(options.methods.empty())
    options.methods = default_methods;
  const std::vector<std::string> charts = chart_files(settings, standard);
  std::cout << "# " << machine::description() << std::endl;
  Comparison comparison(options);
  Csv_file csv(settings.output, settings.earlier_rows);
  for(std::size_t i = 0; i < charts.size(); ++i) {
    for(const std::string& method : options.methods)
      if(csv.has_exceeded_time(name_of_chart(charts[i]), method))
        comparison.note_too_slow(charts[i], method);
    if(is_known(csv, charts[i], options.methods))
      continue;
    const std::vector<Runs> all = comparison.run(charts[i]);
    csv.write(all);
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
  compare(settings, table_1_charts(settings.data_dir, settings.max_faces),
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
          {"decimate_flat", "decimate_flat_strict", "decimate_cgal", "direct", "hlscm_flat",
           "hlscm_flat_strict", "hlscm_cgal"},
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
  app.add_option("--repeat-below", settings.comparison.slow_seconds,
                 "seconds; a method whose first run on a chart takes longer is not repeated")
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
  app.add_flag_callback(
      "--resume", [&] { settings.earlier_rows = Earlier_rows::KEEP; },
      "keep the rows of the CSV file and skip the charts it has");
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
