// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_TEXTURED_SOUPS_H
#define HLSCM_TEST_SUPPORT_TEXTURED_SOUPS_H

// Files of textured meshes, and GLB files, for the tests of programs.

#include <support/program_runs.h>

#include <cstdint>
#include <map>

namespace program_test {

// A mesh with texture coordinates at its corners.
struct Textured_soup
{
  Soup surface;
  std::vector<std::array<double, 2>> uv;
  std::vector<std::vector<std::size_t>> uv_faces;
};

// A torus of n x 2n quads cut to pieces of the texture, as many as `columns`.
inline Textured_soup cut_torus(std::size_t n, std::size_t columns)
{
  Textured_soup result;
  const std::size_t m = 2 * n, width = m / columns;
  for(std::size_t i = 0; i < m; ++i) {
    for(std::size_t j = 0; j < n; ++j) {
      const double a = 6.283185307179586 * double(i) / double(m);
      const double b = 6.283185307179586 * double(j) / double(n), r = 2 + std::cos(b);
      result.surface.points.push_back({r * std::cos(a), r * std::sin(a), std::sin(b)});
    }
  }
  std::map<std::array<std::size_t, 3>, std::size_t> numbers; // of piece, row and column
  const auto uv = [&](std::size_t piece, std::size_t i, std::size_t j) {
    const auto [found, is_new] = numbers.insert({{piece, i, j}, result.uv.size()});
    if(is_new) {
      result.uv.push_back({0.01 * double(i) + 0.07 * double(piece), 0.01 * double(j)});
    }
    return found->second;
  };
  for(std::size_t i = 0; i < m; ++i) {
    for(std::size_t j = 0; j < n; ++j) {
      const std::size_t i1 = (i + 1) % m, j1 = (j + 1) % n, piece = i / width;
      result.surface.faces.push_back({i * n + j, i1 * n + j, i1 * n + j1});
      result.surface.faces.push_back({i * n + j, i1 * n + j1, i * n + j1});
      result.uv_faces.push_back({uv(piece, i, j), uv(piece, i + 1, j), uv(piece, i + 1, j + 1)});
      result.uv_faces.push_back({uv(piece, i, j), uv(piece, i + 1, j + 1), uv(piece, i, j + 1)});
    }
  }
  return result;
}

// Twice the signed area of a face in the texture.
inline double uv_area(const Textured_soup& soup, std::size_t f)
{
  const auto& t = soup.uv_faces[f];
  const auto &a = soup.uv[t[0]], &b = soup.uv[t[1]], &c = soup.uv[t[2]];
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

inline std::string obj(const Textured_soup& soup)
{
  std::ostringstream out;
  out.precision(17);
  for(const auto& p : soup.surface.points) {
    out << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
  }
  for(const auto& p : soup.uv) {
    out << "vt " << p[0] << " " << p[1] << "\n";
  }
  for(std::size_t f = 0; f < soup.surface.faces.size(); ++f) {
    out << "f";
    for(std::size_t c = 0; c < 3; ++c) {
      out << " " << soup.surface.faces[f][c] + 1 << "/" << soup.uv_faces[f][c] + 1;
    }
    out << "\n";
  }
  return out.str();
}

inline Textured_soup read_textured_obj(const fs::path& path)
{
  Textured_soup result;
  std::ifstream file(path);
  for(std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if(keyword == "v") {
      auto& p = result.surface.points.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    } else if(keyword == "vt") {
      auto& p = result.uv.emplace_back();
      words >> p[0] >> p[1];
    } else if(keyword == "f") {
      auto& face = result.surface.faces.emplace_back();
      auto& uv_face = result.uv_faces.emplace_back();
      std::size_t v, t;
      char slash;
      while(words >> v >> slash >> t) {
        face.push_back(v - 1);
        uv_face.push_back(t - 1);
      }
    }
  }
  return result;
}

// The JSON of a GLB file, whose chunks are checked.
inline Json json_of_glb(const std::string& bytes)
{
  const auto number = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + at, 4);
    return std::size_t(value);
  };
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(number(4), 2u);
  EXPECT_EQ(number(8), bytes.size());
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(number(20 + number(12)), bytes.size() - 28 - number(12)); // the binary chunk
  return Json::parse(bytes.substr(20, number(12)));
}

} // namespace program_test

#endif // HLSCM_TEST_SUPPORT_TEXTURED_SOUPS_H
