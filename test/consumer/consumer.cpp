// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Flattens a wavy sheet with the installed library.

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace PMP = CGAL::Polygon_mesh_processing;
#ifdef CGAL_LINKED_WITH_TBB
using Concurrency_tag = CGAL::Parallel_tag;
#else
using Concurrency_tag = CGAL::Sequential_tag;
#endif

int main()
{
  const int n = 120; // cells in each direction: enough vertices for several levels
  Mesh mesh;
  const auto wave = [n](int i, int j) {
    const double x = double(i) / n, y = double(j) / n;
    return Kernel::Point_3(x, y, 0.1 * std::sin(6 * x) * std::cos(5 * y));
  };
  CGAL::make_grid(n, n, mesh, wave, true);

  const auto border = PMP::longest_border(mesh).first;
  auto uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  SMP::HLSCM_parameterizer_3<Mesh, CGAL::Default, CGAL::Default, Concurrency_tag> parameterizer;
  const SMP::Error_code error = SMP::parameterize(mesh, parameterizer, border, uv);
  if(error != SMP::OK) {
    std::cerr << parameterizer.report().message << std::endl;
    return EXIT_FAILURE;
  }
  const auto measures = SMP::measure_distortion(mesh, uv);
  std::cout << parameterizer.report().levels.size() << " levels, quasi-conformal ratio "
            << measures.quasi_conformal_mean << ", " << measures.flipped_faces << " flipped faces"
            << std::endl;
  const bool is_conformal = measures.quasi_conformal_mean < 1.05 && measures.flipped_faces == 0;
  const bool is_multigrid = parameterizer.report().levels.size() > 1;
  return parameterizer.report().converged && is_multigrid && is_conformal ? EXIT_SUCCESS
                                                                          : EXIT_FAILURE;
}
