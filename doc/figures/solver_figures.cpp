// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Figures 3 and 6 of Ray and Lévy 2003, and the picture of a textured chart.

#include "Conformal_problem.h"
#include "Figures.h"
#include "Sheet.h"
#include "numbers.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>

#include <stdexcept>

namespace figures {

namespace {

struct Level
{
  CGAL::Indexed_mesh::Indexed_triangle_mesh mesh;
  Uv uv;
};

struct Solution
{
  std::vector<Level> levels; // the coarsest first
  SMP::HLSCM_report report;

  std::vector<Pin> pins() const
  {
    std::vector<Pin> pins;
    for(const SMP::HLSCM_pin& pin : report.pins)
      pins.push_back({CGAL::Indexed_mesh::Vertex_index(pin.vertex), Complex(pin.u, pin.v)});
    return pins;
  }
};

Solution solve(const Chart& chart, SMP::HLSCM_options options)
{
  Solution solution;
  options.level_observer = [&](const SMP::Level_view& view) {
    Level level;
    for(const std::uint32_t v : *view.vertices)
      level.mesh.points.push_back(chart.mesh.points[v]);
    level.mesh.triangles = *view.faces;
    level.uv = *view.uv;
    solution.levels.push_back(std::move(level));
    return true;
  };
  Mesh mesh = surface_mesh(chart.mesh);
  const auto uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  SMP::HLSCM_parameterizer_3<Mesh> parameterizer(options);
  if(parameterizer.parameterize(mesh, border, uv) != SMP::OK)
    throw std::runtime_error(parameterizer.report().message);
  solution.report = parameterizer.report();
  return solution;
}

// Columns with a surface above and its parameter domain below.
class Columns
{
public:
  Columns(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh, std::size_t number, double width)
    : m_frame(mesh), m_view(drawn(mesh, Uv(mesh.points.size(), 0.), m_frame)), m_width(width)
    , m_sheet(double(number) * (width + margin) + margin, 1.9 * width + 4. * margin)
  {}

  void add(const std::string& name, const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh, const Uv& uv)
  {
    const Drawn_surface surface = drawn(mesh, uv, m_frame);
    const Panel above{m_left, 3. * margin, m_width, m_width};
    m_sheet.draw_surface(m_view, above, surface, Pattern::ISOLINES);
    m_sheet.draw_domain({m_left, m_width + 3.5 * margin, m_width, 0.9 * m_width}, surface);
    m_sheet.label({m_left, 2. * margin, 0., 0.}, name);
    m_left += m_width + margin;
  }

  void write(const std::filesystem::path& file) const { m_sheet.write(file); }

private:
  static constexpr double margin = 14.;

  Frame m_frame;
  View m_view;
  double m_width, m_left = margin;
  Sheet m_sheet;
};

std::string name_of(const Chart& chart)
{
  return chart.name + ", " + count(chart.mesh.triangles.size()) + " triangles";
}

} // namespace

std::string draw_monogrid_figure(const Chart& chart, const std::filesystem::path& file)
{
  SMP::HLSCM_options options;
  options.tolerance = 1e-4;
  const Solution solution = solve(chart, options);
  const Conformal_problem problem(chart.mesh, solution.pins());
  const double least = problem.energy(problem.minimiser());
  const auto gap = [least](double energy) { return number(energy / least - 1.); };

  Columns columns(chart.mesh, 5, 190.);
  std::string gaps;
  const Uv start = problem.projection(chart.mesh);
  for(const std::size_t iterations : {100, 200, 300, 2500}) {
    const Uv z = problem.relaxed(start, iterations);
    columns.add(std::to_string(iterations), chart.mesh, z);
    gaps += gap(problem.energy(z)) + " after " + count(iterations) + ", ";
  }
  const Level& finest = solution.levels.back();
  columns.add("HLSCM", finest.mesh, finest.uv);
  columns.write(file);
  return "Conjugate gradients on the fine mesh alone (Jacobi preconditioner) after 100, 200, 300 and "
         "2500 iterations, started from the projection to a plane, and the hierarchical solver "
         "(tolerance 1e-4, " + count(solution.report.iterations) + " iterations on the fine mesh). "
         "Above: lines of equal u and equal v. Below: the parameter domain, pale where the map is "
         "conformal, flipped triangles marked red. After a few iterations the lines are smooth, but "
         "the domain still overlaps itself: details converge first, the large shape last. The "
         "energy is above the least one by E/Emin - 1 = " + gaps
         + "and " + gap(solution.report.energy) + " for the hierarchical solver. ("
         + name_of(chart) + ")";
}

std::string draw_levels_figure(const Chart& chart, const std::filesystem::path& file)
{
  SMP::HLSCM_options options;
  options.coarsest_size = 300;
  const Solution solution = solve(chart, options);
  const std::vector<Level>& levels = solution.levels;
  Columns columns(chart.mesh, 3, 255.);
  std::string sizes;
  for(const std::size_t l : {std::size_t(0), levels.size() / 2, levels.size() - 1}) {
    columns.add(std::to_string(levels[l].mesh.points.size()), levels[l].mesh, levels[l].uv);
    sizes += (l == 0 ? "" : l + 1 == levels.size() ? " and " : ", ")
           + count(levels[l].mesh.points.size());
  }
  columns.write(file);
  return "The map on the coarsest, a middle and the finest of " + count(levels.size())
       + " levels (" + sizes + " vertices), each the first guess of the next. Level sizes by the "
         "default ratio, the coarsest level smaller than by default. (" + name_of(chart) + ")";
}

std::string draw_checker_figure(const Chart& chart, const std::filesystem::path& file)
{
  const Solution solution = solve(chart, SMP::HLSCM_options());
  const Level& finest = solution.levels.back();
  const Drawn_surface surface = drawn(finest.mesh, finest.uv, Frame(chart.mesh));
  const View view(surface);
  Sheet sheet(960., 470.);
  sheet.draw_surface(view, {15., 15., 430., 440.}, surface, Pattern::CHECKERBOARD);
  sheet.draw_relief(view, {475., 15., 470., 440.}, surface);
  sheet.write(file);
  return "A chart with a checkerboard texture, and its parameter domain with the light and shade of "
         "the surface. (" + name_of(chart) + ")";
}

} // namespace figures
