#include "analyzer/transforming/proof.h"

#include <array>
#include <cmath>
#include <numbers>
#include <variant>

#include <fmt/format.h>

#include "interpreter/running/error_message.h"

namespace isocnc::transforming {

using execution::MoveKind;
using execution::State;
using geometry::Pose;
using geometry::Vec3;
using running::Event;
using running::FrameEvent;
using running::MoveEvent;

namespace {

/// Places nearer than this are the same: mm, and degrees for B and C. More than the rounding of what is written.
constexpr double kSamePlace = 1e-4;
/// So are centers, and ends of sweeps. An R gives its center less exactly than the ends are given.
constexpr double kSameArc = 1e-3;
/// Feeds whose quotient differs less from 1 are the same; and those that differ less than what is rounded.
constexpr double kSameFeed = 1e-6;
constexpr double kRoundedFeed = 1e-4;

bool is_same(double a, double b) { return std::abs(a - b) < kSamePlace; }
bool is_same(const Vec3& a, const Vec3& b) { return (a - b).norm() < kSamePlace; }

bool is_upright(const Pose& pose) { return std::abs(std::sin(pose.b * std::numbers::pi / 180)) < 1e-9; }

/// Compares the events of two blocks.
class BlockComparison {
 public:
  /// `before` and `new_before` are the states before the blocks.
  BlockComparison(const ProgramMap& map, const State& before, const State& new_before,
                  std::optional<double> free_height)
      : map_(map),
        before_(before),
        new_before_(new_before),
        in_machine_(map.in_machine(before)),
        free_height_(free_height) {}

  std::optional<TransformObstacle> compare(const Event& old_event, const Event& new_event) const {
    if (old_event.what.index() != new_event.what.index()) return TransformObstacle::EffectDiffers;
    if (const auto* move = std::get_if<MoveEvent>(&old_event.what))
      return compare(*move, std::get<MoveEvent>(new_event.what));
    if (const auto* frame = std::get_if<FrameEvent>(&old_event.what))
      return compare(*frame, std::get<FrameEvent>(new_event.what));
    Event there = new_event;
    there.line = old_event.line;
    if (running::to_json(old_event) != running::to_json(there)) return TransformObstacle::EffectDiffers;
    return std::nullopt;
  }

 private:
  std::optional<TransformObstacle> compare(const FrameEvent& old_frame, const FrameEvent& new_frame) const {
    if (old_frame.face_mounted != new_frame.face_mounted ||
        !is_same(old_frame.workpiece_origin, new_frame.workpiece_origin))
      return TransformObstacle::EffectDiffers;
    if (!old_frame.face_mounted) return std::nullopt;
    State mounted = before_;
    mounted.face_mounted = true;
    const PoseMap inside = map_.in_force(mounted);
    const geometry::Frame& old_face = old_frame.in_force;
    const geometry::Frame& new_face = new_frame.in_force;
    // Coordinates inside are mapped, too, so the axes follow from both.
    const geometry::Mat3 axes = in_machine_.linear * old_face.axes * inside.linear;
    const bool is_there = is_same(new_face.origin, in_machine_.point(old_face.origin));
    constexpr double kSameAxes = 1e-7;
    return is_there && (new_face.axes - axes).norm() < kSameAxes ? std::nullopt
                                                                 : std::optional(TransformObstacle::FaceUnknown);
  }

  std::optional<TransformObstacle> compare(const MoveEvent& old_move, const MoveEvent& new_move) const {
    if (old_move.kind != new_move.kind || old_move.five_axis != new_move.five_axis)
      return TransformObstacle::EffectDiffers;
    const auto obstacle =
        old_move.kind == MoveKind::Rapid ? compare_rapids(old_move, new_move) : compare_feeds(old_move, new_move);
    if (obstacle) return obstacle;
    const auto side = [](const MoveEvent& move) -> Vec3 { return move.compensation.side * move.normal; };
    if (old_move.compensation.reduces != new_move.compensation.reduces ||
        old_move.compensation.plane_is_sound != new_move.compensation.plane_is_sound ||
        !is_same(side(new_move), in_machine_.turn(side(old_move))))
      return TransformObstacle::SideDiffers;
    return std::nullopt;
  }

  std::optional<TransformObstacle> compare_feeds(const MoveEvent& old_move, const MoveEvent& new_move) const {
    const Pose from = in_machine_.pose(old_move.from);
    const Pose to = in_machine_.pose(old_move.to);
    const bool has_start = is_same(new_move.from.tip, from.tip) && is_same(new_move.from.b, from.b);
    if (!has_start) return TransformObstacle::StartUnknown;
    if (!is_same(new_move.to.tip, to.tip) || !is_same(new_move.to.b, to.b)) return TransformObstacle::PlaceDiffers;
    // An upright tool is the same wherever C is.
    const bool is_turned = is_same(new_move.from.c, from.c) && is_same(new_move.to.c, to.c);
    const bool rests = is_same(new_move.from.c, new_move.to.c) && is_same(old_move.from.c, old_move.to.c);
    if (!is_turned && !(rests && is_upright(from) && is_upright(to))) return TransformObstacle::StartUnknown;
    const double feed = old_move.feed * map_.transformation().feed_factor;
    if (old_move.inverse_time != new_move.inverse_time ||
        std::abs(new_move.feed - feed) > kSameFeed * feed + kRoundedFeed * 25.4)
      return TransformObstacle::FeedDiffers;
    if (old_move.kind != MoveKind::Arc) return std::nullopt;
    const double radians = std::numbers::pi / 180;
    const Vec3 sweep = in_machine_.turn(old_move.normal) * (old_move.sweep_deg * radians * old_move.radius);
    const Vec3 new_sweep = new_move.normal * (new_move.sweep_deg * radians * old_move.radius);
    const double off_center = (new_move.center - in_machine_.point(old_move.center)).norm();
    return off_center < kSameArc && (sweep - new_sweep).norm() < kSameArc * (1 + std::abs(old_move.sweep_deg) * radians)
               ? std::nullopt
               : std::optional(TransformObstacle::ArcDiffers);
  }

  /// Rapids from where the program has not given an axis yet.
  std::optional<TransformObstacle> compare_rapids(const MoveEvent& old_move, const MoveEvent& new_move) const {
    const auto values = [](const Pose& pose, const State& state) {
      const Vec3 tip = state.frame_in_force().to_inner(pose.tip);
      return std::array<double, 5>{tip.x(), tip.y(), tip.z(), pose.b, pose.c};
    };
    const PoseMap map = map_.in_force(before_);
    const auto mapped = [&](const Pose& pose) {
      const Vec3 tip = before_.frame_in_force().to_inner(pose.tip);
      const Pose there = map.pose({tip, pose.b, pose.c});
      return std::array<double, 5>{there.tip.x(), there.tip.y(), there.tip.z(), there.b, there.c};
    };
    const std::array<double, 5> from = mapped(old_move.from);
    const std::array<double, 5> to = mapped(old_move.to);
    const std::array<double, 5> new_from = values(new_move.from, new_before_);
    const std::array<double, 5> new_to = values(new_move.to, new_before_);
    for (std::size_t axis = 0; axis < to.size(); ++axis) {
      const bool stays = !is_same(from[axis], new_from[axis]) && is_same(new_from[axis], new_to[axis]);
      if (!is_same(to[axis], new_to[axis]) && (!stays || is_given(old_move, axis, map)))
        return TransformObstacle::PlaceDiffers;
    }
    if (free_height_ && !is_free(old_move, new_move)) return TransformObstacle::CopyStartsLow;
    return std::nullopt;
  }

  /// Whether a rapid may start elsewhere than that of the old program: high enough or straight up, and with B and C as
  /// there at its end.
  bool is_free(const MoveEvent& old_move, const MoveEvent& new_move) const {
    const Pose& from = new_move.from;
    const Pose& to = new_move.to;
    const bool is_same_start = is_same(from.tip, in_machine_.point(old_move.from.tip)) &&
                               is_same(from.b, old_move.from.b) && is_same(from.c, old_move.from.c);
    const bool is_turned = !is_same(to.b, old_move.to.b) || !is_same(to.c, old_move.to.c);
    const bool is_upward = is_same(Vec3(from.tip.x(), from.tip.y(), to.tip.z()), to.tip) && to.tip.z() > from.tip.z() &&
                           is_same(from.b, to.b) && is_same(from.c, to.c);
    return is_same_start || (!is_turned && (is_upward || from.tip.z() >= *free_height_ - kSamePlace));
  }

  /// Whether a motion gives the end of an axis of the new program, or an increment of it.
  bool is_given(const MoveEvent& old_move, std::size_t axis, const PoseMap& map) const {
    const auto has = [&](std::size_t from) { return (old_move.placed >> from & 1u) != 0; };
    if (axis >= 3) return has(axis);
    const Vec3 way = map.linear * (before_.frame_in_force().to_inner(old_move.to.tip) -
                                   before_.frame_in_force().to_inner(old_move.from.tip));
    const auto row = static_cast<Eigen::Index>(axis);
    for (std::size_t from = 0; from < 3; ++from)
      if (has(from) && std::abs(map.linear(row, static_cast<Eigen::Index>(from))) > 1e-9) return true;
    return std::abs(way[row]) > kSamePlace;
  }

  const ProgramMap& map_;
  const State& before_;
  const State& new_before_;
  const PoseMap in_machine_;
  const std::optional<double> free_height_;
};

}  // namespace

std::string error_text(const running::RunResult& result, dialect::Language language) {
  return fmt::format("{}: {}", dialect::definition(result.error.id).code, running::error_message(result, language));
}

std::optional<TransformationRefusal> find_difference(std::string_view program, std::string_view transformed,
                                                     const ProgramMap& map, const running::RunOptions& options,
                                                     dialect::Language language) {
  const running::Program old_program(program);
  const running::Program new_program(transformed);
  running::Runner old_run(old_program, options);
  running::Runner new_run(new_program, options);
  return find_difference(old_run, new_run, 0, std::nullopt, map, language);
}

std::optional<TransformationRefusal> find_difference(running::Runner& old_run, running::Runner& new_run,
                                                     std::size_t first_line, std::optional<std::size_t> end_line,
                                                     const ProgramMap& map, dialect::Language language,
                                                     std::optional<double> free_height) {
  while (!old_run.has_ended() && (!end_line || old_run.place().line < *end_line)) {
    const std::size_t line = old_run.place().line;
    const State before = old_run.result().state;
    const State new_before = new_run.result().state;
    if (new_run.has_ended() || new_run.place().line != line + first_line)
      return TransformationRefusal{TransformObstacle::EffectDiffers, line};
    old_run.step();
    new_run.step();
    const running::RunResult& result = new_run.result();
    if (new_run.has_ended() && result.ending == running::Ending::Error && old_run.result().ending != result.ending)
      return TransformationRefusal{TransformObstacle::NewError, line, error_text(result, language)};
    const auto old_events = old_run.events();
    const auto new_events = new_run.events();
    if (old_events.size() != new_events.size()) return TransformationRefusal{TransformObstacle::EffectDiffers, line};
    const BlockComparison blocks(map, before, new_before, free_height);
    for (std::size_t i = 0; i < old_events.size(); ++i)
      if (const auto obstacle = blocks.compare(old_events[i], new_events[i]))
        return TransformationRefusal{*obstacle, line};
  }
  const bool is_whole = end_line ? !old_run.has_ended() : new_run.has_ended();
  return is_whole ? std::nullopt
                  : std::optional(TransformationRefusal{TransformObstacle::EffectDiffers, old_run.result().line});
}

}  // namespace isocnc::transforming
