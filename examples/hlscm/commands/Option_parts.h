// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_OPTION_PARTS_H
#define HLSCM_PROGRAM_OPTION_PARTS_H

#include "common/Program_options.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hlscm {

// What the descriptions of several commands are made of.

template <typename Value>
using Names = std::vector<std::pair<std::string, Value>>;

/// Adds an option whose value is one of some names.
template <typename Value>
void add_choice(CLI::App& app, const std::string& name, const Names<Value>& names, Value& value,
                const std::string& help)
{
  std::string all;
  for(const auto& entry : names) {
    all += (all.empty() ? "" : "|") + entry.first;
  }
  const auto choose = [names, all, &value](const std::string& text) {
    for(const auto& entry : names) {
      if(text == entry.first) {
        value = entry.second;
        return;
      }
    }
    throw CLI::ValidationError("\"" + text + "\" is none of " + all);
  };
  app.add_option_function<std::string>(name, choose, help)->type_name(all);
}

/// Reads "a,b,c" as numbers; empty if it is anything else.
std::vector<double> numbers(const std::string& text);

bool is_count(double value);

/// Reads "E" or "E%".
Length to_length(const std::string& text);

/// Adds an option whose value lies above `low` and is at most `high`.
CLI::Option* add_number(CLI::App& app, const std::string& name, double low, double high,
                        double& value, const std::string& help);

/// Adds an option whose value is a whole number of a range.
template <typename Number>
CLI::Option* add_count(CLI::App& app, const std::string& name, Number low, Number high,
                       Number& value, const std::string& help)
{
  return app.add_option(name, value, help)->check(CLI::Range(low, high, "N"));
}

/// The methods of conformal maps by their names; none is behind the name `other`, if there is one.
Names<std::optional<CGAL::Surface_mesh_parameterization::Conformal_method>>
method_names(const std::string& other = {});

void add_threads(CLI::App& app, unsigned int& threads);

/// Adds what a map is adapted to.
void add_signal(CLI::App& app, Program_options& options);

/// Adds what may be done to a mesh before all else.
void add_weld(CLI::App& app, Program_options& options);

/// Adds what all commands that read a mesh may be told.
void add_quiet(CLI::App& app, Program_options& options);

/// Adds these and the report.
void add_report_and_quiet(CLI::App& app, Program_options& options);

/// Adds what `atlas` and `bake` are told about what the input has already, and how the texture is to
/// be laid out.
void add_layout_options(CLI::App& app, Program_options& options);

/// Adds the commands `atlas` and `bake`.
void add_atlas_commands(CLI::App& app, Program_options& options);

/// Throws `CLI::ValidationError` if options of `bake` contradict each other.
void check_bake(const Program_options& options);

} // namespace hlscm

#endif // HLSCM_PROGRAM_OPTION_PARTS_H
