// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/View_page.h"

#include "pictures/View.h"
#include "writing/Packed_arrays.h"

#include <CGAL/Surface_mesh_texturing/udim.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hlscm {

namespace {

using Json = nlohmann::ordered_json;
using CGAL::Indexed_mesh::Triangle_indices;

constexpr std::int32_t steps = (1 << 20) - 1; // of a grid, along its longest side
constexpr double one = 32767;                 // a coordinate of a unit vector
constexpr double farthest_tile = 100;         // texture coordinates beyond are not on pages

template <std::size_t dimension>
using Coordinates = std::array<double, dimension>;

/// An axis-parallel box in space or in the plane.
template <std::size_t dimension>
struct Box
{
  Coordinates<dimension> low, high;

  Box()
  {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }

  template <class Points>
  void add(const Points& points)
  {
    for(const auto& p : points) {
      for(std::size_t k = 0; k < dimension; ++k) {
        low[k] = std::min(low[k], p[int(k)]);
        high[k] = std::max(high[k], p[int(k)]);
      }
    }
  }

  double longest_side() const
  {
    double side = 0;
    for(std::size_t k = 0; k < dimension; ++k) {
      side = std::max(side, high[k] - low[k]);
    }
    return side > 0 ? side : 1;
  }
};

/// Coordinates as whole numbers. What the page has is `origin + step * number`.
template <std::size_t dimension>
struct Grid
{
  Coordinates<dimension> low; ///< of the model
  double unit;                ///< a step, as a length of the model
  Coordinates<dimension> origin;
  double step;

  std::int32_t number(double x, std::size_t k) const
  {
    return std::int32_t(std::lround((x - low[k]) / unit));
  }

  Json to_json() const { return {{"origin", origin}, {"step", step}}; }
};

// In the page the longest side of the model goes from -1 to 1.
Grid<3> space_grid(const Box<3>& box)
{
  Grid<3> grid{box.low, box.longest_side() / steps, {}, 2. / steps};
  for(std::size_t k = 0; k < 3; ++k) {
    grid.origin[k] = (box.low[k] - box.high[k]) / box.longest_side();
  }
  return grid;
}

/// The texture as the page has it: its pages, and the grid of coordinates.
struct Plane
{
  Grid<2> grid;
  std::array<double, 4> pages; ///< left, bottom, width and height
};

// Pages are unit squares, whose sides rounding may pass; what is far from them is scaled into one.
Plane plane_of(const Box<2>& box)
{
  const double unit = box.longest_side() / steps;
  const bool is_far = std::max({std::abs(box.low[0]), std::abs(box.low[1]), std::abs(box.high[0]),
                                std::abs(box.high[1])})
                    > farthest_tile;
  if(is_far) {
    return {{box.low, unit, {0, 0}, 1. / steps}, {0, 0, 1, 1}};
  }
  constexpr double rounding = 1e-4;
  std::array<double, 4> pages;
  for(std::size_t k = 0; k < 2; ++k) {
    pages[k] = std::floor(box.low[k] + rounding);
    pages[k + 2] = std::max(1., std::ceil(box.high[k] - rounding) - pages[k]);
  }
  return {{box.low, unit, box.low, unit}, pages};
}

// Each coordinate as the difference from that of a predecessor, which comes before.
template <std::size_t dimension, class Points>
void add_coordinates(const Points& points, const std::vector<std::uint32_t>& predecessor,
                     const Grid<dimension>& grid, Packed_arrays& arrays)
{
  for(std::size_t k = 0; k < dimension; ++k) {
    std::vector<std::int32_t> differences;
    differences.reserve(points.size());
    for(std::size_t i = 0; i < points.size(); ++i) {
      const std::int32_t before
          = i > 0 ? grid.number(points[predecessor[i]][int(k)], k) : 0;
      differences.push_back(grid.number(points[i][int(k)], k) - before);
    }
    arrays.add_signed(differences);
  }
}

void add_triangles(const std::vector<Triangle_indices>& triangles, Packed_arrays& arrays)
{
  for(std::size_t c = 0; c < 3; ++c) {
    std::vector<std::uint32_t> column;
    column.reserve(triangles.size());
    for(const Triangle_indices& t : triangles) {
      column.push_back(t[c]);
    }
    arrays.add(column);
  }
}

Json add_original(const Progressive_model& model, const Grid<3>& space, const Grid<2>& plane,
                  Packed_arrays& arrays)
{
  const std::size_t wedges = model.number_of_wedges();
  const std::size_t base = model.number_of_wedges_after(model.number_of_collapses());
  std::vector<std::uint32_t> is_first(wedges), parents, of_wedge(wedges), of_vertex(model.points.size());
  for(std::uint32_t w = 0; w < wedges; ++w) {
    const std::uint32_t v = model.vertex[w];
    is_first[w] = w == 0 || model.vertex[w - 1] != v;
    of_wedge[w] = w >= base ? model.parent(w) : w - 1;
    if(w >= base) {
      parents.push_back(model.parent(w));
    }
    if(is_first[w] != 0 && v > 0) {
      const std::uint32_t target = model.vertex[of_wedge[w]];
      of_vertex[v] = target < v ? target : v - 1;
    }
  }
  arrays.add(is_first);
  arrays.add(parents);
  add_coordinates(model.points, of_vertex, space, arrays);
  add_coordinates(model.uv, of_wedge, plane, arrays);
  add_triangles(model.progressive_mesh.triangles, arrays);
  return {{"faces", model.progressive_mesh.triangles.size()},
          {"vertices", model.points.size()},
          {"base", base},
          {"grid", space.to_json()},
          {"uv_grid", plane.to_json()}};
}

void add_unit_vectors(const std::vector<std::array<double, 4>>& vectors, std::size_t dimension,
                      Packed_arrays& arrays)
{
  for(std::size_t k = 0; k < dimension; ++k) {
    std::vector<std::int32_t> column;
    for(const auto& vector : vectors) {
      column.push_back(std::int32_t(std::lround(one * vector[k])));
    }
    arrays.add_signed(column);
  }
}

Json add_light(const Framed_mesh& light, const Grid<3>& space, const Grid<2>& plane,
               Packed_arrays& arrays)
{
  Textured_triangle_mesh corners; // one point and one texture coordinate for each frame
  std::vector<std::uint32_t> before;
  std::vector<std::array<double, 4>> normals, tangents;
  for(const auto& frame : light.frames.frames) {
    before.push_back(std::uint32_t(before.empty() ? 0 : before.size() - 1));
    corners.points.push_back(light.mesh.points[frame.vertex]);
    corners.uv.push_back(light.mesh.uv[frame.wedge]);
    const auto& n = light.frames.normals[frame.vertex];
    const auto& t = frame.tangent;
    normals.push_back({n.x(), n.y(), n.z(), 0});
    tangents.push_back({t.x(), t.y(), t.z(), frame.sign});
  }
  arrays.add(before); // as many as there are
  add_coordinates(corners.points, before, space, arrays);
  add_coordinates(corners.uv, before, plane, arrays);
  add_unit_vectors(normals, 3, arrays);
  add_unit_vectors(tangents, 4, arrays);
  add_triangles(light.frames.corners, arrays);
  return {{"faces", light.mesh.triangles.size()},
          {"vertices", light.mesh.points.size()},
          {"grid", space.to_json()},
          {"uv_grid", plane.to_json()}};
}

// From where the model is looked at, and the axis that is upwards.
Json view_of(const Viewed_model& model, const Grid<3>& space)
{
  Drawn_surface surface;
  const auto& points = model.original ? model.original->points : model.light->mesh.points;
  for(const auto& p : points) {
    Vector_3 place;
    for(std::size_t k = 0; k < 3; ++k) {
      place[k] = space.origin[k] + space.step * ((p[int(k)] - space.low[k]) / space.unit);
    }
    surface.points.push_back(place);
  }
  if(model.original) {
    for(Triangle_indices t : model.original->progressive_mesh.triangles) {
      surface.triangles.push_back({model.original->vertex[t[0]], model.original->vertex[t[1]],
                                   model.original->vertex[t[2]]});
    }
  } else {
    for(const Triangle_indices& t : model.light->mesh.triangles) {
      surface.triangles.push_back({t[0], t[1], t[2]});
    }
  }
  const View view(surface);
  const auto up = std::max_element(view.up().begin(), view.up().end(), [](double a, double b) {
    return std::abs(a) < std::abs(b);
  });
  Vector_3 axis{};
  axis[std::size_t(up - view.up().begin())] = *up < 0 ? -1 : 1;
  return {{"toward", view.toward()}, {"up", axis}};
}

// An element of the page that holds a text, which must not end it.
std::string element(const std::string& id, const std::string& type, const std::string& text)
{
  return "<script id=\"" + id + "\" type=\"" + type + "\">" + text + "</script>\n";
}

// JSON in which nothing looks like the end of an element
std::string harmless(const Json& json)
{
  std::string text;
  for(const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    text += c == '<' ? "\\u003c" : std::string(1, c);
  }
  return text;
}

} // namespace

std::string fill_view_page(const std::string& page, const Viewed_model& model)
{
  Box<3> space_box;
  Box<2> plane_box;
  if(model.original) {
    space_box.add(model.original->points);
    plane_box.add(model.original->uv);
  }
  if(model.light) {
    space_box.add(model.light->mesh.points);
    plane_box.add(model.light->mesh.uv);
  }
  const Grid<3> space = space_grid(space_box);
  const Plane plane = plane_of(plane_box);
  Packed_arrays arrays;
  Json facts = {{"name", model.name}, {"box", plane.pages}, {"view", view_of(model, space)},
                {"is_object_space", model.is_object_space}, {"report", model.report},
                {"notes", model.notes}};
  if(model.original) {
    facts["model"] = add_original(*model.original, space, plane.grid, arrays);
  }
  if(model.light) {
    facts["light"] = add_light(*model.light, space, plane.grid, arrays);
  }
  std::string pictures;
  for(std::size_t i = 0; i < model.pictures.size(); ++i) {
    const Viewed_picture& picture = model.pictures[i];
    const std::string id = "hlscm-picture-" + std::to_string(i);
    const auto corner = CGAL::Surface_mesh_texturing::udim_corner(picture.page);
    facts["sheets"][picture.sheet].push_back({{"id", id}, {"u", corner.x()}, {"v", corner.y()}});
    pictures += element(id, "text/plain", base64(picture.png));
  }
  const std::size_t mark = page.find(view_page_mark);
  return page.substr(0, mark) + element("hlscm-facts", "application/json", harmless(facts))
       + element("hlscm-data", "text/plain", arrays.text()) + pictures
       + page.substr(mark + std::string(view_page_mark).size());
}

} // namespace hlscm
