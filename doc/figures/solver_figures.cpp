// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Figures 3 and 6 of Ray and Lévy 2003, and the picture of a textured chart.

#include "Figures.h"
#include "Sheet.h"
#include "numbers.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>

#include <stdexcept>

namespace figures {

namespace {

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

struct Level
{
  SMM::Indexed_triangle_mesh mesh;
  Uv uv;
};

struct Solution
{
  std::vector<Level> levels; // the coarsest first
  SMP::HLSCM_report report;
};

Mesh surface_mesh(const SMM::Indexed_triangle_mesh& indexed)
{
  Mesh mesh;
  for(const auto& p : indexed.points)
    mesh.add_vertex(p);
  typedef Mesh::Vertex_index V;
  for(const auto& t : indexed.triangles)
    mesh.add_face(V(t[0]), V(t[1]), V(t[2]));
  return mesh;
}

Solution solve(const SMM::Indexed_triangle_mesh& indexed, SMP::HLSCM_options options)
{
  Mesh mesh = surface_mesh(indexed);
  Solution solution;
  options.level_observer = [&](const SMP::Level_view& view) {
    Level level;
    for(const std::uint32_t v : *view.vertices)
      level.mesh.points.push_back(indexed.points[v]);
    level.mesh.triangles = *view.faces;
    level.uv = *view.uv;
    solution.levels.push_back(std::move(level));
  };
  const auto uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  SMP::HLSCM_parameterizer_3<Mesh> parameterizer(options);
  if(parameterizer.parameterize(mesh, border, uv) != SMP::OK)
    throw std::runtime_error(parameterizer.report().message);
  solution.report = parameterizer.report();
  return solution;
}

} // namespace

std::string draw_monogrid_figure(const Chart& chart, const std::filesystem::path& file)
{
  SMP::HLSCM_options options;
  options.tolerance = 1e-4;
  const Solution solution = solve(chart.mesh, options);
  std::vector<Pin> pins;
  for(const SMP::HLSCM_pin& pin : solution.report.pins)
    pins.push_back({SMM::Vertex_index(pin.vertex), Complex(pin.u, pin.v)});
  const Conformal_problem problem(chart.mesh, pins);
  const double least = problem.energy(problem.minimiser());

  const Frame frame(chart.mesh);
  const View view(drawn(chart.mesh, problem.start(), frame));
  constexpr double side = 210., margin = 16., upper = 220., lower = 180.;
  Sheet sheet(5. * (side + margin) + margin, upper + lower + 4. * margin);
  std::string gaps;
  double left = margin;
  const auto draw = [&](const std::string& name, const SMM::Indexed_triangle_mesh& mesh,
                        const Uv& uv) {
    const Drawn_surface surface = drawn(mesh, uv, frame);
    const Panel above{left, 2. * margin, side, upper},
                below{left, upper + 3. * margin, side, lower};
    sheet.draw_surface(view, above, surface, Pattern::ISOLINES);
    sheet.draw_domain(below, surface);
    sheet.label(above, name);
    left += side + margin;
  };
  Uv z = problem.start();
  for(const std::size_t iterations : {100, 200, 300, 2500}) {
    z = problem.relaxed(problem.start(), iterations);
    draw(std::to_string(iterations), chart.mesh, z);
    gaps += number(problem.energy(z) / least - 1.) + " after " + count(iterations) + ", ";
  }
  const Level& finest = solution.levels.back();
  draw("HLSCM", finest.mesh, finest.uv);
  sheet.write(file);
  return gaps + number(solution.report.energy / least - 1.);
}

std::string draw_levels_figure(const Chart& chart, const std::filesystem::path& file)
{
  SMP::HLSCM_options options;
  options.coarsest_size = 400;
  const Solution solution = solve(chart.mesh, options);
  const std::vector<Level>& levels = solution.levels;
  const Frame frame(chart.mesh);
  const View view(drawn(chart.mesh, levels.back().uv, frame));
  constexpr double side = 290., margin = 20., upper = 300., lower = 240.;
  Sheet sheet(3. * (side + margin) + margin, upper + lower + 4. * margin);
  double left = margin;
  for(const std::size_t l : {std::size_t(0), levels.size() / 2, levels.size() - 1}) {
    const Drawn_surface surface = drawn(levels[l].mesh, levels[l].uv, frame);
    const Panel above{left, 2. * margin, side, upper},
                below{left, upper + 3. * margin, side, lower};
    sheet.draw_surface(view, above, surface, Pattern::ISOLINES);
    sheet.draw_domain(below, surface);
    sheet.label(above, std::to_string(levels[l].mesh.points.size()));
    left += side + margin;
  }
  sheet.write(file);
  return "";
}

std::string draw_checker_figure(const Chart& chart, const std::filesystem::path& file)
{
  const Solution solution = solve(chart.mesh, SMP::HLSCM_options());
  const Frame frame(chart.mesh);
  const Level& finest = solution.levels.back();
  const Drawn_surface surface = drawn(finest.mesh, finest.uv, frame);
  const View view(surface);
  Sheet sheet(1000., 520.);
  sheet.draw_surface(view, {20., 20., 440., 480.}, surface, Pattern::CHECKERBOARD);
  sheet.draw_domain({500., 20., 480., 480.}, surface);
  sheet.write(file);
  return "";
}

} // namespace figures
