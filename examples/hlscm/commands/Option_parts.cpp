// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Option_parts.h"

#include <charconv>
#include <cmath>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

std::vector<double> numbers(const std::string& text)
{
  std::vector<double> values;
  const char* end = text.data() + text.size();
  for(const char* p = text.data(); p <= end; ++p) {
    double value = 0;
    const std::from_chars_result result = std::from_chars(p, end, value);
    if(result.ec != std::errc() || !std::isfinite(value)
       || (result.ptr != end && *result.ptr != ',')) {
      return {};
    }
    values.push_back(value);
    p = result.ptr;
  }
  return values;
}

bool is_count(double value) { return value >= 0 && value <= 1e9 && value == std::floor(value); }

Length to_length(const std::string& text)
{
  const bool is_relative = !text.empty() && text.back() == '%';
  const auto number = numbers(text.substr(0, text.size() - (is_relative ? 1 : 0)));
  if(number.size() != 1 || !(number[0] >= 0)) {
    throw CLI::ValidationError("\"" + text + "\" is neither a length nor a number of %");
  }
  return {is_relative ? number[0] / 100 : number[0], is_relative};
}

CLI::Option* add_number(CLI::App& app, const std::string& name, double low, double high,
                        double& value, const std::string& help)
{
  const auto check = [low, high](const std::string& text) -> std::string {
    const auto number = numbers(text);
    return number.size() == 1 && number[0] > low && number[0] <= high
               ? ""
               : "\"" + text + "\" is not a number above " + CLI::detail::to_string(low)
                     + " and at most " + CLI::detail::to_string(high);
  };
  return app.add_option(name, value, help)->check(CLI::Validator(check, ""))->type_name("NUMBER");
}

Names<std::optional<SMP::Conformal_method>> method_names(const std::string& other)
{
  Names<std::optional<SMP::Conformal_method>> names = {{"hlscm", SMP::Conformal_method::HLSCM},
                                                       {"spectral", SMP::Conformal_method::SPECTRAL},
                                                       {"cascadic", SMP::Conformal_method::CASCADIC},
                                                       {"lscm", SMP::Conformal_method::LSCM},
                                                       {"direct", SMP::Conformal_method::DIRECT}};
  if(!other.empty()) {
    names.emplace_back(other, std::nullopt);
  }
  return names;
}

void add_threads(CLI::App& app, unsigned int& threads)
{
  add_count(app, "--threads", 0u, 1024u, threads,
            "threads of the hierarchical methods; 0, the default, for all processors. The "
            "result does not depend on it");
}

void add_signal(CLI::App& app, Program_options& options)
{
  app.add_option("--signal", options.signal,
                 "give more of the plane to where something changes fast: the normals of the "
                 "surface, the colours of its vertices (.ply), a picture on its texture "
                 "coordinates (.png, .jpg, .bmp, .tga); or, from any other file, to faces of a "
                 "larger number")
      ->type_name("normals|colors|FILE");
  app.add_option("--signal-weight", options.signal_weight,
                 "how many times as much as the surface that counts (default 4)")
      ->check(CLI::Range(0., 1e6, "NUMBER"))
      ->needs("--signal");
}

void add_weld(CLI::App& app, Program_options& options)
{
  app.add_option_function<std::string>(
         "--weld", [&options](const std::string& text) { options.weld = to_length(text); },
         "merge vertices that are no farther apart than that, a length or in % of the diagonal of the "
         "bounding box; STL, GLB and glTF files have equal points merged in any case")
      ->type_name("E|E%");
}

void add_report_and_quiet(CLI::App& app, Program_options& options)
{
  app.add_option("--report", options.report, "what was done and measured, as JSON")
      ->type_name("FILE.json");
  add_quiet(app, options);
}

void add_quiet(CLI::App& app, Program_options& options)
{
  app.add_flag("--quiet", options.is_quiet, "print errors only");
  add_weld(app, options);
  app.add_flag("--strict", options.is_strict,
               "refuse a mesh that is not what the command needs, instead of mending or cutting it");
}

} // namespace hlscm
