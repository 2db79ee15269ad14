// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_FIRST_FLATTENING_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_FIRST_FLATTENING_H

#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/internal/Chart.h>

#include <Eigen/SparseCholesky>
#ifdef CGAL_HLSCM_USE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <cmath>
#include <complex>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The conformal map of a disk whose border keeps its lengths, the one with the least distortion of
// areas (Springborn, Schröder, Pinkall 2008; boundary first flattening: Sawhney and Crane 2017,
// section 4). With the logarithm u of the scale, 0 on the border, and the cotangent Laplacian A:
//
//     A_II u_I = -Omega_I          Omega: 2 pi minus the angles at an inner vertex
//     k'_B = k_B + A_BI u_I        k: pi minus the angles at a border vertex
//
// The border curve with these turning angles and the given lengths, closed by the least change of
// lengths, is extended to the inner vertices by A_II x_I = -A_IB x_B.
class Border_first_flattening
{
public:
  typedef std::complex<double> Complex;
  typedef std::vector<Complex> Values;

  // `chart`: a disk, with its mesh
  explicit Border_first_flattening(const Chart& chart)
    : m_mesh(chart.mesh), m_loop(chart.borders[0]), m_rank(m_mesh.points.size(), 0)
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
    if(m_number_inside > 0) {
      m_factorization.compute(m_laplacian);
      if(m_factorization.info() != Eigen::Success)
        return {};
    }
    Values z(m_mesh.points.size());
    lay_out_border(turning_angles(), z);
    extend(z);
    return z;
  }

private:
#ifdef CGAL_HLSCM_USE_CHOLMOD
  typedef Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> Factorization;
#else
  typedef Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> Factorization;
#endif

  // An entry of A between an inner vertex and one on the border.
  struct Link
  {
    std::int32_t inside;
    std::uint32_t border;
    double value;
  };

  void assemble();
  std::vector<double> turning_angles();
  void lay_out_border(const std::vector<double>& turning, Values& z) const;
  void extend(Values& z);

  const Chart::Mesh& m_mesh;
  const std::vector<Chart::Vertex_index>& m_loop;
  std::vector<std::int32_t> m_rank; // among the inner vertices, or -1
  std::size_t m_number_inside = 0;
  std::vector<double> m_angle_sum;
  std::vector<double> m_length;            // of the border edge that begins at a vertex
  Eigen::SparseMatrix<double> m_laplacian; // A_II, the lower triangle
  std::vector<Link> m_links;
  Factorization m_factorization;
};

inline void Border_first_flattening::assemble()
{
  typedef Eigen::Triplet<double> Entry;
  std::vector<Entry> entries;
  entries.reserve(6 * m_mesh.triangles.size());
  m_angle_sum.assign(m_mesh.points.size(), 0.);
  m_length.assign(m_mesh.points.size(), 0.);
  std::vector<std::uint32_t> next(m_mesh.points.size(), Surface_mesh_multiresolution::no_vertex);
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
        entries.push_back(Entry(i, i, w));
      if(j >= 0)
        entries.push_back(Entry(j, j, w));
      if(i >= 0 && j >= 0)
        entries.push_back(Entry((std::max)(i, j), (std::min)(i, j), -w));
      else if(i >= 0)
        m_links.push_back({i, q, -w});
      else if(j >= 0)
        m_links.push_back({j, p, -w});
    }
  }
  m_laplacian.resize(Eigen::Index(m_number_inside), Eigen::Index(m_number_inside));
  m_laplacian.setFromTriplets(entries.begin(), entries.end());
}

// How much the border curve turns at each vertex of the loop.
inline std::vector<double> Border_first_flattening::turning_angles()
{
  std::vector<double> k(m_mesh.points.size());
  Eigen::VectorXd defect(m_number_inside), u;
  for(std::size_t v = 0; v < k.size(); ++v)
    if(m_rank[v] >= 0)
      defect[m_rank[v]] = 2. * CGAL_PI - m_angle_sum[v];
    else
      k[v] = CGAL_PI - m_angle_sum[v];
  if(m_number_inside > 0) {
    u = m_factorization.solve(-defect);
    for(const Link& link : m_links)
      k[link.border] += link.value * u[link.inside];
  }
  std::vector<double> result;
  for(const auto v : m_loop)
    result.push_back(k[v]);
  return result;
}

// The closed curve with these turning angles. Its lengths l' minimise the sum of (l' - l)^2 / l.
inline void Border_first_flattening::lay_out_border(const std::vector<double>& turning,
                                                    Values& z) const
{
  const std::size_t n = m_loop.size();
  std::vector<Complex> step(n);
  double direction = 0., xx = 0., xy = 0., yy = 0.;
  Complex gap(0.);
  for(std::size_t i = 0; i < n; ++i) { // the edge from vertex i to the next one
    const double length = m_length[m_loop[i]];
    step[i] = std::polar(length, direction);
    direction += turning[(i + 1) % n];
    const Complex t = length > 0. ? step[i] / length : Complex(0.);
    gap += step[i];
    xx += length * t.real() * t.real();
    xy += length * t.real() * t.imag();
    yy += length * t.imag() * t.imag();
  }
  const double det = xx * yy - xy * xy;
  const double x = det > 0. ? (yy * gap.real() - xy * gap.imag()) / det : 0.;
  const double y = det > 0. ? (xx * gap.imag() - xy * gap.real()) / det : 0.;
  Complex place(0.);
  for(std::size_t i = 0; i < n; ++i) {
    z[m_loop[i]] = place;
    const double length = std::abs(step[i]);
    if(length > 0.)
      place += step[i] * (1. - (x * step[i].real() + y * step[i].imag()) / length);
  }
}

inline void Border_first_flattening::extend(Values& z)
{
  if(m_number_inside == 0)
    return;
  Eigen::MatrixX2d f = Eigen::MatrixX2d::Zero(Eigen::Index(m_number_inside), 2);
  for(const Link& link : m_links) {
    f(link.inside, 0) -= link.value * z[link.border].real();
    f(link.inside, 1) -= link.value * z[link.border].imag();
  }
  const Eigen::MatrixX2d x = m_factorization.solve(f);
  for(std::size_t v = 0; v < z.size(); ++v)
    if(m_rank[v] >= 0)
      z[v] = Complex(x(m_rank[v], 0), x(m_rank[v], 1));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_FIRST_FLATTENING_H
