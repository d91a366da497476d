// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/current_loop.hpp"

#include <algorithm>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::actuation {
namespace {

/// Complete elliptic integral of the second kind E(m) of the parameter m, and
/// G(m) = (K − (2 − m) D) / m with D = (K − E) / m, which is smooth at m = 0.
struct Elliptic {
  double E = 0;
  double G = 0;
  double dG = 0;  ///< dG/dm
};

/// Sums G = Σ g_n mⁿ from the series of K and E; exact to rounding for m < 0.1.
Elliptic by_series(double m) {
  Elliptic sum;
  double c = 1;      // (2n−1)!! / (2n)!!
  double power = 1;  // mⁿ
  double below = 0;  // mⁿ⁻¹
  for (int n = 0; n < 18; ++n) {
    const double c1 = c * (2 * n + 1) / (2 * n + 2);
    const double c2 = c1 * (2 * n + 3) / (2 * n + 4);
    const double d = c * c1;
    const double d1 = c1 * c2;
    const double g = c1 * c1 - 2 * d1 + d;
    sum.E += c * c / (1 - 2 * n) * power;
    sum.G += g * power;
    sum.dG += n * g * below;
    c = c1;
    below = power;
    power *= m;
  }
  return {0.5 * pi * sum.E, 0.5 * pi * sum.G, 0.5 * pi * sum.dG};
}

/// `rest` is 1 − m, passed separately because it may be tiny.
Elliptic elliptic(double m, double rest) {
  if (m < 0.1) return by_series(m);
  const double K = boost::math::ellint_rf(0.0, rest, 1.0);
  const double D = boost::math::ellint_rd(0.0, rest, 1.0) / 3;
  const double G = (K - (2 - m) * D) / m;
  const double slope_k = (K - D) / (2 * rest);
  const double slope_d = (slope_k - 0.5 * D) / m;
  return {K - m * D, G, (slope_k + D - (2 - m) * slope_d - G) / m};
}

}  // namespace

FieldGradient loop_field(const CurrentLoop& loop, const Eigen::Vector3d& position) {
  const double a = loop.radius;
  const Eigen::Vector3d off = position - loop.centre;
  const double z = off.dot(loop.axis);
  const Eigen::Vector3d across = off - z * loop.axis;  // ρ times its direction
  const double rho = across.norm();

  // With the minimum and maximum distances α, β to the wire, m = 4aρ/β² = 1 − α²/β²:
  //   B_z = Q (E − ρ² H),  B_ρ = Q ρ z H,  Q = µ0 a² / (π α² β),  H = 4 G / β².
  const double beta2 = (a + rho) * (a + rho) + z * z;
  const double alpha2 = std::max((a - rho) * (a - rho) + z * z, 1e-12 * a * a);
  const double beta = std::sqrt(beta2);
  const double m = std::min(4 * a * rho / beta2, 1 - alpha2 / beta2);
  const auto [E, G, dG] = elliptic(m, alpha2 / beta2);
  const double Q = loop.turns * mu_0 * a * a / (pi * alpha2 * beta);
  const double H = 4 * G / beta2;
  const double h = Q * z * H;  // B_ρ / ρ

  // h = 4 µ0 a² z G / (π α² β³), so its derivatives follow from those of α², β and G.
  const double q = 4 * Q / beta2;
  const double dm_drho = (4 * a - 2 * m * (rho + a)) / beta2;
  const double dm_dz = -2 * m * z / beta2;
  const double dh_drho =
      q * z * (dG * dm_drho - G * (2 * (rho - a) / alpha2 + 3 * (rho + a) / beta2));
  const double dh_dz = q * (G + z * (dG * dm_dz - G * z * (2 / alpha2 + 3 / beta2)));

  const Eigen::Vector3d out = rho > 0 ? Eigen::Vector3d(across / rho) : Eigen::Vector3d::Zero();
  FieldGradient result;
  result.field = Q * (E - rho * rho * H) * loop.axis + h * across;
  const Eigen::Matrix3d along = loop.axis * loop.axis.transpose();
  const double spread = rho * dh_drho;
  result.gradient = h * (Eigen::Matrix3d::Identity() - along) + spread * out * out.transpose() -
                    (2 * h + spread) * along +
                    dh_dz * (across * loop.axis.transpose() + loop.axis * across.transpose());
  return result;
}

}  // namespace microswarm::actuation
