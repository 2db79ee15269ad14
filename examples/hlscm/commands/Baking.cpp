// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Baking.h"

#include "common/Interruption.h"
#include "common/Program_error.h"
#include "common/Ray_caster.h"
#include "common/Stopwatch.h"

#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>

#include <algorithm>
#include <utility>

namespace hlscm {

namespace SMT = CGAL::Surface_mesh_texturing;

namespace {

class Baker
{
public:
  Baker(const Baking_input& input, const Program_options& options, const Time_limit& limit,
        Progress_bar& progress)
    : m_input(input), m_options(options), m_limit(limit), m_progress(progress),
      m_fine_normals(SMT::vertex_normals(input.fine.points, input.fine.triangles)),
      m_frames(SMT::tangent_frames(input.light, SMT::vertex_normals(input.light)))
  {
    m_library.width = input.width * input.pages;
    m_library.height = input.height;
    m_library.space
        = options.bake.is_object_space ? SMT::Normal_space::OBJECT : SMT::Normal_space::TANGENT;
    m_library.progress = [this](double part) {
      return m_progress.try_advance(part) && !(m_may_run_out && m_limit.is_up());
    };
  }

  // Within a limit of time with one sample of a texel first, then with twice as many each way, and
  // again: the last ones that were all done in time are the result.
  Baked_images run(Bake_report& report)
  {
    Baked_images best = run(m_limit.exists() ? 1 : m_options.bake.samples, report);
    m_may_run_out = true;
    for(std::size_t samples = report.samples_each_way;
        samples < m_options.bake.samples && !m_limit.is_up();) {
      samples = std::min(2 * samples, m_options.bake.samples);
      Bake_report with_more = report;
      try {
        best = run(samples, with_more);
        report = with_more;
      } catch(const Time_is_up&) {
      }
    }
    report.stopped_early = report.samples_each_way < m_options.bake.samples;
    best.frames = std::move(m_frames);
    return best;
  }

private:
  struct Time_is_up
  {};

  Baked_images run(std::size_t samples, Bake_report& report)
  {
    m_library.samples = report.samples_each_way = samples;
    Baked_images images;
    SMT::Baked_map normals = checked(bake_normals());
    images.normals = std::move(normals.image);
    report.samples = normals.number_of_samples;
    report.samples_beside = normals.number_of_samples_beside;
    report.samples_without = normals.number_of_samples_without;
    if(report.samples == report.samples_without) {
      throw Program_error(m_options.input, "no point of it is where the light model is, give two "
                                           "models of one surface in one place");
    }
    if(m_options.bake.has_displacement) {
      m_progress.start_stage("heights");
      const SMT::Displacement_shader shader(m_input.fine.points, m_input.fine.triangles,
                                            m_input.light, m_frames.normals);
      const SMT::Baked_map map = checked(bake_with(shader));
      set_displacement(map, images);
    }
    if(m_input.coloured) {
      m_progress.start_stage("colours");
      const SMT::Image_shader shader(*m_input.coloured, m_input.colours);
      images.colours = checked(bake_with(shader)).image;
    }
    return images;
  }

  SMT::Baked_map bake_normals()
  {
    m_progress.start_stage("baking");
    if(m_input.shares_texture()) {
      return SMT::bake_normal_map(m_input.fine, m_fine_normals, m_input.light, m_frames, m_library);
    }
    SMT::Baking_by_rays_options by_rays;
    static_cast<SMT::Baking_options&>(by_rays) = m_library;
    return SMT::bake_normal_map_by_rays<Ray_caster>({m_input.fine.points, m_input.fine.triangles},
                                                    m_fine_normals, m_input.light, m_frames, by_rays);
  }

  // Data that the normals could be baked of is good.
  template <typename Shader>
  SMT::Baked_map bake_with(const Shader& shader)
  {
    if(m_input.shares_texture()) {
      const SMT::Equal_uv equal(m_input.fine, m_input.light, m_library);
      return SMT::bake(m_input.light, equal, shader, m_library);
    }
    const Ray_caster caster(m_input.fine.points, m_input.fine.triangles);
    const double radius = SMT::Bounding_ball({&m_input.light.points}).radius;
    const SMT::Along_rays<Ray_caster> rays(
        caster, m_input.fine.points, m_input.fine.triangles, m_input.light, m_frames.normals,
        SMT::Baking_by_rays_options().max_distance * radius);
    return SMT::bake(m_input.light, rays, shader, m_library);
  }

  static void set_displacement(const SMT::Baked_map& map, Baked_images& images)
  {
    bool is_first = true;
    for(std::size_t i = 0; i < map.is_covered.size(); ++i) {
      if(map.is_covered[i]) {
        const double height = double(map.image.texels[i]);
        images.lowest = is_first ? height : std::min(images.lowest, height);
        images.highest = is_first ? height : std::max(images.highest, height);
        is_first = false;
      }
    }
    images.displacement = map.image;
  }

  SMT::Baked_map checked(SMT::Baked_map map) const
  {
    Interruption::check();
    if(map.status == CGAL::Indexed_mesh::Mesh_status::CANCELLED) {
      throw Time_is_up();
    }
    if(!map.error.empty()) {
      throw Program_error(m_options.input, map.error);
    }
    return map;
  }

  const Baking_input& m_input;
  const Program_options& m_options;
  const Time_limit& m_limit;
  Progress_bar& m_progress;
  bool m_may_run_out = false; // without a result
  std::vector<SMT::Vector_3> m_fine_normals;
  SMT::Tangent_frames m_frames; // of the light model
  SMT::Baking_options m_library;
};

} // namespace

Baked_images bake_images(const Baking_input& input, const Program_options& options,
                         const Time_limit& limit, Progress_bar& progress, Bake_report& report)
{
  const Stopwatch baking;
  Baked_images images = Baker(input, options, limit, progress).run(report);
  report.seconds_bake = baking.seconds();
  return images;
}

void compare_normals(const Baking_input& input, const Baked_images& images,
                     const SMT::Texture_image& normals, const Program_options& options,
                     Bake_report& report)
{
  const Stopwatch comparing;
  const SMT::Rendering_error error = SMT::rendering_error(
      input.fine, input.light, images.frames, normals,
      options.bake.is_object_space ? SMT::Normal_space::OBJECT : SMT::Normal_space::TANGENT);
  report.mapped = {error.mean_angle, error.angle_95};
  report.smooth = {error.mean_angle_without_map, error.angle_95_without_map};
  report.silhouette_difference = error.silhouette_difference;
  report.seconds_compare = comparing.seconds();
}

} // namespace hlscm
