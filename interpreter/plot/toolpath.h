#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "interpreter/timing/timing.h"

namespace isocnc::plot {

/// A position of the tool tip on its path, with its time. Between two points B, C and the tip move straight at a
/// constant acceleration: after the part u of the time between, they have covered the part (u v0 + u^2 (v1 - v0) / 2) /
/// ((v0 + v1) / 2) of the path.
struct ToolpathPoint {
  geometry::Pose pose;  ///< Machine frame.
  double time = 0;      ///< Seconds.
  double speed = 0;     ///< mm/s along the path; deg/s where B and C alone turn.
};

/// Maximum deviation of the points from the machine's motion.
struct ToolpathTolerance {
  double across = 0.01;  ///< mm across the path.
  double along = 0.05;   ///< mm along the path at the same time.
  double turned = 0.05;  ///< Degrees of B and C.
};

enum class StepKind : std::uint8_t { Rapid, Feed, Arc, Wait };

/// The machine's activity for one block: a motion, or time at rest.
struct ToolpathStep {
  std::size_t line = 0;  ///< From 0.
  StepKind kind = StepKind::Rapid;
  std::size_t tool = 0;  ///< Index in tools().
  double feed = 0;       ///< Same units as feed_of().
  /// The start point, then the points of the path; only the start if nothing moves.
  std::span<const ToolpathPoint> points;
};

/// A frame that was in force, in machine coordinates, and the line that first mounted it, from 0.
struct ToolpathFrame {
  geometry::Frame frame;
  std::size_t line = 0;
};

/// Collects the path of the tool tip from the reports of Timing, as the machine takes it: with rounded corners, split
/// arcs of G49, and swings where a rapid turns B or C. It keeps one step at a time.
class Toolpath {
 public:
  /// `home` is the machine's position at the start. `on_step` is called with the steps in their order.
  Toolpath(const timing::TimedMachine& machine, const geometry::Pose& home,
           std::function<void(const ToolpathStep&)> on_step);

  void add(const motion::Stretch& stretch);
  void add(const timing::TimedEvent& timed);

  /// The first entry means no tool; the others are in the order of their first use.
  const std::vector<std::optional<execution::ToolCode>>& tools() const { return tools_; }
  /// In the order of their first use, each once; at most kMaxFrames.
  const std::vector<ToolpathFrame>& frames() const { return frames_; }
  static constexpr std::size_t kMaxFrames = 100;

 private:
  void add_curve(const kinematics::Path& path, const motion::Phase& phase, double start, double from, double to,
                 int depth);
  ToolpathPoint point_at(const kinematics::Path& path, const motion::Phase& phase, double start, double time) const;
  void go_to(const ToolpathPoint& point);
  bool leads_by(const ToolpathPoint& point, const ToolpathPoint& from, const ToolpathPoint& to) const;
  bool may_skip_to(const ToolpathPoint& point) const;
  void keep_last();
  geometry::Pose mount(execution::ToolCode tool);
  void add_frame(const running::FrameEvent& event, std::size_t line);
  void add_step(const timing::TimedEvent& timed, StepKind kind, double feed);

  const timing::TimedMachine& machine_;
  std::function<void(const ToolpathStep&)> on_step_;
  ToolpathTolerance tolerance_;
  std::vector<ToolpathPoint> points_;   ///< Points of the current step; the first is its start.
  std::vector<ToolpathPoint> skipped_;  ///< Points after the last of points_; all but the last may be left out.
  std::vector<std::optional<execution::ToolCode>> tools_{std::nullopt};
  std::size_t tool_ = 0;
  double tool_length_ = 0;
  std::vector<ToolpathFrame> frames_;
};

}  // namespace isocnc::plot
