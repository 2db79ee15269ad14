// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_FIRST_BORDER_FIRST_FLATTENING_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_FIRST_BORDER_FIRST_FLATTENING_H

#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/internal/border_first/Border_curve.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Chart.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#ifdef CGAL_HLSCM_USE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Solves systems with a cotangent Laplacian. Supernodes pay from some ten thousand rows on; with a
// thousand, CHOLMOD takes twice as long as Eigen.
class Laplacian_solver
{
public:
  // Takes the lower triangle; returns whether that succeeded.
  bool factorize(const Eigen::SparseMatrix<double>& laplacian)
  {
    m_is_large = laplacian.rows() > most_small;
    return m_is_large ? Multigrid::factorize_sparse(m_large, laplacian)
                      : Multigrid::factorize_sparse(m_small, laplacian);
  }

  template <class Vectors>
  void solve(const Vectors& f, Vectors& x)
  {
    if(m_is_large)
      Multigrid::solve_sparse(m_large, f, x);
    else
      Multigrid::solve_sparse(m_small, f, x);
  }

private:
  typedef Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> Small;
#ifdef CGAL_HLSCM_USE_CHOLMOD
  typedef Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> Large;
#else
  typedef Small Large;
#endif
  static constexpr Eigen::Index most_small = 16000;

  Small m_small;
  Large m_large;
  bool m_is_large = false;
};

// The neighbourhood of some border vertices, on which a change of the scale there is worked out.
class Scale_patch
{
public:
  explicit Scale_patch(const Chart& chart) : m_chart(chart) {}

  // The change of the logarithm of the scale at the vertices of `border` that adds the turning
  // angles `change` there, with no change beyond `radius` edges from them nor at other border
  // vertices. Empty if the system cannot be solved.
  std::vector<double> scale_change(const std::vector<std::uint32_t>& border, std::size_t radius,
                                   const std::vector<double>& change);

private:
  void grow(const std::vector<std::uint32_t>& border, std::size_t radius);

  void add(std::uint32_t v)
  {
    m_rank[v] = std::int32_t(m_vertices.size());
    m_vertices.push_back(v);
  }

  void add_neighbors(std::uint32_t v)
  {
    for(std::uint32_t i = 0; i < m_chart.rings.degree(v); ++i) {
      const std::uint32_t w = m_chart.rings.ring(v)[i];
      if(m_rank[w] < 0 && !m_chart.rings.is_border(w))
        add(w);
    }
  }

  Eigen::SparseMatrix<double> laplacian() const;

  const Chart& m_chart;
  std::vector<std::uint32_t> m_vertices; // those of the border first
  std::vector<std::int32_t> m_rank;      // of each vertex of the chart in the patch, or -1
};

inline void Scale_patch::grow(const std::vector<std::uint32_t>& border, std::size_t radius)
{
  m_rank.resize(m_chart.mesh.points.size(), -1); // the first time; few charts have a patch
  for(const std::uint32_t v : m_vertices)
    m_rank[v] = -1;
  m_vertices.clear();
  for(const std::uint32_t v : border)
    add(v);
  for(std::size_t begin = 0, step = 0; step < radius; ++step) {
    const std::size_t end = m_vertices.size();
    for(; begin < end; ++begin)
      add_neighbors(m_vertices[begin]);
  }
}

// The cotangent Laplacian of the patch, the lower triangle.
inline Eigen::SparseMatrix<double> Scale_patch::laplacian() const
{
  std::vector<Eigen::Triplet<double>> entries;
  for(std::size_t row = 0; row < m_vertices.size(); ++row) {
    const std::uint32_t v = m_vertices[row], degree = m_chart.rings.degree(v);
    const std::uint32_t* ring = m_chart.rings.ring(v);
    const auto& points = m_chart.mesh.points;
    const std::uint32_t triangles = m_chart.rings.is_border(v) ? degree - 1 : degree;
    const auto add = [&](std::uint32_t w, double weight) {
      entries.emplace_back(int(row), int(row), weight);
      if(m_rank[w] >= 0 && m_rank[w] < std::int32_t(row))
        entries.emplace_back(int(row), m_rank[w], -weight);
    };
    for(std::uint32_t i = 0; i < triangles; ++i) {
      const std::uint32_t a = ring[i], b = ring[(i + 1) % degree];
      const auto half = half_cotangents(Conformal_triangle(points[v], points[a], points[b]));
      add(a, half[2]);
      add(b, half[1]);
    }
  }
  const Eigen::Index n = Eigen::Index(m_vertices.size());
  Eigen::SparseMatrix<double> result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

inline std::vector<double> Scale_patch::scale_change(const std::vector<std::uint32_t>& border,
                                                     std::size_t radius,
                                                     const std::vector<double>& change)
{
  grow(border, radius);
  Laplacian_solver solver;
  if(!solver.factorize(laplacian()))
    return {};
  Eigen::VectorXd right = Eigen::VectorXd::Zero(Eigen::Index(m_vertices.size()));
  for(std::size_t i = 0; i < change.size(); ++i)
    right[Eigen::Index(i)] = change[i];
  Eigen::VectorXd u;
  solver.solve(right, u);
  return std::vector<double>(u.data(), u.data() + change.size());
}

// The conformal map of a disk whose border keeps its lengths, the one with the least distortion of
// areas (Springborn, Schröder, Pinkall 2008; boundary first flattening: Sawhney and Crane 2017,
// section 4). With the logarithm u of the scale, 0 on the border, and the cotangent Laplacian A:
//
//     A_II u_I + A_IB u_B = -Omega_I     Omega: 2 pi minus the angles at an inner vertex
//     k' = k + A_BI u_I + A_BB u_B       k: pi minus the angles at a border vertex
//
// The border curve with these turning angles and the lengths scaled by exp(u), closed by the least
// change of lengths, is extended to the inner vertices by A_II x_I = -A_IB x_B.
//
// Where the curve would cross itself in a small loop (the surface may turn by more than a full
// angle at the tip of a seam), the border is opened: near the loop the turning angles are
// prescribed instead of the scale (section 4 too: either may be, at each vertex).
class Border_first_flattening
{
public:
  typedef std::complex<double> Complex;
  typedef std::vector<Complex> Values;

  // `chart`: a disk, with its mesh
  explicit Border_first_flattening(const Chart& chart)
    : m_mesh(chart.mesh), m_loop(chart.borders[0]), m_rank(m_mesh.points.size(), 0), m_patch(chart)
  {
    constexpr std::int32_t border = -1;
    for(const auto v : m_loop)
      m_rank[v] = border;
    for(std::int32_t& r : m_rank)
      if(r != border)
        r = std::int32_t(m_number_inside++);
  }

  // Returns the parameter of each vertex, or nothing if the Laplacian cannot be factorized.
  Values run()
  {
    assemble();
    if(m_number_inside > 0 && !m_inside.factorize(m_laplacian))
      return {};
    return extend(open_loops());
  }

private:
  // A weight of A between a border vertex and another vertex, of one triangle.
  struct Link
  {
    std::uint32_t border, other;
    double weight;
  };

  void assemble();
  Border_curve border_curve();
  Border_curve open_loops();
  bool open(const Border_curve& curve, const std::vector<Border_loop>& loops);
  Values extend(const Border_curve& curve);

  const Chart::Mesh& m_mesh;
  const std::vector<Chart::Vertex_index>& m_loop;
  std::vector<std::int32_t> m_rank; // among the inner vertices, or -1
  std::size_t m_number_inside = 0;
  std::vector<double> m_angle_sum;
  std::vector<double> m_length;            // of the border edge that begins at a vertex
  std::vector<double> m_scale;             // its logarithm u, of each vertex
  Eigen::SparseMatrix<double> m_laplacian; // A_II, the lower triangle
  std::vector<Link> m_links;
  Laplacian_solver m_inside;
  Scale_patch m_patch;
};

inline void Border_first_flattening::assemble()
{
  typedef Eigen::Triplet<double> Entry;
  std::vector<Entry> entries;
  entries.reserve(3 * m_mesh.triangles.size() + m_number_inside);
  std::vector<double> diagonal(m_number_inside, 0.);
  m_angle_sum.assign(m_mesh.points.size(), 0.);
  m_length.assign(m_mesh.points.size(), 0.);
  m_scale.assign(m_mesh.points.size(), 0.);
  std::vector<std::uint32_t> next(m_mesh.points.size(), Indexed_mesh::no_vertex);
  for(std::size_t i = 0; i < m_loop.size(); ++i)
    next[m_loop[i]] = m_loop[(i + 1) % m_loop.size()];
  for(std::size_t t = 0; t < m_mesh.triangles.size(); ++t) {
    const Conformal_triangle triangle = conformal_triangle(m_mesh, t);
    for(int c = 0; c < 3; ++c) {
      const double cotangent = triangle.cotangent(c), w = 0.5 * cotangent;
      m_angle_sum[m_mesh.triangles[t][c]] += std::atan2(1., cotangent);
      const std::uint32_t p = m_mesh.triangles[t][(c + 1) % 3];
      const std::uint32_t q = m_mesh.triangles[t][(c + 2) % 3];
      const std::int32_t i = m_rank[p], j = m_rank[q];
      if(next[p] == q) // longer by what gives triangles without area theirs
        m_length[p] = std::sqrt(squared_distance(m_mesh.points[p], m_mesh.points[q]))
                    + (triangle.is_mollified() ? Conformal_triangle::mollification : 0.);
      if(i >= 0)
        diagonal[i] += w;
      else
        m_links.push_back({p, q, w});
      if(j >= 0)
        diagonal[j] += w;
      else
        m_links.push_back({q, p, w});
      if(i >= 0 && j >= 0)
        entries.push_back(Entry((std::max)(i, j), (std::min)(i, j), -w));
    }
  }
  for(std::size_t i = 0; i < m_number_inside; ++i)
    entries.push_back(Entry(int(i), int(i), diagonal[i]));
  m_laplacian.resize(Eigen::Index(m_number_inside), Eigen::Index(m_number_inside));
  m_laplacian.setFromTriplets(entries.begin(), entries.end());
}

// The curve for the scale on the border, to which the scale inside is adapted.
inline Border_curve Border_first_flattening::border_curve()
{
  if(m_number_inside > 0) {
    Eigen::VectorXd right(m_number_inside);
    for(std::size_t v = 0; v < m_rank.size(); ++v)
      if(m_rank[v] >= 0)
        right[m_rank[v]] = m_angle_sum[v] - 2. * CGAL_PI;
    for(const Link& link : m_links)
      if(m_rank[link.other] >= 0)
        right[m_rank[link.other]] += link.weight * m_scale[link.border];
    Eigen::VectorXd u;
    m_inside.solve(right, u);
    for(std::size_t v = 0; v < m_rank.size(); ++v)
      if(m_rank[v] >= 0)
        m_scale[v] = u[m_rank[v]];
  }
  std::vector<double> k(m_mesh.points.size()), turning, length;
  for(const auto v : m_loop)
    k[v] = CGAL_PI - m_angle_sum[v];
  for(const Link& link : m_links)
    k[link.border] += link.weight * (m_scale[link.border] - m_scale[link.other]);
  for(std::size_t i = 0; i < m_loop.size(); ++i) {
    const std::uint32_t v = m_loop[i], w = m_loop[(i + 1) % m_loop.size()];
    turning.push_back(k[v]);
    length.push_back(m_length[v] * std::exp(0.5 * (m_scale[v] + m_scale[w])));
  }
  return Border_curve(std::move(turning), length);
}

// The curve with its small loops opened, as far as that goes.
inline Border_curve Border_first_flattening::open_loops()
{
  constexpr int rounds = 8;
  Border_curve curve = border_curve();
  for(int i = 0; i < rounds; ++i) {
    const std::vector<Border_loop> loops = curve.loops(m_loop.size() / 4);
    if(loops.empty() || !open(curve, loops))
      break;
    curve = border_curve();
  }
  return curve;
}

// Changes the scale near these loops such that the curve turns more at one vertex of each; returns
// whether that could be done.
inline bool Border_first_flattening::open(const Border_curve& curve,
                                          const std::vector<Border_loop>& loops)
{
  const std::size_t n = m_loop.size();
  std::vector<double> change(n, 0.);
  std::vector<bool> is_free(n, false);
  std::size_t radius = 0;
  for(const Border_loop& loop : loops) {
    const std::size_t margin = (std::min)(loop.size / 2 + 2, n / 8);
    const std::size_t pivot = curve.sharpest_vertex(loop);
    const double angle = curve.opening(loop, pivot, margin);
    if(angle == 0.)
      continue;
    change[pivot % n] += angle;
    for(std::size_t i = 0; i < loop.size + 2 * margin; ++i)
      is_free[(loop.first + n - margin + i) % n] = true;
    radius = (std::max)(radius, loop.size + 2 * margin);
  }
  std::vector<std::uint32_t> vertices;
  std::vector<double> change_there;
  for(std::size_t i = 0; i < n; ++i)
    if(is_free[i]) {
      vertices.push_back(m_loop[i]);
      change_there.push_back(change[i]);
    }
  if(vertices.empty())
    return false;
  const std::vector<double> scale = m_patch.scale_change(vertices, radius, change_there);
  for(std::size_t i = 0; i < scale.size(); ++i)
    m_scale[vertices[i]] += scale[i];
  return !scale.empty();
}

inline Border_first_flattening::Values Border_first_flattening::extend(const Border_curve& curve)
{
  Values z(m_mesh.points.size());
  for(std::size_t i = 0; i < m_loop.size(); ++i)
    z[m_loop[i]] = Complex(curve.point(i).x(), curve.point(i).y());
  if(m_number_inside == 0)
    return z;
  Eigen::MatrixX2d f = Eigen::MatrixX2d::Zero(Eigen::Index(m_number_inside), 2);
  for(const Link& link : m_links)
    if(m_rank[link.other] >= 0) {
      f(m_rank[link.other], 0) += link.weight * z[link.border].real();
      f(m_rank[link.other], 1) += link.weight * z[link.border].imag();
    }
  Eigen::MatrixX2d x;
  m_inside.solve(f, x);
  for(std::size_t v = 0; v < z.size(); ++v)
    if(m_rank[v] >= 0)
      z[v] = Complex(x(m_rank[v], 0), x(m_rank[v], 1));
  return z;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_FIRST_BORDER_FIRST_FLATTENING_H
