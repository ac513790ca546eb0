#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "debugger/debuggee/debuggee.h"
#include "debugger/debuggee/surroundings.h"
#include "interpreter/simulation/simulation.h"

namespace isocnc::expressions {

/// A moment of a run, as expressions see it.
struct Moment {
  const execution::State& state;
  const running::Registers& registers;
  double vgpl = 0;
  std::size_t line = 0;           ///< From 0.
  double override_percent = 100;  ///< Override of the feed.
  double playback = 0;            ///< 0: as fast as possible; 1: in real time.
  /// The machine at this moment. Without it, as in a search backward, the machine counts as standing where the program
  /// has led it, and the time is not known.
  const simulation::Simulation* machine = nullptr;
  /// What surrounds the machine; null where it does not matter.
  const debuggee::Surroundings* surroundings = nullptr;
  /// How deep the contact that is judged gets, mm; none where none is.
  std::optional<double> contact_depth = {};
};

/// The present of a simulation.
Moment moment_of(const simulation::Simulation& simulation);

/// What takes changes of quantities by hand: the session. Each throws RequestError where the program does not stand.
class Controls {
 public:
  /// Changes what IFs compare, wherever the program stands.
  virtual void change_variables(const std::function<void(debuggee::Debuggee& debuggee)>& change) = 0;
  /// Changes the machine itself, between two blocks and not under G41 or G42.
  virtual void change_machine(const std::function<void(debuggee::Debuggee& debuggee)>& change) = 0;
  /// 0: as fast as possible; 1: in real time.
  virtual void set_playback(double speed) = 0;
  virtual debuggee::Debuggee& stopped_debuggee() const = 0;
  virtual std::string_view in_language(const dialect::Text& text) const = 0;

 protected:
  Controls() = default;
  ~Controls() = default;
};

/// Something that has a number at any moment, and its name: `X`, `ZM`, `V12`, `MOTION`. Its row in the table is all
/// that there is to it, also for what can be set.
struct Quantity {
  using Read = double (*)(const Moment& moment, int index);
  /// False where it cannot have the value, which is finite. Throws RequestError where the machine cannot take the
  /// change now.
  using Set = bool (*)(Controls& controls, int index, double value);

  std::string_view name;
  dialect::Text meaning;
  std::string_view unit = {};  ///< `mm`, `°`, ...; empty for plain numbers.
  Read read = nullptr;
  int index = 0;      ///< Which one of its kind: of registers the number.
  Set set = nullptr;  ///< Null for a quantity that cannot be set.
  /// For what surrounds the machine, which changes all along a path: what a limit of it is for.
  std::optional<debuggee::LimitedQuantity> limited = {};

  double at(const Moment& moment) const { return read(moment, index); }
};

/// The quantity with this name, in any case; null when there is none.
const Quantity* find_quantity(std::string_view name);

/// The number of the register with this name, `V1` to `V30` in any case; none for other names.
std::optional<int> find_register(std::string_view name);

/// All quantities, in the order of the documentation.
std::span<const Quantity> all_quantities();

/// The tool tip as the program counts it: in the frame in force, the workpiece frame, the machine frame.
geometry::Pose programmed_pose(const Moment& moment);
geometry::Pose workpiece_pose(const Moment& moment);
geometry::Pose machine_pose(const Moment& moment);

}  // namespace isocnc::expressions
