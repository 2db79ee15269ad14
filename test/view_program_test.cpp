// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs `hlscm view` on generated files, with an empty page: what it puts there is read back here, and
// in browsers by the tests of examples/web.

#include <support/textured_soups.h>

#include <zlib.h>

#include <cstdint>

namespace program_test {

const std::string view_page = "<html><!-- hlscm: the model --></html>";

// The text of an element of a page.
std::string text_of_element(const std::string& page, const std::string& id)
{
  const std::size_t tag = page.find("<script id=\"" + id + "\"");
  if(tag == std::string::npos) {
    return "";
  }
  const std::size_t begin = page.find('>', tag) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

std::string decode_base64(const std::string& text)
{
  static const std::string digits
      = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for(const char c : text) {
    if(c == '=') {
      break;
    }
    EXPECT_NE(digits.find(c), std::string::npos);
    group = group << 6 | std::uint32_t(digits.find(c));
    bits += 6;
    if(bits >= 8) {
      bits -= 8;
      bytes += char(group >> bits & 255);
    }
  }
  return bytes;
}

// The arrays of a page, one after the other.
class Page_arrays
{
public:
  explicit Page_arrays(const std::string& text)
  {
    const std::string packed = decode_base64(text);
    z_stream stream{};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = uInt(packed.size());
    EXPECT_EQ(inflateInit(&stream), Z_OK);
    std::string block(1 << 16, '\0');
    int state = Z_OK;
    while(state == Z_OK) {
      stream.next_out = reinterpret_cast<Bytef*>(block.data());
      stream.avail_out = uInt(block.size());
      state = inflate(&stream, Z_NO_FLUSH);
      m_bytes.append(block, 0, block.size() - stream.avail_out);
    }
    EXPECT_EQ(state, Z_STREAM_END);
    inflateEnd(&stream);
  }

  std::vector<std::uint32_t> next()
  {
    const std::size_t size = byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24, planes = byte(4);
    m_at += 5;
    std::vector<std::uint32_t> numbers(size, 0);
    for(std::size_t plane = 0; plane < planes; ++plane) {
      for(std::size_t i = 0; i < size; ++i) {
        numbers[i] |= std::uint32_t(byte(i)) << (8 * plane);
      }
      m_at += size;
    }
    return numbers;
  }

  std::vector<std::int64_t> next_signed()
  {
    std::vector<std::int64_t> numbers;
    for(const std::uint32_t n : next()) {
      numbers.push_back(n % 2 == 0 ? std::int64_t(n / 2) : -std::int64_t(n / 2) - 1);
    }
    return numbers;
  }

  bool is_at_end() const { return m_at == m_bytes.size(); }

private:
  std::size_t byte(std::size_t i) const { return std::uint8_t(m_bytes.at(m_at + i)); }

  std::string m_bytes;
  std::size_t m_at = 0;
};

using Columns = std::vector<std::vector<double>>;

// Coordinates, each the difference from that of its predecessor.
Columns decoded_columns(Page_arrays& arrays, const std::vector<std::size_t>& predecessor, const Json& grid)
{
  Columns columns;
  for(const double origin : grid["origin"]) {
    std::vector<std::int64_t> steps = arrays.next_signed();
    EXPECT_EQ(steps.size(), predecessor.size());
    std::vector<double> column;
    for(std::size_t i = 0; i < steps.size(); ++i) {
      steps[i] += i > 0 ? steps[predecessor[i]] : 0;
      column.push_back(origin + double(steps[i]) * grid["step"].get<double>());
    }
    columns.push_back(column);
  }
  return columns;
}

// The mesh in a page, which is between -1 and 1.
Textured_soup soup_of_page(const std::string& page)
{
  const Json facts = Json::parse(text_of_element(page, "hlscm-facts"));
  const Json& model = facts["model"];
  Page_arrays arrays(text_of_element(page, "hlscm-data"));
  const auto is_first = arrays.next(), parents = arrays.next();
  const std::size_t wedges = is_first.size(), base = model["base"];
  EXPECT_EQ(parents.size(), wedges - base);
  std::vector<std::size_t> vertex, of_wedge, of_vertex;
  for(std::size_t w = 0; w < wedges; ++w) {
    of_wedge.push_back(w >= base ? parents[w - base] : w == 0 ? 0 : w - 1);
    vertex.push_back(is_first[w] != 0 ? of_vertex.size() : vertex.back());
    if(is_first[w] != 0) {
      const std::size_t v = vertex[w], target = vertex[of_wedge[w]];
      of_vertex.push_back(target < v || v == 0 ? target : v - 1);
    }
  }
  EXPECT_EQ(of_vertex.size(), model["vertices"].get<std::size_t>());
  const Columns points = decoded_columns(arrays, of_vertex, model["grid"]);
  const Columns uv = decoded_columns(arrays, of_wedge, model["uv_grid"]);
  const std::array<std::vector<std::uint32_t>, 3> corners
      = {arrays.next(), arrays.next(), arrays.next()};
  EXPECT_TRUE(arrays.is_at_end());
  Textured_soup soup;
  for(std::size_t v = 0; v < of_vertex.size(); ++v) {
    soup.surface.points.push_back({points[0][v], points[1][v], points[2][v]});
  }
  for(std::size_t w = 0; w < wedges; ++w) {
    soup.uv.push_back({uv[0][w], uv[1][w]});
  }
  for(std::size_t f = 0; f < corners[0].size(); ++f) {
    soup.uv_faces.push_back({corners[0][f], corners[1][f], corners[2][f]});
    soup.surface.faces.push_back({vertex[corners[0][f]], vertex[corners[1][f]], vertex[corners[2][f]]});
  }
  return soup;
}

// The corners of all faces, as (x, y, z, u, v), each face beginning with its least one; sorted.
std::vector<std::array<double, 15>> sorted_faces(const Textured_soup& soup)
{
  std::vector<std::array<double, 15>> all;
  for(std::size_t f = 0; f < soup.surface.faces.size(); ++f) {
    std::array<std::array<double, 5>, 3> corners;
    for(std::size_t c = 0; c < 3; ++c) {
      const auto& p = soup.surface.points[soup.surface.faces[f][c]];
      const auto& q = soup.uv[soup.uv_faces[f][c]];
      corners[c] = {p[0], p[1], p[2], q[0], q[1]};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    auto& face = all.emplace_back();
    for(std::size_t k = 0; k < 15; ++k) {
      face[k] = corners[k / 5][k % 5];
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

// A point of the model as it is in the page, by the grid that its bounding box makes; and the same of
// texture coordinates, which stay what they are.
Textured_soup on_grid(Textured_soup soup)
{
  constexpr double steps = (1 << 20) - 1;
  const auto snap = [](auto& points, bool is_centred) {
    auto low = points[0], high = points[0];
    for(const auto& p : points) {
      for(std::size_t k = 0; k < p.size(); ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    double side = 0;
    for(std::size_t k = 0; k < low.size(); ++k) {
      side = std::max(side, high[k] - low[k]);
    }
    for(auto& p : points) {
      for(std::size_t k = 0; k < p.size(); ++k) {
        const double number = std::round((p[k] - low[k]) / (side / steps));
        p[k] = is_centred ? (low[k] - high[k]) / side + number * (2 / steps)
                          : low[k] + number * (side / steps);
      }
    }
  };
  snap(soup.surface.points, true);
  snap(soup.uv, false);
  return soup;
}

class View_page : public Program
{
protected:
  View_page() { write("viewer.html", view_page); }

  Outcome view(const std::string& input, const Texts& options = {}) const
  {
    Texts arguments{"view", input, "-o", path("page.html")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments);
  }

  std::string page_of(const std::string& input, const Texts& options = {}) const
  {
    Texts all{"--template", path("viewer.html")};
    all.insert(all.end(), options.begin(), options.end());
    const Outcome outcome = view(input, all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read_file(folder / "page.html");
  }
};

TEST_F(View_page, holds_the_mesh_and_its_texture)
{
  for(const Textured_soup& torus : {cut_torus(20, 4), cut_torus(9, 1)}) {
    const std::string page = page_of(write("in.obj", obj(torus)));
    EXPECT_EQ(page.rfind("<html>", 0), 0u);
    EXPECT_EQ(page.substr(page.size() - 7), "</html>");
    const auto expected = sorted_faces(on_grid(torus)), found = sorted_faces(soup_of_page(page));
    ASSERT_EQ(found.size(), expected.size());
    for(std::size_t f = 0; f < found.size(); ++f) {
      for(std::size_t k = 0; k < 15; ++k) {
        ASSERT_NEAR(found[f][k], expected[f][k], 1e-12);
      }
    }
    const Json facts = Json::parse(text_of_element(page, "hlscm-facts"));
    EXPECT_EQ(facts["name"], "in.obj");
    EXPECT_EQ(facts["box"], Json({0., 0., 1., 1.}));
    EXPECT_EQ(facts["report"], nullptr);
  }
}

TEST_F(View_page, is_the_same_for_any_number_of_threads)
{
  const std::string in = write("in.off", off(grid(60, hilly)));
  const std::string page = page_of(in, {"--threads", "1"});
  EXPECT_EQ(page, page_of(in, {"--threads", "2"}));
  EXPECT_EQ(soup_of_page(page).surface.faces.size(), 2u * 59 * 59);
}

TEST_F(View_page, shows_light_models_with_their_normal_maps)
{
  const std::string in = write("in.off", off(torus(24, false)));
  ASSERT_EQ(run({"bake", in, "-o", path("baked"), "--faces", "200", "--texture", "128"}).exit_code, 0);
  const std::string page = page_of(path("baked"));
  const Json facts = Json::parse(text_of_element(page, "hlscm-facts"));
  const Json report = Json::parse(read_file(folder / "baked/report.json"));
  EXPECT_EQ(facts["name"], "baked");
  EXPECT_EQ(facts["model"]["faces"], report["faces"]);
  EXPECT_EQ(facts["light"]["faces"], report["light"]["faces"]);
  EXPECT_EQ(facts["report"]["light"], report["light"]);
  EXPECT_EQ(facts["is_object_space"], false);
  ASSERT_EQ(facts["sheets"]["normals"].size(), 1u);
  const std::string id = facts["sheets"]["normals"][0]["id"];
  EXPECT_EQ(decode_base64(text_of_element(page, id)), read_file(folder / "baked/normal.png"));
}

TEST_F(View_page, lays_the_pages_of_an_atlas_side_by_side)
{
  const std::string in = write("in.off", off(torus(24, false)));
  ASSERT_EQ(run({"atlas", in, "-o", path("atlas"), "--texture", "64", "--padding", "4", "--pages", "4",
                 "--max-quasi-conformal", "1.2"})
                .exit_code,
            0);
  const Json report = Json::parse(read_file(folder / "atlas/report.json"));
  const Json facts = Json::parse(text_of_element(page_of(path("atlas")), "hlscm-facts"));
  EXPECT_GT(report["pages"], 1);
  EXPECT_EQ(facts["box"], Json({0., 0., report["pages"].get<double>(), 1.}));
}

TEST_F(View_page, says_what_is_missing)
{
  const std::string in = write("in.off", off(grid(6, hilly)));
  const std::string none = path("none.html"), empty = write("empty.html", "<html></html>");
  const std::set<std::string> before = names();
  Outcome outcome = view(in, {"--template", none});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, none, {"HLSCM_BUILD_WEB"}), "");
  outcome = view(in, {"--template", empty});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, empty, {"not the page"}), "");
  fs::create_directory(folder / "nothing");
  outcome = view(path("nothing"), {"--template", path("viewer.html")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, path("nothing"), {"atlas.obj"}), "");
  fs::remove(folder / "nothing");
  EXPECT_EQ(run({"view", in, "-o", path("page.png")}).exit_code, 2);
  outcome = run({"view", in, "--template", path("viewer.html"), "-o", path("viewer.html")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, path("viewer.html"), {"is the input"}), "");
  EXPECT_EQ(names(), before);
}

TEST_F(View_page, has_no_name_that_ends_its_elements)
{
  const std::string name = "a<!-- <script>.off";
  const std::string page = page_of(write(name, off(grid(6, hilly))));
  EXPECT_EQ(Json::parse(text_of_element(page, "hlscm-facts"))["name"], name);
  EXPECT_EQ(page.find("<!--"), std::string::npos);
}

} // namespace program_test
