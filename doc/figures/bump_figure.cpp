// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 1 of Ray and Lévy 2003: a bump that the angular-defect filter keeps, or that is lost.

#include "Conformal_problem.h"
#include "Figures.h"
#include "Sheet.h"
#include "numbers.h"
#include "surfaces.h"

#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>

namespace figures {

namespace {

namespace SMS = CGAL::Surface_mesh_simplification;

constexpr unsigned int cells = 80;            // of the plane, in each direction
constexpr std::size_t coarse_vertices = 30;
constexpr std::size_t steps = 20;             // of conjugate gradients after the first guess
constexpr std::uint32_t number_of_meshes = 50; // over which the means are taken

// Costs nothing: what is added to it does not know the shape of the surface.
struct No_cost
{
  template <class Profile, class Placement>
  typename Profile::FT operator()(const Profile&, const Placement&) const { return 0.; }
};

// The fine mesh and its map of least energy; two opposite corners of the plane are pinned.
struct Fine_level
{
  explicit Fine_level(const CGAL::Indexed_mesh::Indexed_triangle_mesh& m)
    : mesh(m)
    , corners{0, cells, CGAL::Indexed_mesh::Vertex_index(m.points.size() - 1 - cells),
              CGAL::Indexed_mesh::Vertex_index(m.points.size() - 1)}
    , pins{{corners.front(), 0.}, {corners.back(), 1.}}
    , problem(mesh, pins), uv(problem.minimiser()), energy(problem.energy(uv))
  {}

  CGAL::Indexed_mesh::Indexed_triangle_mesh mesh;
  std::vector<CGAL::Indexed_mesh::Vertex_index> corners;
  std::vector<Pin> pins;
  Conformal_problem problem;
  Uv uv;
  double energy;
};

// Energies are in units of the least one.
struct Coarse_level
{
  CGAL::Indexed_mesh::Indexed_triangle_mesh mesh;
  Uv uv;
  double height = 0.; // of the highest vertex
  Uv first_guess;     // on the fine mesh
  double guess_energy, relaxed_energy;
};

// As in the paper, the cheapest collapse of all comes first. The corners stay.
template <class Cost, class Filter>
SMM::Progressive_mesh decimate(const Fine_level& fine, const Cost& cost, const Filter& filter)
{
  SMM::Progressive_mesh_options options;
  options.target_vertices = coarse_vertices;
  options.order = SMM::Collapse_order::STRICT;
  options.is_locked.assign(fine.mesh.points.size(), false);
  for(const CGAL::Indexed_mesh::Vertex_index v : fine.corners)
    options.is_locked[v] = true;
  CGAL::Indexed_mesh::Indexed_triangle_mesh normalized = fine.mesh;
  CGAL::Indexed_mesh::normalize(normalized);
  return SMM::build_progressive_mesh(surface_mesh(normalized), options, cost, filter)
    .progressive_mesh;
}

// As in the paper, a vertex gets its first value from the nearest triangle when it is split off.
Coarse_level coarse_level(const Fine_level& fine, const SMM::Progressive_mesh& pm)
{
  SMM::Hierarchy_options options;
  options.coarsest_size = pm.number_of_vertices - pm.collapses.size();
  options.ratio = double(pm.number_of_vertices) / double(options.coarsest_size); // two levels
  options.rule = SMM::Prolongation_rule::VSPLIT;
  const std::vector<SMM::Mesh_level> levels = SMM::build_hierarchy(fine.mesh, pm, options);
  std::vector<Pin> pins;
  for(const Pin& pin : fine.pins)
    pins.push_back({CGAL::Indexed_mesh::Vertex_index(levels[0].position(pin.vertex)), pin.value});

  Coarse_level coarse;
  coarse.mesh = levels[0].mesh;
  coarse.uv = Conformal_problem(coarse.mesh, pins).minimiser();
  for(const auto& p : coarse.mesh.points)
    coarse.height = (std::max)(coarse.height, p.y());
  levels[1].from_coarser.prolongate(coarse.uv, coarse.first_guess);
  coarse.guess_energy = fine.problem.energy(coarse.first_guess) / fine.energy;
  coarse.relaxed_energy
    = fine.problem.energy(fine.problem.relaxed(coarse.first_guess, steps)) / fine.energy;
  return coarse;
}

// By a cost of edge lengths and triangle shapes alone, and a bound of the angular defect.
Coarse_level by_blind_cost(const Fine_level& fine, double bound)
{
  return coarse_level(fine, decimate(fine, SMS::Triangle_shape_cost<No_cost>(1.),
                                     SMS::Angular_defect_filter<>(bound)));
}

Coarse_level by_default_cost(const Fine_level& fine, double bound)
{
  return coarse_level(fine, decimate(fine, SMM::hierarchy_collapse_cost(),
                                     SMM::hierarchy_collapse_filter(bound)));
}

// Of the energy without the bound to that with it.
struct Mean_ratios
{
  double guess = 1., relaxed = 1.; // geometric means
  std::size_t better = 0;          // meshes on which the bound lowers the relaxed energy

  explicit Mean_ratios(const Bump& bump)
  {
    for(std::uint32_t seed = 1; seed <= number_of_meshes; ++seed) {
      const Fine_level fine(bump.mesh(cells, seed));
      const Coarse_level lost = by_blind_cost(fine, 360.), kept = by_blind_cost(fine, 70.);
      guess *= std::pow(lost.guess_energy / kept.guess_energy, 1. / number_of_meshes);
      relaxed *= std::pow(lost.relaxed_energy / kept.relaxed_energy, 1. / number_of_meshes);
      better += lost.relaxed_energy > kept.relaxed_energy ? 1 : 0;
    }
  }
};

void draw(const Fine_level& fine, const Coarse_level& lost, const Coarse_level& kept,
          const std::filesystem::path& file)
{
  const Frame frame(fine.mesh);
  const View view = view_from({0.45, 0.62, 0.8}, drawn(fine.mesh, fine.uv, frame));
  Sheet sheet(1240., 560.);
  const auto draw_panel = [&](const char* name, const Panel& panel,
                              const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh, const Uv& uv,
                              bool has_edges) {
    const Drawn_surface surface = drawn(mesh, uv, frame);
    sheet.draw_surface(view, panel, surface, Pattern::ISOLINES);
    if(has_edges)
      sheet.draw_edges(view, panel, surface);
    sheet.label(panel, name);
  };
  draw_panel("A", {15., 140., 400., 280.}, fine.mesh, fine.uv, false);
  draw_panel("B", {445., 25., 380., 250.}, lost.mesh, lost.uv, true);
  draw_panel("C", {850., 25., 380., 250.}, fine.mesh, lost.first_guess, false);
  draw_panel("D", {445., 300., 380., 250.}, kept.mesh, kept.uv, true);
  draw_panel("E", {850., 300., 380., 250.}, fine.mesh, kept.first_guess, false);
  sheet.write(file);
}

} // namespace

std::string draw_bump_figure(const std::filesystem::path& file)
{
  const Bump bump;
  const Fine_level fine(bump.mesh(cells, 1));
  const Coarse_level lost = by_blind_cost(fine, 360.), kept = by_blind_cost(fine, 70.);
  draw(fine, lost, kept, file);

  const Coarse_level plain = by_default_cost(fine, 360.), standard = by_default_cost(fine, 70.);
  const Mean_ratios means(bump);
  return "A bump of height " + number(bump.height()) + " on a plane, "
    + count(fine.mesh.triangles.size()) + " triangles, with lines of equal u (red) and equal v "
    "(blue). A: the map of least energy. B: the mesh decimated to " + count(coarse_vertices)
    + " vertices by a cost that knows only edge lengths and triangle shapes, without a bound on the "
    "angular defect (360 degrees); the bump is " + number(lost.height) + " high. C: the map of B "
    "as the first guess on the fine mesh, with " + number(lost.guess_energy)
    + " times the least energy, and " + number(lost.relaxed_energy) + " times after "
    + count(steps) + " steps of conjugate gradients. D: the same decimation with the bound of 70 "
    "degrees; the bump is " + number(kept.height) + " high. E: the first guess from D, with "
    + number(kept.guess_energy) + " times the least energy, and " + number(kept.relaxed_energy)
    + " times after " + count(steps) + " steps. Over " + count(number_of_meshes)
    + " irregular meshes of this bump the energy without the bound is on average (geometric mean) "
    + number(means.guess) + " times that with it in the first guess and " + number(means.relaxed)
    + " times after " + count(steps) + " steps; it is higher after these steps on "
    + count(means.better) + " of them. The default cost, whose volume term protects the bump too, "
    "keeps it " + number(standard.height) + " high with the bound and " + number(plain.height)
    + " without; its first guess has " + number(standard.guess_energy) + " and "
    + number(plain.guess_energy) + " times the least energy.";
}

} // namespace figures
