// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Indexed_mesh/weld_points.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace weld_points_test {

namespace IM = CGAL::Indexed_mesh;

typedef IM::Polygon_soup Polygon_soup;
typedef Polygon_soup::Point_3 Point_3;

// Each vertex is a corner of a face, so that the corners tell what became of the vertices.
Polygon_soup soup_of(const std::vector<Point_3>& points)
{
  Polygon_soup soup;
  soup.points = points;
  for(std::size_t v = 0; v < points.size(); ++v)
    soup.corners.push_back(IM::Vertex_index(v));
  soup.close_face();
  return soup;
}

// By its definition: each vertex becomes the first of those kept that is near.
Polygon_soup welded_by_definition(const Polygon_soup& soup, double distance)
{
  Polygon_soup result = soup;
  result.points.clear();
  std::vector<IM::Vertex_index> number;
  for(const Point_3& p : soup.points) {
    const auto is_near = [&](const Point_3& q) {
      return p == q || std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()) <= distance;
    };
    const auto found = std::find_if(result.points.begin(), result.points.end(), is_near);
    number.push_back(IM::Vertex_index(found - result.points.begin()));
    if(found == result.points.end())
      result.points.push_back(p);
  }
  for(IM::Vertex_index& v : result.corners)
    v = number[v];
  return result;
}

std::vector<Point_3> random_points(std::size_t n, double size, double offset, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-size, size);
  std::vector<Point_3> points;
  for(std::size_t i = 0; i < n; ++i)
    points.emplace_back(offset + coordinate(random), offset + coordinate(random),
                        coordinate(random) / 8);
  for(std::size_t i = 0; i < n / 4; ++i) // some are equal
    points[random() % n] = points[random() % n];
  return points;
}

TEST(Weld_points, does_what_its_definition_says)
{
  unsigned seed = 0;
  for(const double size : {1e-300, 1e-3, 1., 1e6, 1e300})
    for(const double offset : {0., 3., -1e5})
      for(const double relative : {0., 1e-9, 0.01, 0.1, 0.3, 10.}) {
        SCOPED_TRACE(testing::Message() << size << " " << offset << " " << relative << " " << seed);
        const Polygon_soup soup = soup_of(random_points(400, size, offset * size, ++seed));
        Polygon_soup welded = soup;
        const std::size_t less = IM::weld_points(welded, relative * size);
        const Polygon_soup expected = welded_by_definition(soup, relative * size);
        EXPECT_EQ(welded.points, expected.points);
        EXPECT_EQ(welded.corners, expected.corners);
        EXPECT_EQ(less, soup.points.size() - expected.points.size());
        EXPECT_EQ(IM::soup_error(welded), "");
      }
}

TEST(Weld_points, takes_minus_zero_for_zero)
{
  Polygon_soup soup = soup_of(
      {Point_3(0., 1., 2.), Point_3(-0., 1., 2.), Point_3(1., -0., 0.), Point_3(1., 0., -0.)});
  EXPECT_EQ(IM::weld_points(soup, 0), 2u);
  EXPECT_EQ(soup.corners, (std::vector<IM::Vertex_index>{0, 0, 1, 1}));
  EXPECT_FALSE(std::signbit(soup.points[0].x())); // the first one is as it was
  EXPECT_TRUE(std::signbit(soup.points[1].y()));
}

TEST(Weld_points, leaves_alone_what_is_not_finite)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for(const double distance : {0., 1., 1e308, 5e-324}) {
    Polygon_soup soup = soup_of({Point_3(inf, 0., 0.), Point_3(inf, 0., 0.), Point_3(nan, 0., 0.),
                                 Point_3(nan, 0., 0.), Point_3(0., 0., 0.), Point_3(0., 0., 0.)});
    EXPECT_EQ(IM::weld_points(soup, distance), 1u) << distance;
    EXPECT_EQ(soup.corners, (std::vector<IM::Vertex_index>{0, 1, 2, 3, 4, 4})) << distance;
  }
}

TEST(Weld_points, forms_no_chains)
{
  std::vector<Point_3> points;
  for(int i = 0; i < 10; ++i)
    points.emplace_back(0.75 * i, 0., 0.);
  Polygon_soup soup = soup_of(points);
  EXPECT_EQ(IM::weld_points(soup, 1), 5u);
  EXPECT_EQ(soup.corners, (std::vector<IM::Vertex_index>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4}));
}

TEST(Weld_points, takes_any_distance)
{
  const double largest = (std::numeric_limits<double>::max)();
  const std::vector<Point_3> points{Point_3(largest, 0., 0.), Point_3(-largest, 0., 0.),
                                    Point_3(1., 0., 0.), Point_3(1. + 1e-15, 0., 0.)};
  for(const double distance : {5e-324, 1e-300, 1., 1e300}) {
    Polygon_soup soup = soup_of(points);
    EXPECT_EQ(IM::weld_points(soup, distance), distance >= 1 ? 1u : 0u) << distance;
  }
  for(const double distance : {largest, std::numeric_limits<double>::infinity()}) {
    Polygon_soup soup = soup_of(points);
    EXPECT_GE(IM::weld_points(soup, distance), 2u) << distance;
  }
  Polygon_soup empty;
  EXPECT_EQ(IM::weld_points(empty, 1), 0u);
}

// Texture coordinates and the sizes of faces stay.
TEST(Weld_points, changes_nothing_but_vertices)
{
  Polygon_soup soup = soup_of({Point_3(0., 0., 0.), Point_3(1., 0., 0.), Point_3(0., 1., 0.),
                               Point_3(1., 0., 0.), Point_3(1., 1., 0.), Point_3(0., 1., 0.)});
  soup.first_corner = {0, 3, 6};
  for(int i = 0; i < 6; ++i)
    soup.uv.emplace_back(i, -i);
  soup.uv_corners = {5, 4, 3, 2, 1, 0};
  const Polygon_soup before = soup;
  EXPECT_EQ(IM::weld_points(soup, 0), 2u);
  EXPECT_EQ(soup.corners, (std::vector<IM::Vertex_index>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(soup.first_corner, before.first_corner);
  EXPECT_EQ(soup.uv, before.uv);
  EXPECT_EQ(soup.uv_corners, before.uv_corners);
}

} // namespace weld_points_test
