#include "interpreter/plot/path_recording.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "interpreter/dialect/locale.h"
#include "interpreter/plot/scene_facts.h"
#include "interpreter/running/vector_json.h"
#include "interpreter/simulation/timed_run.h"
#include "interpreter/verification/verification_report.h"

namespace isocnc::plot {

using OrderedJson = nlohmann::ordered_json;

/// Flags in the first byte of a step, besides its kind. For each flag that is set a number follows, in this order.
enum StepBits : std::uint8_t {
  kOtherLine = 0x04,   ///< Number of lines forward, if not one.
  kOtherTool = 0x08,   ///< Index of the tool.
  kOtherFeed = 0x10,   ///< Difference to the last feed, signed.
  kPause = 0x20,       ///< Time since the last point.
  kPointCount = 0x40,  ///< Number of points, if not one.
};

PathRecording::PathRecording(const PlotSubject& subject, const timing::TimedMachine& machine)
    : subject_(subject), machine_(machine), home_(place({.pose = subject.home})), last_(home_) {}

PathRecording::RecordedPoint PathRecording::place(const ToolpathPoint& point) {
  const geometry::Pose& pose = point.pose;
  RecordedPoint result;
  for (int axis = 0; axis < 3; ++axis) result.tip[static_cast<std::size_t>(axis)] = in_units(pose.tip[axis], 1e-3);
  result.b = in_units(pose.b, 1e-4);
  result.c = in_units(pose.c, 1e-4);
  result.speed = in_units(point.speed, 1e-3);
  return result;
}

void PathRecording::add(const ToolpathStep& step) {
  const std::size_t count = step.points.size() - 1;
  const std::int64_t pause = in_units(step.points.front().time - last_time_, 1e-8);
  const std::int64_t feed = in_units(step.feed, 1e-3);
  const std::pair<StepBits, bool> flags[] = {{kOtherLine, step.line != last_line_ + 1},
                                             {kOtherTool, step.tool != last_tool_},
                                             {kOtherFeed, feed != last_feed_},
                                             {kPause, pause > 0},
                                             {kPointCount, count != 1}};
  auto head = static_cast<std::uint64_t>(step.kind);
  for (const auto& [bit, is_set] : flags)
    if (is_set) head |= bit;
  steps_.put(head);
  if (head & kOtherLine) steps_.put(step.line - last_line_);
  if (head & kOtherTool) steps_.put(step.tool);
  if (head & kOtherFeed) steps_.put_signed(feed - last_feed_);
  if (head & kPause) steps_.put(static_cast<std::uint64_t>(pause));
  if (head & kPointCount) steps_.put(count);
  last_line_ = step.line;
  last_tool_ = step.tool;
  last_feed_ = feed;
  if (pause > 0) last_time_ = step.points.front().time;
  for (const ToolpathPoint& point : step.points.subspan(1)) add(place(point), point.time);
}

/// Writes the difference to the last point.
void PathRecording::add(const RecordedPoint& place, double time) {
  for (std::size_t axis = 0; axis < 3; ++axis) points_.put_signed(place.tip[axis] - last_.tip[axis]);
  points_.put(static_cast<std::uint64_t>(std::max<std::int64_t>(0, in_units(time - last_time_, 1e-8))));
  points_.put_signed(place.speed - last_.speed);
  ++points_since_turn_;
  if (place.b != last_.b || place.c != last_.c) {
    turns_.put(std::exchange(points_since_turn_, 0));
    turns_.put_signed(place.b - last_.b);
    turns_.put_signed(place.c - last_.c);
  }
  last_ = place;
  last_time_ = std::max(time, last_time_);
}

/// Infinite ends become null.
static OrderedJson range(const kinematics::AxisLimits& axis) {
  return OrderedJson::array({axis.minimum, axis.maximum});
}

static OrderedJson tool_of(const std::optional<execution::ToolCode>& tool, const std::vector<PlotTool>& known) {
  OrderedJson json = {{"name", nullptr}, {"length", nullptr}, {"radius", nullptr}};
  if (!tool) return json;
  json["name"] = shown_tool(*tool, known);
  for (const PlotTool& each : known) {
    if (each.code != *tool) continue;
    if (each.length) json["length"] = *each.length;
    if (each.radius) json["radius"] = *each.radius;
  }
  return json;
}

std::string PathRecording::facts(const Toolpath& path, const PlottedRun& run) const {
  static constexpr std::string_view kEndings[] = {"end", "error", "until"};
  const bool is_three_axis = machine_.motion.kinematics.kind == kinematics::MachineKind::ThreeAxis;
  OrderedJson json = {{"version", 1},
                      {"name", subject_.name},
                      {"language", dialect::name_of(subject_.language)},
                      {"ending", kEndings[static_cast<std::size_t>(run.result.ending)]},
                      {"endLine", run.result.line},
                      {"turnsTool", !is_three_axis},
                      {"home", OrderedJson::array({home_.tip[0], home_.tip[1], home_.tip[2], home_.b, home_.c})},
                      {"tools", OrderedJson::array()},
                      {"frames", OrderedJson::array()},
                      {"travel", OrderedJson::array()}};
  for (const auto& tool : path.tools()) json["tools"].push_back(tool_of(tool, subject_.tools));
  for (const ToolpathFrame& each : path.frames())
    json["frames"].push_back({{"line", each.line},
                              {"origin", running::array(each.frame.origin)},
                              {"i", running::array(geometry::Vec3(each.frame.axes.col(0)))},
                              {"j", running::array(geometry::Vec3(each.frame.axes.col(1)))},
                              {"k", running::array(geometry::Vec3(each.frame.axes.col(2)))}});
  for (const kinematics::AxisLimits& axis : machine_.motion.axes) json["travel"].push_back(range(axis));
  if (subject_.scene) json["scene"] = scene_facts(*subject_.scene, machine_.motion.kinematics, subject_.origin);
  if (run.verified.certificate) {
    json["contacts"] = contact_facts(run.verified);
    if (run.cuts && run.verified.material)
      json["stock"] = stock_facts(*run.cuts, *run.verified.material, *subject_.scene, machine_.motion.kinematics);
    json["certificate"] = in_both_languages(*run.verified.certificate);
  }
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

RecordedPath record_path(std::string_view program, const PlotSubject& subject, const running::RunOptions& options,
                         const timing::TimedMachine& machine) {
  PathRecording recording(subject, machine);
  Toolpath path(machine, subject.home, [&](const ToolpathStep& step) { recording.add(step); });
  const running::RunResult result = simulation::run_timed(
      program, options, machine,
      {.event = [&](const timing::TimedEvent& timed) { path.add(timed); },
       .stretch = [&](const motion::Stretch& stretch, const timing::TimedEvent&) { path.add(stretch); }});
  return {.facts = recording.facts(path, {result, {}, nullptr}),
          .steps = std::string(recording.steps()),
          .points = std::string(recording.points()),
          .turns = std::string(recording.turns())};
}

}  // namespace isocnc::plot
