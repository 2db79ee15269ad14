// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_OPTIONS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_OPTIONS_H

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Multigrid/Schedule.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>
#include <CGAL/Surface_mesh_parameterization/Flip_repair_options.h>

#include <array>
#include <complex>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMParameterizer
/// How the minimum of the conformal energy is found.
enum class Conformal_method
{
  HLSCM,    ///< conjugate gradients preconditioned by multigrid cycles, to the minimiser
  SPECTRAL, ///< without pins: the map of least energy for the size of its border, by an eigensolver
  CASCADIC, ///< the cascade of Ray and Lévy 2003: a few steps on each level; no tolerance is met
  LSCM,     ///< conjugate gradients on the fine mesh alone (monogrid)
  DIRECT    ///< sparse Cholesky factorization of the whole system
};

/// \ingroup PkgHLSCMParameterizer
/// In which order the mesh is decimated.
enum class Decimation_engine
{
  FLAT,       ///< `Flat_collapse_engine`, in batches
  FLAT_STRICT ///< `Flat_collapse_engine`, always the cheapest collapse of all
};

/// \ingroup PkgHLSCMParameterizer
/// How far a mesh is decimated.
struct Decimation_goal
{
  std::size_t target_vertices; ///< where to stop
  double angular_defect_bound; ///< a vertex of no smaller defect stays; degrees
  /// Told the part done in [0, 1] from time to time; returning `false` stops early.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMParameterizer
/// Decimates a mesh by halfedge collapses. `is_locked`: for each vertex whether it must stay.
typedef std::function<Surface_mesh_multiresolution::Progressive_mesh(
  const Indexed_mesh::Indexed_triangle_mesh& mesh, const std::vector<bool>& is_locked,
  const Decimation_goal& goal)>
  Decimation_function;

/// \ingroup PkgHLSCMParameterizer
/// The preconditioner of the monogrid method.
enum class Monogrid_preconditioner
{
  JACOBI,                ///< the diagonal
  SYMMETRIC_GAUSS_SEIDEL ///< a forward and a backward sweep of Gauss-Seidel
};

using Surface_mesh_multiresolution::Prolongation_rule;

/// \ingroup PkgHLSCMParameterizer
/// The map on one level, as observers see it. The vertices of a level, the finest too, stand in an
/// order of their own: `vertices` tells where they are in the mesh.
struct Level_view
{
  std::size_t level;            ///< 0 is the coarsest
  std::size_t number_of_levels; ///< their number
  /// For each vertex of the level its position in `vertices(mesh)`.
  const std::vector<std::uint32_t>* vertices;
  /// The faces, as indices into `vertices`.
  const std::vector<std::array<std::uint32_t, 3>>* faces;
  /// The parameter \f$ u + iv \f$ of each vertex.
  const std::vector<std::complex<double>>* uv;
};

/*!
\ingroup PkgHLSCMParameterizer

The options of `HLSCM_parameterizer_3`.
*/
struct HLSCM_options
{
  /// How the minimum is found.
  Conformal_method method = Conformal_method::HLSCM;
  /// The part of the energy by which the result may lie above the minimum, \f$ (E - E_{\min}) / E
  /// \f$: 1e-2 cannot be told from the minimum by eye, 1e-4 leaves uv errors of about 1e-3 of the
  /// map.
  double tolerance = 1e-2;
  /// Smoothing steps before and after the coarse correction, and visits of the coarse level. By
  /// default the K-cycle of `Multigrid::Schedule()`, and for the cascade, which takes
  /// `post_smoothing` conjugate gradient steps on each level, `Multigrid::Schedule::cascade(10)`.
  std::optional<Multigrid::Schedule> schedule;
  /// Vertices of a level to those of the next coarser one; 0 for the method's default: 4, and for
  /// the cascade 10, as in the paper.
  double level_ratio = 0.;
  /// Vertices of the coarsest level, which is solved directly.
  std::size_t coarsest_size = 2000;
  /// A vertex whose angular defect is not below this stays, in degrees (the paper's 70).
  double angular_defect_bound = 70.;
  /// Which energy is minimised.
  Conformal_weights weights = Conformal_weights::EXACT;
  /// The metric in which the map is conformal, a tensor for each face, in the order of the faces, such
  /// as that of `signal_metric()`; empty: that of the surface. Only with `Conformal_weights::EXACT`.
  /// `Hierarchical_conformal_map` knows no other than that of the surface.
  std::vector<Indexed_mesh::Space_tensor> metric;
  /// What mends flipped faces of the map, at the price of a little energy, such as
  /// `Flip_repairer()` of `<CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>`; nothing by
  /// default. The time limit and cancelling hold for it, too.
  Flip_repair_function repair_flips;
  /// In which order the mesh is decimated.
  Decimation_engine engine = Decimation_engine::FLAT;
  /// What decimates the mesh in the place of `engine`, such as `Edge_collapse_decimation()` of
  /// `<CGAL/Surface_mesh_parameterization/Edge_collapse_decimation.h>`; nothing by default.
  Decimation_function decimate;
  /// How values go to finer levels.
  Prolongation_rule prolongation = Prolongation_rule::WALK;
  /// The preconditioner of `Conformal_method::LSCM`.
  Monogrid_preconditioner preconditioner = Monogrid_preconditioner::JACOBI;
  /// Iterations on the fine mesh before the solver gives up; 0 for the method's default: 500, and
  /// 100000 for the monogrid method.
  std::size_t maximal_iterations = 0;
  /// Threads that a parameterizer with `Parallel_tag` may use; 0 for all that the machine has. The
  /// result does not depend on it.
  unsigned int threads = 0;
  /// The iteration also ends when no uv will change by more than this part of the longer side of
  /// the map's bounding box, as far as can be estimated, such as a texel of its texture; 0 for
  /// never.
  double uv_tolerance = 0.;
  /// Seconds after which the map becomes the result as it is; 0 for no limit. Nothing is cut off
  /// before the map of the coarsest level, which comes after about two thirds of the whole time.
  double time_limit = 0.;
  /// Whether the collapses that lead to the levels are kept, for levels of detail that share the
  /// map as their texture coordinates: see `HLSCM_parameterizer_3::progressive_mesh()` and
  /// `Conformal_map`.
  bool keep_progressive_mesh = false;
  /// Told the part done in [0, 1] from time to time; returning `false` cancels.
  std::function<bool(double)> progress;
  /// Told the map on each level as soon as it is known; returning `false` makes it the result as it
  /// is, taken to the finest level.
  std::function<bool(const Level_view&)> level_observer;
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_OPTIONS_H
