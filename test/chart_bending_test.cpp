// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Charts that bend on their pages to fill them.

#include <support/chart_generators.h>
#include <support/packed_charts.h>
#include <support/texture_atlas_properties.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/bend_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace chart_bending_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
using SMT::internal::Control_net;
using SMT::internal::Control_weights;
using SMT::internal::Elastic_charts;
using SMT::internal::Strain_element;
typedef SMT::internal::Plane_vector_d Vector;
typedef SMT::Chart_shape::Point_2 Point_2;

constexpr std::uint64_t seed = 271126;
const std::string seed_text = ", seed " + std::to_string(seed);

SMT::Texture_atlas_options with_bending(double bending)
{
  SMT::Texture_atlas_options options = small_texture();
  options.bending = bending;
  return options;
}

// Shapes of one and of several charts, round, long, bent, and with thin triangles.
std::vector<Named_mesh> shapes()
{
  const Indexed_triangle_mesh strip = with_noise(grid(60, 5), 0.1, seed);
  std::vector<Named_mesh> result = {{"torus", torus(30, 12)}, {"disk", round_disk(12)}};
  if(is_sanitized)
    return result;
  result.push_back({"strip", strip});
  result.push_back({"hills", with_hills(grid(60, 60), 3., seed)});
  result.push_back({"star", moved(round_disk(24), [](const Point_3& p) {
    const double scale = 1. + 0.7 * std::cos(5. * std::atan2(p.y(), p.x()));
    return Point_3(scale * p.x(), scale * p.y(), 0.);
  })});
  result.push_back({"slivers", with_slivers(with_noise(grid(20, 400), 0.3, seed), 40.)});
  return result;
}

// The charts of an atlas where they lie, in texels.
SMT::Packing_result packing_of(const SMT::Texture_atlas_result& built,
                               std::vector<SMT::Chart_shape>& shapes)
{
  const SMT::Texture_atlas& atlas = built.atlas;
  SMT::Packing_result result;
  result.pages = atlas.number_of_pages;
  shapes.assign(atlas.charts.number_of_charts, {});
  for(SMT::Chart_shape& shape : shapes)
    for(const Point_2& p : atlas.mesh.uv)
      shape.uv.emplace_back(double(atlas.width) * p.x(), double(atlas.height) * p.y());
  for(std::size_t t = 0; t < atlas.mesh.wedges.size(); ++t)
    shapes[atlas.charts.chart[t]].triangles.push_back(atlas.mesh.wedges[t]);
  for(const std::uint32_t page : atlas.page) {
    result.placements.emplace_back();
    result.placements.back().page = page;
  }
  return result;
}

// The root of the mean of the squared changes of length from one atlas to another one with the same
// charts, along two principal directions of each triangle, where charts as a whole grow alike.
double change_of_lengths(const SMT::Texture_atlas& rigid, const SMT::Texture_atlas& bent)
{
  std::vector<std::array<double, 3>> stretched; // both singular values, and the area
  double area = 0., bent_area = 0.;
  for(std::size_t t = 0; t < rigid.mesh.wedges.size(); ++t) {
    const auto side = [t](const SMT::Texture_atlas& atlas, int k) {
      const auto& w = atlas.mesh.wedges[t];
      return atlas.mesh.uv[w[k]] - atlas.mesh.uv[w[0]];
    };
    const auto a = side(rigid, 1), b = side(rigid, 2), p = side(bent, 1), q = side(bent, 2);
    const double det = a.x() * b.y() - a.y() * b.x();
    // J (a, b) = (p, q)
    const double xx = (p.x() * b.y() - q.x() * a.y()) / det, xy = (q.x() * a.x() - p.x() * b.x()) / det;
    const double yx = (p.y() * b.y() - q.y() * a.y()) / det, yy = (q.y() * a.x() - p.y() * b.x()) / det;
    const double sum = std::hypot(xx + yy, yx - xy), difference = std::hypot(xx - yy, yx + xy);
    stretched.push_back({0.5 * (sum + difference), 0.5 * std::abs(sum - difference), 0.5 * det});
    area += 0.5 * det;
    bent_area += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  const double scale = std::sqrt(bent_area / area);
  double squares = 0.;
  for(const auto& s : stretched)
    for(int k = 0; k < 2; ++k)
      squares += 0.5 * s[2] * std::pow(s[k] / scale - 1., 2);
  return std::sqrt(squares / area);
}

// The map of a chart of an atlas with these coordinates for its wedges.
std::vector<Point_2> map_of(const SMT::Chart_mesh& chart, const SMT::Texture_atlas& atlas,
                            const std::vector<Point_2>& uv)
{
  std::vector<Point_2> result(chart.vertices.size());
  for(std::size_t t = 0; t < chart.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      result[chart.mesh.triangles[t][c]] = uv[atlas.mesh.wedges[chart.triangles[t]][c]];
  return result;
}

// A square with so many edges along a side, not where the origin is.
struct Noisy_square
{
  explicit Noisy_square(int n) : mesh(with_noise(grid(n, n), 0.2, seed))
  {
    for(const Point_3& p : mesh.points)
      uv.emplace_back(10. + p.x(), 20. + p.y());
  }

  Indexed_triangle_mesh mesh;
  std::vector<Point_2> uv;
};

// Edges along a side of a chart, the size of the squares of its net, and whether it shall be affine: few
// vertices, a large chart with many, a small one, and one that shall be affine.
const std::tuple<int, double, bool> nets[]
  = {{4, 40., false}, {40, 20., false}, {40, 100., false}, {40, 20., true}};

TEST(Control_net, reproduces_affine_maps_and_covers_the_chart)
{
  const auto affine = [](const Vector& p) {
    return Vector{1.2 * p.x - 0.3 * p.y + 7., 0.1 * p.x + 0.9 * p.y - 2.};
  };
  for(const auto& [n, size, is_affine] : nets) {
    const auto [mesh, uv] = Noisy_square(n);
    std::vector<Vector> points(3); // of others
    const Control_net net(uv, mesh.triangles, size, is_affine, points);
    const std::string where = std::to_string(n) + ", " + std::to_string(points.size()) + seed_text;
    std::vector<Vector> moved;
    for(const Vector& p : points)
      moved.push_back(affine(p));
    for(std::uint32_t v = 0; v < uv.size(); ++v) {
      const Vector rest = {uv[v].x(), uv[v].y()}, p = net.place(v, points), q = net.place(v, moved);
      EXPECT_NEAR(std::hypot(p.x - rest.x, p.y - rest.y), 0., 1e-11) << where;
      EXPECT_NEAR(std::hypot(q.x - affine(rest).x, q.y - affine(rest).y), 0., 1e-11) << where;
      Control_weights weights;
      net.weigh(v, weights);
      double sum = 0.;
      for(std::size_t k = 0; k < weights.size(); ++k) {
        sum += weights[k].weight;
        EXPECT_TRUE(k == 0 || weights[k - 1].point < weights[k].point) << where;
      }
      EXPECT_NEAR(sum, 1., 1e-12) << where;
    }
    double area = 0., expected = 0.;
    for(const auto& t : mesh.triangles)
      expected += CGAL::area(uv[t[0]], uv[t[1]], uv[t[2]]);
    for(const Strain_element& e : net.elements()) {
      area += e.area;
      Vector alpha, beta; // of the affine map: (1.2 + 0.9 + i (0.1 + 0.3)) / 2, (1.2 - 0.9 + i (0.1 - 0.3)) / 2
      for(std::size_t k = 0; k < e.half_gradients.size(); ++k) {
        const auto& [i, g] = e.half_gradients[k];
        alpha = alpha + moved[i].times(g.conjugate());
        beta = beta + moved[i].times(g);
        EXPECT_TRUE(k == 0 || e.half_gradients[k - 1].first < i) << where;
      }
      EXPECT_NEAR(std::hypot(alpha.x - 1.05, alpha.y - 0.2), 0., 1e-11) << where;
      EXPECT_NEAR(std::hypot(beta.x - 0.15, beta.y + 0.1), 0., 1e-11) << where;
    }
    EXPECT_NEAR(area, expected, 1e-9 * expected) << where;
    for(const Control_weights& difference : net.differences()) {
      Vector sum;
      for(const auto& w : difference)
        sum = sum + moved[w.point] * w.weight;
      EXPECT_NEAR(std::hypot(sum.x, sum.y), 0., 1e-11) << where;
    }
  }
}

TEST(Control_net, moves_turns_and_scales_rigid_charts_only)
{
  for(const auto& [n, size, is_affine] : nets) {
    const auto [mesh, uv] = Noisy_square(n);
    std::vector<Vector> points;
    Control_net net(uv, mesh.triangles, size, is_affine, points);
    EXPECT_EQ(net.make_rigid(), points.size() == 3) << n << seed_text; // if it is linear
    if(points.size() != 3)
      continue;
    const std::vector<Vector> rest = points;
    for(Vector& p : points)
      p = {1.2 * p.x - 0.3 * p.y + 7., 0.1 * p.x + 0.9 * p.y - 2.};
    const Vector alpha = {1.05, 0.2}; // see above
    for(std::uint32_t v = 0; v < uv.size(); ++v) {
      const Vector r = net.place(v, rest), p = net.place(v, points) - net.place(0, points);
      const Vector way = Vector{uv[v].x() - uv[0].x(), uv[v].y() - uv[0].y()}.times(alpha);
      EXPECT_NEAR(std::hypot(r.x - uv[v].x(), r.y - uv[v].y()), 0., 1e-11) << n << seed_text;
      EXPECT_NEAR(std::hypot(p.x - way.x, p.y - way.y), 0., 1e-11) << n << seed_text;
    }
  }
}

// A square in the middle of a page, with so many edges along a side.
struct Lone_square
{
  Lone_square(double low, double high, int n) : mesh(grid(n, n))
  {
    for(const Point_3& p : mesh.points)
      uv.emplace_back(low + (high - low) * p.x() / n, low + (high - low) * p.y() / n);
    std::vector<std::uint32_t> loop; // counterclockwise
    const auto at = [&](double x, double y) {
      for(std::uint32_t v = 0; v < uv.size(); ++v)
        if(mesh.points[v].x() == x && mesh.points[v].y() == y)
          return v;
      return 0u;
    };
    for(int i = 0; i < 4 * n; ++i) {
      const double k = i % n;
      loop.push_back(i < n ? at(k, 0) : i < 2 * n ? at(n, k) : i < 3 * n ? at(n - k, n) : at(0, n - k));
    }
    const SMT::internal::Contact_sizes sizes = {{100., 100.}, {1., 1.}, {99., 99.}, 3., 1.};
    std::vector<Vector> points;
    net.emplace(uv, mesh.triangles, 50., false, points);
    SMT::internal::Border_contacts contacts(sizes);
    contacts.add_loop(0, 0, loop, uv, *net);
    charts.emplace(points, contacts, sizes);
    charts->add_chart(net->elements(), net->differences());
    charts->set_stiffness_of_contacts(40.);
  }

  Indexed_triangle_mesh mesh;
  std::vector<Point_2> uv;
  std::optional<Control_net> net;
  std::optional<Elastic_charts> charts;
};

// How much the gap of a bay of 6 texels is too small, of which 3 are wanted, where one of its sides leans
// towards the other one by so much at its open end; each vertex is a control point.
double worst_gap_of_bay(double lean)
{
  std::vector<Point_2> uv;
  for(const double y : {10., 30., 80.})
    for(const double x : {10., 30., 36., 56.})
      uv.emplace_back(x, y);
  const std::vector<Triangle_indices> triangles = {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7},
                                                   {2, 7, 6}, {4, 5, 9}, {4, 9, 8}, {6, 7, 11}, {6, 11, 10}};
  std::vector<Vector> points;
  const Control_net net(uv, triangles, 5., false, points);
  SMT::internal::Border_contacts contacts({{100., 100.}, {1., 1.}, {99., 99.}, 3., 1.});
  contacts.add_loop(0, 0, {0, 1, 2, 3, 7, 11, 10, 6, 5, 9, 8, 4}, uv, net);
  contacts.set_gaps(points);
  EXPECT_EQ(points.size(), uv.size());
  for(Vector& p : points)
    if(p.x > 33. && p.y > 50.)
      p.x -= lean;
  contacts.find(points);
  return contacts.worst();
}

// Sides that have gone through each other are as far apart as before, but beyond 0.
TEST(Border_contacts, know_the_sides_of_a_bay_beyond_each_other)
{
  EXPECT_EQ(worst_gap_of_bay(0.), 0.);
  const double near_zero = worst_gap_of_bay(5.9); // 0.1 is left at the corner
  EXPECT_GT(near_zero, 2.9);
  EXPECT_NEAR(worst_gap_of_bay(6.1), near_zero + 0.2, 1e-9);
  EXPECT_NEAR(worst_gap_of_bay(8.), near_zero + 2.1, 1e-9);
}

// What nothing is in the way of grows as it should, without strain; what the page is too small for is
// as large as the page, and then not bent either.
TEST(Elastic_charts, grow_until_they_meet_the_sides)
{
  for(const int n : {3, 30}) {
    Lone_square free(30., 70., n);
    free.charts->grow(1.5);
    for(int i = 0; i < 10; ++i)
      free.charts->step();
    EXPECT_NEAR(free.charts->scale(), 1.5, 1e-9) << n;
    EXPECT_NEAR(free.charts->strain(), 0., 1e-9) << n;
    const Elastic_charts::State grown = free.charts->state();
    free.charts->grow(1.1);
    free.charts->step();
    free.charts->restore(grown);
    EXPECT_NEAR(free.charts->scale(), 1.5, 1e-9) << n;
    Lone_square held(10., 90., n);
    held.charts->grow(1.3);
    for(int i = 0; i < 20; ++i)
      held.charts->step();
    EXPECT_NEAR(held.charts->scale(), 98. / 80., 0.01) << n;
    EXPECT_NEAR(held.charts->strain(), 0., 1e-3) << n;
    EXPECT_LT(held.charts->worst_gap(), 1.) << n;
  }
}

// Two squares of ten texels, the second one with its lower left corner at (x + 0.5, y + 0.5).
TEST(Page_check, finds_charts_that_are_too_near)
{
  SMT::Packing_options options;
  options.width = options.height = 64;
  const auto faults = [&](double x, double y) {
    SMT::internal::Page_check check(options, 1);
    for(const auto& [left, bottom] : {std::pair<double, double>{10., 10.}, {x, y}}) {
      SMT::internal::Chart_outline square;
      square.centre = {left + 5.5, bottom + 5.5};
      square.diameter = 10.;
      const std::array<SMT::internal::Vector_2d, 4> corner = {{{-5., -5.}, {5., -5.}, {5., 5.}, {-5., 5.}}};
      square.parts.emplace_back();
      for(int k = 0; k < 4; ++k)
        square.parts[0].push_back({corner[k], corner[(k + 1) % 4], 1});
      check.add(square, 0);
    }
    return check.faults().size();
  };
  // Columns 10 to 20 are touched; 21 and 22 shall be free
  EXPECT_EQ(faults(23., 10.), 0u);
  EXPECT_GT(faults(22., 10.), 0u);
  EXPECT_GT(faults(22., 22.), 0u); // along the diagonal
  EXPECT_EQ(faults(23., 23.), 0u);
  EXPECT_GT(faults(12., 12.), 0u);
  // The outermost row and column of a page are free
  EXPECT_EQ(faults(52., 52.), 0u);
  EXPECT_GT(faults(53., 40.), 0u);
  EXPECT_GT(faults(40., 0.4), 0u);
  EXPECT_EQ(faults(40., 1.), 0u);
  EXPECT_GT(faults(-20., 40.), 0u);
}

TEST(Chart_bending, fills_pages_more_and_keeps_what_charts_promise)
{
  for(const Named_mesh& shape : shapes()) {
    const auto rigid = SMT::build_texture_atlas(shape.mesh, with_bending(0.));
    const auto bent = SMT::build_texture_atlas(shape.mesh, with_bending(0.03));
    ASSERT_EQ(rigid.error + bent.error, "") << shape.name << seed_text;
    EXPECT_EQ(rigid.atlas.charts.chart, bent.atlas.charts.chart) << shape.name << seed_text;
    EXPECT_GE(bent.report.utilisation, rigid.report.utilisation - 1e-12) << shape.name << seed_text;
    EXPECT_EQ(error_in_atlas(shape.mesh, bent.atlas), "") << shape.name << seed_text;
    // Gaps by trial of all texels
    std::vector<SMT::Chart_shape> charts;
    const SMT::Packing_result packing = packing_of(bent, charts);
    EXPECT_EQ(packed_charts::padding_error(charts, with_bending(0.).packing, packing), "")
      << shape.name << seed_text;
    EXPECT_LT(change_of_lengths(rigid.atlas, bent.atlas), 0.05) << shape.name << seed_text;
    const std::vector<SMT::Chart_mesh> meshes = SMT::chart_meshes(shape.mesh, bent.atlas.charts);
    for(std::size_t i = 0; i < meshes.size(); ++i) {
      const SMT::Chart_report& report = bent.report.charts[i];
      EXPECT_TRUE(report.is_one_to_one) << shape.name << seed_text;
      const std::vector<Point_2> uv = map_of(meshes[i], bent.atlas, bent.atlas.mesh.uv);
      const SMT::Chart_distortion measured = SMT::measure_chart_distortion(meshes[i].mesh, uv);
      EXPECT_NEAR(report.distortion.area_scale, measured.area_scale, 1e-4) << shape.name << seed_text;
      EXPECT_NEAR(report.distortion.quasi_conformal, measured.quasi_conformal, 1e-4)
        << shape.name << seed_text;
      EXPECT_TRUE(report.is_rough || measured.is_within(SMT::Distortion_bound()))
        << shape.name << seed_text;
    }
    if(shape.name == "disk") { // from pi / 4
      EXPECT_GT(bent.report.utilisation, rigid.report.utilisation + 0.04) << seed_text;
    }
    if(shape.name == "star") { // among small charts that could slip through others, and with thin triangles
      EXPECT_GT(bent.report.utilisation, rigid.report.utilisation + 0.02) << seed_text;
    }
  }
}

// The more charts may bend the fuller the page, and the more lengths change.
TEST(Chart_bending, goes_as_far_as_it_may)
{
  const Indexed_triangle_mesh mesh = round_disk(12);
  double before = 0.;
  for(const double bending : {0., 0.01, 0.03, 0.1}) {
    const auto built = SMT::build_texture_atlas(mesh, with_bending(bending));
    ASSERT_EQ(built.error, "");
    EXPECT_GT(built.report.utilisation, before + 0.01) << bending;
    before = built.report.utilisation;
  }
}

// The areas of the triangles of a map.
std::vector<double> areas_of(const SMT::internal::Mapped_chart& map)
{
  std::vector<double> result;
  for(const Triangle_indices& t : map.chart.mesh.triangles)
    result.push_back(CGAL::area(map.uv[t[0]], map.uv[t[1]], map.uv[t[2]]));
  return result;
}

// All but those that are as bad as they may be, and one that became invalid before, which may be stretched:
// areas in it all change alike.
TEST(Chart_bending, is_for_all_but_charts_at_their_bounds)
{
  for(const std::size_t bounded : {2u, 3u}) { // each of so many
    const Indexed_triangle_mesh mesh = with_hills(torus(30, 12), 0.3, seed);
    const SMT::Texture_atlas_options options = with_bending(0.);
    const auto rigid = SMT::build_texture_atlas(mesh, options);
    ASSERT_EQ(rigid.error, "") << seed_text;
    std::vector<SMT::Chart_shape> charts;
    SMT::Packing_result packing = packing_of(rigid, charts);
    packing.texels_per_unit = 1.;
    packing.utilisation = rigid.report.utilisation;
    std::vector<SMT::internal::Mapped_chart> maps;
    std::vector<SMT::Distortion_bound> bounds;
    for(SMT::Chart_mesh& chart : SMT::chart_meshes(mesh, rigid.atlas.charts)) {
      maps.emplace_back();
      maps.back().uv = map_of(chart, rigid.atlas, charts[maps.size() - 1].uv);
      SMT::Chart_report& report = maps.back().report;
      report.is_one_to_one = true;
      report.distortion = SMT::measure_chart_distortion(chart.mesh, maps.back().uv);
      maps.back().chart = std::move(chart);
      constexpr double rounding = 1. + 1e-6, any = std::numeric_limits<double>::infinity();
      maps.back().bound = {any, any};
      if(maps.size() % bounded == 0)
        maps.back().bound = {rounding * report.distortion.area_scale,
                             rounding * report.distortion.quasi_conformal};
      bounds.push_back(maps.back().bound);
    }
    ASSERT_GE(maps.size(), 3u) << seed_text;
    SMT::internal::Mapped_chart& stretched = maps[bounded - 2];
    stretched.is_affine = true;
    const std::vector<double> areas = areas_of(stretched);
    const SMT::internal::Chart_mapping mapping = {};
    const auto goes_on = [] { return true; };
    const auto work_and_used = [&](double most_work) {
      std::vector<SMT::internal::Mapped_chart> charts_bent = maps;
      SMT::Packing_result packing_bent = packing;
      SMT::internal::Bending amount = {0.15}; // takes many steps
      amount.most_work = most_work;
      const double work
        = SMT::internal::bend_charts(amount, options.packing, mapping, goes_on, charts_bent, packing_bent);
      return std::make_pair(work, packing_bent.utilisation);
    };
    const auto little = work_and_used(0.), any = work_and_used(std::numeric_limits<double>::infinity());
    EXPECT_LE(little.first, any.first) << bounded << seed_text;
    if(bounded == 3) { // else most charts can hardly bend, and all soon stop
      EXPECT_LT(little.first, any.first) << seed_text;
    }
    EXPECT_GE(little.second, rigid.report.utilisation) << bounded << seed_text;
    SMT::internal::bend_charts({0.03}, options.packing, mapping, goes_on, maps, packing);
    EXPECT_GT(packing.utilisation, rigid.report.utilisation + 0.01) << bounded << seed_text;
    for(std::size_t i = 0; i < maps.size(); ++i) {
      const SMT::Chart_distortion after = SMT::measure_chart_distortion(maps[i].chart.mesh, maps[i].uv);
      EXPECT_TRUE(after.is_within(bounds[i])) << i << seed_text;
    }
    EXPECT_TRUE(stretched.is_affine) << bounded << seed_text;
    const std::vector<double> bent = areas_of(stretched);
    for(std::size_t t = 0; t < areas.size(); ++t)
      EXPECT_NEAR(bent[t] / areas[t], bent[0] / areas[0], 1e-6 * bent[0] / areas[0]) << bounded << seed_text;
  }
}

// What is asked for beyond a first bending comes from further ones, not from cuts, each from where charts
// are; but for a page that is full already, and for a strip much longer than the page.
TEST(Chart_bending, is_repeated_before_charts_are_cut)
{
  for(const Named_mesh& shape : shapes()) {
    SMT::Texture_atlas_options options = with_bending(0.02);
    options.seam_price = std::numeric_limits<double>::infinity();
    const auto once = SMT::build_texture_atlas(shape.mesh, options);
    options.min_used = once.report.utilisation + 0.01;
    const auto again = SMT::build_texture_atlas(shape.mesh, options);
    ASSERT_EQ(again.error, "") << shape.name << seed_text;
    EXPECT_EQ(error_in_atlas(shape.mesh, again.atlas), "") << shape.name << seed_text;
    const bool can_gain = shape.name != "hills" && shape.name != "slivers";
    EXPECT_GE(again.report.utilisation, can_gain ? options.min_used : once.report.utilisation)
      << shape.name << seed_text;
    EXPECT_EQ(again.report.page_cuts, 0u) << shape.name << seed_text;
    EXPECT_EQ(again.atlas.charts.number_of_charts, once.atlas.charts.number_of_charts)
      << shape.name << seed_text;
  }
}

// Several pages, and a mip level at which charts are apart.
TEST(Chart_bending, keeps_gaps_of_several_pages_and_mip_levels)
{
  const Indexed_triangle_mesh mesh = torus(30, 12);
  for(const auto& [pages, mip_levels] : {std::pair<std::size_t, unsigned int>{3, 0}, {1, 2}}) {
    SMT::Texture_atlas_options options = with_bending(0.03);
    options.packing.width = 232;
    options.packing.height = 264;
    options.packing.max_pages = pages;
    options.packing.mip_levels = mip_levels;
    const auto bent = SMT::build_texture_atlas(mesh, options);
    options.bending = 0.;
    const auto rigid = SMT::build_texture_atlas(mesh, options);
    ASSERT_EQ(bent.error + rigid.error, "") << pages;
    EXPECT_GT(bent.report.utilisation, rigid.report.utilisation) << pages;
    std::vector<SMT::Chart_shape> charts;
    const SMT::Packing_result packing = packing_of(bent, charts);
    EXPECT_EQ(packed_charts::padding_error(charts, options.packing, packing), "") << pages;
    EXPECT_EQ(error_in_atlas(mesh, bent.atlas), "") << pages;
  }
}

// What asks for straight or rigid charts has them.
TEST(Chart_bending, is_left_out_where_charts_shall_be_rigid)
{
  const Indexed_triangle_mesh mesh = torus(24, 10);
  for(int which = 0; which < 4; ++which) {
    std::array<std::vector<Point_2>, 2> uv;
    for(int k = 0; k < 2; ++k) {
      SMT::Texture_atlas_options options = with_bending(k == 0 ? 0. : 0.05);
      options.is_aligned = which == 0;
      options.has_whole_texels = which == 1;
      options.packing.texels_per_unit = which == 2 ? 1. : 0.;
      options.packing.max_pages = which == 2 ? 0 : 1;
      options.may_stretch = which != 3;
      const auto built = SMT::build_texture_atlas(mesh, options);
      ASSERT_EQ(built.error, "") << which;
      uv[k] = built.atlas.mesh.uv;
    }
    EXPECT_TRUE(uv[0] == uv[1]) << which;
  }
}

TEST(Chart_bending, must_be_a_number)
{
  for(const double bending : {-0.1, std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity()}) {
    const auto built = SMT::build_texture_atlas(grid(4, 4), with_bending(bending));
    EXPECT_EQ(built.status, SMT::Mesh_status::BAD_OPTIONS);
    EXPECT_NE(built.error.find("bending"), std::string::npos) << built.error;
  }
}

} // namespace chart_bending_test
