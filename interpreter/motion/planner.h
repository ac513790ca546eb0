#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpreter/motion/blend.h"
#include "interpreter/motion/element.h"
#include "interpreter/motion/limits.h"
#include "interpreter/motion/machine.h"
#include "interpreter/motion/move.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Gives moves their time. Moves go in one by one, and come out as stretches in the same order, as soon as nothing that
/// may still follow can change them:
///
///     planner.push(move);
///     while (const Stretch* stretch = planner.next()) use(*stretch);
///     ...
///     planner.rest();
///     while (const Stretch* stretch = planner.next()) use(*stretch);
///
/// The times are the shortest under the constraints of docs/motion.md. Memory is bounded, however long the program,
/// if next() is called as above. What comes out depends on what went in, not on when next() was called. A planner is a
/// value: a copy goes on by itself.
class Planner {
 public:
  explicit Planner(Machine machine);

  /// A move that goes nowhere has no stretch; its exact stop holds.
  void push(const Move& move);

  /// The machine comes to rest after all that was pushed, and stays so for a time: at dwells, tool changes, and
  /// wherever the control waits.
  void rest(double seconds = 0);

  /// The next stretch, or null where what was pushed does not determine it yet. Valid until the planner is used again.
  const Stretch* next();

  /// Seconds until the end of all stretches that are determined, rests included.
  double time() const { return time_; }

 private:
  enum class SpanKind : std::uint8_t { Line, Curve, Corner };

  /// A piece of the path with limits of its own.
  struct Span {
    SpanKind kind = SpanKind::Line;
    std::uint8_t phase_count = 0;
    bool ends_move = false;
    std::uint64_t tag = 0;
    std::uint64_t next_tag = 0;  ///< Corner: of its second half.
    double begin = 0;
    double length = 0;
    double cap = 0;           ///< Most x = (ds/dt)^2.
    double acceleration = 0;  ///< Line: most |a|.
    double entry_cap = 0;     ///< Most x at the begin, by the span before and this one.
    double entry = 0;         ///< Most x at the begin, from which what follows can be kept.
    std::size_t curve = 0;    ///< Curve: its limits' number.
    double start = 0;         ///< When planned.
    double duration = 0;
    std::array<Phase, 3> phases;
    Path path;
  };

  void take_elements();
  void take(Element element);
  void join(Element& next);
  void come_to_rest();
  void append(const Element& element);
  void append_line(const Element& element);
  void append_curve(const Element& element);
  void append_corner(const Blend& blend, const Element& before, const Element& after);
  Span& add(SpanKind kind, const Element& element, double cap);

  double before(const Span& span, double exit) const;
  double after(const Span& span, double entry) const;
  std::size_t look_back();
  void look_back_from_rest();
  void plan_ahead();
  void plan_until(std::size_t end, double exit);
  void give_time(Span& span, double entry, double exit);
  void forget_handed_out();

  Machine machine_;
  Splitter splitter_;
  Element last_;  ///< Its end waits for what comes next.
  bool has_last_ = false;
  geometry::Pose end_;  ///< Of the last move.
  bool has_end_ = false;

  std::vector<Span> spans_;
  std::vector<CurveLimits> curves_;
  std::size_t first_curve_ = 0;  ///< Number of the first in curves_.
  std::size_t handed_out_ = 0;   ///< Spans before it.
  std::size_t planned_ = 0;      ///< Spans before it have their times.
  std::size_t batch_;            ///< So many unplanned spans call for planning.
  bool half_out_ = false;        ///< The first half of a corner is handed out.
  double speed_square_ = 0;      ///< x at the begin of the first unplanned span.
  double last_cap_ = 0;          ///< Of the last span; 0 at rest.
  double time_ = 0;
  Stretch stretch_;
};

}  // namespace isocnc::motion
