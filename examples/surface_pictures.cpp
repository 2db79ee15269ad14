// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "precompiled.h"
#include "surface_pictures.h"

#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_texturing/IO/PNG.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

template bool
CGAL::IO::read_polygon_mesh(const std::string&,
                            CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>&,
                            const CGAL::parameters::Default_named_parameters&);

namespace surface_pictures {

typedef CGAL::Simple_cartesian<double>::Vector_3 Vector;

namespace {

// Columns x rows squares, cut in two, of a surface (x, y, z) = f(s, t); closed in both directions
// or open.
template <class Function>
Mesh surface_of(unsigned int columns, unsigned int rows, bool is_closed, const Function& f)
{
  Mesh mesh;
  const unsigned int last = is_closed ? 0 : 1, width = columns + last, height = rows + last;
  for(unsigned int j = 0; j < height; ++j)
    for(unsigned int i = 0; i < width; ++i)
      mesh.points.push_back(f(double(i) / columns, double(j) / rows));
  const auto at = [=](unsigned int i, unsigned int j) { return (j % height) * width + i % width; };
  for(unsigned int j = 0; j < rows; ++j)
    for(unsigned int i = 0; i < columns; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

} // namespace

Mesh hills(unsigned int n)
{
  return surface_of(n, n, false, [](double s, double t) {
    return Mesh::Point_3(s, t, 0.12 * std::sin(9. * s) * std::cos(7. * t));
  });
}

Mesh bumpy_torus(unsigned int n)
{
  return surface_of(2 * n, n, true, [](double s, double t) {
    const double a = 2. * CGAL_PI * s, b = 2. * CGAL_PI * t;
    const double r = 0.4 + 0.05 * std::sin(5. * a) * std::cos(3. * b);
    return Mesh::Point_3((1. + r * std::cos(b)) * std::cos(a), (1. + r * std::cos(b)) * std::sin(a),
                         r * std::sin(b));
  });
}

bool get_surface(int argc, char* argv[], Mesh other, Mesh& mesh)
{
  mesh = std::move(other);
  CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> of_file;
  if(argc < 2)
    return true;
  if(!CGAL::IO::read_polygon_mesh(argv[1], of_file) || !CGAL::is_triangle_mesh(of_file)) {
    std::cerr << "cannot read triangles from " << argv[1] << "\n";
    return false;
  }
  mesh = CGAL::Indexed_mesh::copy_mesh(of_file);
  return true;
}

bool draw(const std::string& filename, const Mesh& mesh, const std::vector<double>& value,
                 int contours)
{
  constexpr int size = 800;
  const Vector right(0.86, 0.5, 0.), up(-0.3, 0.52, 0.8), front(0.4, -0.69, 0.6);
  const auto [least, most] = std::minmax_element(value.begin(), value.end());
  double lo[2] = {1e300, 1e300}, hi[2] = {-1e300, -1e300};
  std::vector<Vector> place; // on the picture, and towards the eye
  for(const auto& p : mesh.points) {
    const Vector v = p - CGAL::ORIGIN;
    place.emplace_back(v * right, v * up, v * front);
    for(int c = 0; c < 2; ++c) {
      lo[c] = (std::min)(lo[c], place.back()[c]);
      hi[c] = (std::max)(hi[c], place.back()[c]);
    }
  }
  const double scale = 0.94 * size / (std::max)(hi[0] - lo[0], hi[1] - lo[1]);
  for(Vector& p : place)
    p = Vector(0.5 * size + scale * (p.x() - 0.5 * (lo[0] + hi[0])),
               0.5 * size - scale * (p.y() - 0.5 * (lo[1] + hi[1])), scale * p.z());
  CGAL::Surface_mesh_texturing::Texture_image image;
  image.width = image.height = size;
  image.channels = 3;
  image.texels.assign(3 * size * size, 1.f);
  std::vector<double> depth(size * size, -1e300);
  for(const auto& t : mesh.triangles) {
    const Vector &a = place[t[0]], b = place[t[1]] - a, c = place[t[2]] - a;
    const double area = b.x() * c.y() - b.y() * c.x();
    const Vector normal = CGAL::cross_product(mesh.points[t[1]] - mesh.points[t[0]],
                                              mesh.points[t[2]] - mesh.points[t[0]]);
    const double light = std::abs(normal * (front + 0.6 * up - 0.5 * right))
                       / (1.3 * std::sqrt(normal.squared_length()) + 1e-300);
    const auto range = [&](int k) {
      const double p = place[t[0]][k], q = place[t[1]][k], r = place[t[2]][k];
      return std::make_pair(int((std::max)(0., std::ceil((std::min)({p, q, r})))),
                            int((std::min)(size - 1., std::floor((std::max)({p, q, r})))));
    };
    for(int y = range(1).first; y <= range(1).second; ++y)
      for(int x = range(0).first; x <= range(0).second; ++x) {
        const double v = ((x - a.x()) * c.y() - (y - a.y()) * c.x()) / area,
                     w = ((y - a.y()) * b.x() - (x - a.x()) * b.y()) / area;
        const double z = a.z() + v * b.z() + w * c.z();
        if(!(v >= 0. && w >= 0. && v + w <= 1.) || z <= depth[y * size + x])
          continue;
        depth[y * size + x] = z;
        const double u = ((1. - v - w) * value[t[0]] + v * value[t[1]] + w * value[t[2]] - *least)
                       / (*most - *least + 1e-300);
        const double line = std::abs(u * contours - std::round(u * contours)) < 0.08 ? 0.35 : 1.;
        const double shade = line * (0.45 + 0.55 * light);
        const double color[3] = {0.25 + 0.7 * u, 0.35 + 0.9 * u * (1. - u), 0.95 - 0.75 * u};
        for(int k = 0; k < 3; ++k)
          image.texels[3 * (y * size + x) + k] = float((std::min)(1., shade * color[k] * 1.15));
      }
  }
  CGAL::Surface_mesh_texturing::PNG_options options;
  options.bits = 8;
  options.lowest = 0.;
  options.highest = 1.;
  return CGAL::Surface_mesh_texturing::IO::write_PNG(filename, image, options);
}

} // namespace surface_pictures
