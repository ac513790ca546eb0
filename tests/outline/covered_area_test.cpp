#include "interpreter/outline/covered_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/support/random.h"

namespace isocnc::outline {
namespace {

using support::Random;
using support::seeds;

double area(const Contour& contour) {
  double twice = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const OutlinePoint& a = contour[i];
    const OutlinePoint& b = contour[(i + 1) % contour.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

struct Line {
  OutlinePoint from;
  OutlinePoint to;
  double radius = 0;

  double distance(const OutlinePoint& point) const {
    const OutlinePoint way = to - from;
    const double part = way.squaredNorm() > 0 ? std::clamp((point - from).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0;
    return (point - from - part * way).norm() - radius;
  }
};

double distance(const std::vector<Line>& lines, const OutlinePoint& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Line& line : lines) least = std::min(least, line.distance(point));
  return least;
}

CoveredArea covered(const std::vector<Line>& lines) {
  CoveredArea area;
  for (const Line& line : lines) area.add(line.from, line.to, line.radius);
  return area;
}

/// Points on the sides, some ten to a side.
std::vector<OutlinePoint> along(const Contour& contour) {
  std::vector<OutlinePoint> points;
  for (std::size_t i = 0; i < contour.size(); ++i)
    for (int part = 0; part < 10; ++part)
      points.push_back(contour[i] + (contour[(i + 1) % contour.size()] - contour[i]) * part / 10);
  return points;
}

bool is_inside(const Contour& contour, const OutlinePoint& point) {
  bool is_in = false;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const OutlinePoint& a = contour[i];
    const OutlinePoint& b = contour[(i + 1) % contour.size()];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()))
      is_in = !is_in;
  }
  return is_in;
}

/// An L, 100 mm long and high, of a tool of radius 10.
const std::vector<Line> kCorner = {{{0, 100}, {0, 0}, 10}, {{0, 0}, {100, 0}, 10}};

TEST(CoveredArea, HasTheRectangleAroundItsStrokes) {
  const Contour rectangle = covered(kCorner).rectangle();
  EXPECT_EQ(rectangle, (Contour{{-10, -10}, {110, -10}, {110, 110}, {-10, 110}}));
}

TEST(CoveredArea, HasTheHullOfItsClosedForm) {
  // A triangle of legs of 100 mm, widened by 10.
  const double around = 200 + 100 * std::numbers::sqrt2;
  const double exact = 5000 + 10 * around + std::numbers::pi * 100;
  const Contour hull = covered(kCorner).hull();
  EXPECT_GT(area(hull), exact);
  EXPECT_NEAR(area(hull), exact, 0.005 * exact);
  // Tools of other radii count with their own.
  std::vector<Line> two = kCorner;
  two.push_back({{200, 0}, {200, 0}, 1});
  for (const OutlinePoint& corner : covered(two).hull())
    EXPECT_LE(distance({{{0, 0}, {200, 0}, 0}, {{200, 0}, {0, 100}, 0}, {{0, 0}, {0, 100}, 0}}, corner), 10.1);
}

TEST(CoveredArea, HasOneContourAroundEachPart) {
  std::vector<Line> apart = kCorner;
  apart.push_back({{300, 0}, {300, 50}, 5});
  const std::vector<Contour> contours = covered(apart).contours();
  ASSERT_EQ(contours.size(), 2u);
  // The L of 20 mm: two bars, their common square, three quarters of a circle at the corner and two half circles.
  const double corner = 2 * 100 * 20 - 100 + std::numbers::pi * (100 + 25);
  const double bar = 50 * 10 + std::numbers::pi * 25;
  const double reach = CoveredArea::kContourTolerance * 320;
  std::vector<double> areas{area(contours[0]), area(contours[1])};
  std::sort(areas.begin(), areas.end());
  EXPECT_GT(areas[0], bar);
  EXPECT_LT(areas[0], bar + 140 * reach);
  EXPECT_GT(areas[1], corner);
  EXPECT_LT(areas[1], corner + 450 * reach);
}

TEST(CoveredArea, HasNoContourInItsHoles) {
  const std::vector<Line> frame = {{{0, 0}, {200, 0}, 5},
                                   {{200, 0}, {200, 200}, 5},
                                   {{200, 200}, {0, 200}, 5},
                                   {{0, 200}, {0, 0}, 5},
                                   {{90, 90}, {110, 110}, 5}};
  EXPECT_EQ(covered(frame).contours().size(), 1u);
}

TEST(CoveredAreaProperty, ContoursGoAroundAllOfItAndCloseToIt) {
  for (const std::uint64_t seed : seeds(8)) {
    Random random(seed);
    std::vector<Line> lines;
    const auto place = [&] { return OutlinePoint(random.real(-300, 300), random.real(-200, 200)); };
    for (int count = random.between(1, 12); count > 0; --count)
      lines.push_back({place(), random.one_in(4) ? place() : OutlinePoint(random.real(-300, 300), random.real(0, 1)),
                       random.any_of({"a", "b"}) == "a" ? 4.0 : random.real(0, 30)});
    const CoveredArea area = covered(lines);
    const Contour rectangle = area.rectangle();
    const double side = std::max(rectangle[2].x() - rectangle[0].x(), rectangle[2].y() - rectangle[0].y());
    const std::vector<Contour> contours = area.contours();
    const Contour hull = area.hull();
    for (const Contour& contour : contours)
      for (const OutlinePoint& point : along(contour)) {
        const double away = distance(lines, point);
        ASSERT_GT(away, 0) << "seed " << seed;
        ASSERT_LT(away, CoveredArea::kContourTolerance * side) << "seed " << seed;
      }
    for (const Line& line : lines)
      for (const OutlinePoint& end : {line.from, line.to}) {
        const auto has = [&](const Contour& contour) { return is_inside(contour, end); };
        ASSERT_TRUE(std::any_of(contours.begin(), contours.end(), has)) << "seed " << seed;
        ASSERT_TRUE(is_inside(hull, end) || line.radius == 0) << "seed " << seed;
      }
  }
}

}  // namespace
}  // namespace isocnc::outline
