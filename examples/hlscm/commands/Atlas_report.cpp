// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Atlas_report.h"
#include "commands/Json_number.h"
#include "commands/Repairs.h"

#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace hlscm {

namespace {

using Json = nlohmann::ordered_json;
namespace SMT = CGAL::Surface_mesh_texturing;

Json to_json(const SMT::Chart_report& chart)
{
  return {{"faces", chart.faces},
          {"area", number(chart.distortion.area)},
          {"border_length", number(chart.border_length)},
          {"area_scale", number(chart.distortion.area_scale)},
          {"quasi_conformal", number(chart.distortion.quasi_conformal)},
          {"flips", chart.distortion.flipped_faces},
          {"repaired_flips", chart.repaired_flips},
          {"one_to_one", chart.is_one_to_one},
          {"page", chart.page}};
}

Json json_of(const std::array<double, 4>& values)
{
  Json all = Json::array();
  for(const double value : values) {
    all.push_back(number(value));
  }
  return all;
}

Json to_json(const SMT::Texture_atlas_report& atlas)
{
  Json charts = Json::array();
  for(const SMT::Chart_report& chart : atlas.charts) {
    charts.push_back(to_json(chart));
  }
  const auto& d = atlas.distortion;
  return {{"texels_per_unit", number(atlas.texels_per_unit)},
          {"utilisation", number(atlas.utilisation)},
          {"texel_utilisation", number(atlas.texel_utilisation)},
          {"seam_length", number(atlas.seam_length)},
          {"seams",
           {{"relative_length", number(atlas.seams.relative_length)},
            {"on_creases", number(atlas.seams.on_creases)},
            {"in_concavities", number(atlas.seams.in_concavities)},
            {"occlusion", number(atlas.seams.occlusion)},
            {"surface_occlusion", number(atlas.seams.surface_occlusion)},
            {"jaggedness", number(atlas.seams.jaggedness)}}},
          {"texels",
           {{"parts", atlas.texels.parts},
            {"quasi_conformal", json_of(atlas.texels.quasi_conformal)},
            {"area_scale", json_of(atlas.texels.area_scale)},
            {"density_range", number(atlas.texels.density_range)},
            {"compactness", number(atlas.texels.compactness)}}},
          {"page_cuts", atlas.page_cuts},
          {"unwanted_seams", atlas.unwanted_seams},
          {"recut_charts", atlas.recut_charts},
          {"rough_charts", atlas.rough_charts},
          {"stopped_early", atlas.stopped_early},
          {"flips", d.flipped_faces},
          {"degenerate_faces", d.degenerate_faces},
          {"distortion",
           {{"quasi_conformal_mean", number(d.quasi_conformal_mean)},
            {"quasi_conformal_99", number(d.quasi_conformal_99)},
            {"quasi_conformal_max", number(d.quasi_conformal_max)},
            {"area_scale_range", number(d.area_scale_range)},
            {"stretch_L2", number(d.stretch_L2)}}},
          {"number_of_charts", atlas.charts.size()},
          {"charts", charts}};
}

Json to_json(const Normal_error& error)
{
  return {{"mean", error.mean}, {"quantile_95", error.quantile_95}};
}

Json to_json(const Bake_report& bake)
{
  Json json = {{"faces", bake.faces},
               {"vertices", bake.vertices},
               {"texture_vertices", bake.wedges},
               {"diagonal", number(bake.diagonal)}};
  if(bake.distance) {
    json["distance"] = {{"mean", number(bake.distance->mean)},
                        {"max", number(bake.distance->maximum)}};
  }
  json["displacement"] = {{"lowest", number(bake.lowest)}, {"highest", number(bake.highest)}};
  json["normal_error_degrees"] = {{"without_map", to_json(bake.smooth)},
                                  {"with_map", to_json(bake.mapped)}};
  json["silhouette_difference"] = bake.silhouette_difference;
  json["samples_each_way"] = bake.samples_each_way;
  json["stopped_early"] = bake.stopped_early;
  json["samples"] = bake.samples;
  json["samples_beside"] = bake.samples_beside;
  json["samples_without"] = bake.samples_without;
  return json;
}

Json seconds(const Atlas_report& report)
{
  Json json = {{"read", report.seconds_read}};
  if(report.atlas) {
    json["segment"] = report.atlas->seconds_segment;
    json["map"] = report.atlas->seconds_map;
    json["pack"] = report.atlas->seconds_pack;
    json["atlas"] = report.atlas->seconds_total;
  }
  json["measure"] = report.seconds_measure;
  if(report.bake) {
    json["simplify"] = report.bake->seconds_simplify;
    json["bake"] = report.bake->seconds_bake;
    json["compare"] = report.bake->seconds_compare;
  }
  json["write"] = report.seconds_write;
  return json;
}

void add_atlas_lines(const SMT::Texture_atlas_report& atlas, std::size_t faces,
                     std::ostringstream& text)
{
  const auto& d = atlas.distortion;
  text << "atlas       " << atlas.charts.size()
       << (atlas.charts.size() == 1 ? " chart" : " charts") << ", seams " << atlas.seam_length
       << " long, " << 100 * atlas.utilisation << " % of the texture used\n"
       << "angles      quasi-conformal ratio mean " << d.quasi_conformal_mean << ", 99 % below "
       << d.quasi_conformal_99 << ", max " << d.quasi_conformal_max << "\n"
       << "areas       scale range " << d.area_scale_range << ", stretch L2 " << d.stretch_L2
       << "\nseams       " << atlas.seams.relative_length << " roots of the area long, "
       << 100 * atlas.seams.on_creases << " % on creases, " << 100 * atlas.seams.in_concavities
       << " % in concavities, jaggedness " << atlas.seams.jaggedness << "; cuts for the page "
       << atlas.page_cuts << "\nflips       " << d.flipped_faces << " of " << faces << " faces\n";
}

void add_bake_lines(const Bake_report& bake, std::ostringstream& text)
{
  text << "light       " << bake.faces << " faces, " << bake.vertices << " vertices";
  if(bake.distance && bake.diagonal > 0) {
    text << std::setprecision(3) << "; distance mean "
         << 100 * bake.distance->mean / bake.diagonal << ", max "
         << 100 * bake.distance->maximum / bake.diagonal << " % of the diagonal";
  }
  text << std::fixed << std::setprecision(2) << "\nnormals     off by " << bake.mapped.mean
       << " degrees in the mean, 95 % below " << bake.mapped.quantile_95
       << "; without the map " << bake.smooth.mean << ", " << bake.smooth.quantile_95 << "\n"
       << std::defaultfloat;
}

} // namespace

std::vector<std::string> Atlas_report::all_warnings() const
{
  std::vector<std::string> all = warnings;
  all.insert(all.end(), layout.warnings.begin(), layout.warnings.end());
  if(atlas && atlas->stopped_early) {
    all.push_back("the time was up before the atlas was as good as it gets; see --time-limit, or USR1 "
                  "was sent");
  }
  if(atlas && atlas->rough_charts > 0) {
    all.push_back("charts beyond the bounds on distortion, as the surface is so rough there that small "
                  "ones would be, too: "
                  + std::to_string(atlas->rough_charts) + " of " + std::to_string(atlas->charts.size()));
  }
  if(atlas && atlas->distortion.degenerate_faces > 0) {
    all.push_back("triangles without area in the texture: "
                  + std::to_string(atlas->distortion.degenerate_faces) + " of "
                  + std::to_string(faces));
  }
  if(atlas && atlas->utilisation < wanted_utilisation) {
    std::ostringstream text;
    text << std::setprecision(4) << 100 * atlas->utilisation
         << " % of the texture are used, less than " << 100 * wanted_utilisation
         << " %" << (atlas->why_not_used.empty() ? "" : ": ") << atlas->why_not_used;
    all.push_back(text.str());
  }
  if(overlapping_texels > 0) {
    all.push_back("texels in more than one triangle: " + std::to_string(overlapping_texels));
  }
  if(bake && bake->stopped_early) {
    all.push_back("the time was up: samples of a texel each way are "
                  + std::to_string(bake->samples_each_way)
                  + ", fewer than asked for; see --time-limit");
  }
  if(bake && bake->samples_without > 0) {
    all.push_back("samples of the light model that found no point of the input: "
                  + std::to_string(bake->samples_without) + " of "
                  + std::to_string(bake->samples));
  }
  return all;
}

std::string to_json(const Atlas_report& report, const Program_options& options)
{
  Json files = Json::array();
  for(const auto& [name, bytes] : report.files) {
    files.push_back({{"name", name}, {"bytes", bytes}});
  }
  Json json = {{"input", options.input},
               {"output", options.output},
               {"vertices", report.vertices},
               {"faces", report.faces},
               {"width", report.width},
               {"height", report.height},
               {"pages", report.pages},
               {"overlapping_texels", report.overlapping_texels}};
  if(report.atlas) {
    json["texture_vertices"] = report.wedges;
    json.update(to_json(*report.atlas));
    add_layout(report.layout, options.atlas.layout, json);
  }
  if(report.bake) {
    json["light"] = to_json(*report.bake);
  }
  json["files"] = files;
  json["seconds"] = seconds(report);
  json["peak_memory_mb"] = report.peak_memory_mb;
  json["repairs"] = to_json(report.repairs);
  json["warnings"] = report.all_warnings();
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_table(const Atlas_report& report, const Program_options& options)
{
  std::ostringstream text;
  text << std::setprecision(4) << "input       " << options.input << ": " << report.vertices
       << " vertices, " << report.faces << " faces\n"
       << "texture     " << report.pages << (report.pages == 1 ? " page" : " pages") << " of "
       << report.width << " x " << report.height << " texels, " << report.overlapping_texels
       << " of them in more than one triangle\n";
  if(report.atlas) {
    add_atlas_lines(*report.atlas, report.faces, text);
    add_layout_lines(report.layout, options.atlas.layout, text);
  }
  if(report.bake) {
    add_bake_lines(*report.bake, text);
  }
  text << std::fixed << std::setprecision(2) << "seconds     ";
  const Json all_seconds = seconds(report);
  for(const auto& [stage, value] : all_seconds.items()) {
    text << (stage == "read" ? "" : ", ") << stage << " " << value.get<double>();
  }
  text << "\nmemory      " << std::lround(report.peak_memory_mb) << " MB at most\nwritten     ";
  for(std::size_t i = 0; i < report.files.size(); ++i) {
    text << (i > 0 ? ", " : "") << report.files[i].first;
  }
  text << (options.report.empty() ? "" : ", " + options.report)
       << (options.pictures.empty() ? "" : ", " + options.pictures + "/*.png") << "\n";
  return text.str();
}

} // namespace hlscm
