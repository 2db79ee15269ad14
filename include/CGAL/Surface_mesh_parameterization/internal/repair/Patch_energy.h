// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_PATCH_ENERGY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_PATCH_ENERGY_H

#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The energy of one triangle as a function of x = |h| = s1 + s2 and y = |g| = s1 - s2 (s1 and s2 the
// singular values, s2 negative on a flipped triangle; D = (x^2 - y^2) / 4 the determinant)
//
//   f = 1/2 c y^2 + 1/2 m y^2 / chi(D) + 1/2 a (1 + D^2) / chi(D),
//   chi(D) = (D + R) / 2,  R = sqrt(D^2 + eps^2),
//
// and its derivatives. The first term is the conformal energy. The second one is 0 for
// similarities, too, and is large near and below D = 0; the third one holds D near 1, lest
// triangles shrink to points together. With eps > 0 all are finite for all maps, and their
// minimisers untangle as eps tends to 0 (Garanzha et al. 2021); with eps = 0 they are barriers,
// since chi(D) = D.
struct Energy_terms
{
  double conformal; // c
  double barrier;   // m
  double area;      // a
  double epsilon;
};

struct Triangle_energy
{
  double f, f_x, f_y;
  double f_xx, f_xy, f_yy;   // projected to a positive semidefinite matrix
  double across_h, across_g; // second derivatives across h and g: f_x / x and f_y / y, if positive

  Triangle_energy(double x, double y, double d, const Energy_terms& terms)
  {
    const double c = terms.conformal, m = terms.barrier, a = terms.area, eps = terms.epsilon;
    const double y2 = y * y, root = eps > 0. ? std::hypot(d, eps) : d;
    // no difference that cancels
    const double chi = d > 0. ? 0.5 * (d + root) : 0.5 * eps * eps / (root - d);
    const double r = 1. / (chi * root); // chi' / chi^2, as chi' = chi / R; and its derivative:
    const double dr = (0.5 * eps * eps / (root * chi) - 2.) / (root * root * chi);
    f = 0.5 * (c * y2 + (m * y2 + a * (1. + d * d)) / chi);
    // of f with y^2 fixed, by D
    const double f_d = -0.5 * (m * y2 + a * (1. + d * d)) * r + a * d / chi;
    const double f_dd = -0.5 * (m * y2 + a * (1. + d * d)) * dr + a * (1. / chi - 2. * d * r);
    const double along_y = c + m / chi;
    across_h = 0.5 * f_d; // D_x = x / 2, D_y = -y / 2
    across_g = along_y - 0.5 * f_d;
    f_x = x * across_h;
    f_y = y * across_g;
    f_xx = across_h + 0.25 * x * x * f_dd;
    f_xy = -0.25 * x * y * f_dd - 0.5 * m * x * y * r;
    f_yy = across_g + 0.25 * y2 * f_dd + m * y2 * r;
    across_h = (std::max)(0., across_h);
    across_g = (std::max)(0., across_g);
    project();
  }

private:
  // Sets a negative eigenvalue of the 2 x 2 matrix to 0.
  void project()
  {
    const double mean = 0.5 * (f_xx + f_yy), half = 0.5 * (f_xx - f_yy);
    const double radius = std::hypot(half, f_xy);
    if(mean - radius >= 0. || !(radius > 0.))
      return;
    const double top = (std::max)(0., mean + radius);
    // top times the projector (1 + (half, f_xy) / radius) / 2
    const double cosine = half / radius, sine = f_xy / radius;
    f_xx = 0.5 * top * (1. + cosine);
    f_yy = 0.5 * top * (1. - cosine);
    f_xy = 0.5 * top * sine;
  }
};

// A triangle of a patch: places of its corners among the values of the patch, of which the first
// ones are free, and the coefficients of the derivatives of a map on it.
struct Patch_triangle
{
  typedef std::complex<double> Complex;

  std::array<std::uint32_t, 3> corner;
  std::array<Complex, 3> w; // g = sum w_j z_j, h = sum conj(w_j) z_j; W_j / 2A
  double area;
  double weight; // of its conformal energy

  Patch_triangle(const std::array<std::uint32_t, 3>& places, const Conformal_triangle& shape,
                 double energy_weight)
    : corner(places), area(shape.area()), weight(energy_weight)
  {
    w[1] = shape.antiholomorphic_derivative({Complex(0.), Complex(1.), Complex(0.)});
    w[2] = shape.antiholomorphic_derivative({Complex(0.), Complex(0.), Complex(1.)});
    w[0] = -(w[1] + w[2]);
  }
};

// The energy of the triangles of a patch as a function of its free values; the others are fixed.
class Patch_energy
{
public:
  typedef std::complex<double> Complex;
  typedef std::vector<Complex> Values;
  typedef Eigen::SparseMatrix<double> Matrix;

  // The first `number_free` values are free.
  Patch_energy(std::vector<Patch_triangle> triangles, std::size_t number_free)
    : m_triangles(std::move(triangles)), m_free(number_free)
  {}

  // The same with equilateral triangles of the same areas.
  Patch_energy with_equal_angles() const;

  std::size_t number_free() const { return m_free; }

  double value(const Values& z, const Energy_terms& terms) const;

  // The gradient, real and imaginary parts in turn, and the lower triangle of a positive
  // semidefinite approximation of the Hessian.
  void differentiate(const Values& z, const Energy_terms& terms, Eigen::VectorXd& gradient,
                     Matrix& hessian) const;

  // The sum of the conformal energies, with their weights.
  double conformal_energy(const Values& z) const
  {
    return value(z, Energy_terms{1., 0., 0., 1.});
  }

  double least_determinant(const Values& z) const;

  // The greatest t up to which no triangle of z + t d loses its positive area; infinity if none
  // does.
  double first_flip(const Values& z, const Values& d) const;

  // The area of the image to that of the surface, signs disregarded.
  double area_scale(const Values& z) const;

private:
  static double cross(const Complex& a, const Complex& b)
  {
    return a.real() * b.imag() - a.imag() * b.real();
  }

  // Derivatives of z on a triangle
  struct Jacobian
  {
    Complex h, g;
    double determinant;

    Jacobian(const Patch_triangle& t, const Values& z)
    {
      const Complex b = z[t.corner[1]] - z[t.corner[0]], c = z[t.corner[2]] - z[t.corner[0]];
      h = std::conj(t.w[1]) * b + std::conj(t.w[2]) * c;
      g = t.w[1] * b + t.w[2] * c;
      determinant = 0.5 * cross(b, c) / t.area; // (|h|^2 - |g|^2) / 4 would cancel
    }
  };

  static Energy_terms weighted(const Patch_triangle& t, const Energy_terms& terms)
  {
    return {terms.conformal * t.weight * t.area, terms.barrier * t.area, terms.area * t.area,
            terms.epsilon};
  }

  typedef Eigen::Matrix<double, 4, 6> Chain;
  static Chain chain(const Patch_triangle& t);
  static Eigen::Matrix4d second_derivatives(const Triangle_energy& e, const Complex& h,
                                            const Complex& g);

  std::vector<Patch_triangle> m_triangles;
  std::size_t m_free;
};

inline Patch_energy Patch_energy::with_equal_angles() const
{
  typedef Conformal_triangle::Point_3 Point_3;
  std::vector<Patch_triangle> equilateral;
  for(const Patch_triangle& t : m_triangles) {
    const double side = std::sqrt(4. / std::sqrt(3.) * t.area), height = 2. * t.area / side;
    const Conformal_triangle shape(Point_3(0., 0., 0.), Point_3(side, 0., 0.),
                                   Point_3(0.5 * side, height, 0.));
    equilateral.push_back(Patch_triangle(t.corner, shape, t.weight));
  }
  return Patch_energy(std::move(equilateral), m_free);
}

inline double Patch_energy::value(const Values& z, const Energy_terms& terms) const
{
  double sum = 0.;
  for(const Patch_triangle& t : m_triangles) {
    const Jacobian j(t, z);
    if(terms.epsilon == 0. && !(j.determinant > 0.))
      return std::numeric_limits<double>::infinity();
    sum += Triangle_energy(std::abs(j.h), std::abs(j.g), j.determinant, weighted(t, terms)).f;
  }
  return sum;
}

// d(re h, im h, re g, im g) / d(re z_0, im z_0, ...)
inline Patch_energy::Chain Patch_energy::chain(const Patch_triangle& t)
{
  Chain m;
  for(int j = 0; j < 3; ++j) {
    const double re = t.w[j].real(), im = t.w[j].imag();
    m.block<4, 2>(0, 2 * j) << re, im, -im, re, re, -im, im, re;
  }
  return m;
}

// In the directions of h and g and across them the matrix is known.
inline Eigen::Matrix4d Patch_energy::second_derivatives(const Triangle_energy& e, const Complex& h,
                                                        const Complex& g)
{
  const auto direction = [](const Complex& c) {
    const double length = std::abs(c);
    return length > 0. ? Eigen::Vector2d(c.real() / length, c.imag() / length)
                       : Eigen::Vector2d(1., 0.);
  };
  const Eigen::Vector2d along_h = direction(h), along_g = direction(g);
  const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
  Eigen::Matrix4d k;
  k.topLeftCorner<2, 2>()
    = e.across_h * identity + (e.f_xx - e.across_h) * along_h * along_h.transpose();
  k.bottomRightCorner<2, 2>()
    = e.across_g * identity + (e.f_yy - e.across_g) * along_g * along_g.transpose();
  k.topRightCorner<2, 2>() = e.f_xy * along_h * along_g.transpose();
  k.bottomLeftCorner<2, 2>() = k.topRightCorner<2, 2>().transpose();
  return k;
}

inline void Patch_energy::differentiate(const Values& z, const Energy_terms& terms,
                                        Eigen::VectorXd& gradient, Matrix& hessian) const
{
  typedef Eigen::Triplet<double> Triplet;
  const Eigen::Index size = Eigen::Index(2 * m_free);
  gradient = Eigen::VectorXd::Zero(size);
  std::vector<Triplet> entries;
  entries.reserve(21 * m_triangles.size());
  for(const Patch_triangle& t : m_triangles) {
    const Jacobian j(t, z);
    const double x = std::abs(j.h), y = std::abs(j.g);
    const Triangle_energy e(x, y, j.determinant, weighted(t, terms));
    const Complex at_h = x > 0. ? e.f_x / x * j.h : Complex(0.);
    const Complex at_g = y > 0. ? e.f_y / y * j.g : Complex(0.);
    const Chain m = chain(t);
    const Eigen::Matrix<double, 6, 1> local_gradient
      = m.transpose() * Eigen::Vector4d(at_h.real(), at_h.imag(), at_g.real(), at_g.imag());
    const Eigen::Matrix<double, 6, 6> local
      = m.transpose() * second_derivatives(e, j.h, j.g) * m;
    const auto place = [&t](int i) { return Eigen::Index(2 * t.corner[i / 2] + i % 2); };
    for(int i = 0; i < 6; ++i) {
      if(place(i) >= size)
        continue;
      gradient[place(i)] += local_gradient[i];
      for(int k = 0; k < 6; ++k)
        if(place(k) <= place(i))
          entries.push_back(Triplet(int(place(i)), int(place(k)), local(i, k)));
    }
  }
  hessian.resize(size, size);
  hessian.setFromTriplets(entries.begin(), entries.end());
}

inline double Patch_energy::least_determinant(const Values& z) const
{
  double least = std::numeric_limits<double>::infinity();
  for(const Patch_triangle& t : m_triangles)
    least = (std::min)(least, Jacobian(t, z).determinant);
  return least;
}

// Twice the area is a t^2 + b t + c with c > 0.
inline double Patch_energy::first_flip(const Values& z, const Values& d) const
{
  double first = std::numeric_limits<double>::infinity();
  for(const Patch_triangle& t : m_triangles) {
    const auto side = [&t](const Values& v, int i) { return v[t.corner[i]] - v[t.corner[0]]; };
    const double a = cross(side(d, 1), side(d, 2)), c = cross(side(z, 1), side(z, 2));
    const double b = cross(side(z, 1), side(d, 2)) + cross(side(d, 1), side(z, 2));
    const double discriminant = b * b - 4. * a * c;
    if(discriminant < 0. || (a >= 0. && b >= 0.))
      continue; // no root, or none that is positive
    const double root = std::sqrt(discriminant);
    const double time = b < 0. ? 2. * c / (root - b) : -0.5 * (b + root) / a; // the first one
    if(time > 0.)
      first = (std::min)(first, time);
  }
  return first;
}

inline double Patch_energy::area_scale(const Values& z) const
{
  double image = 0., surface = 0.;
  for(const Patch_triangle& t : m_triangles) {
    image += std::fabs(Jacobian(t, z).determinant) * t.area;
    surface += t.area;
  }
  return image / surface;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_PATCH_ENERGY_H
