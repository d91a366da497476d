// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/plain_sleef.hpp"

#include <gtest/gtest.h>
#include <sleef.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/rng.hpp"

namespace microswarm {
namespace {

namespace plain = maths::plain;

/// Equal bits, or both no number.
bool has_same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

void expect_sleef(double x, double y) {
  SCOPED_TRACE(testing::Message() << std::hexfloat << x << ' ' << y);
  if (!std::isfinite(x) || std::abs(x) < 1e14) {
    EXPECT_TRUE(has_same_bits(plain::sin(x), Sleef_cinz_sind1_u10purec(x)));
    EXPECT_TRUE(has_same_bits(plain::cos(x), Sleef_cinz_cosd1_u10purec(x)));
    const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(x);
    double sine = 0, cosine = 0;
    plain::sincos(x, sine, cosine);
    EXPECT_TRUE(has_same_bits(sine, both.x));
    EXPECT_TRUE(has_same_bits(cosine, both.y));
  }
  EXPECT_TRUE(has_same_bits(plain::asin(x), Sleef_cinz_asind1_u10purec(x)));
  EXPECT_TRUE(has_same_bits(plain::acos(x), Sleef_cinz_acosd1_u10purec(x)));
  EXPECT_TRUE(has_same_bits(plain::atan2(y, x), Sleef_cinz_atan2d1_u10purec(y, x)));
  EXPECT_TRUE(has_same_bits(plain::exp(x), Sleef_cinz_expd1_u10purec(x)));
  EXPECT_TRUE(has_same_bits(plain::expm1(x), Sleef_cinz_expm1d1_u10purec(x)));
  EXPECT_TRUE(has_same_bits(plain::log(x), Sleef_cinz_logd1_u10purec(x)));
  EXPECT_TRUE(has_same_bits(plain::log1p(x), Sleef_cinz_log1pd1_u10purec(x)));
  EXPECT_TRUE(has_same_bits(plain::log10(x), Sleef_cinz_log10d1_u10purec(x)));
  EXPECT_TRUE(has_same_bits(plain::pow(x, y), Sleef_cinz_powd1_u10purec(x, y)));
  EXPECT_TRUE(has_same_bits(plain::tanh(x), Sleef_cinz_tanhd1_u10purec(x)));
}

TEST(PlainSleef, HasTheBitsOfSleefAtSpecialValues) {
  const double values[] = {0,   0.5,   1,      2,      3,      15,   710,      745.2,
                           1e3, 1e308, 1e-308, 5e-324, 0x1p53, 1e13, infinity, std::nan("")};
  for (const double x : values)
    for (const double y : values)
      for (const int signs : {0, 1, 2, 3})
        expect_sleef((signs & 1) != 0 ? -x : x, (signs & 2) != 0 ? -y : y);
}

TEST(PlainSleef, HasTheBitsOfSleefAtRandomValues) {
  Rng rng(1, Purpose::test);
  for (int i = 0; i < 20'000; ++i) {
    const double share = rng.uniform(-1, 1), some = rng.uniform(-20, 20);
    const double many = rng.uniform(-1000, 1000), size = std::exp2(rng.uniform(-300, 300));
    expect_sleef(share, some);
    expect_sleef(some, many);
    expect_sleef(many, share);
    expect_sleef(size, 3 * share);
    expect_sleef(-size, size);
    expect_sleef(std::abs(some), some);
    expect_sleef(std::round(some) * 1.5707963267948966 + 1e-5 * share, std::round(some));
    expect_sleef(std::bit_cast<double>(rng.bits()), std::bit_cast<double>(rng.bits()));
  }
}

}  // namespace
}  // namespace microswarm
