// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Lit_picture.h"

#include <cmath>

namespace hlscm {

namespace {

constexpr double ambient = 0.30, diffuse = 0.66, shininess = 30;

Vector_3 unit(const Vector_3& a) { return (1 / std::max(std::sqrt(dot(a, a)), 1e-300)) * a; }

class Lamp
{
public:
  explicit Lamp(const View& view)
  {
    constexpr std::array<double, 3> place{-0.45, 0.55, 0.70}; // right, up, toward the viewer
    m_light = unit(place[0] * view.right() + place[1] * view.up() + place[2] * view.toward());
    m_half_way = unit(m_light + view.toward());
  }

  Colour operator()(const Vector_3& normal, const Colour& material, double gloss) const
  {
    const double brightness = ambient + diffuse * std::max(0., dot(normal, m_light));
    const double shine = gloss * std::pow(std::max(0., dot(normal, m_half_way)), shininess);
    return {brightness * material[0] + shine, brightness * material[1] + shine,
            brightness * material[2] + shine};
  }

private:
  Vector_3 m_light, m_half_way;
};

} // namespace

void draw_lit(Canvas& canvas, const View& view, const std::vector<Vector_3>& points,
              const std::vector<std::array<std::uint32_t, 3>>& triangles,
              const Surface_shader& shader, Progress_bar& progress)
{
  const Lamp lamp(view);
  for(std::size_t t = 0; t < triangles.size(); ++t) {
    if(t % 4096 == 0) {
      progress.advance(double(t) / double(triangles.size()));
    }
    const Vector_3 &a = points[triangles[t][0]], &b = points[triangles[t][1]],
                   &c = points[triangles[t][2]];
    const bool is_toward = dot(cross(b - a, c - a), view.toward()) >= 0;
    const bool is_outside = is_toward != view.is_inside_out();
    canvas.draw_triangle({view(a), view(b), view(c)}, [&](const std::array<double, 3>& at) {
      const Surface_look look = shader(t, at);
      return lamp((is_toward ? 1 : -1) * unit(look.normal),
                  is_outside ? look.colour : mix(look.colour, inside_colour, 0.6),
                  is_outside ? look.gloss : 0);
    });
  }
}

} // namespace hlscm
