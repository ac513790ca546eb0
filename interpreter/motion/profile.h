#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "interpreter/motion/limits.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// The fastest motion along a way, whatever it leads along, under limits of speed and acceleration that change from
/// span to span. Spans go in one by one, and are planned as soon as nothing that may still follow can change them. A
/// value.
class Profile {
 public:
  enum class SpanKind : std::uint8_t {
    Line,   ///< Limits as in LineLimits.
    Curve,  ///< Limits as in CurveLimits.
    Level,  ///< The speed stays as it is.
  };

  struct Span {
    SpanKind kind = SpanKind::Line;
    std::uint8_t phase_count = 0;
    double begin = 0;  ///< s.
    double length = 0;
    double cap = 0;           ///< Most x = (ds/dt)^2.
    double acceleration = 0;  ///< Line: as in LineLimits.
    double fall = 0;          ///< The same.
    double entry_cap = 0;     ///< Most x at the begin, by the span before and this one.
    double entry = 0;         ///< Most x at the begin, from which what follows can be kept.
    std::size_t bounds = 0;   ///< Curve: number of the first of its bounds, those forward before those backward.
    std::uint8_t forward_count = 0;
    std::uint8_t backward_count = 0;
    double start = 0;  ///< When planned.
    double duration = 0;
    std::array<Phase, 3> phases;
  };

  Profile();

  void append_line(double begin, double length, const LineLimits& limits);
  /// `cap`: most x, in addition to the limits' own.
  void append_curve(double begin, double length, double cap, const CurveLimits& limits);
  void append_level(double length, double cap);

  /// Plans all that was appended; it ends at rest, which lasts some time.
  void come_to_rest();
  void wait(double seconds) { time_ += seconds; }

  /// Whether enough has gathered to look for what is determined.
  bool wants_planning() const { return unplanned() >= batch_; }
  void plan_ahead();
  std::size_t unplanned() const { return spans_.size() - planned_; }

  /// The next span that is planned, or one of those after it, or null.
  const Span* front(std::size_t after = 0) const {
    return handed_out_ + after < planned_ ? &spans_[handed_out_ + after] : nullptr;
  }
  void pop(std::size_t count = 1) { handed_out_ += count; }

  /// Gives back the memory of what was popped. Pointers to spans are lost.
  void forget_handed_out();
  /// Whether that is worth it.
  bool holds_much_past() const;
  /// Bytes that it holds, beside itself.
  std::size_t memory() const { return bytes_of(spans_) + bytes_of(bounds_); }

  /// Seconds until the end of all that is planned.
  double time() const { return time_; }

 private:
  Span& add(SpanKind kind, double begin, double length, double cap);
  std::span<const CurveBound> bounds(const Span& span, Direction direction) const;
  double reach(const Span& span, double x, Direction direction) const;
  std::size_t look_back();
  void look_back_from_rest();
  void plan_until(std::size_t end, double exit);
  void assign_times(Span& span, double entry, double exit, bool is_reach);

  std::vector<Span> spans_;
  std::vector<CurveBound> bounds_;
  std::size_t first_bound_ = 0;  ///< Number of the first in bounds_.
  std::size_t handed_out_ = 0;   ///< Spans before it.
  std::size_t planned_ = 0;      ///< Spans before it have their times.
  std::size_t batch_;            ///< So many unplanned spans call for planning.
  double speed_square_ = 0;      ///< x at the begin of the first unplanned span.
  double last_cap_ = 0;          ///< Of the last span; 0 at rest.
  double time_ = 0;
};

}  // namespace isocnc::motion
