// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Gltf_accessor.h"
#include "formats/Gltf_file.h"
#include "formats/Gltf_scene.h"

#include <CGAL/Indexed_mesh/weld_points.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace hlscm {
namespace gltf {
namespace {

enum Mode { POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN };

/// The triangles that indices stand for.
class Triangles
{
public:
  Triangles(std::vector<std::uint32_t> indices, std::size_t mode)
  {
    if(mode == TRIANGLES) {
      m_corners = std::move(indices);
      return;
    }
    for(std::size_t i = 2; i < indices.size(); ++i) {
      if(mode == TRIANGLE_FAN) {
        add(indices[0], indices[i - 1], indices[i]);
      } else {
        add(indices[i - 2 + i % 2], indices[i - 1 - i % 2], indices[i]);
      }
    }
  }

  std::vector<std::uint32_t> corners() && { return std::move(m_corners); }

private:
  // Triangles that only lead from one part of a strip to the next have a vertex twice.
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c)
  {
    if(a != b && b != c && c != a) {
      m_corners.insert(m_corners.end(), {a, b, c});
    }
  }

  std::vector<std::uint32_t> m_corners;
};

// One line of text, whatever is in a name.
std::string printable(std::string name, const std::string& otherwise)
{
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  const std::size_t first = name.find_first_not_of(' ');
  return first == std::string::npos ? otherwise
                                    : name.substr(first, name.find_last_not_of(' ') - first + 1);
}

/// Reads all meshes of the scene into one soup.
class Gltf_reader
{
public:
  explicit Gltf_reader(const Mesh_source& source) : m_source(source), m_file(source) {}

  Read_mesh read()
  {
    check_extensions();
    const Scene scene = read_scene(m_file);
    check_size(scene);
    for(std::size_t m = 0; m < scene.meshes.size(); ++m) {
      m_source.progress.advance(double(m) / double(scene.meshes.size()));
      add_mesh(scene.meshes[m], scene.meshes.size() > 1);
    }
    add_warnings(scene);
    check_corner_data(m_mesh);
    return std::move(m_mesh);
  }

private:
  [[noreturn]] void fail_compressed(const std::string& by, const std::string& extension) const
  {
    m_source.fail("it is compressed by " + by + " (" + extension
                  + "), which cannot be read, export the mesh without");
  }

  void check_extensions()
  {
    const Json* required = File::member(m_file.json(), "extensionsRequired");
    for(std::size_t i = 0; required != nullptr && required->is_array() && i < required->size(); ++i)
    {
      const std::string name =
          (*required)[i].is_string() ? (*required)[i].get<std::string>() : std::string();
      if(name.find("draco") != std::string::npos) {
        fail_compressed("Draco", name);
      }
      if(name.find("meshopt") != std::string::npos) {
        fail_compressed("meshopt", name);
      }
      const bool is_known = name == "KHR_mesh_quantization"
                            || name.find("_material") != std::string::npos
                            || name.find("_texture") != std::string::npos
                            || name.find("_lights") != std::string::npos;
      if(!is_known) {
        m_mesh.warnings.push_back("it is made for programs that know " + printable(name, "?")
                                  + ", which is left out");
      }
    }
  }

  const Json& primitives_of(const Element& mesh) const
  {
    const Json* primitives = File::member(mesh.json, "primitives");
    if(primitives == nullptr || !primitives->is_array()) {
      m_file.fail(mesh.name, "has no primitives");
    }
    return *primitives;
  }

  // Few bytes may place a mesh many times: that should not fill the memory.
  void check_size(const Scene& scene) const
  {
    constexpr std::size_t no_count = std::numeric_limits<std::size_t>::max();
    const std::size_t most = std::max(std::size_t(1) << 27, 16 * m_source.size());
    std::vector<std::size_t> indices(m_file.count("meshes"), no_count);
    std::size_t sum = 0;
    for(const Placed_mesh& placed : scene.meshes) {
      const Element mesh = m_file.element("meshes", "mesh", placed.mesh);
      const bool is_copy = indices[placed.mesh] != no_count;
      if(!is_copy) {
        indices[placed.mesh] = number_of_indices(mesh);
      }
      sum += indices[placed.mesh];
      if(is_copy && sum > most) {
        m_source.fail("its nodes place meshes with more than " + std::to_string(most)
                      + " corners in all, too many for this program: export fewer copies");
      }
    }
  }

  std::size_t number_of_indices(const Element& mesh) const
  {
    std::size_t sum = 0;
    for(const Json& primitive : primitives_of(mesh)) {
      const Element element{primitive, mesh.name};
      const Json* attributes = File::member(primitive, "attributes");
      auto accessor = m_file.number(element, "indices");
      if(!accessor && attributes != nullptr) {
        accessor = m_file.number({*attributes, mesh.name}, "POSITION");
      }
      sum += accessor ? count_of_accessor(m_file, *accessor) : 0;
    }
    return sum;
  }

  void add_mesh(const Placed_mesh& placed, bool is_one_of_many)
  {
    const Element mesh = m_file.element("meshes", "mesh", placed.mesh);
    const Json& primitives = primitives_of(mesh);
    const std::string name =
        printable(placed.name, is_one_of_many ? "mesh_" + std::to_string(placed.mesh) : "");
    if(!name.empty()) {
      add_line("o " + name);
    }
    for(std::size_t p = 0; p < primitives.size(); ++p) {
      add_primitive({primitives[p], "primitive " + std::to_string(p) + " of " + mesh.name},
                    placed.transform);
    }
  }

  void add_line(const std::string& text)
  {
    m_mesh.lines.push_back({m_mesh.soup.number_of_faces(), text});
  }

  void add_material(const Element& primitive)
  {
    const auto material = m_file.number(primitive, "material");
    std::string line = "usemtl None";
    if(material) {
      const Element element = m_file.element("materials", "material", *material);
      line = "usemtl "
             + printable(File::text(element.json, "name"), "material_" + std::to_string(*material));
    }
    if(line != m_material && (material || !m_material.empty())) {
      m_material = line;
      add_line(line);
    }
  }

  void add_primitive(const Element& primitive, const Transform& transform)
  {
    const std::size_t mode = m_file.number(primitive, "mode").value_or(TRIANGLES);
    if(mode > TRIANGLE_FAN) {
      m_file.fail(primitive.name, "is of the unknown mode " + std::to_string(mode));
    }
    if(mode < TRIANGLES) {
      ++m_points_and_lines;
      return;
    }
    add_material(primitive);
    const Json* attributes = File::member(primitive.json, "attributes");
    const Element of{attributes != nullptr ? *attributes : primitive.json, primitive.name};
    const std::size_t positions = m_file.needed_number(of, "POSITION");
    refuse_draco(primitive, positions);
    Polygon_soup part;
    part.corners = read_triangles(primitive, count_of_accessor(m_file, positions), mode);
    const std::vector<std::uint32_t> used = drop_unused(part.corners);
    add_points(positions, transform, used, part);
    add_uv(m_file.number(of, "TEXCOORD_0"), primitive, used, part);
    CGAL::Indexed_mesh::weld_points(part, 0);
    if(transform.determinant() < 0) { // a mirror turns the triangles
      turn(part.corners);
      turn(part.uv_corners);
    }
    append(part);
  }

  // The same bytes may be there without compression, too.
  void refuse_draco(const Element& primitive, std::size_t positions) const
  {
    const Json* extensions = File::member(primitive.json, "extensions");
    const Element accessor = m_file.element("accessors", "accessor", positions);
    if(extensions != nullptr && extensions->contains("KHR_draco_mesh_compression")
       && File::member(accessor.json, "bufferView") == nullptr)
    {
      fail_compressed("Draco", "KHR_draco_mesh_compression");
    }
  }

  std::vector<std::uint32_t> read_triangles(const Element& primitive, std::size_t vertices,
                                            std::size_t mode)
  {
    std::vector<std::uint32_t> indices;
    if(const auto accessor = m_file.number(primitive, "indices")) {
      indices = read_indices(m_file, *accessor);
    } else {
      m_source.check_index("vertices", vertices);
      if(vertices > m_file.size()) {
        m_file.fail(primitive.name,
                    "promises " + std::to_string(vertices) + " vertices without bytes");
      }
      indices.resize(vertices);
      for(std::size_t i = 0; i < vertices; ++i) {
        indices[i] = std::uint32_t(i);
      }
    }
    const auto bad = std::find_if(indices.begin(), indices.end(),
                                  [vertices](std::uint32_t v) { return v >= vertices; });
    if(bad != indices.end()) {
      m_file.fail(primitive.name, "names vertex " + std::to_string(*bad) + " in its index "
                                      + std::to_string(bad - indices.begin()) + " but there are "
                                      + std::to_string(vertices) + " vertices");
    }
    if(mode == TRIANGLES && indices.size() % 3 != 0) {
      m_file.fail(primitive.name,
                  "has " + std::to_string(indices.size()) + " corners, no multiple of three");
    }
    return Triangles(std::move(indices), mode).corners();
  }

  // Several primitives may share their vertices: each has those that its triangles use. Returns
  // these, in their order.
  static std::vector<std::uint32_t> drop_unused(std::vector<std::uint32_t>& corners)
  {
    const std::uint32_t last =
        corners.empty() ? 0 : *std::max_element(corners.begin(), corners.end());
    std::vector<std::uint32_t> number(std::size_t(last) + 1, 0), used;
    for(const std::uint32_t v : corners) {
      number[v] = 1;
    }
    for(std::uint32_t v = 0; v < number.size(); ++v) {
      if(number[v] != 0) {
        number[v] = std::uint32_t(used.size());
        used.push_back(v);
      }
    }
    for(std::uint32_t& v : corners) {
      v = number[v];
    }
    return used;
  }

  void add_points(std::size_t accessor, const Transform& transform,
                  const std::vector<std::uint32_t>& used, Polygon_soup& part)
  {
    const std::vector<double> numbers = read_vectors(m_file, accessor, 3);
    const bool is_identity = transform.rows == Transform().rows;
    part.points.reserve(used.size());
    for(const std::uint32_t v : used) {
      const double* p = numbers.data() + 3 * std::size_t(v);
      part.points.push_back(is_identity ? Polygon_soup::Point_3(p[0], p[1], p[2]) : transform(p));
    }
  }

  // Texture coordinates run downwards in these files, upwards in all others.
  void add_uv(std::optional<std::size_t> accessor, const Element& primitive,
              const std::vector<std::uint32_t>& used, Polygon_soup& part)
  {
    if(!accessor) {
      return;
    }
    const std::vector<double> numbers = read_vectors(m_file, *accessor, 2);
    if(!used.empty() && numbers.size() / 2 <= used.back()) {
      m_file.fail(primitive.name, "has " + std::to_string(numbers.size() / 2)
                                      + " texture coordinates, too few for its vertices");
    }
    part.uv.reserve(used.size());
    for(const std::uint32_t v : used) {
      part.uv.emplace_back(numbers[2 * std::size_t(v)], 1 - numbers[2 * std::size_t(v) + 1]);
    }
    part.uv_corners = part.corners;
  }

  static void turn(std::vector<std::uint32_t>& corners)
  {
    for(std::size_t c = 0; c + 2 < corners.size(); c += 3) {
      std::swap(corners[c + 1], corners[c + 2]);
    }
  }

  void append(Polygon_soup& part)
  {
    Polygon_soup& soup = m_mesh.soup;
    const std::size_t corners = soup.corners.size() + part.corners.size();
    m_source.check_index("corners", corners);
    m_source.check_index("vertices", soup.points.size() + part.points.size());
    const std::uint32_t first = std::uint32_t(soup.points.size());
    const std::uint32_t first_uv = std::uint32_t(soup.uv.size());
    if(soup.corners.empty()) { // mostly there is one part
      soup = std::move(part);
      soup.first_corner = {0};
    } else {
      soup.points.insert(soup.points.end(), part.points.begin(), part.points.end());
      soup.uv.insert(soup.uv.end(), part.uv.begin(), part.uv.end());
      for(const std::uint32_t v : part.corners) {
        soup.corners.push_back(v + first);
      }
      for(const std::uint32_t i : part.uv_corners) {
        soup.uv_corners.push_back(i + first_uv);
      }
    }
    soup.first_corner.reserve(corners / 3 + 1);
    while(soup.first_corner.back() < corners) {
      soup.first_corner.push_back(soup.first_corner.back() + 3);
    }
  }

  void add_warnings(const Scene& scene)
  {
    if(m_points_and_lines > 0) {
      m_mesh.warnings.push_back("primitives of points or lines are left out: "
                                + std::to_string(m_points_and_lines));
    }
    if(scene.skinned > 0) {
      m_mesh.warnings.push_back("meshes with a skeleton are taken in the pose that they have "
                                "without it: "
                                + std::to_string(scene.skinned));
    }
  }

  const Mesh_source& m_source;
  File m_file;
  Read_mesh m_mesh;
  std::string m_material; // the line of the last one
  std::size_t m_points_and_lines = 0;
};

} // namespace
} // namespace gltf

Read_mesh read_gltf(const Mesh_source& source) { return gltf::Gltf_reader(source).read(); }

} // namespace hlscm
