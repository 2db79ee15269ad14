// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Baking.h"

#include "common/Interruption.h"
#include "common/Program_error.h"
#include "common/Stopwatch.h"

#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>
#ifdef HLSCM_WITHOUT_EMBREE
#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#else
#include <CGAL/Surface_mesh_texturing/Embree_ray_caster.h>
#endif

#include <algorithm>
#include <utility>

namespace hlscm {

namespace SMT = CGAL::Surface_mesh_texturing;

namespace {

#ifdef HLSCM_WITHOUT_EMBREE
using Ray_caster = SMT::AABB_tree_ray_caster;
#else
using Ray_caster = SMT::Embree_ray_caster;
#endif

class Baker
{
public:
  Baker(const Baking_input& input, const Program_options& options, Progress_bar& progress)
    : m_input(input), m_options(options), m_progress(progress),
      m_fine_normals(SMT::vertex_normals(input.fine.points, input.fine.triangles))
  {
    m_library.width = options.atlas.texture * input.pages;
    m_library.height = options.atlas.texture;
    m_library.samples = options.bake.samples;
    m_library.space
        = options.bake.is_object_space ? SMT::Normal_space::OBJECT : SMT::Normal_space::TANGENT;
    m_library.progress = [&progress](double part) { return progress.try_advance(part); };
  }

  Baked_images run(Bake_report& report)
  {
    Baked_images images;
    images.frames = SMT::tangent_frames(m_input.light, SMT::vertex_normals(m_input.light));
    SMT::Baked_map normals = checked(bake_normals(images.frames));
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
                                            m_input.light, images.frames.normals);
      const SMT::Baked_map map = checked(bake_with(shader, images.frames));
      set_displacement(map, images);
    }
    if(m_input.coloured) {
      m_progress.start_stage("colours");
      const SMT::Image_shader shader(*m_input.coloured, m_input.colours);
      images.colours = checked(bake_with(shader, images.frames)).image;
    }
    return images;
  }

private:
  SMT::Baked_map bake_normals(const SMT::Tangent_frames& frames)
  {
    m_progress.start_stage("baking");
    if(m_input.shares_texture()) {
      return SMT::bake_normal_map(m_input.fine, m_fine_normals, m_input.light, frames, m_library);
    }
    SMT::Baking_by_rays_options by_rays;
    static_cast<SMT::Baking_options&>(by_rays) = m_library;
    return SMT::bake_normal_map_by_rays<Ray_caster>({m_input.fine.points, m_input.fine.triangles},
                                                    m_fine_normals, m_input.light, frames, by_rays);
  }

  // Data that the normals could be baked of is good.
  template <typename Shader>
  SMT::Baked_map bake_with(const Shader& shader, const SMT::Tangent_frames& frames)
  {
    if(m_input.shares_texture()) {
      const SMT::Equal_uv equal(m_input.fine, m_input.light, m_library);
      return SMT::bake(m_input.light, equal, shader, m_library);
    }
    const Ray_caster caster(m_input.fine.points, m_input.fine.triangles);
    const double radius = SMT::internal::Bounding_ball({&m_input.light.points}).radius;
    const SMT::Along_rays<Ray_caster> rays(
        caster, m_input.fine.points, m_input.fine.triangles, m_input.light, frames.normals,
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
    if(!map.error.empty()) {
      throw Program_error(m_options.input, map.error);
    }
    return map;
  }

  const Baking_input& m_input;
  const Program_options& m_options;
  Progress_bar& m_progress;
  std::vector<SMT::Vector_3> m_fine_normals;
  SMT::Baking_options m_library;
};

} // namespace

Baked_images bake_images(const Baking_input& input, const Program_options& options,
                         Progress_bar& progress, Bake_report& report)
{
  const Stopwatch baking;
  const CGAL::Blocked_execution::Thread_scope threads(options.library.threads);
  Baked_images images = Baker(input, options, progress).run(report);
  report.seconds_bake = baking.seconds();
  return images;
}

void compare_normals(const Baking_input& input, const Baked_images& images,
                     const SMT::Texture_image& normals, const Program_options& options,
                     Bake_report& report)
{
  const Stopwatch comparing;
  const CGAL::Blocked_execution::Thread_scope threads(options.library.threads);
  const SMT::Rendering_error error = SMT::rendering_error(
      input.fine, input.light, images.frames, normals,
      options.bake.is_object_space ? SMT::Normal_space::OBJECT : SMT::Normal_space::TANGENT);
  report.mapped = {error.mean_angle, error.angle_95};
  report.smooth = {error.mean_angle_without_map, error.angle_95_without_map};
  report.silhouette_difference = error.silhouette_difference;
  report.seconds_compare = comparing.seconds();
}

} // namespace hlscm
