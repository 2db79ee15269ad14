// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Json_number.h"
#include "commands/Repairs.h"
#include "commands/Run_report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <sys/resource.h>

namespace hlscm {

namespace {

using Json = nlohmann::ordered_json;

/// "label      text" lines with aligned texts.
class Table
{
public:
  template <typename... Parts>
  void add(const char* label, const Parts&... parts)
  {
    m_text << std::left << std::setw(12) << label << std::setprecision(4);
    (m_text << ... << parts) << "\n";
  }
  std::string str() const { return m_text.str(); }

private:
  std::ostringstream m_text;
};

std::string seconds(double value)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(value < 0.1 ? 3 : 2) << value;
  return text.str();
}

std::string pins_text(const Run_report& report)
{
  constexpr std::size_t shown = 4;
  std::ostringstream text;
  const auto& pins = report.solver.pins;
  if(pins.empty()) {
    return "none";
  }
  for(std::size_t i = 0; i < std::min(pins.size(), shown); ++i) {
    text << (i > 0 ? ", " : "") << "vertex " << pins[i].vertex << " at (" << std::setprecision(4)
         << pins[i].u << ", " << pins[i].v << ")";
  }
  if(pins.size() > shown) {
    text << " and " << pins.size() - shown << " more";
  }
  return text.str();
}

std::string levels_text(const Run_report& report)
{
  std::ostringstream text;
  for(const auto& level : report.solver.levels) {
    text << (text.tellp() > 0 ? ", " : "") << level.vertices;
  }
  return std::to_string(report.solver.levels.size()) + " (vertices: " + text.str() + ")";
}

std::string gap_text(double gap)
{
  std::ostringstream text;
  text << std::setprecision(4) << ", about " << gap << " above the minimum";
  return std::isfinite(gap) ? text.str() : ", how far above the minimum is not known";
}

Json to_json(const CGAL::Surface_mesh_parameterization::Flip_repair_report& repair)
{
  return {{"flipped_before", repair.flipped_before},
          {"degenerate_before", repair.degenerate_before},
          {"flipped_after", repair.flipped_after},
          {"degenerate_after", repair.degenerate_after},
          {"patches", repair.patches},
          {"moved_vertices", repair.moved_vertices},
          {"branch_vertices", repair.branch_vertices},
          {"energy_before", number(repair.energy_before)},
          {"energy_after", number(repair.energy_after)},
          {"seconds", repair.seconds},
          {"unmended_faces", repair.unmended_faces}};
}

// One object for each component.
Json to_json(const std::vector<CGAL::Surface_mesh_texturing::Mapped_component>& components)
{
  Json result = Json::array();
  for(const auto& component : components) {
    result.push_back({{"faces", component.faces},
                      {"borders", component.borders},
                      {"genus", component.genus},
                      {"cut", component.is_cut},
                      {"mapped", component.is_mapped},
                      {"energy", number(component.report.energy)}});
  }
  return result;
}

// What a reader should know about components, nothing for a single one that was not cut.
std::string components_text(const Run_report& report)
{
  std::size_t cut = 0, unmapped = 0;
  for(const auto& component : report.components) {
    cut += component.is_cut;
    unmapped += !component.is_mapped;
  }
  if(report.components.size() == 1) {
    return cut > 0 ? "1, cut to a disk" : "";
  }
  std::string text = std::to_string(report.components.size()) + ", laid side by side";
  if(cut > 0) {
    text += ", " + std::to_string(cut) + " of them cut to disks";
  }
  if(unmapped > 0) {
    text += ", " + std::to_string(unmapped) + " without extent, each mapped to one point";
  }
  return text;
}

} // namespace

double peak_memory_mb()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024;
}

std::vector<std::string> all_warnings(const Run_report& report)
{
  const auto& solver = report.solver;
  std::vector<std::string> warnings = report.warnings;
  warnings.insert(warnings.end(), solver.warnings.begin(), solver.warnings.end());
  if(solver.stopped_early) {
    warnings.push_back("the time was up, this is the map that there was");
  }
  const auto add = [&](const char* what, std::size_t number) {
    if(number > 0) {
      warnings.push_back(what + std::to_string(number) + " of " + std::to_string(solver.faces));
    }
  };
  add("flipped triangles in the map: ", report.distortion.flipped_faces);
  add("triangles without area in the map: ", report.distortion.degenerate_faces);
  return warnings;
}

std::string to_json(const Run_report& report, const Program_options& options)
{
  const auto& s = report.solver;
  const auto& d = report.distortion;
  Json pins = Json::array(), levels = Json::array();
  for(const auto& pin : s.pins) {
    pins.push_back({{"index", pin.vertex}, {"uv", {pin.u, pin.v}}});
  }
  for(const auto& level : s.levels) {
    levels.push_back({{"vertices", level.vertices},
                      {"faces", level.faces},
                      {"iterations", level.iterations},
                      {"seconds", level.seconds}});
  }
  Json json = {{"input", options.input},
               {"output", options.output},
               {"method", s.method},
               {"tolerance", options.library.tolerance},
               {"vertices", s.vertices},
               {"faces", s.faces},
               {"borders", s.borders},
               {"components", to_json(report.components)},
               {"repairs", to_json(report.repairs)},
               {"pins", pins},
               {"levels", s.levels.size()},
               {"level_table", levels},
               {"iterations", s.iterations},
               {"converged", s.converged},
               {"energy", number(s.energy)},
               {"energy_gap_estimate", number(s.energy_gap_estimate)},
               {"flips", d.flipped_faces},
               {"degenerate_faces", d.degenerate_faces},
               {"mollified_faces", s.mollified_faces},
               {"distortion",
                {{"conformal_energy", number(d.conformal_energy)},
                 {"quasi_conformal_mean", number(d.quasi_conformal_mean)},
                 {"quasi_conformal_99", number(d.quasi_conformal_99)},
                 {"quasi_conformal_max", number(d.quasi_conformal_max)},
                 {"area_scale_range", number(d.area_scale_range)},
                 {"stretch_L2", number(d.stretch_L2)},
                 {"stretch_Linf", number(d.stretch_Linf)}}},
               {"seconds",
                {{"read", report.seconds_read},
                 {"hierarchy", s.seconds_hierarchy},
                 {"operators", s.seconds_operators},
                 {"solve", s.seconds_solve},
                 {"measure", report.seconds_measure},
                 {"total", report.seconds_total},
                 {"write", report.seconds_write}}},
               {"peak_memory_mb", report.peak_memory_mb},
               {"warnings", report.warnings}};
  if(!options.signal.empty()) {
    json["signal"] = {{"of", options.signal}, {"weight", options.signal_weight}};
  }
  if(report.stretch) {
    json["stretch"] = {{"energy", number(report.stretch->energy)},
                       {"energy_gap_estimate", number(report.stretch->energy_gap)}};
  }
  if(s.flip_repair) {
    json["flip_repair"] = to_json(*s.flip_repair);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_table(const Run_report& report, const Program_options& options)
{
  const auto& s = report.solver;
  const auto& d = report.distortion;
  Table table;
  table.add("input", options.input, ": ", s.vertices, " vertices, ", s.faces, " faces, ", s.borders,
            s.borders == 1 ? " border" : " borders");
  const std::string components = components_text(report);
  if(!components.empty()) {
    table.add("components", components);
  }
  if(s.method == "direct") {
    table.add("method", s.method);
  } else {
    table.add("method", s.method, ", ", s.iterations,
              s.iterations == 1 ? " iteration" : " iterations", " on the finest level, ",
              s.converged       ? "converged"
              : s.stopped_early ? "stopped early since the time was up"
                                : "tolerance not reached");
  }
  if(!options.signal.empty()) {
    table.add("signal", options.signal, ", counts ", options.signal_weight,
              " times as much as the surface");
  }
  table.add("levels", levels_text(report));
  table.add("pins", pins_text(report));
  if(report.stretch) {
    table.add("stretch", report.stretch->energy, " on average, can fall by about ",
              100 * report.stretch->energy_gap, " % more");
  }
  table.add("energy", s.energy, gap_text(s.energy_gap_estimate));
  table.add("angles", "quasi-conformal ratio mean ", d.quasi_conformal_mean, ", 99 % below ",
            d.quasi_conformal_99, ", max ", d.quasi_conformal_max);
  table.add("areas", "scale range ", d.area_scale_range, ", stretch L2 ", d.stretch_L2);
  table.add("flips", d.flipped_faces, " of ", s.faces, " faces",
            d.degenerate_faces > 0
                ? ", " + std::to_string(d.degenerate_faces) + " more have no area in the map"
                : "");
  if(s.flip_repair) {
    const auto& repair = *s.flip_repair;
    table.add("repair", repair.flipped_before + repair.degenerate_before,
              " flipped or degenerate faces before, ", repair.unmended_faces.size(), " after; ",
              repair.moved_vertices, " vertices moved, energy ", repair.energy_before, " before, ",
              seconds(repair.seconds), " s");
  }
  table.add("seconds", seconds(report.seconds_total), " = hierarchy ", seconds(s.seconds_hierarchy),
            " + operators ", seconds(s.seconds_operators), " + solve ", seconds(s.seconds_solve),
            " + other ",
            seconds(std::max(0., report.seconds_total - s.seconds_hierarchy - s.seconds_operators
                                     - s.seconds_solve)),
            "; read ", seconds(report.seconds_read), ", write ", seconds(report.seconds_write));
  table.add("memory", std::lround(report.peak_memory_mb), " MB at most");
  table.add("written", options.output, options.report.empty() ? "" : ", " + options.report,
            options.pictures.empty() ? "" : ", " + options.pictures + "/*.png");
  return table.str();
}

} // namespace hlscm
