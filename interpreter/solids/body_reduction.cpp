#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "interpreter/geometry/plane_curve.h"
#include "interpreter/solids/revolved_body.h"

// What remains of a body at least `depth` away from its surface. In the half plane of z and r the body lies below its
// outline r = f(z), since its pieces are stacked. A point remains if no point of the outline is nearer than `depth`. So
// the outline of what remains is the lowest of: the lines of the outline, shifted inwards, and circles about the
// corners where the outline turns inwards, whose lower halves are replaced by tangents that lie below them.

namespace isocnc::solids {

using geometry::Vec2;

namespace {

/// A straight line in the plane of z (first) and r (second), from a smaller z to a larger one.
struct OutlineLine {
  Vec2 from;
  Vec2 to;

  double at(double z) const {
    const double part = (z - from.x()) / (to.x() - from.x());
    return from.y() + part * (to.y() - from.y());
  }
};

class Reduction {
 public:
  Reduction(const RevolvedBody& body, double depth) : depth_(depth) {
    bottom_ = body.bottom() + depth;
    top_ = body.top();
    for (const BodyPiece& piece : body.pieces()) piece.rounding > 0 ? add_rounded(piece) : add_walls(piece);
  }

  std::optional<RevolvedBody> result() {
    add_lines();
    add_pieces();
    if (pieces_.empty()) return {};
    return RevolvedBody(std::move(pieces_));
  }

 private:
  /// A ball or bull nose keeps its core; one that is rounded by less than the depth is replaced by a chamfer within it.
  void add_rounded(const BodyPiece& piece) {
    const Frustum& core = piece.core;
    if (piece.rounding > depth_) {
      pieces_.push_back({.core = core, .rounding = piece.rounding - depth_});
      bottom_ = std::max(bottom_, core.bottom);
      return;
    }
    points_.emplace_back(core.bottom - piece.rounding, core.bottom_radius);
  }

  void add_walls(const BodyPiece& piece) {
    add_point(Vec2(piece.core.bottom, piece.core.bottom_radius));
    add_point(Vec2(piece.core.top, piece.core.top_radius));
  }

  void add_point(const Vec2& point) {
    if (points_.empty() || points_.back() != point) points_.push_back(point);
  }

  void add_lines() {
    for (std::size_t i = 1; i < points_.size(); ++i) add_shifted(points_[i - 1], points_[i]);
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
      const Vec2 arriving = points_[i] - points_[i - 1];
      const Vec2 leaving = points_[i + 1] - points_[i];
      if (geometry::cross(arriving, leaving) > 0) add_circle(points_[i]);
    }
  }

  /// Inwards is to the right of the way from the tip up.
  void add_shifted(const Vec2& from, const Vec2& to) {
    const Vec2 along = (to - from).normalized();
    const Vec2 inwards = depth_ * Vec2(along.y(), -along.x());
    if (to.x() > from.x()) {
      lines_.push_back({from + inwards, to + inwards});
    } else {
      const double low = std::min(from.y(), to.y());
      const double z = from.x();
      const double other = z + inwards.x();
      lines_.push_back({Vec2(std::min(z, other), low), Vec2(std::max(z, other), low)});
    }
  }

  /// Tangents to the lower half of the circle about a corner, each between those beside it.
  void add_circle(const Vec2& center) {
    const double error = std::max(kCornerShare * depth_, kCornerError);
    const double tangents = std::ceil(std::numbers::pi / 2 / std::acos(depth_ / (depth_ + error)));
    const double step = std::numbers::pi / tangents;
    const double reach = depth_ / std::cos(step / 2);
    Vec2 last(center.x() - depth_, center.y());
    for (int i = 0; i <= static_cast<int>(tangents); ++i) {
      const double angle = std::numbers::pi + (i + 0.5) * step;
      const Vec2 next = i < static_cast<int>(tangents) ? Vec2(center + reach * Vec2(std::cos(angle), std::sin(angle)))
                                                       : Vec2(center.x() + depth_, center.y());
      if (next.x() > last.x()) lines_.push_back({last, next});
      last = next;
    }
  }

  std::vector<double> breaks() const {
    std::vector<double> all = {bottom_, top_};
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const OutlineLine& line = lines_[i];
      const double slope = (line.to.y() - line.from.y()) / (line.to.x() - line.from.x());
      all.insert(all.end(), {line.from.x(), line.to.x(), line.from.x() - line.from.y() / slope});
      for (std::size_t j = 0; j < i; ++j)
        if (lines_[j].from.x() < line.to.x() && line.from.x() < lines_[j].to.x())
          all.push_back(crossing(lines_[j], line));
    }
    std::erase_if(all, [&](double z) { return !(z >= bottom_ && z <= top_); });
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// z where two lines cross; not finite for parallel ones.
  static double crossing(const OutlineLine& a, const OutlineLine& b) {
    const double slope_a = (a.to.y() - a.from.y()) / (a.to.x() - a.from.x());
    const double slope_b = (b.to.y() - b.from.y()) / (b.to.x() - b.from.x());
    return a.from.x() + (b.at(a.from.x()) - a.from.y()) / (slope_a - slope_b);
  }

  const OutlineLine* lowest(double z) const {
    const OutlineLine* best = nullptr;
    for (const OutlineLine& line : lines_)
      if (z >= line.from.x() && z <= line.to.x() && (!best || line.at(z) < best->at(z))) best = &line;
    return best;
  }

  /// Between two neighboring breaks one line is the lowest. Where it is above the axis, and the lowest on, it makes one
  /// piece.
  void add_pieces() {
    const std::vector<double> z = breaks();
    const OutlineLine* last = nullptr;
    for (std::size_t i = 1; i < z.size(); ++i) {
      const OutlineLine* const line = lowest((z[i - 1] + z[i]) / 2);
      const bool is_there = line && line->at(z[i - 1]) + line->at(z[i]) > kNoRadius;
      if (is_there && line == last) {
        pieces_.back().core.top = z[i];
        pieces_.back().core.top_radius = std::max(line->at(z[i]), 0.0);
      } else if (is_there) {
        pieces_.push_back({.core = {z[i - 1], std::max(line->at(z[i - 1]), 0.0), z[i], std::max(line->at(z[i]), 0.0)}});
      }
      last = is_there ? line : nullptr;
    }
  }

  static constexpr double kNoRadius = 1e-9;      ///< mm
  static constexpr double kCornerShare = 0.005;  ///< By which the circles about corners are too large, of the depth.
  static constexpr double kCornerError = 0.002;  ///< The same in mm: the larger one counts.

  double depth_;
  double bottom_;
  double top_;
  std::vector<Vec2> points_;
  std::vector<OutlineLine> lines_;
  std::vector<BodyPiece> pieces_;
};

}  // namespace

std::optional<RevolvedBody> RevolvedBody::reduced(double depth) const {
  if (!(depth > 0)) return *this;
  return Reduction(*this, depth).result();
}

}  // namespace isocnc::solids
