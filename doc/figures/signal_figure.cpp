// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Checkerboards by maps of three kinds, side by side, and their parameter domains.

#include "Figures.h"
#include "Sheet.h"
#include "numbers.h"

#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace figures {

namespace {

namespace SMP = CGAL::Surface_mesh_parameterization;

Uv uv_of(const std::vector<Kernel::Point_2>& points, const std::string& error)
{
  if(points.empty())
    throw std::runtime_error(error);
  Uv uv;
  for(const Kernel::Point_2& p : points)
    uv.emplace_back(p.x(), p.y());
  return uv;
}

Uv low_stretch(const Chart& chart, const SMP::Low_stretch_options& options)
{
  const SMP::Low_stretch_map map = SMP::low_stretch_map(chart.mesh, options);
  return uv_of(map.uv, map.error);
}

} // namespace

std::string draw_signal_figure(const Chart& chart, const std::filesystem::path& file)
{
  constexpr double width = 300., margin = 14.;
  SMP::HLSCM_options conformal;
  conformal.method = SMP::Conformal_method::SPECTRAL;
  const SMP::Conformal_map map = SMP::conformal_map(chart.mesh, conformal);
  SMP::Low_stretch_options options;
  std::vector<Uv> maps = {uv_of(map.uv, map.report.message), low_stretch(chart, options)};
  options.metric
    = SMP::signal_metric(chart.mesh, CGAL::Surface_mesh_texturing::normal_signal(chart.mesh)).tensors;
  maps.push_back(low_stretch(chart, options));
  const Frame frame(chart.mesh);
  Sheet sheet(3. * (width + margin) + margin, 1.95 * width + 4. * margin);
  const View view(drawn(chart.mesh, maps[1], frame));
  for(std::size_t i = 0; i < maps.size(); ++i) {
    const Drawn_surface surface = drawn(chart.mesh, maps[i], frame);
    const double left = margin + double(i) * (width + margin);
    sheet.draw_surface(view, {left, 3. * margin, width, width}, surface, Pattern::CHECKERBOARD);
    sheet.draw_relief(view, {left, width + 3.5 * margin, width, 0.9 * width}, surface);
  }
  sheet.write(file);
  return "A checkerboard by the conformal map without pins, the low-stretch map, and the low-stretch "
         "map in the metric of the normals; below, their parameter domains with the light and shade of the "
         "surface. (" + chart.name + ", " + count(chart.mesh.triangles.size())
         + " triangles)";
}

} // namespace figures
