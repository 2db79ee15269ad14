// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small charts that go to where there is room before larger ones bend.

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_texturing/internal/filling/Roomy_places.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Page_check.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace roomy_places_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
typedef SMT::internal::Plane_vector_d Vector;
typedef SMT::Chart_shape::Point_2 Point_2;

// A page that is small enough for rooms to be exact.
SMT::Packing_options page()
{
  SMT::Packing_options options;
  options.width = options.height = 96;
  return options;
}

// Squares on pages.
struct Squares
{
  void add(double left, double bottom, double side, std::uint32_t page = 0)
  {
    const Indexed_triangle_mesh mesh = grid(1, 1);
    const CGAL::Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
    const std::vector<std::uint8_t> none(mesh.triangles.size(), 0);
    maps.emplace_back();
    maps.back().chart = SMT::chart_meshes(mesh, adjacency, SMT::charts_between(adjacency, none)).at(0);
    places.emplace_back();
    for(const Point_3& p : maps.back().chart.mesh.points)
      places.back().emplace_back(left + side * p.x(), bottom + side * p.y());
    placements.emplace_back();
    placements.back().page = page;
  }

  SMT::internal::Chart_outline outline(std::size_t i) const
  {
    const auto place = [&](std::uint32_t v) { return SMT::internal::vector_of(places[i][v]); };
    return SMT::internal::outline_at(maps[i], place);
  }

  void move(double small, double gap)
  {
    SMT::internal::move_to_room(maps, placements, SMT::internal::exact_raster(page()), small, gap, places);
  }

  std::size_t faults(std::size_t pages) const
  {
    SMT::internal::Page_check check(page(), pages);
    for(std::size_t i = 0; i < maps.size(); ++i)
      check.add(outline(i), placements[i].page);
    return check.faults().size();
  }

  std::vector<SMT::internal::Mapped_chart> maps;
  std::vector<SMT::Chart_placement> placements;
  std::vector<std::vector<Point_2>> places;
};

// By trial of all squares around all cells.
TEST(Roomy_places, finds_the_most_room)
{
  for(std::uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const SMT::internal::Packing_raster raster = SMT::internal::exact_raster(page());
    SMT::internal::Roomy_places rooms(raster);
    Squares squares;
    std::vector<char> is_taken(std::size_t(raster.width * raster.height), 0);
    for(int i = 0; i < 12; ++i) {
      const double left = 1.5 + double(random() % 80), bottom = 1.5 + double(random() % 80);
      const double side = double(1 + random() % 12);
      squares.add(left, bottom, side);
      rooms.add(rooms.cells(squares.outline(std::size_t(i))));
      for(int y = int(bottom - raster.origin[1]); y <= int(bottom + side - raster.origin[1]); ++y)
        for(int x = int(left - raster.origin[0]); x <= int(left + side - raster.origin[0]); ++x)
          if(x < raster.width && y < raster.height)
            is_taken[std::size_t(y * raster.width + x)] = 1;
    }
    const auto room_around = [&](int x, int y) { // of whole cells, beside its own one
      for(int r = 0;; ++r)
        for(int i = x - r; i <= x + r; ++i)
          for(int j = y - r; j <= y + r; ++j)
            if(i < 0 || j < 0 || i >= raster.width || j >= raster.height
               || is_taken[std::size_t(j * raster.width + i)] != 0)
              return r - 0.5;
    };
    double most = -1.;
    for(int y = 0; y < raster.height; ++y)
      for(int x = 0; x < raster.width; ++x) {
        const Vector middle = {raster.origin[0] + x + 0.5, raster.origin[1] + y + 0.5};
        ASSERT_EQ(rooms.room_at(middle), room_around(x, y)) << x << " " << y << ", seed " << seed;
        most = (std::max)(most, room_around(x, y));
      }
    EXPECT_EQ(rooms.best().room, most) << "seed " << seed;
    EXPECT_EQ(rooms.room_at(rooms.best().place), most) << "seed " << seed;
  }
}

// Between two large ones, with the right half of the page free; on the other page all is full.
TEST(Small_charts, go_to_where_there_is_room)
{
  Squares squares;
  squares.add(2.5, 2.5, 40.);
  squares.add(2.5, 53.5, 40.);
  squares.add(20.5, 45.5, 5.);
  squares.add(10.5, 45.5, 4.);
  squares.add(2.5, 2.5, 90., 1);
  squares.add(30.5, 45.1, 5.5);
  Squares before = squares;
  squares.move(5.2, 3.);
  for(const std::size_t i : {0u, 1u, 4u, 5u}) // large, alone, and not small enough
    EXPECT_EQ(squares.places[i], before.places[i]) << i;
  for(const std::size_t i : {2u, 3u})
    EXPECT_GT(squares.places[i][0].x(), 43.) << i;
  EXPECT_EQ(squares.faults(2), 0u);
  // A gap that is not there
  squares = before;
  squares.move(5.2, 30.);
  EXPECT_EQ(squares.places, before.places);
}

// Whatever else moves: packings stay such, and those that are large stay where they are.
TEST(Small_charts, stay_apart)
{
  std::size_t moved = 0;
  for(std::uint32_t seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    Squares squares;
    for(int i = 0; i < 200; ++i) {
      const double left = 1.5 + double(random() % 80), bottom = 1.5 + double(random() % 80);
      squares.add(left, bottom, double(2 + random() % (i < 4 ? 40 : 5)));
      if(squares.faults(1) > 0) {
        squares.maps.pop_back();
        squares.places.pop_back();
        squares.placements.pop_back();
      }
    }
    const Squares before = squares;
    squares.move(6., 3.);
    EXPECT_EQ(squares.faults(1), 0u) << "seed " << seed;
    for(std::size_t i = 0; i < squares.maps.size(); ++i) {
      const double side = before.places[i].back().x() - before.places[i].front().x();
      moved += squares.places[i] != before.places[i] ? 1 : 0;
      EXPECT_TRUE(side < 6. || squares.places[i] == before.places[i]) << "seed " << seed;
    }
  }
  EXPECT_GT(moved, 30u);
}

} // namespace roomy_places_test
