// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PROGRAM_OPTIONS_H
#define HLSCM_PROGRAM_PROGRAM_OPTIONS_H

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hlscm {

enum class Command { INFO, PARAMETERIZE, LEVELS, ATLAS, BAKE, VIEW, WEB };

/// What `levels` writes: a file for each level, one with all levels, or the progressive mesh.
enum class Level_format { OBJ, PLY, GLB, PM };

/// What decimates a mesh to be mapped.
enum class Engine { FLAT, FLAT_STRICT, CGAL };

/// What maps with low stretch make small.
enum class Stretch { SYMMETRIC_DIRICHLET, MIPS, ARAP, AREA };

/// Where the borders of maps with low stretch go.
enum class Border { FREE, CIRCLE, SQUARE, POLYGON };

/// A vertex of the input, counted from 0, and where it goes.
struct Pin
{
  std::size_t vertex;
  double u, v;
};

/// A length, or its part of the diagonal of the bounding box.
struct Length
{
  double value;
  bool is_relative;
};

/// What packs an atlas.
enum class Packer { RASTER, HORIZON };

/// How the charts of an atlas are mapped.
enum class Chart_map { BORDER_FIRST, LOW_STRETCH, SPECTRAL, HLSCM, CASCADIC };

/// Between what faces of the input seams shall be.
enum class Chart_limits { NONE, GROUPS, MATERIALS };

/// Of `atlas` and `bake`: what the input has already, and how the texture is to be laid out.
struct Layout_settings
{
  bool is_repacked = false;  ///< the charts of the input stay, and are placed anew
  bool keeps_scale = false;  ///< then: their sizes, too
  std::string density;       ///< a file with a number for each face; empty: none
  std::string importance;    ///< an image on the input; empty: none
  Chart_limits limits = Chart_limits::NONE;
  Chart_limits separate = Chart_limits::NONE; ///< each on textures of its own
  bool is_aligned = false;   ///< borders of charts run along the axes
  bool is_udim = false;      ///< pages are tiles of one plane
  bool is_stacked = false;   ///< equal parts share their place
  bool is_symmetric = false; ///< equal parts and mirrored halves have equal charts
  bool is_lightmap = false;  ///< the atlas is a second set of texture coordinates

  /// Whether there is anything to report.
  bool is_any() const
  {
    return is_repacked || !density.empty() || !importance.empty() || limits != Chart_limits::NONE
           || separate != Chart_limits::NONE || is_aligned || is_udim || is_stacked || is_symmetric || is_lightmap;
  }
};

/// Of `atlas` and `bake`.
struct Atlas_settings
{
  std::size_t texture = 1024; ///< texels of a side
  std::size_t padding = 2;    ///< texels around each chart
  unsigned int mip_levels = 0;
  CGAL::Surface_mesh_texturing::Distortion_bound bound;
  std::size_t max_charts = 0; ///< 0: as many as the bound needs
  std::optional<double> seam_price; ///< of seams that fill the pages; none: the default
  double min_used = 0;        ///< % of the textures
  double bending = 3;         ///< of charts, % of lengths
  double largest_aspect = 1;  ///< of textures: width to height
  bool has_smooth_seams = false; ///< they go through faces
  bool hides_seams = false;      ///< they rather lie where the surface hides them
  std::string charts;         ///< a file, or "uv"; empty: they are to be found
  bool is_one_disk = false;   ///< one chart for each connected component
  std::size_t pages = 1;      ///< at most
  double cutting_time = 0;    ///< seconds for fewer charts
  double packing_time = 0;    ///< seconds for better packings
  double time_limit = 0;      ///< seconds for `atlas`, or for all of `bake`; 0: none
  Packer packer = Packer::RASTER;
  Chart_map method = Chart_map::LOW_STRETCH;
  bool writes_ply = false;
  Layout_settings layout;
};

/// Of `bake`.
struct Bake_settings
{
  std::string target;           ///< a mesh; empty: a level of the input
  std::size_t samples = 2;      ///< of a texel, each way
  bool is_object_space = false; ///< instead of tangent space
  int bits = 8;                 ///< of a channel: 8 or 16
  bool has_displacement = false;
  std::string colours;          ///< a picture; empty: none
};

struct Program_options
{
  Command command = Command::PARAMETERIZE;
  std::string input;
  bool is_strict = false;                ///< what is no oriented manifold is refused
  std::optional<Length> weld;           ///< vertices that are no farther apart become one
  std::optional<std::size_t> component; ///< of `parameterize`: the only one to be mapped
  bool is_quiet = false;
  bool is_verbose = false;  ///< of `parameterize`: shows the levels of the solver
  bool prints_json = false; ///< of `info`

  std::string output;    ///< .obj or .ply; of `view`: .html; else a folder
  std::string view_page; ///< a file, the page into which `view` puts models; empty: that of the program
  std::string web_texture; ///< of `web`: a PNG file; empty: a checkerboard
  std::string report;    ///< empty: none
  std::string pictures;  ///< a folder; empty: none
  std::vector<Pin> pins; ///< none, or two and more
  CGAL::Surface_mesh_parameterization::HLSCM_options library;
  bool is_method_given = false; ///< by the user, in `library`
  bool is_tolerance_given = false; ///< the same
  bool is_angular_defect_given = false; ///< the same
  /// That in `library`; none: with low stretch
  std::optional<CGAL::Surface_mesh_parameterization::Conformal_method> method
      = CGAL::Surface_mesh_parameterization::Conformal_method::HLSCM;
  Stretch stretch = Stretch::SYMMETRIC_DIRICHLET; ///< what is then small
  /// What the map is adapted to: "normals", "colors", an image or a file with a number for each face;
  /// empty: nothing
  std::string signal;
  double signal_weight = 4; ///< how much that counts
  Border border = Border::FREE; ///< then
  std::string border_polygon;   ///< then: a file with its corners
  std::vector<CGAL::Simple_cartesian<double>::Point_2> border_corners; ///< then: what is in it
  std::string face_weights;     ///< then: a file with a number for each face; empty: all count alike
  std::vector<double> weights_of_faces; ///< then: what is in it, for the triangles that are mapped
  bool is_from_uv = false;    ///< then: begins with the texture coordinates of the file
  bool is_one_to_one = false; ///< then: no two parts of a component overlap
  bool repairs_flips = false; ///< of the map
  Engine engine = Engine::FLAT;

  std::size_t memory = 0;  ///< bytes for a map out of core; 0: all is in memory
  bool is_resumed = false; ///< then: goes on with what an earlier run has left
  std::string work_folder; ///< then: of its files; empty: beside the output

  std::vector<std::size_t> faces;          ///< of the levels; empty: parts of all
  std::optional<Length> error;             ///< of the surface of one level more, of the light model
  std::optional<Length> texture_error;     ///< of the texture of one level more
  std::vector<Level_format> formats;       ///< of the levels
  bool is_lossless = false;                ///< the progressive mesh

  Atlas_settings atlas;
  Bake_settings bake;
};

/// The options, or the exit code if there is nothing (more) to do: help was printed, or the usage
/// was wrong and that was said.
struct Parsed_command_line
{
  std::optional<Program_options> options;
  int exit_code = 0;
};

Parsed_command_line parse_command_line(int argc, char** argv);

} // namespace hlscm

#endif // HLSCM_PROGRAM_PROGRAM_OPTIONS_H
