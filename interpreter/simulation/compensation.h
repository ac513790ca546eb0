#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "interpreter/geometry/contour_offset.h"
#include "interpreter/syntax/finding.h"
#include "interpreter/timing/timing.h"

namespace isocnc::simulation {

/// A finding during a run that does not stop it.
struct RunWarning {
  std::size_t line = 0;  ///< From 0.
  dialect::DiagnosticId id = dialect::kNoDiagnostic;
  std::array<double, dialect::kMaxArguments> values{};  ///< Lengths in mm.
  bool is_in_inches = false;                            ///< G70 is in force there.

  friend bool operator==(const RunWarning&, const RunWarning&) = default;
};

/// The finding that tells a warning, without a span.
syntax::Finding finding_of(const RunWarning& warning);

/// Turns the programmed motions under G41 and G42 into motions of the tool tip, in the same order among all events
/// (docs/dialect.md gives the rules). Inserted motions get the line of the motion before them. All other events pass
/// through unchanged: at once without compensation, and under it as soon as the motion before them is fully known.
///
/// Memory does not grow with the program. A value: a copy runs independently.
class Compensation {
 public:
  /// Callbacks for the compensated events and the warnings.
  struct Listeners {
    std::function<void(const running::Event&)> event;
    std::function<void(const RunWarning&)> warning;
  };

  /// Keeps a reference to the machine, which knows the radii of the tools.
  explicit Compensation(const timing::TimedMachine& machine) : machine_(&machine) {}
  /// For a machine between two blocks, not under G41 or G42, with the given tool. `beside` is the last motion with
  /// compensation, if the tool is still offset from the program; otherwise null.
  Compensation(const timing::TimedMachine& machine, const execution::ToolCode& tool, const running::MoveEvent* beside);

  void take(const running::Event& event, const Listeners& listeners);

  /// Stops the look-ahead: the control reads the next block only when the machine has arrived here (I.5, I.3.11). The
  /// tool stops at the offset end point of the last motion and continues the contour from there. IF and G990 do this
  /// without a call.
  void pause(const Listeners& listeners);

  /// Ends the run: the tool stays at the offset end point of the contour.
  void finish(const Listeners& listeners) { end_contour(listeners); }

  /// Whether motions wait for the ones after them. The tool has then not yet made all motions taken.
  bool holds_motions() const { return is_open_ && !is_paused_; }
  /// Whether the tool is off the programmed path. After G40 it stays so until a motion leads it back.
  bool is_beside_contour() const { return is_beside_; }

  /// Heap memory in bytes, without the object itself.
  std::size_t memory() const;

 private:
  /// Axes and normal of the arc plane, in the machine frame.
  struct ContourPlane {
    geometry::Vec3 u = geometry::Vec3::UnitX();
    geometry::Vec3 v = geometry::Vec3::UnitY();
    geometry::Vec3 normal = geometry::Vec3::UnitZ();

    geometry::Vec2 flat(const geometry::Vec3& point) const { return {u.dot(point), v.dot(point)}; }
    geometry::Vec3 point(const geometry::Vec2& flat, double height) const;
    /// Whether a motion runs along the normal only, or has no length.
    bool is_upright(const running::MoveEvent& move) const;
  };

  /// The block of an element.
  struct ElementBlock {
    std::size_t line = 0;
    bool is_in_inches = false;
  };

  /// An event that has not been passed on: an element of the contour, or an event after one.
  struct HeldEvent {
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
  void go(const running::Event& of, const running::MoveEvent& move, const Listeners& listeners);
  const ElementBlock& block_of(std::uint64_t element) const;
  std::uint64_t count(const running::Event& event);

  const timing::TimedMachine* machine_;
  double radius_ = 0;  // Radius of the mounted tool, mm.
  ContourPlane plane_;
  geometry::ContourOffset contour_{1};
  bool is_open_ = false;    // The contour has not ended.
  bool is_paused_ = false;  // All events of the contour have been passed on.
  bool is_beside_ = false;  // The tip is off the programmed position.
  geometry::Pose tip_;      // Position of the tip while it is off the program.
  std::deque<HeldEvent> waiting_;
  std::deque<ElementBlock> blocks_;  // Of the last elements.
  std::uint64_t elements_ = 0;
};

}  // namespace isocnc::simulation
