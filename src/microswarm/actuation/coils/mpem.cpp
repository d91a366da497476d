// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/mpem.hpp"

#include <cmath>

#include "microswarm/actuation/coils/si.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::actuation {
namespace {

constexpr double m_per_um = 1e-6;

/// A vector field of degree k in r, r^k (f(c) u − g(c) z), c = cos θ = u·z, and its gradient. All
/// multipoles have this form.
struct Term {
  double coefficient = 0;
  int degree = 0;
  double f = 0, df = 0, g = 0, dg = 0;
};

void add(FieldGradient& sum, const Term& t, const Eigen::Vector3d& u, const Eigen::Vector3d& z,
         double r) {
  const double c = u.dot(z);
  const Eigen::Vector3d w = t.f * u - t.g * z;
  sum.field += t.coefficient * maths::power(r, t.degree) * w;
  if (t.degree == 0) return;  // uniform
  sum.gradient += t.coefficient * maths::power(r, t.degree - 1) *
                  (t.degree * w * u.transpose() + (t.df * u - t.dg * z) * (z - c * u).transpose() +
                   t.f * (Eigen::Matrix3d::Identity() - u * u.transpose()));
}

/// P_n, P_n' and P_n'' at c for n = 0 … order + 1, by P'_{n+1} = P'_{n−1} + (2n + 1) P_n.
struct Legendre {
  Legendre(std::size_t order, double c)
      : value(order + 2, 1), first(order + 2, 0), second(order + 2, 0) {
    value[1] = c;
    first[1] = 1;
    for (std::size_t n = 1; n <= order; ++n) {
      const double k = 2.0 * static_cast<double>(n) + 1;
      const double next = static_cast<double>(n) + 1;
      value[n + 1] = (k * c * value[n] - (next - 1) * value[n - 1]) / next;
      first[n + 1] = first[n - 1] + k * value[n];
      second[n + 1] = second[n - 1] + k * first[n];
    }
  }
  std::vector<double> value, first, second;
};

}  // namespace

FieldGradient multipole_field(const Multipole& source, const Eigen::Vector3d& position) {
  const Eigen::Vector3d off = m_per_um * position - source.position;
  const double r = off.norm();
  const Eigen::Vector3d& z = source.direction;
  const Eigen::Vector3d u = r > 0 ? Eigen::Vector3d(off / r) : z;
  const Legendre p(std::max(source.A.size(), source.B.size()), u.dot(z));
  FieldGradient sum;
  for (std::size_t i = 0; i < source.A.size(); ++i) {
    const std::size_t n = i + 1;  // −∇(rⁿ P_n) = rⁿ⁻¹ (P'_{n−1} u − P'_n z)
    if (source.A[i] == 0) continue;
    add(sum,
        {source.A[i], static_cast<int>(i), p.first[n - 1], p.second[n - 1], p.first[n],
         p.second[n]},
        u, z, r);
  }
  for (std::size_t i = 0; r > 0 && i < source.B.size(); ++i) {
    const std::size_t n = i + 1;  // −∇(P_n / rⁿ⁺¹) = (P'_{n+1} u − P'_n z) / rⁿ⁺²
    if (source.B[i] == 0) continue;
    add(sum,
        {source.B[i], -static_cast<int>(n) - 2, p.first[n + 1], p.second[n + 1], p.first[n],
         p.second[n]},
        u, z, r);
  }
  sum.field *= mt_per_t;
  sum.gradient *= mt_per_t * m_per_um;
  return sum;
}

FieldGradient field_at(const std::vector<Multipole>& sources, const Eigen::Vector3d& position) {
  FieldGradient sum;
  for (const Multipole& source : sources) sum += multipole_field(source, position);
  return sum;
}

bool MpemSystem::in_workspace(const Eigen::Vector3d& position) const {
  return (position.array() >= lo.array()).all() && (position.array() <= hi.array()).all();
}

}  // namespace microswarm::actuation
