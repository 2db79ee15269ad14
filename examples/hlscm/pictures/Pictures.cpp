// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Pictures.h"

#include "pictures/Domain_picture.h"
#include "pictures/Surface_picture.h"

namespace hlscm {

namespace {

constexpr double map_side = 1400, short_side_at_least = 500; // pixels
constexpr double map_margin = 24, level_side = 560;

struct Size
{
  double width, height;

  Panel inside() const
  {
    return {map_margin, map_margin, width - 2 * map_margin, height - 2 * map_margin};
  }
  Canvas canvas() const { return Canvas(std::size_t(width), std::size_t(height)); }
};

Size picture_size(double aspect_ratio)
{
  const double width = aspect_ratio >= 1 ? map_side : map_side * aspect_ratio;
  const double height = aspect_ratio >= 1 ? map_side / aspect_ratio : map_side;
  return {std::max(width, short_side_at_least), std::max(height, short_side_at_least)};
}

void draw_domain_picture(const Drawn_surface& surface, Output_file& file, Progress_bar& progress)
{
  Uv_box box;
  box.add(surface);
  const Size size = picture_size(box.width() / box.height());
  Canvas canvas = size.canvas();
  draw_domain(canvas, size.inside(), surface, box, progress);
  canvas.write_png(file);
}

void draw_surface_picture(View view, const Drawn_surface& surface, Pattern pattern,
                          Output_file& file, Progress_bar& progress)
{
  const Size size = picture_size(view.aspect_ratio());
  view.fit_to(size.inside());
  Canvas canvas = size.canvas();
  draw_surface(canvas, view, surface, pattern, progress);
  canvas.write_png(file);
}

// A column for each level: the surface above, the domain below.
void draw_level_picture(View view, const std::vector<Drawn_surface>& levels, Output_file& file,
                        Progress_bar& progress)
{
  Uv_box box;
  for(const Drawn_surface& level : levels) {
    box.add(level);
  }
  const auto row_height = [](double aspect_ratio) {
    return std::clamp(level_side / aspect_ratio, 0.4 * level_side, 1.4 * level_side);
  };
  const double upper = row_height(view.aspect_ratio()),
               lower = row_height(box.width() / box.height());
  const Size size{double(levels.size()) * (level_side + map_margin) + map_margin,
                  upper + lower + 3 * map_margin};
  Canvas canvas = size.canvas();
  double left = map_margin;
  for(const Drawn_surface& level : levels) {
    view.fit_to({left, map_margin, level_side, upper});
    draw_surface(canvas, view, level, Pattern::ISOLINES, progress);
    draw_domain(canvas, {left, upper + 2 * map_margin, level_side, lower}, level, box, progress);
    left += level_side + map_margin;
  }
  canvas.write_png(file);
}

} // namespace

Picture_files::Picture_files(Output_files& files, const std::filesystem::path& folder)
  : m_domain((files.create_folder(folder), files.create(folder / "domain.png"))),
    m_isolines(files.create(folder / "isolines.png")),
    m_checker(files.create(folder / "checker.png")), m_levels(files.create(folder / "levels.png"))
{}

void Picture_files::draw(const std::vector<Drawn_surface>& levels, Progress_bar& progress)
{
  progress.start_stage("drawing");
  const Drawn_surface& surface = levels.back();
  const View view(surface);
  draw_domain_picture(surface, m_domain, progress);
  draw_surface_picture(view, surface, Pattern::ISOLINES, m_isolines, progress);
  draw_surface_picture(view, surface, Pattern::CHECKERBOARD, m_checker, progress);
  draw_level_picture(view, levels, m_levels, progress);
}

} // namespace hlscm
