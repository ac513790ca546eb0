#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "interpreter/kinematics/limits.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// The fastest motion along a path under limits of speed and acceleration that change from span to span. The profile
/// knows lengths and limits only, not the shape of the path. Spans go in one by one, and each is planned as soon as no
/// later span can change it. s is the path parameter, x the square of ds/dt in mm^2/s^2. The class has value semantics.
class Profile {
 public:
  enum class SpanKind : std::uint8_t {
    Line,   ///< Span under LineLimits.
    Curve,  ///< Span under CurveLimits.
    Level,  ///< Span on which the speed is constant.
    Phase,  ///< Span that is a given phase.
  };

  /// An interval of the path with its own limits, and after planning, its phases.
  struct SpeedSpan {
    SpanKind kind = SpanKind::Line;
    std::uint8_t phase_count = 0;  ///< Number of `phases` in use.
    double begin = 0;              ///< Path parameter s at the start, mm or degrees.
    double length = 0;             ///< Range of s, mm or degrees.
    double cap = 0;                ///< Maximum of x on the span.
    double acceleration = 0;       ///< LineLimits::acceleration of a line.
    double fall = 0;               ///< LineLimits::fall of a line.
    double entry_cap = 0;          ///< Maximum of x at the start, by the caps of the previous span and this one.
    double entry = 0;              ///< Maximum of x at the start from which the limits of all later spans can be kept.
    std::size_t bounds = 0;  ///< Number of the first bound of a curve; the forward bounds precede the backward ones.
    std::uint8_t forward_count = 0;
    std::uint8_t backward_count = 0;
    double start = 0;     ///< Start time, s; set by planning.
    double duration = 0;  ///< Duration, s; set by planning.
    std::array<Phase, 3> phases;
  };

  Profile();

  void append_line(double begin, double length, const kinematics::LineLimits& limits);
  /// Appends a span of a curve, with the bounds of its CurveLimits. `cap`: maximum of x, by these and by the feed.
  void append_curve(double begin, double length, double cap, std::span<const kinematics::CurveBound> forward,
                    std::span<const kinematics::CurveBound> backward);
  /// Appends a span on which the speed is constant. `cap`: maximum of x.
  void append_level(double length, double cap);
  /// Appends a span that is a given phase. Requires that the machine is at rest, and comes to rest after the last one
  /// of a sequence of such spans.
  void append_phase(double length, const Phase& phase);

  /// Plans all spans appended so far, with rest at their end.
  void come_to_rest();
  /// Stays at rest for a time, s. Requires that the machine is at rest.
  void wait(double seconds) { time_ += seconds; }

  /// Returns whether enough unplanned spans have accumulated for plan_ahead().
  bool wants_planning() const { return unplanned() >= batch_; }
  /// Plans all spans that no later span can change.
  void plan_ahead();
  std::size_t unplanned() const { return spans_.size() - planned_; }

  /// Returns the planned span `after` places after the next one, or null.
  const SpeedSpan* front(std::size_t after = 0) const {
    return handed_out_ + after < planned_ ? &spans_[handed_out_ + after] : nullptr;
  }
  void pop(std::size_t count = 1) { handed_out_ += count; }

  /// Frees the memory of popped spans. Invalidates pointers to spans.
  void forget_handed_out();
  /// Returns whether enough spans are popped to make forget_handed_out() worth its cost.
  bool holds_much_past() const;
  /// Returns the number of bytes held outside the object itself.
  std::size_t memory() const { return bytes_of(spans_) + bytes_of(bounds_); }

  /// Returns the time at the end of all planned spans, s.
  double time() const { return time_; }

 private:
  SpeedSpan& add(SpanKind kind, double begin, double length, double cap);
  std::span<const kinematics::CurveBound> bounds(const SpeedSpan& span, kinematics::Direction direction) const;
  double reach(const SpeedSpan& span, double x, kinematics::Direction direction) const;
  std::size_t look_back();
  void look_back_from_rest();
  void plan_until(std::size_t end, double exit);
  void assign_times(SpeedSpan& span, double entry, double exit, bool is_reach);

  std::vector<SpeedSpan> spans_;
  std::vector<kinematics::CurveBound> bounds_;
  std::size_t first_bound_ = 0;  ///< Number of the first element of `bounds_`.
  std::size_t handed_out_ = 0;   ///< Number of popped spans in `spans_`.
  std::size_t planned_ = 0;      ///< Number of planned spans in `spans_`.
  std::size_t batch_;            ///< Number of unplanned spans that triggers planning.
  double speed_square_ = 0;      ///< x at the start of the first unplanned span, mm^2/s^2.
  double last_cap_ = 0;          ///< Maximum of x on the last span; 0 at rest.
  double time_ = 0;              ///< Time at the end of all planned spans, s.
};

}  // namespace isocnc::motion
