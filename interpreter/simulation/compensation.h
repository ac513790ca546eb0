#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "interpreter/geometry/contour_offset.h"
#include "interpreter/simulation/timing.h"

namespace isocnc::simulation {

/// Something that a run tells and that does not stop it.
struct RunWarning {
  std::uint64_t line = 0;  ///< From 0.
  dialect::DiagnosticId id = dialect::kNoDiagnostic;
  std::array<double, dialect::kMaxArguments> values{};

  friend bool operator==(const RunWarning&, const RunWarning&) = default;
};

/// Turns the motions that a program wants under G41 and G42 into those of the tool tip, in the same order among all
/// events (docs/dialect.md tells the rules). What is inserted has the line of the motion before it. Everything else
/// goes through as it is; without compensation at once, and under it as soon as the motion before it is known to its
/// end.
///
/// Memory does not grow with the program. A value: a copy goes on by itself.
class Compensation {
 public:
  /// Who is told.
  struct Listeners {
    std::function<void(const running::Event&)> event;
    std::function<void(const RunWarning&)> warning;
  };

  /// Keeps a reference to the machine, which knows the radii of the tools.
  explicit Compensation(const TimedMachine& machine) : machine_(&machine) {}
  /// Of a machine that stands between two blocks, not under G41 or G42, with that tool. `beside` is the motion that has
  /// led it beside a contour, from which none has led it back; null elsewhere.
  Compensation(const TimedMachine& machine, const execution::ToolCode& tool, const running::MoveEvent* beside);

  void take(const running::Event& event, const Listeners& listeners);

  /// The control reads on when the machine has come to here, and no sooner (I.5, I.3.11): the tool stops beside the end
  /// of the motion before, and the contour goes on from there. IFs and G990 do so of themselves.
  void pause(const Listeners& listeners);

  /// The run is over: the tool stays beside the contour where that ends.
  void finish(const Listeners& listeners) { end_contour(listeners); }

  /// Whether motions wait for what follows: the tool is not yet where those taken will have led it.
  bool holds_motions() const { return is_open_ && !is_paused_; }
  /// Whether the tool is off the programmed path. After G40 it is, until a motion leads it back.
  bool is_beside_contour() const { return is_beside_; }

  /// Bytes that it holds, beside itself.
  std::size_t memory() const;

 private:
  /// Axes of the arc plane and what stands on it, in the machine frame.
  struct Plane {
    geometry::Vec3 u = geometry::Vec3::UnitX();
    geometry::Vec3 v = geometry::Vec3::UnitY();
    geometry::Vec3 normal = geometry::Vec3::UnitZ();

    geometry::Vec2 flat(const geometry::Vec3& point) const { return {u.dot(point), v.dot(point)}; }
    geometry::Vec3 point(const geometry::Vec2& flat, double height) const;
    /// Whether a motion leads along the normal alone, or nowhere.
    bool is_upright(const running::MoveEvent& move) const;
  };

  /// An event that has not gone out: an element of the contour, or what comes behind one.
  struct Waiting {
    running::Event event;
    std::uint64_t element = 0;
    bool is_element = false;
  };

  void wait(const running::Event& event, const Listeners& listeners);
  void follow(const running::Event& event, const running::MoveEvent& move, const Listeners& listeners);
  void mount(const execution::ToolCode& tool);
  void begin_contour(const running::MoveEvent& move);
  void turn_plane(const geometry::Vec3& normal);
  void end_contour(const Listeners& listeners);
  void come_back(const running::Event& event, const running::MoveEvent& move, const Listeners& listeners);
  void pass_on(const Listeners& listeners);
  void pass_on_before(std::uint64_t element, const Listeners& listeners);
  void go_along(const geometry::OffsetPiece& piece, const Listeners& listeners);
  void go_beside(const running::Event& event, const Listeners& listeners);
  void go(std::uint64_t line, const running::MoveEvent& move, const Listeners& listeners);
  std::uint64_t line_of(std::uint64_t element) const;
  std::uint64_t count(std::uint64_t line);

  const TimedMachine* machine_;
  double radius_ = 0;  // Of the tool that is mounted.
  Plane plane_;
  geometry::ContourOffset contour_{1};
  bool is_open_ = false;    // The contour goes on.
  bool is_paused_ = false;  // Nothing of it waits.
  bool is_beside_ = false;  // The tip is not where the program has led it.
  geometry::Pose tip_;      // Where it is then.
  std::deque<Waiting> waiting_;
  std::deque<std::uint64_t> lines_;  // Of the last elements.
  std::uint64_t elements_ = 0;
};

}  // namespace isocnc::simulation
