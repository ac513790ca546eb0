#include "interpreter/outline/covered_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace isocnc::outline {

void CoveredArea::add(const OutlinePoint& from, const OutlinePoint& to, double radius) {
  strokes_.push_back({from, to, radius});
}

std::vector<double> CoveredArea::radii() const {
  std::vector<double> all;
  for (const Stroke& stroke : strokes_)
    if (std::find(all.begin(), all.end(), stroke.radius) == all.end()) all.push_back(stroke.radius);
  return all;
}

Eigen::AlignedBox2d CoveredArea::bounds() const {
  Eigen::AlignedBox2d box;
  for (const Stroke& stroke : strokes_)
    for (const OutlinePoint& end : {stroke.from, stroke.to}) {
      box.extend(end - OutlinePoint::Constant(stroke.radius));
      box.extend(end + OutlinePoint::Constant(stroke.radius));
    }
  return box;
}

Contour CoveredArea::rectangle() const {
  if (is_empty()) return {};
  const Eigen::AlignedBox2d box = bounds();
  return {box.min(), {box.max().x(), box.min().y()}, box.max(), {box.min().x(), box.max().y()}};
}

static double cross(const OutlinePoint& a, const OutlinePoint& b) { return a.x() * b.y() - a.y() * b.x(); }

static Contour convex_hull(std::vector<OutlinePoint> points) {
  const auto is_before = [](const OutlinePoint& a, const OutlinePoint& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  };
  std::sort(points.begin(), points.end(), is_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  // The lower side from left to right, then the upper one back.
  Contour hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const OutlinePoint& point : points) {
      while (hull.size() >= begin + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull[hull.size() - 2]) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

Contour CoveredArea::hull() const {
  constexpr int kCorners = 48;
  std::vector<OutlinePoint> around;
  for (const double radius : radii()) {
    std::vector<OutlinePoint> ends;
    for (const Stroke& stroke : strokes_)
      if (stroke.radius == radius) ends.insert(ends.end(), {stroke.from, stroke.to});
    // The polygon around the circle.
    const double reach = radius / std::cos(std::numbers::pi / kCorners);
    for (const OutlinePoint& end : convex_hull(std::move(ends)))
      for (int i = 0; i < kCorners; ++i) {
        const double angle = 2 * std::numbers::pi * i / kCorners;
        around.push_back(end + reach * OutlinePoint(std::cos(angle), std::sin(angle)));
      }
  }
  return convex_hull(std::move(around));
}

namespace {

/// Squares that are covered or not.
class Raster {
 public:
  /// Covers the box and a margin around it, which is never marked.
  Raster(const Eigen::AlignedBox2d& box, double cell)
      : origin_(box.min() - OutlinePoint::Constant(kMargin * cell)),
        cell_(cell),
        columns_(static_cast<std::ptrdiff_t>(std::ceil(box.sizes().x() / cell)) + 2 * kMargin),
        rows_(static_cast<std::ptrdiff_t>(std::ceil(box.sizes().y() / cell)) + 2 * kMargin),
        marks_(static_cast<std::size_t>(columns_ * rows_)) {}

  /// Marks the squares on a line.
  void mark(const OutlinePoint& from, const OutlinePoint& to) {
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / (cell_ * kStep))));
    for (int i = 0; i <= steps; ++i) {
      const OutlinePoint place = (from + (to - from) * i / steps - origin_) / cell_;
      at(static_cast<std::ptrdiff_t>(place.x()), static_cast<std::ptrdiff_t>(place.y())) = 1;
    }
  }

  /// Adds all squares whose centers are within `radius` mm of those of the marked ones.
  void add_around(const Raster& marked, double radius) {
    const double reach = radius / cell_;
    const auto height = static_cast<std::ptrdiff_t>(reach);
    std::vector<std::int32_t> steps(static_cast<std::size_t>((columns_ + 1) * rows_));
    for (std::ptrdiff_t y = 0; y < rows_; ++y)
      for (std::ptrdiff_t x = 0; x < columns_; ++x) {
        if (!marked.at(x, y)) continue;
        const std::ptrdiff_t begin = x;
        while (x + 1 < columns_ && marked.at(x + 1, y)) ++x;
        for (std::ptrdiff_t row = std::max<std::ptrdiff_t>(y - height, 0); row <= std::min(y + height, rows_ - 1);
             ++row) {
          const auto across = static_cast<double>(row - y);
          const auto half = static_cast<std::ptrdiff_t>(std::sqrt(reach * reach - across * across));
          ++steps[static_cast<std::size_t>(row * (columns_ + 1) + std::max<std::ptrdiff_t>(begin - half, 0))];
          --steps[static_cast<std::size_t>(row * (columns_ + 1) + std::min(x + half + 1, columns_))];
        }
      }
    for (std::ptrdiff_t y = 0; y < rows_; ++y) {
      std::int32_t count = 0;
      for (std::ptrdiff_t x = 0; x < columns_; ++x) {
        count += steps[static_cast<std::size_t>(y * (columns_ + 1) + x)];
        if (count > 0) at(x, y) = 1;
      }
    }
  }

  void fill_holes() {
    std::vector<char> outside(marks_.size());
    std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> open{{0, 0}};
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      if (!contains(x, y) || at(x, y) || outside[index(x, y)]) continue;
      outside[index(x, y)] = 1;
      open.insert(open.end(), {{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}});
    }
    for (std::size_t i = 0; i < marks_.size(); ++i) marks_[i] = !outside[i];
  }

  /// The outlines of what is marked, along the sides of squares. There must be no holes.
  std::vector<Contour> outlines() const {
    std::vector<Contour> all;
    std::vector<char> is_done(marks_.size());  // The lower side of the square.
    for (std::ptrdiff_t y = 1; y < rows_; ++y)
      for (std::ptrdiff_t x = 0; x < columns_; ++x)
        if (at(x, y) && !at(x, y - 1) && !is_done[index(x, y)]) all.push_back(outline_from(x, y, is_done));
    return all;
  }

 private:
  static constexpr std::ptrdiff_t kMargin = 8;
  static constexpr double kStep = 0.5;

  std::size_t index(std::ptrdiff_t x, std::ptrdiff_t y) const { return static_cast<std::size_t>(y * columns_ + x); }
  bool contains(std::ptrdiff_t x, std::ptrdiff_t y) const { return x >= 0 && y >= 0 && x < columns_ && y < rows_; }
  char& at(std::ptrdiff_t x, std::ptrdiff_t y) { return marks_[index(x, y)]; }
  char at(std::ptrdiff_t x, std::ptrdiff_t y) const { return marks_[index(x, y)]; }

  /// Counterclockwise, from the lower side of a square: what is marked lies to the left.
  Contour outline_from(std::ptrdiff_t x, std::ptrdiff_t y, std::vector<char>& is_done) const {
    constexpr std::array<std::pair<int, int>, 4> kWays = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    Contour corners;
    const std::pair start(x, y);
    std::size_t way = 0;
    do {
      if (way == 0) is_done[index(x, y)] = 1;
      corners.push_back(origin_ + cell_ * OutlinePoint(static_cast<double>(x), static_cast<double>(y)));
      x += kWays[way].first;
      y += kWays[way].second;
      // The squares ahead of the corner, to the left and to the right.
      const bool is_left = is_ahead(x, y, way, true);
      const bool is_right = is_ahead(x, y, way, false);
      way = is_right ? (way + 3) % 4 : is_left ? way : (way + 1) % 4;
    } while (std::pair(x, y) != start || way != 0);
    return corners;
  }

  bool is_ahead(std::ptrdiff_t x, std::ptrdiff_t y, std::size_t way, bool to_the_left) const {
    // Of the four squares around a corner: which is ahead to the left, for each way.
    constexpr std::array<std::pair<int, int>, 4> kLeft = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
    const auto& [dx, dy] = kLeft[to_the_left ? way : (way + 3) % 4];
    return contains(x + dx, y + dy) && at(x + dx, y + dy);
  }

  OutlinePoint origin_;
  double cell_;
  std::ptrdiff_t columns_;
  std::ptrdiff_t rows_;
  std::vector<char> marks_;
};

double distance(const OutlinePoint& point, const OutlinePoint& from, const OutlinePoint& to) {
  const OutlinePoint way = to - from;
  const double length = way.squaredNorm();
  const double part = length > 0 ? std::clamp((point - from).dot(way) / length, 0.0, 1.0) : 0;
  return (point - from - part * way).norm();
}

/// Leaves out corners, so that none of those left out is farther than `tolerance` from the rest.
Contour simplified(const Contour& corners, double tolerance) {
  std::vector<char> is_kept(corners.size() + 1);
  const auto corner = [&](std::size_t i) -> const OutlinePoint& { return corners[i % corners.size()]; };
  std::vector<std::pair<std::size_t, std::size_t>> open;
  const auto farthest =
      std::max_element(corners.begin(), corners.end(), [&](const OutlinePoint& a, const OutlinePoint& b) {
        return (a - corners.front()).squaredNorm() < (b - corners.front()).squaredNorm();
      });
  const auto middle = static_cast<std::size_t>(farthest - corners.begin());
  is_kept[0] = is_kept[middle] = 1;
  open.insert(open.end(), {{0, middle}, {middle, corners.size()}});
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    std::size_t worst = begin;
    double most = tolerance;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double away = distance(corner(i), corner(begin), corner(end));
      if (away > most) std::tie(worst, most) = std::pair(i, away);
    }
    if (worst == begin) continue;
    is_kept[worst] = 1;
    open.insert(open.end(), {{begin, worst}, {worst, end}});
  }
  Contour kept;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (is_kept[i]) kept.push_back(corners[i]);
  return kept;
}

}  // namespace

std::vector<Contour> CoveredArea::contours() const {
  if (is_empty()) return {};
  constexpr double kSquares = 1500;      // Along the longer side.
  constexpr double kSmallest = 0.01;     // mm.
  constexpr double kOffTheLine = 1.0;    // From a line to the center of a square that is marked for it, in squares.
  constexpr double kHalfDiagonal = 0.8;  // Of a square.
  constexpr double kLeftOut = 1.0;       // By simplified().
  const Eigen::AlignedBox2d box = bounds();
  const double cell = std::max(box.sizes().maxCoeff() / kSquares, kSmallest);
  Raster covered(box, cell);
  for (const double radius : radii()) {
    Raster lines(box, cell);
    for (const Stroke& stroke : strokes_)
      if (stroke.radius == radius) lines.mark(stroke.from, stroke.to);
    covered.add_around(lines, radius + cell * (kOffTheLine + kHalfDiagonal + kLeftOut));
  }
  covered.fill_holes();
  std::vector<Contour> all = covered.outlines();
  for (Contour& contour : all) contour = simplified(contour, cell * kLeftOut);
  return all;
}

}  // namespace isocnc::outline
