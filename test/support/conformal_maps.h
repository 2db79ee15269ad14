// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_CONFORMAL_MAPS_H
#define HLSCM_TEST_SUPPORT_CONFORMAL_MAPS_H

// Runs of the parameterizer and what is promised of them.

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>

#include <algorithm>
#include <complex>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace test_support {

namespace SMP = CGAL::Surface_mesh_parameterization;

typedef SMP::HLSCM_parameterizer_3<Surface_mesh> Parameterizer;
typedef Parameterizer::Point_2 Point_2;
typedef std::vector<std::complex<double>> Parameters;

inline std::vector<CGAL::Simple_cartesian<double>::Point_2> to_points(const Parameters& uv)
{
  std::vector<CGAL::Simple_cartesian<double>::Point_2> points;
  for(const std::complex<double>& z : uv)
    points.emplace_back(z.real(), z.imag());
  return points;
}

// The map p -> f(x + iy) of a planar mesh.
template <class F>
Parameters map_of(const Indexed_triangle_mesh& mesh, const F& f)
{
  Parameters uv;
  for(const Point_3& p : mesh.points)
    uv.push_back(f(std::complex<double>(p.x(), p.y())));
  return uv;
}

// What came of a run: among others the parameters in the order of vertices(mesh), `untouched` where
// none were set.
struct Outcome
{
  SMP::Error_code error = SMP::OK;
  SMP::HLSCM_report report;
  Parameters uv;
};

constexpr double untouched = -123.;

typedef Surface_mesh::Property_map<Surface_mesh::Vertex_index, Point_2> Uv_map;

// A new property map whose values are `untouched`.
inline Uv_map new_uv_map(Surface_mesh& mesh)
{
  return mesh.add_property_map<Surface_mesh::Vertex_index, Point_2>(
    "", Point_2(untouched, untouched)).first;
}

inline Parameters parameters(const Surface_mesh& mesh, const Uv_map& uvmap)
{
  Parameters result;
  for(const auto v : vertices(mesh))
    result.push_back({get(uvmap, v).x(), get(uvmap, v).y()});
  return result;
}

// The same as a property map of the mesh.
inline Uv_map to_uv_map(Surface_mesh& mesh, const Parameters& uv)
{
  Uv_map uvmap = new_uv_map(mesh);
  std::size_t i = 0;
  for(const auto v : vertices(mesh)) {
    put(uvmap, v, Point_2(uv[i].real(), uv[i].imag()));
    ++i;
  }
  return uvmap;
}

// Vertices by their positions in vertices(mesh), and where they go.
typedef std::vector<std::pair<std::size_t, std::complex<double>>> Pins;

inline Outcome parameterize(Surface_mesh& mesh, const SMP::HLSCM_options& options,
                        const Pins& pins = Pins(),
                        Surface_mesh::Halfedge_index bhd = Surface_mesh::null_halfedge())
{
  Parameterizer parameterizer(options);
  std::vector<std::pair<Surface_mesh::Vertex_index, Point_2>> vertex_pins;
  for(const auto& [v, z] : pins)
    vertex_pins.push_back({Surface_mesh::Vertex_index(Vertex_index(v)),
                           Point_2(z.real(), z.imag())});
  if(!pins.empty())
    parameterizer.set_pins(vertex_pins);
  Uv_map uvmap = new_uv_map(mesh);
  Outcome run;
  run.error = parameterizer.parameterize(
    mesh, bhd == Surface_mesh::null_halfedge() ? border_halfedge(mesh) : bhd, uvmap);
  run.report = parameterizer.report();
  run.uv = parameters(mesh, uvmap);
  mesh.remove_property_map(uvmap);
  return run;
}

inline SMP::HLSCM_options with_method(SMP::Conformal_method method, double tolerance = 1e-4)
{
  SMP::HLSCM_options options;
  options.method = method;
  options.tolerance = tolerance;
  return options;
}

inline SMP::Distortion_measures measure(Surface_mesh& mesh, const Parameters& uv)
{
  Uv_map uvmap = to_uv_map(mesh, uv);
  const SMP::Distortion_measures result = SMP::measure_distortion(mesh, uvmap);
  mesh.remove_property_map(uvmap);
  return result;
}

// The diagonal of the bounding box.
inline double size_of(const Parameters& uv)
{
  double lo[2] = {1e300, 1e300}, hi[2] = {-1e300, -1e300};
  for(const auto& z : uv)
    for(int c = 0; c < 2; ++c) {
      lo[c] = (std::min)(lo[c], c == 0 ? z.real() : z.imag());
      hi[c] = (std::max)(hi[c], c == 0 ? z.real() : z.imag());
    }
  return std::hypot(hi[0] - lo[0], hi[1] - lo[1]);
}

// The greatest distance of a vertex from where it should be, in parts of the size of the map.
inline double difference(const Parameters& uv, const Parameters& expected)
{
  double greatest = 0.;
  for(std::size_t i = 0; i < uv.size(); ++i)
    greatest = (std::max)(greatest, std::abs(uv[i] - expected[i]));
  return greatest / size_of(expected);
}

// The hierarchical method beside the sparse direct one on the same system.
struct Comparison
{
  Outcome hierarchical, direct;
  double hierarchical_energy = 0., direct_energy = 0.; // the minimised one
  std::size_t hierarchical_flips = 0, direct_flips = 0;
  double area_scale_range = 0.; // of the direct method

  // (E - Emin) / E; 0 if both are the rounding errors of a map that is a similarity on each face
  double gap() const
  {
    const double size = size_of(direct.uv), rounding = 1e-20 * size * size;
    if(hierarchical_energy <= rounding && direct_energy <= rounding)
      return 0.;
    return (hierarchical_energy - direct_energy) / hierarchical_energy;
  }
};

// The energy that the weights stand for, summed triangle by triangle: as the form z^H H z it would
// lose up to ten digits where it is small.
inline double energy_of(Surface_mesh& mesh, const Parameters& uv, SMP::Conformal_weights weights)
{
  if(weights == SMP::Conformal_weights::EXACT)
    return measure(mesh, uv).conformal_energy;
  const double unit = SMP::internal::mean_edge_length(mesh);
  double sum = 0.;
  for(const auto f : faces(mesh)) {
    const auto triangle = SMP::internal::conformal_triangle(mesh, f, unit);
    const auto h = halfedge(f, mesh), h1 = next(h, mesh);
    const double energy = triangle.energy({uv[target(h, mesh)], uv[target(h1, mesh)],
                                           uv[target(next(h1, mesh), mesh)]});
    sum += 8. * triangle.area() * unit * unit * energy;
  }
  return sum;
}

// The half of a comparison that is the same for all options with these weights.
inline Comparison direct_half(Surface_mesh& mesh, SMP::Conformal_weights weights,
                              const Pins& pins = Pins())
{
  Comparison c;
  SMP::HLSCM_options options = with_method(SMP::Conformal_method::DIRECT);
  options.weights = weights;
  c.direct = parameterize(mesh, options, pins);
  const SMP::Distortion_measures direct = measure(mesh, c.direct.uv);
  c.direct_flips = direct.flipped_faces;
  c.area_scale_range = direct.area_scale_range;
  c.direct_energy = energy_of(mesh, c.direct.uv, weights);
  return c;
}

inline Comparison compare(Surface_mesh& mesh, const SMP::HLSCM_options& options, Comparison direct,
                          const Pins& pins = Pins())
{
  Comparison c = std::move(direct);
  c.hierarchical = parameterize(mesh, options, pins);
  c.hierarchical_flips = measure(mesh, c.hierarchical.uv).flipped_faces;
  c.hierarchical_energy = energy_of(mesh, c.hierarchical.uv, options.weights);
  return c;
}

inline Comparison compare_with_direct(Surface_mesh& mesh, const SMP::HLSCM_options& options,
                                      const Pins& pins = Pins())
{
  return compare(mesh, options, direct_half(mesh, options.weights, pins), pins);
}

// One row of a table: chart, faces, tolerance, gap, iterations, flips of both.
inline std::string row_of(const std::string& name, const Comparison& c, double tolerance)
{
  char text[200];
  std::snprintf(text, sizeof(text), "%-28s %8zu F  tolerance %.0e  gap %9.2e  %3zu iterations  "
                "flips %zu / %zu", name.c_str(), c.hierarchical.report.faces, tolerance, c.gap(),
                c.hierarchical.report.iterations, c.hierarchical_flips, c.direct_flips);
  return text;
}

// What is wrong with the hierarchical result, or an empty string: it must have converged, its
// energy must lie within the tolerance of the direct one, and it may not have more flipped faces.
//
// Above 1e-4 a face that is all but degenerate in the direct map may tip over within the tolerance:
// one in 10,000 is let pass. Faces below 1e-10 of the size of the map are beyond any tolerance of
// the energy; where there are such, flips are not compared.
inline std::string error_in_comparison(const Comparison& c, double tolerance)
{
  for(const Outcome* run : {&c.hierarchical, &c.direct}) {
    if(run->error != SMP::OK)
      return run->report.method + " failed: " + run->report.message;
    if(!run->report.converged)
      return run->report.method + " did not converge";
  }
  if(!(c.gap() <= tolerance))
    return "the energy is too high";
  if(!(c.gap() >= -1e-9))
    return "the energy is below that of the direct method";
  const std::size_t let_pass
    = tolerance > 1e-4 ? (c.direct.report.faces + 9999) / 10000 : std::size_t(0);
  if(c.area_scale_range < 1e20 && c.hierarchical_flips > c.direct_flips + let_pass)
    return "more faces are flipped";
  return {};
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_CONFORMAL_MAPS_H
