// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/Diagnosis.h"

#include "common/Interruption.h"
#include "common/Program_error.h"

namespace hlscm {

namespace {

std::string text(std::size_t number) { return std::to_string(number); }

// "vertex 7", and how many more.
std::string named(const std::string& element, const Finding& finding)
{
  return element + " " + text(finding.first[0])
         + (finding.count > 1 ? " (and " + text(finding.count - 1) + " more)" : "");
}

std::string named_pair(const std::string& elements, const Finding& finding)
{
  return elements + " " + text(finding.first[0]) + " and " + text(finding.first[1])
         + (finding.count > 1 ? " (and " + text(finding.count - 1) + " more pairs)" : "");
}

Obstacle orientation_obstacle(const Diagnosis& d)
{
  const std::string what = named_pair("faces", d.misoriented)
                           + " run along their common edge in the "
                             "same direction";
  return d.is_orientable
             ? Obstacle{what, "orient all faces consistently first"}
             : Obstacle{what + " and the surface has one side only", "cut it to a disk first"};
}

Obstacle component_obstacle(const Diagnosis& d)
{
  Obstacle obstacle{"the mesh has " + text(d.components) + " connected components",
                    "split it and parameterize each part alone"};
  if(d.coinciding_points > 0) {
    obstacle.remedy += ", or merge its " + text(d.coinciding_points)
                       + " coinciding vertices first if the parts belong together";
  }
  return obstacle;
}

} // namespace

Diagnosis diagnose(const Polygon_soup& soup, Progress_bar& progress)
{
  progress.start_stage("checking");
  const Diagnosis result = CGAL::Indexed_mesh::diagnose_soup(
      soup, [&progress](double part) { return progress.try_advance(part); });
  Interruption::check();
  return result;
}

std::vector<Obstacle> surface_obstacles(const Diagnosis& d)
{
  std::vector<Obstacle> all;
  const auto add_if = [&all](bool is_met, const Obstacle& obstacle) {
    if(is_met) {
      all.push_back(obstacle);
    }
  };
  add_if(bool(d.not_finite),
         {named("vertex", d.not_finite) + " has a coordinate that is not finite",
          "repair or remove it"});
  add_if(bool(d.not_triangular),
         {named("face", d.not_triangular) + " has " + text(d.not_triangular.first[1]) + " corners",
          d.not_triangular.first[1] > 3 ? "triangulate the mesh first"
                                        : "repair it, or export the mesh again"});
  add_if(bool(d.folded), {named("face", d.folded) + " uses a vertex twice", "remove it"});
  add_if(bool(d.isolated),
         {named("vertex", d.isolated) + " belongs to no face",
          "remove isolated vertices, or export the mesh again if faces are missing"});
  add_if(bool(d.duplicate),
         {named_pair("faces", d.duplicate) + " have the same vertices", "remove one of them"});
  add_if(bool(d.non_manifold_edges),
         {"the edge between vertices " + text(d.non_manifold_edges.first[0]) + " and "
              + text(d.non_manifold_edges.first[1]) + " has more than two faces"
              + (d.non_manifold_edges.count > 1
                     ? " (and " + text(d.non_manifold_edges.count - 1) + " more edges)"
                     : ""),
          "split the mesh there into manifold parts"});
  add_if(bool(d.misoriented), orientation_obstacle(d));
  add_if(bool(d.non_manifold_vertices),
         {named("vertex", d.non_manifold_vertices) + " joins "
              + text(d.non_manifold_vertices.first[1]) + " separate fans of faces",
          "give each fan a vertex of its own"});
  return all;
}

std::vector<Obstacle> atlas_obstacles(const Diagnosis& diagnosis)
{
  Diagnosis d = diagnosis;
  d.isolated = Finding();
  return surface_obstacles(d);
}

std::vector<Obstacle> obstacles(const Diagnosis& d)
{
  std::vector<Obstacle> all = surface_obstacles(d);
  const auto add_if = [&all](bool is_met, const Obstacle& obstacle) {
    if(is_met) {
      all.push_back(obstacle);
    }
  };
  add_if(d.components > 1, component_obstacle(d));
  add_if(d.borders == 0, {"the surface is closed", "cut it open along a path of edges first"});
  add_if(d.has_genus() && d.genus > 0,
         {"the surface has " + text(std::size_t(d.genus)) + (d.genus == 1 ? " handle" : " handles"),
          "cut it along the handles to a disk first"});
  return all;
}

void refuse_obstacles(const std::string& file, const std::vector<Obstacle>& obstacles)
{
  if(!obstacles.empty()) {
    throw Program_error(file, obstacles.front().what + ", " + obstacles.front().remedy);
  }
}

} // namespace hlscm
