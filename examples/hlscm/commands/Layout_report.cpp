// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Layout_report.h"

#include "commands/Json_number.h"

#include <CGAL/Surface_mesh_texturing/udim.h>

namespace hlscm {

namespace SMT = CGAL::Surface_mesh_texturing;

void add_layout(const Layout_report& report, const Layout_settings& settings,
                nlohmann::ordered_json& json)
{
  if(!settings.is_any()) {
    return;
  }
  nlohmann::ordered_json layout;
  if(settings.is_repacked) {
    layout["repacked"] = {{"keeps_scale", settings.keeps_scale},
                          {"mirrored_charts", report.mirrored_charts},
                          {"charts_not_one_to_one", report.defective_charts}};
  }
  if(settings.limits != Chart_limits::NONE) {
    layout["limits"]
        = {{"by", settings.limits == Chart_limits::GROUPS ? "groups" : "materials"},
           {"parts", report.parts}};
  }
  if(settings.separate != Chart_limits::NONE) {
    layout["separate"]
        = {{"by", settings.separate == Chart_limits::GROUPS ? "groups" : "materials"},
           {"pages", report.page_names}};
  }
  if(settings.is_stacked || settings.is_symmetric) {
    layout[settings.is_stacked ? "stacked" : "symmetric"]
        = {{"components", report.components},
           {"copies", report.copies},
           {"mirrored_copies", report.mirrored_copies},
           {"halved_components", report.halved_components},
           {"charts_with_equals", report.charts_with_equals}};
  }
  if(settings.is_udim) {
    layout["udim"] = {{"first", SMT::udim_tile(0)}, {"last", SMT::udim_tile(report.tiles - 1)}};
  }
  if(settings.is_lightmap) {
    layout["lightmap"] = {{"texcoord", 1}};
  }
  layout["texels_per_unit_of_charts"] = {{"least", number(report.least_density)},
                                         {"most", number(report.most_density)}};
  layout["axis_parallel"] = number(report.axis_parallel);
  json["layout"] = layout;
}

void add_layout_lines(const Layout_report& report, const Layout_settings& settings,
                      std::ostream& text)
{
  if(!settings.is_any()) {
    return;
  }
  text << "layout      " << report.least_density << " to " << report.most_density
       << " texels to a unit of length, " << 100 * report.axis_parallel
       << " % of the borders of charts along the axes";
  if(report.parts > 0) {
    text << (settings.limits == Chart_limits::GROUPS ? ", limits between groups: "
                                                     : ", limits between materials: ")
         << report.parts;
  }
  for(std::size_t page = 0; page < report.page_names.size(); ++page) {
    text << (page == 0 ? ", pages of " : ", ") << report.page_names[page];
  }
  if(report.mirrored_charts > 0) {
    text << ", charts mirrored as in the input: " << report.mirrored_charts;
  }
  if(settings.is_stacked || settings.is_symmetric) {
    text << ", " << report.copies << " of " << report.components
         << (settings.is_symmetric ? " components and halves " : " components ")
         << (settings.is_stacked ? "in the place of others (" : "with the charts of others (")
         << report.mirrored_copies << " mirrored)";
  }
  if(settings.is_udim) {
    text << ", tiles " << SMT::udim_tile(0) << " to " << SMT::udim_tile(report.tiles - 1);
  }
  text << "\n";
}

} // namespace hlscm
