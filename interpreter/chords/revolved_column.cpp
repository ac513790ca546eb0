#include "interpreter/chords/revolved_column.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interpreter/chords/vector_loops.h"

namespace isocnc::chords {

using solids::BodyPiece;
using solids::Frustum;
using Kind = LowerSurface::Kind;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double widest(const BodyPiece& piece) {
  return std::max(piece.core.bottom_radius, piece.core.top_radius) + piece.rounding;
}

double narrowest(const BodyPiece& piece) {
  return std::min(piece.core.bottom_radius, piece.core.top_radius) + piece.rounding;
}

bool widens(const BodyPiece& piece) { return piece.core.top_radius >= piece.core.bottom_radius; }

BodyPiece turned_over(const BodyPiece& piece) {
  const Frustum& core = piece.core;
  return {.core = {-core.top, core.top_radius, -core.bottom, core.bottom_radius}, .rounding = piece.rounding};
}

/// From the axis outwards: the lower disc, its rounded edge, the side as far as it is seen from below, and the rounded
/// edge of the upper disc.
void append_lower(const BodyPiece& piece, std::vector<LowerSurface>& surfaces) {
  const Frustum& core = piece.core;
  const double rounding = piece.rounding;
  const double height = core.top - core.bottom;
  const bool is_disc = !(height > 0);
  const double inner = is_disc ? std::max(core.bottom_radius, core.top_radius) : core.bottom_radius;
  const double widening = is_disc ? 0 : core.top_radius - core.bottom_radius;
  // Within its start, the next surface is as high as the disc.
  if (inner > 0 && !(rounding > 0) && !(widening > 0))
    surfaces.push_back({.kind = Kind::Flat, .z = core.bottom - rounding, .end = inner});
  const auto append_rounding = [&](double z, double middle, double start, double end) {
    if (!(rounding > 0)) return;
    surfaces.push_back(
        {.kind = Kind::Round, .z = z, .start = start, .end = end, .middle = middle, .rounding = rounding});
  };
  if (!(widening > 0)) return append_rounding(core.bottom, inner, inner, inner + rounding);
  const double length = std::hypot(widening, height);
  const double outward = rounding * height / length;
  const double downward = rounding * widening / length;
  append_rounding(core.bottom, inner, inner, inner + outward);
  surfaces.push_back({.kind = Kind::Cone,
                      .z = core.bottom - downward,
                      .start = inner + outward,
                      .end = core.top_radius + outward,
                      .slope = height / widening});
  append_rounding(core.top, core.top_radius, core.top_radius + outward, core.top_radius + rounding);
}

/// Collects the pieces of a column, from the lowest one up.
class ColumnBuilder {
 public:
  explicit ColumnBuilder(const BodyPiece& first) : pieces_{first} { is_narrowing_ = !widens(first); }

  bool accepts(const BodyPiece& next) const {
    const BodyPiece& last = pieces_.back();
    if (next.core.bottom > last.core.top + kGap) return false;
    if (narrowest(next) >= widest(last) && !is_narrowing_) return true;
    return widest(next) <= narrowest(last) && !(widens(next) && next.core.top_radius > next.core.bottom_radius);
  }

  void append(const BodyPiece& next) {
    const BodyPiece& last = pieces_.back();
    if (narrowest(next) < widest(last) || !widens(next)) is_narrowing_ = true;
    pieces_.push_back(next);
  }

  /// What is hidden by the next piece is left out.
  RevolvedColumn column() const {
    RevolvedColumn result;
    result.bottom = kInfinite;
    result.top = -kInfinite;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const BodyPiece& piece = pieces_[i];
      result.radius = std::max(result.radius, widest(piece));
      result.bottom = std::min(result.bottom, piece.core.bottom - piece.rounding);
      result.top = std::max(result.top, piece.core.top + piece.rounding);
      if (i == 0 || !is_hidden(turned_over(piece), turned_over(pieces_[i - 1]))) append_lower(piece, result.lower);
      if (i + 1 == pieces_.size() || !is_hidden(piece, pieces_[i + 1])) append_lower(turned_over(piece), result.upper);
    }
    return result;
  }

 private:
  static constexpr double kGap = 1e-9;  ///< Largest gap between pieces that is none, mm.

  /// Whether the upper surface of a piece is within the one above.
  static bool is_hidden(const BodyPiece& piece, const BodyPiece& above) {
    return widest(piece) <= narrowest(above) && piece.core.top + piece.rounding <= above.core.top + above.rounding;
  }

  std::vector<BodyPiece> pieces_;
  bool is_narrowing_;
};

}  // namespace

double LowerSurface::height(double r) const {
  const double at = std::max(r, start);
  switch (kind) {
    case Kind::Flat:
      return z;
    case Kind::Cone:
      return z + slope * (at - start);
    case Kind::Round:
      return z - square_root(rounding * rounding - (at - middle) * (at - middle));
  }
  return z;
}

/// The function is convex in v. Its minimum lies on the falling side of v = 0, not nearer to the axis than `start`,
/// within which the height does not depend on v.
double LowerSurface::lowest(double aside, double pitch, double first, double last) const {
  const double half_square = end * end - aside * aside;
  if (!(half_square >= 0)) return kInfinite;
  const double half = std::sqrt(half_square);
  first = std::max(first, -half);
  last = std::min(last, half);
  if (!(first <= last)) return kInfinite;
  const double steep = std::abs(pitch);
  const double inner = aside < start ? square_root(start * start - aside * aside) : 0.0;
  double best = 0;  // |v|
  if (steep > 0) switch (kind) {
      case Kind::Flat:
        best = half;
        break;
      case Kind::Cone:
        best = slope > steep ? std::max(inner, steep * aside / std::sqrt(slope * slope - steep * steep)) : half;
        break;
      case Kind::Round: {
        if (middle == 0) {
          best = std::max(inner, steep * square_root((rounding * rounding - aside * aside) / (1 + steep * steep)));
          break;
        }
        // Where the slope of the surface along v equals the pitch, by halving. Any v gives a height of the body, and
        // near the minimum an error of v hardly matters.
        double low = inner;
        double high = half;
        for (int i = 0; i < 24 && low < high; ++i) {
          const double v = (low + high) / 2;
          const double r = std::hypot(aside, v);
          const double out = std::max(r, start) - middle;
          const double rise = out * v;
          const double fall = steep * r * square_root(rounding * rounding - out * out);
          (rise < fall ? low : high) = v;
        }
        best = (low + high) / 2;
        break;
      }
    }
  const double v = std::clamp(pitch > 0 ? -best : best, first, last);
  return height(std::hypot(aside, v)) + pitch * v;
}

BodyPiece shrunk(const BodyPiece& piece, double by) {
  BodyPiece result = piece;
  result.rounding = std::max(0.0, piece.rounding - by);
  const double of_core = by - (piece.rounding - result.rounding);
  result.core.bottom_radius = std::max(0.0, piece.core.bottom_radius - of_core);
  result.core.top_radius = std::max(0.0, piece.core.top_radius - of_core);
  return result;
}

std::vector<RevolvedColumn> columns_of(const solids::RevolvedBody& body, bool upside_down, double shrunk_by) {
  std::vector<BodyPiece> pieces(body.pieces().begin(), body.pieces().end());
  if (upside_down) std::transform(pieces.begin(), pieces.end(), pieces.begin(), turned_over);
  std::stable_sort(pieces.begin(), pieces.end(), [](const BodyPiece& left, const BodyPiece& right) {
    return left.core.bottom + left.core.top < right.core.bottom + right.core.top;
  });
  std::vector<RevolvedColumn> columns;
  std::vector<ColumnBuilder> builders;
  for (const BodyPiece& piece : pieces) {
    const BodyPiece smaller = shrunk(piece, shrunk_by);
    if (!builders.empty() && builders.back().accepts(smaller)) {
      builders.back().append(smaller);
    } else {
      builders.emplace_back(smaller);
    }
  }
  for (const ColumnBuilder& builder : builders) columns.push_back(builder.column());
  return columns;
}

}  // namespace isocnc::chords
