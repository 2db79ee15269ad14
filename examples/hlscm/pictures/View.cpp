// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/View.h"

#include <limits>

namespace hlscm {

namespace {

constexpr std::size_t maximal_samples = 20000;
constexpr int number_of_directions = 200;
constexpr int cells = 48; // of the coarse depth buffer, in each direction

Vector_3 normalized(const Vector_3& a)
{
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? (1 / length) * a : Vector_3{0, 0, 1};
}

/// A triangle reduced to a point.
struct Sample
{
  Vector_3 point;
  Vector_3 normal; // as long as the area, doubled
};

std::vector<Sample> take_samples(const Drawn_surface& surface)
{
  const std::size_t stride = 1 + surface.triangles.size() / maximal_samples;
  std::vector<Sample> samples;
  for(std::size_t f = 0; f < surface.triangles.size(); f += stride) {
    const Vector_3 &a = surface.points[surface.triangles[f][0]],
                   &b = surface.points[surface.triangles[f][1]],
                   &c = surface.points[surface.triangles[f][2]];
    samples.push_back({(1. / 3) * (a + b + c), cross(b - a, c - a)});
  }
  return samples;
}

// Makes the normals point outwards if they do not on the whole; returns whether they did not.
bool turn_outwards(std::vector<Sample>& samples)
{
  Vector_3 centre{};
  double area = 0;
  for(const Sample& s : samples) {
    const double weight = std::sqrt(dot(s.normal, s.normal));
    centre = centre + weight * s.point;
    area += weight;
  }
  centre = (area > 0 ? 1 / area : 0) * centre;
  double volume = 0;
  for(const Sample& s : samples) {
    volume += dot(s.point - centre, s.normal);
  }
  if(volume < 0) {
    for(Sample& s : samples) {
      s.normal = -1 * s.normal;
    }
  }
  return volume < 0;
}

// How much of the bounding rectangle, seen along an axis, the lowest points of the surface span.
double footprint(const Drawn_surface& surface, std::size_t axis)
{
  constexpr double lowest_part = 0.04; // of the height
  Vector_3 low{1, 1, 1}, high{-1, -1, -1}, foot_low{1, 1, 1}, foot_high{-1, -1, -1};
  const auto add = [](Vector_3& l, Vector_3& h, const Vector_3& p) {
    for(std::size_t k = 0; k < 3; ++k) {
      l[k] = std::min(l[k], p[k]);
      h[k] = std::max(h[k], p[k]);
    }
  };
  for(const Vector_3& p : surface.points) {
    add(low, high, p);
  }
  for(const Vector_3& p : surface.points) {
    if(p[axis] - low[axis] <= lowest_part * (high[axis] - low[axis])) {
      add(foot_low, foot_high, p);
    }
  }
  double fraction = 1;
  for(std::size_t k = 0; k < 3; ++k) {
    if(k != axis && high[k] > low[k]) {
      fraction *= (foot_high[k] - foot_low[k]) / (high[k] - low[k]);
    }
  }
  return fraction;
}

// Scans have y or z upwards; no file says which.
std::size_t vertical_axis(const Drawn_surface& surface)
{
  constexpr double smallest_base = 0.15;
  const double y = footprint(surface, 1), z = footprint(surface, 2);
  return z > std::max(y, smallest_base) ? 2 : 1;
}

// Right and up for an eye in direction `toward`.
std::pair<Vector_3, Vector_3> frame(const Vector_3& toward, std::size_t axis)
{
  if(std::abs(toward[axis]) > 0.9) {
    axis = 3 - axis;
  }
  Vector_3 vertical{};
  vertical[axis] = 1;
  const Vector_3 right = normalized(cross(vertical, toward));
  return {right, cross(toward, right)};
}

// Seen area of the outside, minus that of the inside. The samples lie in the unit ball.
double seen_area(const std::vector<Sample>& samples, const Vector_3& toward, std::size_t axis)
{
  constexpr double tolerance = 0.05; // of depth within a cell
  const auto [right, up] = frame(toward, axis);
  std::vector<double> nearest(cells * cells, -std::numeric_limits<double>::infinity());
  const auto cell = [right = right, up = up](const Sample& s) {
    const auto index = [](double x) { return std::clamp(int((x + 1) / 2 * cells), 0, cells - 1); };
    return std::size_t(index(dot(up, s.point)) * cells + index(dot(right, s.point)));
  };
  for(const Sample& s : samples) {
    double& depth = nearest[cell(s)];
    depth = std::max(depth, dot(toward, s.point));
  }
  double area = 0;
  for(const Sample& s : samples) {
    if(dot(toward, s.point) > nearest[cell(s)] - tolerance) {
      area += dot(toward, s.normal);
    }
  }
  return area;
}

std::vector<Vector_3> candidates(const std::vector<Sample>& samples)
{
  Vector_3 mean_normal{};
  for(const Sample& s : samples) {
    mean_normal = mean_normal + s.normal;
  }
  std::vector<Vector_3> directions{normalized(mean_normal)};
  constexpr double golden_angle = 2.399963229728653;
  for(int i = 0; i < number_of_directions; ++i) { // a spiral over the sphere
    const double z = 1 - (2 * i + 1.) / number_of_directions, r = std::sqrt(1 - z * z);
    directions.push_back({r * std::cos(golden_angle * i), z, r * std::sin(golden_angle * i)});
  }
  return directions;
}

} // namespace

View::View(const Drawn_surface& surface)
{
  std::vector<Sample> samples = take_samples(surface);
  m_is_inside_out = turn_outwards(samples);
  const std::size_t axis = vertical_axis(surface);
  double best = -std::numeric_limits<double>::infinity();
  for(const Vector_3& direction : candidates(samples)) {
    const double area = seen_area(samples, direction, axis);
    if(area > best) {
      best = area;
      m_toward = direction;
    }
  }
  std::tie(m_right, m_up) = frame(m_toward, axis);

  double x[2] = {1e300, -1e300}, y[2] = {1e300, -1e300};
  for(const Vector_3& p : surface.points) {
    x[0] = std::min(x[0], dot(m_right, p));
    x[1] = std::max(x[1], dot(m_right, p));
    y[0] = std::min(y[0], dot(m_up, p));
    y[1] = std::max(y[1], dot(m_up, p));
  }
  m_x = (x[0] + x[1]) / 2;
  m_y = (y[0] + y[1]) / 2;
  m_width = std::max(x[1] - x[0], 1e-6);
  m_height = std::max(y[1] - y[0], 1e-6);
}

void View::fit_to(const Panel& panel)
{
  m_scale = std::min(panel.width / m_width, panel.height / m_height);
  m_centre_x = panel.left + panel.width / 2;
  m_centre_y = panel.top + panel.height / 2;
}

} // namespace hlscm
