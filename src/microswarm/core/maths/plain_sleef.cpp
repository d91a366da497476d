// SPDX-License-Identifier: Apache-2.0
// After SLEEF 3.5.1, © Naoki Shibata and contributors 2010-2020, Boost Software License 1.0.
#include "microswarm/core/maths/plain_sleef.hpp"

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

#include "microswarm/core/maths/double_pair.hpp"

namespace microswarm::maths::plain {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = 3.14159265358979323846;
constexpr double per_pi = 0.318309886183790671538;  // 1/π
// π and ln 2 in parts whose products with whole numbers are exact.
constexpr double pi_a = 3.1415926218032836914, pi_b = 3.1786509424591713469e-08;
constexpr double pi_c = 1.2246467864107188502e-16, pi_d = 1.2736634327021899816e-24;
constexpr double pi_high = 3.141592653589793116, pi_low = 1.2246467991473532072e-16;
constexpr double few_turns = 15, many_turns = 1e14;  // [rad]
constexpr double ln2_high = .69314718055966295651160180568695068359375;
constexpr double ln2_low = .28235290563031577122588448175013436025525412068e-12;
constexpr double per_ln2 = 1.442695040888963407359924681001892137426645954152985934135449406931;
constexpr double turn24 = 1 << 24;

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }
double from_bits(std::uint64_t x) { return std::bit_cast<double>(x); }
double flip_if(bool flips, double x) { return flips ? -x : x; }
double with_sign_of(double x, double of) { return flip_if(std::signbit(of), x); }

/// As x86 converts: the least integer for what is none.
std::int32_t to_int(double x) {
  return x > -2147483649.0 && x < 2147483648.0 ? static_cast<std::int32_t>(x)
                                               : std::numeric_limits<std::int32_t>::min();
}
std::int32_t round_to_int(double x) {
  x += x > 0 ? 0.5 : -0.5;
  return to_int(from_bits(bits(x) - static_cast<std::uint64_t>(1 & to_int(x))));
}
double rounded(double x) { return round_to_int(x); }
double truncated(double x) { return to_int(x); }

/// Polynomials by Estrin's scheme, from the highest coefficient; `x2` is x², and so on.
double poly(double x, double b, double a) { return x * b + a; }
double poly(double x, double x2, double c, double b, double a) { return x2 * c + poly(x, b, a); }
double poly(double x, double x2, double d, double c, double b, double a) {
  return x2 * poly(x, d, c) + poly(x, b, a);
}
/// Of eight coefficients.
double low(double x, const double (&c)[8]) {
  const double x2 = x * x;
  return x2 * x2 * poly(x, x2, c[0], c[1], c[2], c[3]) + poly(x, x2, c[4], c[5], c[6], c[7]);
}

double power_of_two(int q) { return from_bits(static_cast<std::uint64_t>(q + 0x3ff) << 52); }
double times_power(double x, int e) {
  return x * power_of_two(e >> 1) * power_of_two(e - (e >> 1));
}
int exponent(double x) { return static_cast<int>(bits(x) >> 52 & 0x7ff) - 0x3ff; }
double add_to_exponent(double x, int q) {
  return from_bits(bits(x) + (static_cast<std::uint64_t>(static_cast<std::int64_t>(q)) << 52));
}

double sine_of_rest(Pair rest) {
  const Pair s = squared(rest);
  const double s2 = s.x * s.x;
  double u = s2 * s2 * poly(s.x, 2.72052416138529567917983e-15, -7.6429259411395447190023e-13) +
             poly(s.x, s2, 1.60589370117277896211623e-10, -2.5052106814843123359368e-08,
                  2.75573192104428224777379e-06, -0.000198412698412046454654947);
  u = u * s.x + 0.00833333333333318056201922;
  return product(rest, add(1, multiply(add(-0.166666666666666657414808, u * s.x), s)));
}

/// Adds −π in parts, times `high` and `low` and divided by `by`.
Pair reduced(double angle, double high, double low, double by) {
  Pair s = by == 1 ? add(high * -pi_a + angle, low * -pi_a)
                   : add_any(high * (-pi_a * by) + angle, low * (-pi_a * by));
  s = add_any(s, high * (-pi_b * by));
  s = add_any(s, low * (-pi_b * by));
  s = add_any(s, high * (-pi_c * by));
  s = add_any(s, low * (-pi_c * by));
  return add(s, (high + low) * (-pi_d * by));
}

/// exp(s) − 1 for small s, except its first two terms.
constexpr double exp_terms[8] = {2.75573911234900471893338e-07, 2.75572362911928827629423e-06,
                                 2.4801587159235472998791e-05,  0.000198412698960509205564975,
                                 0.00138888888889774492207962,  0.00833333333331652721664984,
                                 0.0416666666666665047591422,   0.166666666666666851703837};

/// exp of a pair, as a pair.
Pair exp_pair(Pair d) {
  const double dq = rounded(d.sum() * per_ln2);
  const int q = round_to_int(dq);
  const Pair s = add_any(add_any(d, dq * -ln2_high), dq * -ln2_low);
  const Pair s2 = squared(s), s4 = squared(s2);
  const double u = s4.x * s4.x * poly(s.x, 0.1602472219709932072e-9, 0.2092255183563157007e-8) +
                   (s4.x * poly(s.x, s2.x, 0.2505230023782644465e-7, 0.2755724800902135303e-6,
                                0.2755731892386044373e-5, 0.2480158735605815065e-4) +
                    poly(s.x, s2.x, 0.1984126984148071858e-3, 0.1388888888886763255e-2,
                         0.8333333333333347095e-2, 0.4166666666666669905e-1));
  Pair t = add(0.5, multiply(s, 0.1666666666666666574e+0));
  t = add(1.0, multiply(t, s));
  t = add(1.0, multiply(t, s));
  t = add(t, multiply(s4, u));
  if (d.x < -1000) return {};
  return {times_power(t.x, q), times_power(t.y, q)};
}

/// A positive number as m 2^e.
struct Parts {
  double m;
  int e;
};
Parts parts(double d) {
  const bool tiny = d < DBL_MIN;
  if (tiny) d *= 0x1p64;
  const int e = exponent(d * (1.0 / 0.75));
  return {add_to_exponent(d, -e), tiny ? e - 64 : e};
}

constexpr Pair ln2{0.693147180559945286226764, 2.319046813846299558417771e-17};

/// Logarithm of 1 + 2 x + …, of the series with these coefficients, from e logarithms of 2 and
/// `twice` x.
double log_sum(int e, Pair x, Pair of_two, Pair twice, const double (&c)[7]) {
  const double x2 = x.x * x.x, x4 = x2 * x2;
  const double t = x4 * x4 * poly(x2, x4, c[0], c[1], c[2]) + poly(x2, x4, c[3], c[4], c[5], c[6]);
  const Pair s = add(multiply(of_two, static_cast<double>(e)), twice);
  return add(s, x2 * x.x * t).sum();
}
constexpr double log_terms[7] = {0.1532076988502701353e+0, 0.1525629051003428716e+0,
                                 0.1818605932937785996e+0, 0.2222214519839380009e+0,
                                 0.2857142932794299317e+0, 0.3999999999635251990e+0,
                                 0.6666666666667333541e+0};

double of_logarithm(double d, double r) {
  if (d == infinity) return infinity;
  if (d < 0 || std::isnan(d)) return not_a_number;
  return d == 0 ? -infinity : r;
}

Pair log_pair(double d) {
  const auto [m, e] = parts(d);
  Pair x = divide(add_any(-1, m), add_any(1, m));
  const Pair x2 = squared(x);
  const double x4 = x2.x * x2.x, x8 = x4 * x4, x16 = x8 * x8;
  const double t = x16 * 0.116255524079935043668677 +
                   (x8 * poly(x2.x, x4, 0.103239680901072952701192, 0.117754809412463995466069,
                              0.13332981086846273921509, 0.153846227114512262845736) +
                    poly(x2.x, x4, 0.181818180850050775676507, 0.222222222230083560345903,
                         0.285714285714249172087875, 0.400000000000000077715612));
  Pair s = add(multiply(ln2, static_cast<double>(e)), scaled(x, 2));
  x = multiply(x2, x);
  s = add(s, multiply(x, Pair{0.666666666666666629659233, 3.80554962542412056336616e-17}));
  x = multiply(x2, x);
  return add(s, multiply(x, t));
}

double exp_of(Pair d) {
  const double dq = rounded(d.sum() * per_ln2);
  const int q = round_to_int(dq);
  const Pair s = normalised(add_any(add_any(d, dq * -ln2_high), dq * -ln2_low));
  const double s2 = s.x * s.x, s4 = s2 * s2;
  const double u =
      s4 * s4 * poly(s.x, 2.51069683420950419527139e-08, 2.76286166770270649116855e-07) +
      low(s.x,
          {2.75572496725023574143864e-06, 2.48014973989819794114153e-05,
           0.000198412698809069797676111, 0.0013888888939977128960529, 0.00833333333332371417601081,
           0.0416666666665409524128449, 0.166666666666666740681535, 0.500000000000000999200722});
  const Pair t = add(add(1, s), multiply(squared(s), u));
  return d.x < -1000 ? 0 : times_power(t.sum(), q);
}

double arcsine_terms(double x2) {
  const double x4 = x2 * x2, x8 = x4 * x4;
  return x8 * x8 *
             poly(x2, x4, 0.3161587650653934628e-1, -0.1581918243329996643e-1,
                  0.1929045477267910674e-1, 0.6606077476277170610e-2) +
         low(x2, {0.1215360525577377331e-1, 0.1388715184501609218e-1, 0.1735956991223614604e-1,
                  0.2237176181932048341e-1, 0.3038195928038132237e-1, 0.4464285681377102438e-1,
                  0.7500000000378581611e-1, 0.1666666666666497543e+0});
}

/// x² and x of an arc sine, and the sum of its further terms.
struct Arc {
  bool small;
  Pair x;
  double u;
};
Arc arc(double d) {
  const double size = std::abs(d);
  const bool small = size < 0.5;
  const double x2 = small ? d * d : (1 - size) * 0.5;
  const Pair x = size == 1 ? Pair{} : small ? Pair{size, 0} : root(x2);
  return {small, x, arcsine_terms(x2) * (x2 * x.x)};
}

Pair arctangent(Pair y, Pair x) {
  int q = std::signbit(x.x) ? -2 : 0;
  if (x.x < 0) x = -x;
  const bool steep = x.x < y.x;
  q += steep;
  const Pair s = steep ? divide(-x, y) : divide(y, x);
  Pair t = normalised(squared(s));
  const double t2 = t.x * t.x, t4 = t2 * t2, t8 = t4 * t4;
  double u = t8 * low(t.x, {1.06298484191448746607415e-05, -0.000125620649967286867384336,
                            0.00070557664296393412389774, -0.00251865614498713360352999,
                            0.00646262899036991172313504, -0.0128281333663399031014274,
                            0.0208024799924145797902497, -0.0289002344784740315686289}) +
             low(t.x, {0.0359785005035104590853656, -0.041848579703592507506027,
                       0.0470843011653283988193763, -0.0524914210588448421068719,
                       0.0587946590969581003860434, -0.0666620884778795497194182,
                       0.0769225330296203768654095, -0.0909090442773387574781907});
  u = u * t.x + 0.111111108376896236538123;
  u = u * t.x + -0.142857142756268568062339;
  u = u * t.x + 0.199999999997977351284817;
  u = u * t.x + -0.333333333333317605173818;
  t = add(s, multiply(multiply(s, t), u));
  return add(multiply(Pair{1.570796326794896557998982, 6.12323399573676603586882e-17}, q), t);
}

}  // namespace

double sin(double d) {
  if (!(std::abs(d) < many_turns)) return std::isfinite(d) ? std::sin(d) : not_a_number;
  double q = rounded(d * per_pi);
  Pair rest;
  if (std::abs(d) < few_turns) {
    rest = add(q * -pi_high + d, q * -pi_low);
  } else {
    const double high = truncated(d * (per_pi / turn24)) * turn24;
    q = rounded(d * per_pi - high);
    rest = reduced(d, high, q, 1);
  }
  return d == 0 ? d : flip_if((round_to_int(q) & 1) == 1, sine_of_rest(rest));
}

double cos(double d) {
  if (!(std::abs(d) < many_turns)) return std::isfinite(d) ? std::cos(d) : not_a_number;
  double q = 2 * rounded(d * per_pi + -0.5) + 1;
  Pair rest;
  if (std::abs(d) < few_turns) {
    rest = add(add_any(d, q * (-pi_high * 0.5)), q * (-pi_low * 0.5));
  } else {
    double high = truncated(d * (per_pi / (1 << 23)) + -per_pi / turn24);
    q = 2 * rounded(d * per_pi + (high * -(1 << 23) + -0.5)) + 1;
    high *= turn24;
    rest = reduced(d, high, q, 0.5);
  }
  return flip_if((round_to_int(q) & 2) == 0, sine_of_rest(rest));
}

void sincos(double d, double& sine, double& cosine) {
  if (!(std::abs(d) < many_turns)) {
    sine = sin(d), cosine = cos(d);
    return;
  }
  double q = rounded(d * (2 * per_pi));
  Pair t;
  if (std::abs(d) < few_turns) {
    t = add(q * (-pi_high * 0.5) + d, q * (-pi_low * 0.5));
  } else {
    const double high = truncated(d * (2 * per_pi / turn24)) * turn24;
    q = rounded(d * (2 * per_pi) - high);
    t = add(high * (-pi_a * 0.5) + d, q * (-pi_a * 0.5));
    t = add_any(t, high * (-pi_b * 0.5));
    t = add_any(t, q * (-pi_b * 0.5));
    t = add_any(t, high * (-pi_c * 0.5));
    t = add_any(t, q * (-pi_c * 0.5));
    t = add(t, (high + q) * (-pi_d * 0.5));
  }
  const double s = square(t);
  double u = 1.58938307283228937328511e-10;
  for (const double c :
       {-2.50506943502539773349318e-08, 2.75573131776846360512547e-06,
        -0.000198412698278911770864914, 0.0083333333333191845961746, -0.166666666666666130709393})
    u = u * s + c;
  const double rise = d == 0 ? d : add(t, u * (s * t.x)).sum();
  u = -1.13615350239097429531523e-11;
  for (const double c : {2.08757471207040055479366e-09, -2.75573144028847567498567e-07,
                         2.48015872890001867311915e-05, -0.00138888888888714019282329,
                         0.0416666666666665519592062, -0.5})
    u = u * s + c;
  const double run = add(1, multiply(s, u)).sum();
  const int quarter = round_to_int(q);
  sine = flip_if((quarter & 2) == 2, (quarter & 1) == 0 ? rise : run);
  cosine = flip_if(((quarter + 1) & 2) == 2, (quarter & 1) == 0 ? run : rise);
}

double asin(double d) {
  const Arc a = arc(d);
  const Pair y = subtract(subtract(Pair{pi_high / 4, pi_low / 4}, a.x), a.u);
  return with_sign_of(a.small ? a.u + a.x.x : y.sum() * 2, d);
}

double acos(double d) {
  const Arc a = arc(d);
  Pair y = a.small ? subtract(Pair{pi_high / 2, pi_low / 2},
                              add(with_sign_of(a.x.x, d), with_sign_of(a.u, d)))
                   : scaled(add(a.x, a.u), 2);
  if (!a.small && d < 0) y = subtract(Pair{pi_high, pi_low}, y);
  return y.sum();
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return not_a_number;
  if (std::abs(x) < 5.5626846462680083984e-309) x *= 0x1p53, y *= 0x1p53;
  double r = with_sign_of(arctangent({std::abs(y), 0}, {x, 0}).sum(), x);
  const auto of_infinite = [&](double angle) { return std::isinf(x) ? with_sign_of(angle, x) : 0; };
  if (std::isinf(x) || x == 0) r = pi / 2 - of_infinite(pi / 2);
  if (std::isinf(y)) r = pi / 2 - of_infinite(pi / 4);
  if (y == 0) r = std::signbit(x) ? pi : 0;
  return with_sign_of(r, y);
}

double exp(double d) {
  double u = rounded(d * per_ln2);
  const int q = round_to_int(u);
  const double s = u * -ln2_low + (u * -ln2_high + d);
  const double s2 = s * s, s4 = s2 * s2;
  u = s4 * s4 * poly(s, 2.08860621107283687536341e-09, 2.51112930892876518610661e-08) +
      low(s, exp_terms);
  u = u * s + 0.5;
  u = times_power(1 + (s * s * u + s), q);
  if (d > 709.78271114955742909217217426) return infinity;
  return d < -1000 ? 0 : u;
}

double expm1(double d) {
  if (d > 709.782712893383996732223) return infinity;
  if (d < -36.736800569677101399113302437) return -1;
  if (d == 0) return d;
  return add_any(exp_pair({d, 0}), -1.0).sum();
}

double log(double d) {
  const auto [m, e] = parts(d);
  const Pair x = divide(add_any(-1, m), add_any(1, m));
  return of_logarithm(d, log_sum(e, x, ln2, scaled(x, 2), log_terms));
}

double log1p(double d) {
  if (d > 1e307) return infinity;
  if (d < -1 || std::isnan(d)) return not_a_number;
  if (d == -1) return -infinity;
  if (d == 0) return d;
  const auto [unused, e] = parts(d + 1);
  const double t = add_to_exponent(1, -e);
  const double m = d * t + (t - 1);
  const Pair x = divide({m, 0}, add(2, m));
  return log_sum(e, x, ln2, scaled(x, 2), log_terms);
}

double log10(double d) {
  const auto [m, e] = parts(d);
  const Pair x = divide(add_any(-1, m), add_any(1, m));
  constexpr double terms[7] = {0.6653725819576758460e-1, 0.6625722782820833712e-1,
                               0.7898105214313944078e-1, 0.9650955035715275132e-1,
                               0.1240841409721444993e+0, 0.1737177927454605086e+0,
                               0.2895296546021972617e+0};
  const Pair twice = multiply(x, Pair{0.86858896380650363334, 1.1430059694096389311e-17});
  return of_logarithm(
      d, log_sum(e, x, {0.30102999566398119802, -2.803728127785170339e-18}, twice, terms));
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y)) return not_a_number;
  const bool whole = std::trunc(y) == y || std::isinf(y);
  const bool odd = whole && std::abs(y) < 0x1p53 && std::fmod(y, 2) != 0;
  const double sign = odd && std::signbit(x) ? -1 : 1;
  if (std::isinf(x) || x == 0) return sign * ((x == 0 ? -y : y) < 0 ? 0 : infinity);
  if (std::isinf(y)) {
    const double grows = with_sign_of(std::abs(x) - 1, y);
    return grows < 0 ? 0 : grows == 0 ? 1 : infinity;
  }
  const Pair d = multiply(log_pair(std::abs(x)), y);
  const double size = d.x > 709.78271114955742909217217426 ? infinity : exp_of(d);
  return x > 0 ? size : whole ? size * sign : not_a_number;
}

double tanh(double x) {
  if (std::isnan(x)) return not_a_number;
  const Pair d = exp_pair({std::abs(x), 0}), e = reciprocal(d);
  const double y = divide(add_any(d, -e), add_any(d, e)).sum();
  return with_sign_of(std::abs(x) > 18.714973875 || std::isnan(y) ? 1 : y, x);
}

}  // namespace microswarm::maths::plain
