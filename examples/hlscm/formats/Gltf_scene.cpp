// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hlscm {
namespace gltf {

using Point_3 = CGAL::Indexed_mesh::Polygon_soup::Point_3;

Point_3 Transform::operator()(const double* p) const
{
  const auto coordinate = [p](const std::array<double, 4>& row) {
    return row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
  };
  return {coordinate(rows[0]), coordinate(rows[1]), coordinate(rows[2])};
}

Transform Transform::operator*(const Transform& first) const
{
  Transform result;
  for(std::size_t i = 0; i < 3; ++i) {
    for(std::size_t j = 0; j < 4; ++j) {
      result.rows[i][j] = j == 3 ? rows[i][3] : 0;
      for(std::size_t k = 0; k < 3; ++k) {
        result.rows[i][j] += rows[i][k] * first.rows[k][j];
      }
    }
  }
  return result;
}

double Transform::determinant() const
{
  const auto& r = rows;
  return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1])
         - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0])
         + r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
}

namespace {

// A member that is an array of numbers, so many of them; nothing if there is none.
std::optional<std::vector<double>> numbers(const File& file, const Element& element,
                                           const char* key, std::size_t count)
{
  const Json* value = File::member(element.json, key);
  if(value == nullptr) {
    return std::nullopt;
  }
  const bool is_good = value->is_array() && value->size() == count
                       && std::all_of(value->begin(), value->end(),
                                      [](const Json& number) { return number.is_number(); });
  if(!is_good) {
    file.fail(element.name, std::string(key) + " should be " + std::to_string(count) + " numbers");
  }
  return value->get<std::vector<double>>();
}

// Translation after rotation, by a quaternion, after scaling.
Transform of_parts(const std::vector<double>& t, std::vector<double> q,
                   const std::vector<double>& s)
{
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if(norm > 0 && norm != 1) {
    std::for_each(q.begin(), q.end(), [norm](double& number) { number /= norm; });
  }
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  Transform result;
  result.rows = {{{(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - z * w) * s[1],
                   2 * (x * z + y * w) * s[2], t[0]},
                  {2 * (x * y + z * w) * s[0], (1 - 2 * (x * x + z * z)) * s[1],
                   2 * (y * z - x * w) * s[2], t[1]},
                  {2 * (x * z - y * w) * s[0], 2 * (y * z + x * w) * s[1],
                   (1 - 2 * (x * x + y * y)) * s[2], t[2]}}};
  return result;
}

Transform transform_of(const File& file, const Element& node)
{
  if(const auto m = numbers(file, node, "matrix", 16)) { // one column after the other
    Transform result;
    for(std::size_t i = 0; i < 3; ++i) {
      for(std::size_t j = 0; j < 4; ++j) {
        result.rows[i][j] = (*m)[4 * j + i];
      }
    }
    return result;
  }
  return of_parts(numbers(file, node, "translation", 3).value_or(std::vector<double>{0, 0, 0}),
                  numbers(file, node, "rotation", 4).value_or(std::vector<double>{0, 0, 0, 1}),
                  numbers(file, node, "scale", 3).value_or(std::vector<double>{1, 1, 1}));
}

std::vector<std::size_t> indices(const File& file, const Element& element, const char* key)
{
  std::vector<std::size_t> result;
  if(const Json* value = File::member(element.json, key)) {
    for(const Json& index : *value) {
      if(!index.is_number_unsigned()) {
        file.fail(element.name, std::string("has something else than indices among its ") + key);
      }
      result.push_back(index.get<std::size_t>());
    }
  }
  return result;
}

// The nodes that a scene begins with: all that are no children if there is no scene.
std::vector<std::size_t> roots(const File& file)
{
  const Element whole{file.json(), "the file"};
  if(file.count("scenes") > 0) {
    const std::size_t scene = file.number(whole, "scene").value_or(0);
    return indices(file, file.element("scenes", "scene", scene), "nodes");
  }
  std::vector<bool> is_child(file.count("nodes"), false);
  for(std::size_t n = 0; n < is_child.size(); ++n) {
    for(const std::size_t child : indices(file, file.element("nodes", "node", n), "children")) {
      if(child < is_child.size()) {
        is_child[child] = true;
      }
    }
  }
  std::vector<std::size_t> result;
  for(std::size_t n = 0; n < is_child.size(); ++n) {
    if(!is_child[n]) {
      result.push_back(n);
    }
  }
  return result;
}

/// Goes through the nodes, without recursion: they may be a long chain.
class Node_walk
{
public:
  explicit Node_walk(const File& file) : m_file(file), m_is_met(file.count("nodes"), false) {}

  Scene run()
  {
    push(roots(m_file), Transform());
    while(!m_stack.empty()) {
      const Pending next = m_stack.back();
      m_stack.pop_back();
      visit(next);
    }
    return m_scene;
  }

private:
  struct Pending
  {
    std::size_t node;
    Transform of_parent;
  };

  void push(const std::vector<std::size_t>& nodes, const Transform& of_parent)
  {
    for(auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      m_stack.push_back({*node, of_parent});
    }
  }

  void visit(const Pending& pending)
  {
    const Element node = m_file.element("nodes", "node", pending.node);
    if(m_is_met[pending.node]) {
      m_file.fail(node.name, "is the child of two nodes");
    }
    m_is_met[pending.node] = true;
    const Transform transform = pending.of_parent * transform_of(m_file, node);
    if(const auto mesh = m_file.number(node, "mesh")) {
      const bool has_skin = File::member(node.json, "skin") != nullptr;
      m_scene.skinned += has_skin;
      m_scene.meshes.push_back(
          {*mesh, File::text(node.json, "name"), has_skin ? Transform() : transform});
    }
    push(indices(m_file, node, "children"), transform);
  }

  const File& m_file;
  std::vector<bool> m_is_met;
  std::vector<Pending> m_stack;
  Scene m_scene;
};

} // namespace

Scene read_scene(const File& file)
{
  Scene scene;
  if(file.count("nodes") > 0) {
    scene = Node_walk(file).run();
  } else {
    for(std::size_t m = 0; m < file.count("meshes"); ++m) {
      scene.meshes.push_back({m, std::string(), Transform()});
    }
  }
  for(Placed_mesh& mesh : scene.meshes) {
    if(mesh.name.empty()) {
      mesh.name = File::text(file.element("meshes", "mesh", mesh.mesh).json, "name");
    }
  }
  return scene;
}

} // namespace gltf
} // namespace hlscm
