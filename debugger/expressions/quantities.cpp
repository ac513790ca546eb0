#include "debugger/expressions/quantities.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "debugger/dap/request_error.h"
#include "interpreter/dialect/any_case.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::expressions {

using dialect::ModalGroup;
using geometry::Pose;

static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

Moment moment_of(const simulation::Simulation& simulation) {
  const running::RunResult& run = simulation.run();
  return {.state = run.state,
          .registers = run.registers,
          .vgpl = simulation.vgpl(),
          .line = simulation.line(),
          .machine = &simulation};
}

Pose machine_pose(const Moment& moment) {
  if (moment.machine != nullptr) return moment.machine->sample().tip;
  const Pose& position = moment.state.position;
  return {moment.state.to_machine(position.tip), position.b, position.c};
}

Pose workpiece_pose(const Moment& moment) {
  Pose pose = machine_pose(moment);
  pose.tip -= moment.state.workpiece_origin;
  return pose;
}

/// Between two blocks the position as programmed, to the last digit; within a block the place of the tip.
Pose programmed_pose(const Moment& moment) {
  const execution::State& state = moment.state;
  if (moment.machine == nullptr || !moment.machine->is_in_block()) return state.position;
  Pose pose = workpiece_pose(moment);
  if (state.face_mounted) pose.tip = state.face.to_inner(pose.tip);
  return pose;
}

static double component(const Pose& pose, int index) {
  return index < 3 ? pose.tip[index] : index == 3 ? pose.b : pose.c;
}

/// Unknown for an axis that an error has left open.
static double read_programmed(const Moment& moment, int index) {
  const bool is_open = (moment.state.unknown & execution::axis_bit(static_cast<execution::Axis>(index))) != 0;
  return is_open ? kUnknown : component(programmed_pose(moment), index);
}
static double read_workpiece(const Moment& moment, int index) { return component(workpiece_pose(moment), index); }
static double read_machine(const Moment& moment, int index) { return component(machine_pose(moment), index); }
static double read_joint(const Moment& moment, int index) {
  return moment.machine != nullptr ? moment.machine->sample().joints[index] : kUnknown;
}
static double read_register(const Moment& moment, int index) {
  return moment.registers[static_cast<std::size_t>(index)];
}
static double read_mode(const Moment& moment, int index) {
  const dialect::GCode* const code = moment.state.g(static_cast<ModalGroup>(index));
  return code != nullptr ? code->number : kUnknown;
}
static double read_vgpl(const Moment& moment, int) { return moment.vgpl; }
static double read_override(const Moment& moment, int) { return moment.override_percent; }
static double read_playback(const Moment& moment, int) { return moment.playback; }
static double read_line(const Moment& moment, int) { return static_cast<double>(moment.line) + 1; }
static double read_time(const Moment& moment, int) {
  return moment.machine != nullptr ? moment.machine->time() : kUnknown;
}
static double read_speed(const Moment& moment, int) {
  return moment.machine != nullptr ? moment.machine->sample().speed * kinematics::kSecondsPerMinute : kUnknown;
}
static double read_clearance(const Moment& moment, int) {
  if (moment.machine == nullptr || moment.surroundings == nullptr) return kUnknown;
  return moment.surroundings->clearance_of(*moment.machine);
}
static double read_depth(const Moment& moment, int) {
  if (moment.contact_depth) return *moment.contact_depth;
  if (moment.machine == nullptr || moment.surroundings == nullptr) return kUnknown;
  return moment.surroundings->depth_of(*moment.machine);
}
static debuggee::MaterialHistory* material_of(const Moment& moment) {
  return moment.machine != nullptr && moment.surroundings != nullptr ? moment.surroundings->material() : nullptr;
}
static double read_removed(const Moment& moment, int) {
  debuggee::MaterialHistory* const material = material_of(moment);
  return material != nullptr ? material->removed_at(*moment.machine).volume : kUnknown;
}
static double read_in_cut(const Moment& moment, int) {
  debuggee::MaterialHistory* const material = material_of(moment);
  if (material == nullptr) return kUnknown;
  return material->is_in_cut(*moment.machine) ? 1 : 0;
}
static double read_feed(const Moment& moment, int) { return execution::feed_in_force(moment.state).number; }
static double read_spindle_speed(const Moment& moment, int) { return moment.state.spindle_speed; }
static double read_spindle(const Moment& moment, int) { return moment.state.spindle_function; }
static double read_tool(const Moment& moment, int index) {
  const execution::ToolCode& tool = moment.state.tool;
  switch (index) {
    case 0:
      return tool.head * 100000 + tool.holder * 1000 + tool.tool;
    case 1:
      return tool.head;
    case 2:
      return tool.holder;
    default:
      return tool.tool;
  }
}

// What rows can set. Values are finite.

static bool set_register(Controls& controls, int index, double value) {
  controls.change_variables([&](debuggee::Debuggee& debuggee) { debuggee.set_register(index, value); });
  return true;
}
static bool set_vgpl(Controls& controls, int, double value) {
  controls.change_variables([&](debuggee::Debuggee& debuggee) { debuggee.set_vgpl(value); });
  return true;
}
static bool set_spindle_speed(Controls& controls, int, double value) {
  if (!(value > 0)) return false;
  controls.change_machine([&](debuggee::Debuggee& debuggee) { debuggee.set_spindle_speed(value); });
  return true;
}
/// Under G93 no F outlives its line (I.3.7, D43), so there is nothing to be set.
static bool set_feed(Controls& controls, int, double value) {
  static constexpr dialect::Text kInverseTime{"G93 is in force: an F counts for its own line alone",
                                              "G93 è in presa: una F vale solo per la sua linea"};
  if (!(value > 0)) return false;
  if (controls.stopped_debuggee().present().run().state.inverse_time())
    throw dap::RequestError(std::string(controls.in_language(kInverseTime)));
  controls.change_machine([&](debuggee::Debuggee& debuggee) { debuggee.set_feed(value); });
  return true;
}
static bool set_override(Controls& controls, int, double value) {
  constexpr double kMaxPercent = 1000;
  if (!(value > 0) || value > kMaxPercent) return false;
  controls.change_machine([&](debuggee::Debuggee& debuggee) { debuggee.set_feed_override(value / 100); });
  return true;
}
static bool set_playback(Controls& controls, int, double value) {
  if (value < 0) return false;
  controls.set_playback(value);
  return true;
}

namespace {

constexpr std::array<std::string_view, 5> kUnits{"mm", "mm", "mm", "°", "°"};

/// `V1` to `V30`.
std::string_view register_name(int number) {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (int i = 0; i <= dialect::kRegisterCount; ++i) names.push_back("V" + std::to_string(i));
    return names;
  }();
  return kNames[static_cast<std::size_t>(number)];
}

void add_axes(std::vector<Quantity>& quantities, std::span<const std::string_view> names, dialect::Text meaning,
              Quantity::Read read) {
  for (std::size_t i = 0; i < names.size(); ++i)
    quantities.push_back(
        {.name = names[i], .meaning = meaning, .unit = kUnits[i], .read = read, .index = static_cast<int>(i)});
}

void add_positions(std::vector<Quantity>& quantities) {
  static constexpr std::array<std::string_view, 5> kProgrammed{"X", "Y", "Z", "B", "C"};
  static constexpr std::array<std::string_view, 3> kWorkpiece{"XW", "YW", "ZW"};
  static constexpr std::array<std::string_view, 5> kMachine{"XM", "YM", "ZM", "BM", "CM"};
  static constexpr std::array<std::string_view, 5> kJoints{"XJ", "YJ", "ZJ", "BJ", "CJ"};
  add_axes(quantities, kProgrammed, {"tool tip, frame in force", "punta utensile, s.d.r. in presa"}, read_programmed);
  add_axes(quantities, kWorkpiece, {"tool tip, workpiece frame", "punta utensile, s.d.r. di pezzo"}, read_workpiece);
  add_axes(quantities, kMachine, {"tool tip, machine frame", "punta utensile, s.d.r. di macchina"}, read_machine);
  add_axes(quantities, kJoints, {"axis of the machine", "asse della macchina"}, read_joint);
}

/// Quantities that are none of a series.
constexpr Quantity kSingle[] = {
    {.name = "S",
     .meaning = {"spindle speed", "velocità del mandrino"},
     .unit = "1/min",
     .read = read_spindle_speed,
     .set = set_spindle_speed},
    {.name = "F", .meaning = {"feed rate as written", "avanzamento come scritto"}, .read = read_feed, .set = set_feed},
    {.name = "SPEED",
     .meaning = {"present speed of the tip", "velocità attuale della punta"},
     .unit = "mm/min",
     .read = read_speed},
    {.name = "SPINDLE", .meaning = {"M of the spindle: 3, 4 or 5", "M del mandrino: 3, 4 o 5"}, .read = read_spindle},
    {.name = "T", .meaning = {"tool in the spindle", "utensile nel mandrino"}, .read = read_tool},
    {.name = "HEAD", .meaning = {"head of the tool", "testa dell'utensile"}, .read = read_tool, .index = 1},
    {.name = "HOLDER", .meaning = {"holder of the tool", "portautensile"}, .read = read_tool, .index = 2},
    {.name = "TOOL", .meaning = {"number of the tool", "numero dell'utensile"}, .read = read_tool, .index = 3},
    {.name = "CLEARANCE",
     .meaning = {"distance from the nearest obstacle to stay away from",
                 "distanza dall'ostacolo più vicino da cui stare lontano"},
     .unit = "mm",
     .read = read_clearance,
     .limited = debuggee::LimitedQuantity::Clearance},
    {.name = "DEPTH",
     .meaning = {"depth of a contact; 0 without one", "profondità di un contatto; 0 se non c'è"},
     .unit = "mm",
     .read = read_depth,
     .limited = debuggee::LimitedQuantity::Depth},
    {.name = "REMOVED",
     .meaning = {"material removed by the block", "materiale asportato dal blocco"},
     .unit = "mm³",
     .read = read_removed,
     .limited = debuggee::LimitedQuantity::Removed},
    {.name = "INCUT",
     .meaning = {"whether the cutter removes material now: 1 or 0", "se il tagliente asporta materiale ora: 1 o 0"},
     .read = read_in_cut,
     .limited = debuggee::LimitedQuantity::InCut},
    {.name = "VGPL",
     .meaning = {"GPL variable that IF compares", "variabile GPL confrontata da IF"},
     .read = read_vgpl,
     .set = set_vgpl},
    {.name = "LINE", .meaning = {"line of the program", "riga del programma"}, .read = read_line},
    {.name = "TIME", .meaning = {"time since the start", "tempo dall'inizio"}, .unit = "s", .read = read_time},
    {.name = "OVERRIDE",
     .meaning = {"override of the feed", "override del feed"},
     .unit = "%",
     .read = read_override,
     .set = set_override},
    {.name = "PLAYBACK",
     .meaning = {"speed of the run: 0 as fast as possible, 1 in real time",
                 "velocità di esecuzione: 0 la massima, 1 in tempo reale"},
     .read = read_playback,
     .set = set_playback},
};

std::vector<Quantity> make_quantities() {
  std::vector<Quantity> all;
  add_positions(all);
  all.insert(all.end(), std::begin(kSingle), std::end(kSingle));
  for (std::size_t i = 0; i < dialect::kModalGroupCount; ++i)
    all.push_back({.name = dialect::kModalGroups[i].variable,
                   .meaning = dialect::kModalGroups[i].name,
                   .unit = {},
                   .read = read_mode,
                   .index = static_cast<int>(i)});
  for (int i = 1; i <= dialect::kRegisterCount; ++i)
    all.push_back({.name = register_name(i),
                   .meaning = {"register", "registro"},
                   .unit = {},
                   .read = read_register,
                   .index = i,
                   .set = set_register});
  return all;
}

}  // namespace

std::span<const Quantity> all_quantities() {
  static const std::vector<Quantity> kQuantities = make_quantities();
  return kQuantities;
}

const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& quantity : all_quantities())
    if (dialect::equal_words(name, quantity.name)) return &quantity;
  return nullptr;
}

std::optional<int> find_register(std::string_view name) {
  const Quantity* const quantity = find_quantity(name);
  if (quantity == nullptr || quantity->read != read_register) return std::nullopt;
  return quantity->index;
}

}  // namespace isocnc::expressions
