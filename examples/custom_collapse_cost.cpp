// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A collapse cost of one's own, which keeps detail near a point, in the flat engine and in CGAL's
// edge_collapse().

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_recorder.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Halfedge_collapse_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/generators.h>

#include <iostream>
#include <vector>

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;

typedef CGAL::Simple_cartesian<double>::Point_3 Point_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;
typedef SMS::Angular_defect_filter<SMS::Collapse_shape_filter<>> Filter;
const Point_3 focus(10, 10, 0);

// A model of GetCost: the squared edge length, divided by the squared distance from the focus.
struct Cost_near_focus : SMS::Edge_length_cost<Mesh>
{
  template <class Profile, class OptionalPoint>
  auto operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    auto cost = SMS::Edge_length_cost<Mesh>::operator()(profile, placement);
    if(cost)
      *cost /= 1. + CGAL::squared_distance(profile.p0(), focus);
    return cost;
  }
};

bool is_fine_near_focus(const SMM::Progressive_mesh& pm, const std::vector<Point_3>& points)
{
  std::size_t near = 0, all = 0;
  for(const auto& t : SMM::triangles_after(pm, pm.collapses.size())) {
    near += CGAL::squared_distance(points[t[0]], focus) < 100. ? 1 : 0;
    ++all;
  }
  std::cout << near << " of " << all << " triangles are near the focus, an eighth of the area\n";
  return near > all / 2;
}

int main()
{
  Mesh mesh;
  CGAL::make_grid(50, 50, mesh, [](double x, double y) { return Point_3(x, y, 0); }, true);
  SMM::Progressive_mesh_options options;
  options.target_vertices = 300;
  const SMM::Progressive_surface surface
    = SMM::build_progressive_mesh(mesh, options, Cost_near_focus(), Filter());

  SMM::Progressive_mesh_recorder<Mesh> recorder(mesh);
  const auto stop = [](double, const auto&, std::size_t, std::size_t edges) { return edges < 900; };
  SMS::edge_collapse(mesh, stop,
    CGAL::parameters::get_cost(Cost_near_focus()).visitor(recorder)
      .get_placement(SMS::Halfedge_collapse_placement<Cost_near_focus, Filter>()));

  return is_fine_near_focus(surface.progressive_mesh, surface.points)
      && is_fine_near_focus(recorder.progressive_mesh(), surface.points) ? 0 : 1;
}
