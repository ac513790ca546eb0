#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "interpreter/running/event.h"
#include "interpreter/timing/spindle_turn.h"
#include "interpreter/timing/timed_event.h"
#include "interpreter/timing/timed_machine.h"
#include "interpreter/timing/tip_position.h"

namespace isocnc::timing {

/// State of a machine at rest after a program (part) has run.
struct Standing {
  double time = 0;
  geometry::Pose tip;         ///< Machine frame.
  geometry::Pose programmed;  ///< Programmed position, machine frame; differs from `tip` after a tool change.
  ToolLength tool;
  UnknownOffset unknown;
  geometry::Mat3 frame_axes = geometry::Mat3::Identity();  ///< Axes of the frame in force, machine frame.
  SpindleMotion spindle;
  double spindle_speed = 0;  ///< The last S; 0 before any.
};

/// What an event asks of the machine.
struct Request {
  TimedEvent timed;          ///< Its times are not known yet.
  std::uint64_t number = 0;  ///< Counts the requests of a run.
  /// Seconds for which the machine stands still for the event, after it has come to rest; none if it need not stop.
  std::optional<double> rest;
  geometry::Pose tip;  ///< Where the tip is after a request to rest, machine frame.
};

/// Reads what the events of a run ask of the machine: with its tool, its spindle, and the place where it really is. A
/// value: a copy reads independently.
class RequestReader {
 public:
  /// Keeps the requests.
  class Receiver {
   public:
    /// A request at the end of all, to be filled in. It is complete once complete_last() is called; the next one is
    /// added after that.
    virtual Request& add() = 0;
    /// The one that was added last.
    virtual Request& last() = 0;
    virtual void complete_last() = 0;

   protected:
    ~Receiver() = default;
  };

  /// Refers to the machine.
  explicit RequestReader(const TimedMachine& machine) : machine_(&machine), position_(machine.home) {}
  RequestReader(const TimedMachine& machine, const Standing& standing);

  /// A motion is complete with the next event that is no G09, or with finish().
  void take(const running::Event& event, Receiver& receiver);
  void finish(Receiver& receiver);

  /// Position of the tip after all complete requests (machine frame), and of the joints there.
  geometry::Pose tip() const { return position_.tip(); }
  kinematics::Coordinates joints() const { return position_.joints(machine_->motion.kinematics); }

 private:
  bool is_place_known() const { return position_.is_place_known(machine_->motion.kinematics); }
  std::shared_ptr<const UnknownOffset> unknown_offset() const;
  Request& add(const running::Event& event, Receiver& receiver);
  void complete_motion(Receiver& receiver);
  void complete_rest(Request& request, double seconds);
  double seconds_of(const running::Event& event) const;
  void turn_spindle(const running::Event& event);

  const TimedMachine* machine_;
  std::uint64_t count_ = 0;
  bool holds_motion_ = false;  ///< The last request is a motion that a G09 may follow.
  bool stops_exactly_ = false;
  TipPosition position_;
  SpindleMotion spindle_;
  double spindle_speed_ = 0;  ///< The last S; 0 before any.
};

}  // namespace isocnc::timing
