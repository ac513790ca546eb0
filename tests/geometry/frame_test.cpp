#include "interpreter/geometry/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/random.h"

namespace isocnc::geometry {
namespace {

using support::Random;

Vec3 random_vector(Random& random, double size) {
  return {random.real(-size, size), random.real(-size, size), random.real(-size, size)};
}

/// Unit axes, oblique and of either hand, that span a volume with which numbers can be trusted.
Mat3 random_oblique_axes(Random& random) {
  for (;;) {
    Mat3 axes;
    for (int i = 0; i < 3; ++i) axes.col(i) = random_vector(random, 1).normalized();
    if (std::abs(axes.determinant()) > 0.05) return axes;
  }
}

TEST(Frame, RoundTripsBringBackThePosition) {
  for (const std::uint64_t seed : support::seeds(10'000)) {
    Random random(seed);
    const Frame frame{.origin = random_vector(random, 1e4), .axes = random_oblique_axes(random)};
    const Vec3 position = random_vector(random, 1e4);
    EXPECT_LT((frame.to_inner(frame.to_outer(position)) - position).norm(), 1e-9) << "seed " << seed;
    EXPECT_LT((frame.to_outer(frame.to_inner(position)) - position).norm(), 1e-9) << "seed " << seed;
  }
}

TEST(Frame, CoordinatesRunAlongTheObliqueAxes) {
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const Frame frame{.origin = random_vector(random, 1e3), .axes = random_oblique_axes(random)};
    const Vec3 p = random_vector(random, 1e3);
    const Vec3 expected =
        frame.origin + p.x() * frame.axes.col(0) + p.y() * frame.axes.col(1) + p.z() * frame.axes.col(2);
    EXPECT_LT((frame.to_outer(p) - expected).norm(), 1e-9) << "seed " << seed;
  }
}

TEST(Frame, TheDefaultChangesNothing) {
  const Vec3 p{1, -2, 3};
  EXPECT_EQ(Frame{}.to_outer(p), p);
  EXPECT_EQ(Frame{}.to_inner(p), p);
}

/// Written out by hand: Rz(C) Ry(B) with the columns multiplied through.
Mat3 axes_by_trigonometry(double b_deg, double c_deg) {
  const double b = b_deg * std::numbers::pi / 180;
  const double c = c_deg * std::numbers::pi / 180;
  Mat3 axes;
  axes.col(0) = Vec3{std::cos(c) * std::cos(b), std::sin(c) * std::cos(b), -std::sin(b)};
  axes.col(1) = Vec3{-std::sin(c), std::cos(c), 0};
  axes.col(2) = Vec3{std::cos(c) * std::sin(b), std::sin(c) * std::sin(b), std::cos(b)};
  return axes;
}

/// Beside the library's functions of long double, to two of the last digits.
TEST(SineAndCosine, AreAsExactAsTheLibrary) {
  for (const std::uint64_t seed : support::seeds(5'000)) {
    Random random(seed);
    for (const double range : {1e-6, 46.0, 360.0, 1e6, 1e12}) {
      const double degrees = random.real(-range, range);
      const auto radians =
          static_cast<long double>(std::remainder(degrees, 360.0)) * std::numbers::pi_v<long double> / 180;
      const auto [sine, cosine] = sine_and_cosine(degrees);
      const double last_digit = range < 1e9 ? 1.2e-16 : 1e-2;  // Beyond, the angle itself is known to no better.
      EXPECT_NEAR(sine, static_cast<double>(std::sin(radians)), 2 * last_digit) << degrees;
      EXPECT_NEAR(cosine, static_cast<double>(std::cos(radians)), 2 * last_digit) << degrees;
    }
  }
}

/// Without 6e-17, and without a zero that is printed with a minus.
TEST(SineAndCosine, AreExactAtQuarterTurns) {
  constexpr double kSines[] = {0, 1, 0, -1};
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const auto [sine, cosine] = sine_and_cosine(quarter * 90.0);
    const auto at = static_cast<std::size_t>((quarter + 12) % 4);
    EXPECT_EQ(sine, kSines[at]) << quarter;
    EXPECT_EQ(cosine, kSines[(at + 1) % 4]) << quarter;
    EXPECT_FALSE((sine == 0 && std::signbit(sine)) || (cosine == 0 && std::signbit(cosine))) << quarter;
  }
  EXPECT_FALSE(std::signbit(sine_and_cosine(-0.0).sine));
}

TEST(AxesFromAngles, AreThoseOfPlainTrigonometry) {
  for (const std::uint64_t seed : support::seeds(2'000)) {
    Random random(seed);
    const double b = random.real(-360, 360);
    const double c = random.real(-720, 720);
    EXPECT_LT((axes_from_angles(b, c) - axes_by_trigonometry(b, c)).norm(), 1e-12)
        << "seed " << seed << ": B" << b << " C" << c;
  }
}

TEST(AxesFromAngles, AreOrthonormalAndRightHanded) {
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const Mat3 axes = axes_from_angles(random.real(-180, 180), random.real(-360, 360));
    EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-12) << "seed " << seed;
    EXPECT_NEAR(axes.determinant(), 1, 1e-12) << "seed " << seed;
  }
}

TEST(AxesFromAngles, NameTheFacesOfABox) {
  const auto normal = [](double b, double c) { return Vec3(axes_from_angles(b, c).col(2)); };
  EXPECT_LT((normal(0, 0) - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((normal(90, 0) - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((normal(90, 90) - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_LT((normal(90, 180) + Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((normal(90, 270) + Vec3::UnitY()).norm(), 1e-12);
}

TEST(HasDirection, FromAMillionthOn) {
  EXPECT_FALSE(has_direction(Vec3::Zero()));
  EXPECT_FALSE(has_direction({0.9e-6, 0, 0}));
  EXPECT_TRUE(has_direction({1.1e-6, 0, 0}));
  EXPECT_TRUE(has_direction({0, 0, -1e3}));
}

Mat3 axes_with_third(const Vec3& third) {
  Mat3 axes = Mat3::Identity();
  axes.col(2) = third.normalized();
  return axes;
}

TEST(AreCoplanar, BelowAMillionthOfAVolume) {
  EXPECT_FALSE(are_coplanar(Mat3::Identity()));
  EXPECT_FALSE(are_coplanar(axes_with_third({0, 0, -1})));
  EXPECT_FALSE(are_coplanar(axes_with_third({1, 1, 1e-5})));
  EXPECT_TRUE(are_coplanar(axes_with_third({1, 1, 0})));
  EXPECT_TRUE(are_coplanar(axes_with_third({1, 1, 1e-7})));
  EXPECT_TRUE(are_coplanar(axes_with_third({1, 0, 0})));
}

}  // namespace
}  // namespace isocnc::geometry
