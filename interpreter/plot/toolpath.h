#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "interpreter/simulation/timing.h"

namespace isocnc::plot {

/// A place of the tool tip on its way, and when it is there. Between two of them B, C and the tip go straight at a
/// constant acceleration: after the part u of the time between, (u v0 + u^2 (v1 - v0) / 2) / ((v0 + v1) / 2) of the
/// way.
struct ToolpathPoint {
  geometry::Pose pose;  ///< Machine frame.
  double time = 0;      ///< Seconds.
  double speed = 0;     ///< mm/s along the path; deg/s where B and C alone turn.
};

/// How far the points may be from where the machine goes.
struct ToolpathTolerance {
  double across = 0.01;  ///< mm beside the path.
  double along = 0.05;   ///< mm before or behind at the time.
  double turned = 0.05;  ///< Degrees of B and C.
};

enum class StepKind : std::uint8_t { Rapid, Feed, Arc, Wait };

/// What the machine did for one block: a motion, or time in which it stands.
struct ToolpathStep {
  std::uint64_t line = 0;  ///< From 0.
  StepKind kind = StepKind::Rapid;
  std::size_t tool = 0;  ///< Of tools().
  double feed = 0;       ///< As feed_of().
  /// Where it begins, and then the points of its way: none where it goes nowhere.
  std::span<const ToolpathPoint> points;
};

/// A frame that was in force, in machine coordinates, and the line that first brought it, from 0.
struct ToolpathFrame {
  geometry::Frame frame;
  std::uint64_t line = 0;
};

/// Gathers the way of the tool tip from what Timing tells, as the machine takes it: corners rounded, arcs of G49 split,
/// and swung out where a rapid turns B or C. It keeps one step at a time.
class Toolpath {
 public:
  /// `home` is where the machine stands at the start. `on_step` hears of the steps in their order.
  Toolpath(const simulation::TimedMachine& machine, const geometry::Pose& home,
           std::function<void(const ToolpathStep&)> on_step);

  void add(const motion::Stretch& stretch);
  void add(const simulation::TimedEvent& timed);

  /// The first is no tool; then in the order of their first use.
  const std::vector<std::optional<execution::ToolCode>>& tools() const { return tools_; }
  /// In the order in which they came; no more than kMostFrames, each once.
  const std::vector<ToolpathFrame>& frames() const { return frames_; }
  static constexpr std::size_t kMaxFrames = 100;

 private:
  void add_curve(const motion::Path& path, const motion::Phase& phase, double start, double from, double to, int depth);
  ToolpathPoint point_at(const motion::Path& path, const motion::Phase& phase, double start, double time) const;
  void go_to(const ToolpathPoint& point);
  bool leads_by(const ToolpathPoint& point, const ToolpathPoint& from, const ToolpathPoint& to) const;
  bool may_skip_to(const ToolpathPoint& point) const;
  void keep_last();
  geometry::Pose mount(execution::ToolCode tool);
  void add_frame(const running::FrameEvent& event, std::uint64_t line);
  void add_step(const simulation::TimedEvent& timed, StepKind kind, double feed);

  const simulation::TimedMachine& machine_;
  std::function<void(const ToolpathStep&)> on_step_;
  ToolpathTolerance tolerance_;
  std::vector<ToolpathPoint> points_;   ///< Of the present step; the first is its begin.
  std::vector<ToolpathPoint> skipped_;  ///< Behind the last of points_; all but the last may be left out.
  std::vector<std::optional<execution::ToolCode>> tools_{std::nullopt};
  std::size_t tool_ = 0;
  double tool_length_ = 0;
  std::vector<ToolpathFrame> frames_;
};

}  // namespace isocnc::plot
