#include "interpreter/simulation/compensation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isocnc::simulation {

using namespace dialect::literals;
using execution::MoveKind;
using geometry::PlaneCurve;
using geometry::Vec2;
using geometry::Vec3;

static constexpr double kNowhere = 1e-9;                // mm
static constexpr std::size_t kMaxEventsBetween = 1000;  // Events between two elements; a control allows some tens.
static constexpr std::size_t kBlocksKept =
    2 * (geometry::ContourOffset::kLookBack + geometry::ContourOffset::kLookAhead);

Vec3 Compensation::ContourPlane::point(const Vec2& flat, double height) const {
  return flat.x() * u + flat.y() * v + height * normal;
}

/// Tolerates axes as far from the right angle as the dialect allows (D26).
bool Compensation::ContourPlane::is_upright(const running::MoveEvent& move) const {
  if (move.kind == MoveKind::Arc) return false;
  const Vec3 way = move.to.tip - move.from.tip;
  return flat(way).norm() <= kNowhere + geometry::kOrthogonalCosine * std::abs(normal.dot(way));
}

static bool turns(const running::MoveEvent& move) { return move.from.b != move.to.b || move.from.c != move.to.c; }

Compensation::Compensation(const timing::TimedMachine& machine, const execution::ToolCode& tool,
                           const running::MoveEvent* beside)
    : machine_(&machine) {
  mount(tool);
  if (beside == nullptr) return;
  turn_plane(beside->normal);
  is_beside_ = true;
  tip_ = beside->to;
}

void Compensation::mount(const execution::ToolCode& tool) {
  const auto radius = machine_->tool_radii.find(tool);
  radius_ = radius == machine_->tool_radii.end() ? 0 : radius->second;
}

void Compensation::take(const running::Event& event, const Listeners& listeners) {
  const auto* const move = std::get_if<running::MoveEvent>(&event.what);
  if (const auto* const tool = std::get_if<running::ToolEvent>(&event.what)) {
    end_contour(listeners);
    mount(tool->tool);
  }
  if (running::stops_reading(event)) pause(listeners);
  if (move == nullptr) return is_open_ ? wait(event, listeners) : listeners.event(event);
  if (is_beside_ && move->kind == MoveKind::Rapid && plane_.is_upright(*move)) contour_.forget();
  const bool is_wanted = radius_ > 0 && move->compensation.side != 0;
  if (is_wanted && move->compensation.plane_is_sound && !turns(*move)) return follow(event, *move, listeners);
  end_contour(listeners);
  if (is_wanted) {
    listeners.warning({.line = event.line, .id = "compensation-not-applied"_diag, .is_in_inches = event.is_in_inches});
  }
  if (!is_beside_) return listeners.event(event);
  come_back(event, *move, listeners);
}

/// Queues an event after the last element. A pause ends the wait when the queue is too long.
void Compensation::wait(const running::Event& event, const Listeners& listeners) {
  if (is_paused_) return go_beside(event, listeners);
  waiting_.push_back({.event = event, .element = elements_});
  if (waiting_.size() > kMaxEventsBetween) pause(listeners);
}

void Compensation::pause(const Listeners& listeners) {
  if (!is_open_) return;
  contour_.finish();
  pass_on(listeners);
  pass_on_before(elements_ + 1, listeners);
  is_paused_ = true;
}

/// Takes a motion under compensation.
void Compensation::follow(const running::Event& event, const running::MoveEvent& move, const Listeners& listeners) {
  if ((plane_.normal - move.normal).norm() > kNowhere) end_contour(listeners);
  const bool begins = !is_open_;
  if (begins) begin_contour(move);
  if (plane_.is_upright(move)) return begins ? go_beside(event, listeners) : wait(event, listeners);
  geometry::ContourElement element{.curve = {.start = plane_.flat(move.from.tip), .end = plane_.flat(move.to.tip)},
                                   .tag = count(event),
                                   .side = move.compensation.side,
                                   .reduces = move.compensation.reduces,
                                   .cuts = move.kind != MoveKind::Rapid};
  if (move.kind == MoveKind::Arc) {
    element.curve.center = plane_.flat(move.center);
    element.curve.sweep = move.sweep_deg * std::numbers::pi / 180;
  }
  waiting_.push_back({.event = event, .element = element.tag, .is_element = true});
  is_open_ = true;
  is_paused_ = false;
  if (begins && !element.curve.is_arc()) {
    const Vec2 beside = element.side * radius_ * geometry::left_of(element.curve.direction_at_end());
    contour_.lead_in({.start = plane_.flat(tip_.tip), .end = element.curve.end + beside}, element, false);
  } else {
    if (begins) contour_.lead_in({.start = plane_.flat(tip_.tip), .end = element.curve.start}, element, true);
    contour_.add(element);
  }
  pass_on(listeners);
}

/// Sets the plane from a motion, and the position of the tool.
void Compensation::begin_contour(const running::MoveEvent& move) {
  if (!is_beside_) tip_ = move.from;
  is_beside_ = true;
  if ((plane_.normal - move.normal).norm() > kNowhere || contour_.radius() != radius_) {
    turn_plane(move.normal);
    contour_ = geometry::ContourOffset(radius_);
  }
}

void Compensation::turn_plane(const Vec3& normal) {
  plane_.normal = normal;
  Vec3::Index minimum = 0;
  normal.cwiseAbs().minCoeff(&minimum);
  plane_.u = Vec3::Unit(minimum).cross(normal).normalized();
  plane_.v = normal.cross(plane_.u);
}

void Compensation::end_contour(const Listeners& listeners) {
  pause(listeners);
  is_open_ = false;
  is_paused_ = false;
}

/// Takes a motion without compensation while the tip is off the programmed path: the tip moves straight back to it. A
/// motion along the normal only keeps the offset.
void Compensation::come_back(const running::Event& event, const running::MoveEvent& move, const Listeners& listeners) {
  if (plane_.is_upright(move)) return go_beside(event, listeners);
  is_beside_ = false;
  running::MoveEvent straight = move;
  if (move.kind == MoveKind::Arc) {
    straight.kind = MoveKind::Feed;
    straight.to.tip = move.from.tip;
    straight.feed = running::feed_of(move);
    straight.inverse_time = false;
  }
  if (move.kind != MoveKind::Rapid)
    contour_.lead_out({.start = plane_.flat(tip_.tip), .end = plane_.flat(straight.to.tip)}, count(event));
  if ((straight.to.tip - tip_.tip).norm() > kNowhere) go(event, straight, listeners);
  if (move.kind == MoveKind::Arc) listeners.event(event);
  pass_on(listeners);
}

/// Passes on the finished pieces of the contour, the events that wait between them, and warnings about flaws.
void Compensation::pass_on(const Listeners& listeners) {
  while (const auto piece = contour_.next_piece()) {
    pass_on_before(piece->tag, listeners);
    go_along(*piece, listeners);
  }
  while (const auto flaw = contour_.next_flaw()) {
    const auto id = flaw->small_arc ? "inside-arc-too-small"_diag : "compensation-gouge"_diag;
    const ElementBlock& block = block_of(flaw->tag);
    RunWarning warning{.line = block.line, .id = id, .values = {contour_.radius()}, .is_in_inches = block.is_in_inches};
    if (flaw->small_arc) warning.values = {*flaw->small_arc, contour_.radius()};
    listeners.warning(warning);
  }
}

/// Passes on all events waiting before an element. Elements without any piece are dropped.
void Compensation::pass_on_before(std::uint64_t element, const Listeners& listeners) {
  for (; !waiting_.empty() && waiting_.front().element < element; waiting_.pop_front())
    if (!waiting_.front().is_element) go_beside(waiting_.front().event, listeners);
}

/// Moves along a piece, whose element is the first in the queue.
void Compensation::go_along(const geometry::OffsetPiece& piece, const Listeners& listeners) {
  const running::Event& event = waiting_.front().event;
  running::MoveEvent move = std::get<running::MoveEvent>(event.what);
  const double height = plane_.normal.dot(piece.is_inserted ? tip_.tip : move.to.tip);
  if (piece.is_inserted) {
    move.feed = running::feed_of(move);
    move.inverse_time = false;
  }
  move.to.tip = plane_.point(piece.curve.end, height);
  if (piece.curve.is_arc()) {
    move.kind = MoveKind::Arc;
    move.center = plane_.point(piece.curve.center, plane_.normal.dot(tip_.tip));
    move.radius = piece.curve.radius();
    move.sweep_deg = piece.curve.sweep * 180 / std::numbers::pi;
  } else if (move.kind == MoveKind::Arc) {
    move.kind = MoveKind::Feed;
  }
  if (piece.curve.length() > kNowhere || (move.to.tip - tip_.tip).norm() > kNowhere) go(event, move, listeners);
}

/// Passes on an event after an element. Its motions go along the normal only, with the rotary axes as programmed.
void Compensation::go_beside(const running::Event& event, const Listeners& listeners) {
  const auto* const move = std::get_if<running::MoveEvent>(&event.what);
  if (move == nullptr) return listeners.event(event);
  running::MoveEvent beside = *move;
  beside.to.tip = plane_.point(plane_.flat(tip_.tip), plane_.normal.dot(move->to.tip));
  go(event, beside, listeners);
}

/// Reports a motion from the actual tip position. While the tip is offset, each motion gets the normal, so that a copy
/// of the machine can continue from it.
void Compensation::go(const running::Event& of, const running::MoveEvent& move, const Listeners& listeners) {
  running::MoveEvent gone = move;
  if (is_beside_) gone.normal = plane_.normal;
  gone.from.tip = tip_.tip;
  gone.length = (gone.to.tip - gone.from.tip).norm();
  if (gone.kind == MoveKind::Arc) {
    const double rise = plane_.normal.dot(gone.to.tip - gone.from.tip);
    gone.length = std::hypot(gone.radius * gone.sweep_deg * std::numbers::pi / 180, rise);
  }
  tip_ = gone.to;
  listeners.event({.line = of.line, .what = gone, .is_in_inches = of.is_in_inches});
}

std::size_t Compensation::memory() const {
  return waiting_.size() * sizeof(HeldEvent) + blocks_.size() * sizeof(ElementBlock) + contour_.memory();
}

const Compensation::ElementBlock& Compensation::block_of(std::uint64_t element) const {
  const auto since = static_cast<std::size_t>(elements_ - element);
  return blocks_[blocks_.size() - 1 - std::min(since, blocks_.size() - 1)];
}

/// Returns the number of a new element, from 1.
std::uint64_t Compensation::count(const running::Event& event) {
  blocks_.push_back({event.line, event.is_in_inches});
  if (blocks_.size() > kBlocksKept) blocks_.pop_front();
  return ++elements_;
}

syntax::Finding finding_of(const RunWarning& warning) {
  syntax::Finding finding{.id = warning.id, .is_in_inches = warning.is_in_inches, .values = warning.values};
  for (double& length : finding.values) length /= dialect::mm_per_unit(warning.is_in_inches);
  return finding;
}

}  // namespace isocnc::simulation
