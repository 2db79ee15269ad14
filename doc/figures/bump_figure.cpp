// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 1 of Ray and Lévy 2003: a bump that the angular-defect filter keeps, or that is lost.

#include "Figures.h"
#include "Sheet.h"
#include "numbers.h"
#include "surfaces.h"

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>

namespace figures {

namespace {

namespace SMS = CGAL::Surface_mesh_simplification;

constexpr std::size_t coarse_vertices = 40;
constexpr std::size_t steps = 20; // of conjugate gradients after the first guess

// Costs nothing: what remains of the costs on top of it does not know the shape of the surface.
struct No_cost
{
  template <class Profile, class Placement>
  typename Profile::FT operator()(const Profile&, const Placement&) const { return 0.; }
};

struct Coarse_level
{
  SMM::Indexed_triangle_mesh mesh;
  Uv uv;
  double height = 0.;  // of the highest vertex
  Uv first_guess;      // on the fine mesh
  double guess_energy, relaxed_energy;
};

// As in the paper: the cheapest collapse of all comes first, values go from a triangle to the
// vertex that a vertex split adds.
template <class Cost, class Filter>
Coarse_level coarse_level(const SMM::Indexed_triangle_mesh& fine, const std::vector<Pin>& pins,
                          const Conformal_problem& problem, const Cost& cost, const Filter& filter)
{
  std::vector<bool> is_locked(fine.points.size(), false);
  for(const Pin& pin : pins)
    is_locked[pin.vertex] = true;
  SMM::Indexed_triangle_mesh normalized = fine;
  SMM::normalize(normalized);
  SMM::Flat_collapse_options collapse_options;
  collapse_options.target_vertices = coarse_vertices;
  collapse_options.order = SMM::Collapse_order::STRICT;
  SMM::Flat_collapse_engine<Cost, Filter> engine(
    normalized, SMM::internal::Vertex_rings(normalized), is_locked, cost, filter);
  const SMM::Progressive_mesh pm = engine.run(collapse_options);

  SMM::Hierarchy_options options;
  options.coarsest_size = pm.number_of_vertices - pm.collapses.size();
  options.ratio = double(pm.number_of_vertices) / double(options.coarsest_size); // two levels
  options.rule = SMM::Prolongation_rule::VSPLIT;
  const std::vector<SMM::Mesh_level> levels = SMM::build_hierarchy(fine, pm, options);

  Coarse_level coarse;
  coarse.mesh = levels[0].mesh;
  std::vector<Pin> coarse_pins;
  for(const Pin& pin : pins)
    coarse_pins.push_back({SMM::Vertex_index(levels[0].position(pin.vertex)), pin.value});
  coarse.uv = Conformal_problem(coarse.mesh, coarse_pins).minimiser();
  levels[1].from_coarser.prolongate(coarse.uv, coarse.first_guess);
  for(const auto& p : coarse.mesh.points)
    coarse.height = (std::max)(coarse.height, p.y());
  coarse.guess_energy = problem.energy(coarse.first_guess);
  coarse.relaxed_energy = problem.energy(problem.relaxed(coarse.first_guess, steps));
  return coarse;
}

} // namespace

std::string draw_bump_figure(const std::filesystem::path& file)
{
  constexpr unsigned int cells = 80;
  const Bump bump;
  const SMM::Indexed_triangle_mesh fine = bump.mesh(cells);
  const std::vector<Pin> pins{{0, 0.}, {SMM::Vertex_index(fine.points.size() - 1), 1.}};
  const Conformal_problem problem(fine, pins);
  const Uv best = problem.minimiser();
  const double least = problem.energy(best);

  const SMS::Triangle_shape_cost<No_cost> blind_cost(1.);
  const Coarse_level lost
    = coarse_level(fine, pins, problem, blind_cost, SMS::Angular_defect_filter<>(360.));
  const Coarse_level kept
    = coarse_level(fine, pins, problem, blind_cost, SMS::Angular_defect_filter<>(70.));
  const auto with_default_cost = [&](double bound) {
    return coarse_level(fine, pins, problem, SMM::hierarchy_collapse_cost(),
                        SMM::hierarchy_collapse_filter(bound)).height;
  };

  const Frame frame(fine);
  const Drawn_surface surface = drawn(fine, best, frame);
  const View view = view_from({0.45, 0.62, 0.8}, surface);
  Sheet sheet(1360., 620.);
  const auto draw = [&](const char* name, const Panel& panel, const SMM::Indexed_triangle_mesh& mesh,
                        const Uv& uv, bool has_edges) {
    const Drawn_surface s = drawn(mesh, uv, frame);
    sheet.draw_surface(view, panel, s, Pattern::ISOLINES);
    if(has_edges)
      sheet.draw_edges(view, panel, s);
    sheet.label(panel, name);
  };
  draw("A", {20., 150., 420., 330.}, fine, best, false);
  draw("B", {480., 30., 410., 270.}, lost.mesh, lost.uv, true);
  draw("C", {930., 30., 410., 270.}, fine, lost.first_guess, false);
  draw("D", {480., 335., 410., 270.}, kept.mesh, kept.uv, true);
  draw("E", {930., 335., 410., 270.}, fine, kept.first_guess, false);
  sheet.write(file);

  const auto times = [least](double energy) { return number(energy / least); };
  return "A bump of height " + number(bump.height()) + " on a plane, "
    + count(fine.triangles.size()) + " triangles, with lines of equal u (red) and equal v (blue). "
    "A: the map of least energy. B: the mesh decimated to " + count(coarse_vertices)
    + " vertices by a cost that knows only edge lengths and triangle shapes, without a bound of the "
    "angular defect (360 degrees); what is left of the bump is " + number(lost.height)
    + " high. C: the map of B as first guess on the fine mesh; its energy is "
    + times(lost.guess_energy) + " times the least, and " + times(lost.relaxed_energy)
    + " times after " + count(steps) + " steps of conjugate gradients. D: the same decimation with "
    "the bound of 70 degrees; the bump is " + number(kept.height) + " high. E: the first guess "
    "from D has " + times(kept.guess_energy) + " times the least energy, and "
    + times(kept.relaxed_energy) + " times after " + count(steps) + " steps. With the cost of the "
    "library, whose volume term also protects the bump, it is " + number(with_default_cost(360.))
    + " high without the bound and " + number(with_default_cost(70.)) + " with it.";
}

} // namespace figures
