#include "interpreter/geometry/contour_offset.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isocnc::geometry {

static constexpr double kSmooth = 1e-4;  // mm: maximum distance of ends that count as one point.

using Box = Eigen::AlignedBox2d;

/// A box around the curve; for an arc, around its whole circle.
static Box box_around(const PlaneCurve& curve) {
  Box box(curve.start);
  box.extend(curve.end);
  if (!curve.is_arc()) return box;
  const Vec2 reach = Vec2::Constant(std::max(curve.radius(), (curve.end - curve.center).norm()));
  return {Vec2(curve.center - reach), Vec2(curve.center + reach)};
}

/// Difference of the distances of an arc's ends from its center, mm.
static double imprecision(const PlaneCurve& curve) {
  return curve.is_arc() ? std::abs(curve.radius() - (curve.end - curve.center).norm()) : 0;
}

template <class T>
static std::optional<T> take_first(std::deque<T>& all) {
  if (all.empty()) return std::nullopt;
  std::optional<T> first = all.front();
  all.pop_front();
  return first;
}

std::optional<OffsetPiece> ContourOffset::next_piece() { return take_first(out_); }
std::optional<ContourFlaw> ContourOffset::next_flaw() { return take_first(flaws_); }

void ContourOffset::lead_in(const PlaneCurve& line, const ContourElement& like, bool is_inserted) {
  pieces_.clear();
  emitted_ = 0;
  contour_.clear();
  before_ = count_;
  closing_ = std::numeric_limits<std::uint64_t>::max();
  side_ = like.side;
  arriving_ = like.curve.direction_at_end();
  pieces_.push_back({.out = {.curve = line, .tag = like.tag, .is_inserted = is_inserted},
                     .number = count_,
                     .pass = pass_,
                     .side = like.side,
                     .cuts = like.cuts,
                     .is_lead_in = true});
}

void ContourOffset::add(const ContourElement& element) {
  const double to_side = element.side * radius_;
  PlaneCurve way = beside(element.curve, to_side);
  KeptElement kept{.curve = element.curve, .box = box_around(element.curve), .number = ++count_, .side = element.side};
  if (vanishes_beside(element.curve, to_side) && element.curve.radius() < radius_ - kGouge) {
    kept.is_too_small = true;
    if (element.cuts) flaws_.push_back({.tag = element.tag, .small_arc = element.curve.radius()});
  }
  if (!element.cuts) ++pass_;
  kept.pass = pass_;
  const Vec2 arriving = std::exchange(arriving_, element.curve.direction_at_end());
  constexpr double kStraightOn = 1e-3;
  kept.is_smooth = !pieces_.back().is_lead_in && (arriving - element.curve.direction_at_start()).norm() < kStraightOn;
  const std::size_t before = pieces_.size();
  const std::size_t ended = before - (has_stopped() ? 0 : 1);
  if (closes(element.curve)) closing_ = std::min(closing_, count_);
  if (element.cuts) {
    contour_.push_back(kept);
    if (contour_.size() > kLookBack) contour_.pop_front();
    for (std::size_t i = 0; i < ended; ++i) {
      look_at(pieces_[i], kept);
      if (i < emitted_) report_gouge(pieces_[i]);
    }
  }
  join(way, element, arriving);
  side_ = element.side;
  pieces_.push_back({.out = {.curve = way, .tag = element.tag},
                     .number = count_,
                     .pass = pass_,
                     .side = element.side,
                     .cuts = element.cuts,
                     .is_smooth = kept.is_smooth});
  for (std::size_t fresh = pieces_.size() - before; element.reduces && fresh > 0; --fresh)
    reduce(pieces_.size() - fresh);
  release(element.reduces ? kLookAhead : 1);
}

/// Whether an element that comes now starts on one of the first elements of the contour.
bool ContourOffset::closes(const PlaneCurve& curve) const {
  const PlaneCurve begin{.start = curve.start, .end = curve.start};
  return std::any_of(contour_.begin(), contour_.end(), [&](const KeptElement& first) {
    return first.number <= before_ + kNeighbors && first.number + kNeighbors < count_ &&
           approach(begin, first.curve).distance() <= kGouge;
  });
}

/// Connects the last piece and the next: trims the start of `next`, or inserts a piece between them. `arriving` is the
/// direction at the end of the contour's last element.
void ContourOffset::join(PlaneCurve& next, const ContourElement& element, const Vec2& arriving) {
  KeptPiece& last = pieces_.back();
  PlaneCurve& way = last.out.curve;
  const bool is_final = has_stopped();
  if (last.is_lead_in && !is_final) way.end = next.start;
  if ((way.end - next.start).norm() <= kSmooth) {
    next.start = way.end;
    return finish_piece(last);
  }
  const Vec2 leaving = element.curve.direction_at_start();
  const double turn = cross(arriving, leaving) * element.side;
  const double turned = std::atan2(cross(arriving, leaving), arriving.dot(leaving));
  constexpr double kReversal = 1e-9;
  const bool is_inside = turn > 0 && !(turn < kReversal && arriving.dot(leaving) < 0);
  const bool same_side = side_ == element.side;
  if (same_side && is_inside && !is_final && trim(next)) return finish_piece(last);
  PlaneCurve corner{.start = way.end, .end = next.start};
  if (same_side && !is_inside && last.cuts && element.cuts) {
    corner.center = element.curve.start;
    corner.sweep = -element.side * std::abs(turned);
  }
  finish_piece(last);
  insert(corner);
}

/// Trims the last piece and the next at the crossing nearest to their corner.
bool ContourOffset::trim(PlaneCurve& next) {
  PlaneCurve& way = pieces_.back().out.curve;
  const Crossings found = crossings(way, next);
  const auto nearest = std::min_element(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
    return a.along_second - a.along_first < b.along_second - b.along_first;
  });
  if (nearest == found.end()) return false;
  way = way.to(nearest->point, nearest->along_first);
  next = next.from(nearest->point, nearest->along_second);
  return true;
}

void ContourOffset::insert(const PlaneCurve& curve) {
  KeptPiece piece = pieces_.back();
  piece.out = {.curve = curve, .tag = piece.out.tag, .is_inserted = true};
  piece.is_lead_in = piece.is_reported = false;
  pieces_.push_back(piece);
  finish_piece(pieces_.back());
}

/// Checks a piece for gouges, once its end is known.
void ContourOffset::finish_piece(KeptPiece& piece) {
  piece.gouges = piece.has_gouge_to_report = false;
  piece.box = box_around(piece.out.curve);
  for (const KeptElement& element : contour_) look_at(piece, element);
}

/// Whether the contour's walls face each other at a point of the cutter's path and a point of another element.
/// `sides`: 1 if the cutter runs on the same side of both, else -1.
static bool faces(const PlaneCurve& way, const PlaneCurve& element, const Approach& at, int sides) {
  constexpr double kFacing = -0.7;  // Cosine: opposite to within about 45 degrees.
  return sides * way.direction_at(at.on_first).dot(element.direction_at(at.on_second)) < kFacing;
}

/// Whether two walls can face each other; two lines do so everywhere or nowhere.
static bool may_face(const PlaneCurve& way, const PlaneCurve& element, int sides) {
  return way.is_arc() || element.is_arc() || faces(way, element, {}, sides);
}

void ContourOffset::look_at(KeptPiece& piece, const KeptElement& element) const {
  if (!piece.cuts || piece.pass != element.pass || piece.has_gouge_to_report) return;
  if (piece.number == element.number && !piece.out.is_inserted && !piece.is_lead_in) return;
  const auto [first, second] = std::minmax(piece.number, element.number);
  const bool is_smooth = second == element.number ? element.is_smooth : piece.is_smooth;
  const bool are_neighbors = second - first <= kNeighbors;
  const bool lead_on_and_off = second >= closing_ && first <= before_ + kNeighbors;
  if ((!are_neighbors && (piece.is_lead_in || lead_on_and_off)) || (second - first == 1 && is_smooth)) return;
  const PlaneCurve& way = piece.out.curve;
  // Lead-in and lead-out shift the cutter sideways, and so pass the contour's ends at less than the radius.
  const double wanted = piece.is_lead_in ? radius_ / 2 : radius_;
  if (piece.box.squaredExteriorDistance(element.box) >= wanted * wanted) return;
  const double minimum = wanted - kGouge - imprecision(way) - imprecision(element.curve);
  if (!(minimum > 0)) return;
  const int sides = piece.side * element.side;
  if (!are_neighbors && !may_face(way, element.curve, sides)) return;
  const Approach nearest = approach(way, element.curve);
  if (nearest.distance() >= minimum) return;
  if (!are_neighbors && !faces(way, element.curve, nearest, sides)) return;
  piece.gouges = true;
  piece.has_gouge_to_report = !is_explained(piece.number, element.number);
}

/// Whether a gouge is next to an inside arc that is too small, which causes it and has been reported.
bool ContourOffset::is_explained(std::uint64_t a, std::uint64_t b) const {
  const auto low = std::min(a, b);
  const auto high = std::max(a, b);
  if (high - low > 2) return false;
  return std::any_of(contour_.begin(), contour_.end(), [&](const KeptElement& element) {
    return element.is_too_small && low <= element.number && element.number <= high;
  });
}

/// Cuts off the shortest loop that gouges and ends at piece `last`.
void ContourOffset::reduce(std::size_t last) {
  bool gouges = false;
  for (std::size_t first = last; first-- > emitted_;) {
    if (pieces_[first].is_lead_in) return;
    gouges = gouges || pieces_[first].gouges;
    if (gouges && cut_loop(first, last)) return;
  }
}

bool ContourOffset::cut_loop(std::size_t first, std::size_t last) {
  for (const Crossing& crossing : crossings(pieces_[first].out.curve, pieces_[last].out.curve)) {
    KeptPiece cut = pieces_[first];
    cut.out.curve = cut.out.curve.to(crossing.point, crossing.along_first);
    finish_piece(cut);
    if (cut.gouges) continue;
    pieces_[first] = cut;
    KeptPiece& rest = pieces_[last];
    rest.out.curve = rest.out.curve.from(crossing.point, crossing.along_second);
    if (last + 1 < pieces_.size()) finish_piece(rest);
    pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                  pieces_.begin() + static_cast<std::ptrdiff_t>(last));
    return true;
  }
  return false;
}

void ContourOffset::finish() {
  if (has_stopped()) return;
  finish_piece(pieces_.back());
  release(0);
}

void ContourOffset::lead_out(const PlaneCurve& line, std::uint64_t tag) {
  KeptPiece piece{
      .out = {.curve = line, .tag = tag, .is_inserted = true}, .number = count_ + 1, .pass = pass_, .is_lead_in = true};
  finish_piece(piece);
  report_gouge(piece);
}

/// Emits the final pieces except the last `held`; a piece is emitted at the latest after kLookAhead elements.
void ContourOffset::release(std::size_t held) {
  const auto has_waited = [&] {
    return pieces_.size() - emitted_ > 1 && pieces_[emitted_].number + kLookAhead < count_;
  };
  for (; pieces_.size() - emitted_ > held || has_waited(); ++emitted_) {
    out_.push_back(pieces_[emitted_].out);
    report_gouge(pieces_[emitted_]);
  }
  for (; emitted_ > 0 && pieces_.front().number + kLookBack < count_; --emitted_) pieces_.pop_front();
}

/// Reports each piece at most once.
void ContourOffset::report_gouge(KeptPiece& piece) {
  if (!piece.has_gouge_to_report || piece.is_reported) return;
  piece.is_reported = true;
  flaws_.push_back({.tag = piece.out.tag});
}

}  // namespace isocnc::geometry
