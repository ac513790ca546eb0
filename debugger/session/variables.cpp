#include "debugger/session/variables.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "interpreter/text/unicode.h"

namespace isocnc::session {

using dialect::ModalGroup;
using dialect::Text;

namespace {

/// References of scopes, and of the groups in them.
enum Reference : std::int64_t {
  kPosition = 1,
  kModes,
  kFeedAndSpindle,
  kTool,
  kFrames,
  kRegisters,
  kGpl,
  kTimes,
  kMachinePosition,
  kWorkpiecePosition,
  kFacePosition,
  kJointPosition,
  kToGo,
  kWorkpieceFrame,
  kFaceFrame,
  kToolValues,
  kFunctionParameters,
  kSurroundings,
  kMaterial,
  kFunctions = 1000,  ///< The number of an M is added to it.
  kNeighbors = 2000,  ///< The place of an obstacle among all, from 0, is added to it.
};

constexpr std::array<Scope, 10> kScopes{{
    {{"Position", "Posizione"}, kPosition, "locals"},
    {{"Modal groups", "Gruppi modali"}, kModes, {}},
    {{"Feed and spindle", "Feed e mandrino"}, kFeedAndSpindle, {}},
    {{"Tool", "Utensile"}, kTool, {}},
    {{"Frames", "Sistemi di riferimento"}, kFrames, {}},
    {{"Registers", "Registri"}, kRegisters, "registers"},
    {{"GPL variables", "Variabili GPL"}, kGpl, {}},
    {{"Times", "Tempi"}, kTimes, {}},
    {{"Surroundings", "Dintorni"}, kSurroundings, {}, true},
    {{"Material", "Materiale"}, kMaterial, {}, true},
}};

constexpr Text kMachineTip{"Machine", "Macchina"};
constexpr Text kWorkpieceTip{"Workpiece", "Pezzo"};
constexpr Text kFaceTip{"Face", "Faccia"};
constexpr Text kJointsName{"Joints", "Assi"};
constexpr Text kToGoName{"Distance to go", "Distanza residua"};
constexpr Text kPath{"Path", "Percorso"};
constexpr Text kSpindle{"Spindle", "Mandrino"};
constexpr Text kClockwise{"M03, clockwise", "M03, orario"};
constexpr Text kCounterclockwise{"M04, counterclockwise", "M04, antiorario"};
constexpr Text kStopped{"M05, stopped", "M05, fermo"};
constexpr Text kNone{"none", "nessuno"};
constexpr Text kName{"Name", "Nome"};
constexpr Text kLength{"Length", "Lunghezza"};
constexpr Text kRadius{"Radius", "Raggio"};
constexpr Text kOrigin{"Origin", "Origine"};
constexpr Text kWorkpieceFrameName{"Workpiece (machine frame)", "Pezzo (s.d.r. di macchina)"};
constexpr Text kFaceFrameName{"Face (workpiece frame)", "Faccia (s.d.r. di pezzo)"};
constexpr Text kLine{"line {}", "riga {}"};
constexpr Text kDefault{"default", "di default"};
constexpr Text kByHand{"by hand", "a mano"};
constexpr Text kLongAgo{"long ago", "da molto"};
constexpr Text kNoMotion{"none yet", "ancora nessuno"};
constexpr Text kBlocks{"Blocks executed", "Blocchi eseguiti"};
constexpr Text kFeedInForce{"Feed mode", "Modo del feed"};
constexpr Text kPerMinute{"G94, per minute", "G94, al minuto"};
constexpr Text kInverse{"G93, inverse time", "G93, inverso del tempo"};
constexpr Text kHit{"hit, {} mm deep", "urto, profondità {} mm"};
constexpr Text kPart{"Part", "Parte"};
constexpr Text kDistance{"Distance", "Distanza"};
constexpr Text kDepth{"Depth", "Profondità"};
constexpr Text kDepthOfCut{"Depth of cut", "Profondità di passata"};
constexpr Text kWidthOfCut{"Width of cut", "Larghezza di passata"};
constexpr Text kLeft{"Left of the blank", "Resto del grezzo"};
constexpr Text kPoint{"Point", "Punto"};
constexpr Text kDescribed{"Described", "Descritto"};
constexpr Text kNoSuchVariables{"there are no variables with the reference {}",
                                "non ci sono variabili con il riferimento {}"};

/// Lists the variables of one reference.
class Listing {
 public:
  Listing(const Session& session, const expressions::ValueFormat& format)
      : session_(session), moment_(session.moment()), format_(format) {}

  std::vector<Variable> variables;

  std::string in_language(const Text& text) const { return std::string(session_.in_language(text)); }
  std::string show(double value) const { return expressions::show_value(value, format_); }

  void add(std::string name, std::string value, std::string type = {}) {
    variables.push_back({.name = std::move(name), .value = std::move(value), .type = std::move(type)});
  }
  void add_group(const Text& name, std::string value, Reference reference) {
    variables.push_back({.name = in_language(name), .value = std::move(value), .reference = reference});
  }
  void add_quantity(std::string_view quantity_name, std::string name = {}) {
    const expressions::Quantity* const quantity = expressions::find_quantity(quantity_name);
    const std::string unit = quantity->unit.empty() ? "" : fmt::format(", {}", quantity->unit);
    variables.push_back({.name = name.empty() ? std::string(quantity->name) : std::move(name),
                         .value = show(quantity->at(moment_)),
                         .type = in_language(quantity->meaning) + unit,
                         .evaluate_name = std::string(quantity->name),
                         .location = session_.location_of(*quantity),
                         .quantity = quantity->set != nullptr ? quantity : nullptr});
  }

  void list_position() {
    for (const std::string_view axis : {"X", "Y", "Z", "B", "C"}) add_quantity(axis);
    add_group(kMachineTip, pose_text(expressions::machine_pose(moment_)), kMachinePosition);
    add_group(kWorkpieceTip, pose_text(expressions::workpiece_pose(moment_)), kWorkpiecePosition);
    if (moment_.state.face_mounted)
      add_group(kFaceTip, pose_text(expressions::programmed_pose(moment_)), kFacePosition);
    add_group(kJointsName, pose_text(kinematics::pose(present().sample().joints)), kJointPosition);
    add_group(kToGoName, fmt::format("{} mm", show(present().to_go().path)), kToGo);
  }

  void list_machine_position() {
    for (const std::string_view axis : {"XM", "YM", "ZM", "BM", "CM"}) add_quantity(axis);
  }
  void list_workpiece_position() {
    for (const std::string_view axis : {"XW", "YW", "ZW"}) add_quantity(axis);
  }
  void list_face_position() {
    for (const std::string_view axis : {"X", "Y", "Z"}) add_quantity(axis);
  }
  void list_joints() {
    for (const std::string_view axis : {"XJ", "YJ", "ZJ", "BJ", "CJ"}) add_quantity(axis);
  }

  void list_to_go() {
    const simulation::DistanceToGo to_go = present().to_go();
    for (int axis = 0; axis < kinematics::kAxisCount; ++axis)
      add(std::string(1, dialect::kAxisLetters[static_cast<std::size_t>(axis)]), show(to_go.axes[axis]),
          axis < 3 ? "mm" : "°");
    add(in_language(kPath), show(to_go.path), "mm");
  }

  void list_modes() {
    for (std::size_t i = 0; i < dialect::kModalGroupCount; ++i) add_mode(static_cast<ModalGroup>(i));
  }

  void list_feed_and_spindle() {
    add_quantity("F");
    add(in_language(kFeedInForce), in_language(moment_.state.inverse_time() ? kInverse : kPerMinute));
    add_quantity("SPEED");
    add_quantity("OVERRIDE");
    add_quantity("PLAYBACK");
    add_quantity("S");
    const std::uint8_t spindle = moment_.state.spindle_function;
    add(in_language(kSpindle), in_language(spindle == 3 ? kClockwise : spindle == 4 ? kCounterclockwise : kStopped));
  }

  void list_tool() {
    const execution::ToolCode& tool = moment_.state.tool;
    if (tool == execution::ToolCode{}) return add("T", in_language(kNone));
    for (const std::string_view name : {"T", "HEAD", "HOLDER", "TOOL"}) add_quantity(name);
    const timing::TimedMachine& machine = session_.debuggee().machine();
    const configuration::Tool* const known = session_.configuration().machine.find_tool(tool);
    if (known && !known->name.empty()) add(in_language(kName), text::printable(known->name));
    add(in_language(kLength), show(machine.tool_length(tool)), "mm");
    const auto radius = machine.tool_radii.find(tool);
    if (radius != machine.tool_radii.end()) add(in_language(kRadius), show(radius->second), "mm");
  }

  void list_frames() {
    add_group(kWorkpieceFrameName, vector_text(moment_.state.workpiece_origin), kWorkpieceFrame);
    if (moment_.state.face_mounted)
      add_group(kFaceFrameName, vector_text(moment_.state.face.origin), kFaceFrame);
    else
      add(in_language(kFaceFrameName), in_language(kNone));
  }
  void list_workpiece_frame() { add_vector(moment_.state.workpiece_origin); }
  void list_face_frame() {
    const geometry::Frame& face = moment_.state.face;
    add(in_language(kOrigin), vector_text(face.origin), "mm");
    for (int axis = 0; axis < 3; ++axis) add(std::string(1, "ijk"[axis]), vector_text(face.axes.col(axis)));
  }

  void list_registers() {
    for (int number = 1; number <= dialect::kRegisterCount; ++number) add_quantity(fmt::format("V{}", number));
  }

  /// Under the names that the GPL of the control gives them (I.4.2 to I.5).
  void list_gpl() {
    add_quantity("VGPL", "Var_IF[1]");
    add_quantity("S", "SValue");
    const execution::ToolCode& tool = moment_.state.tool;
    variables.push_back({.name = "TValues",
                         .value = fmt::format("{}, {}, {}", tool.head, tool.holder, tool.tool),
                         .reference = kToolValues});
    variables.push_back({.name = "MxMFunParams", .value = "", .reference = kFunctionParameters});
  }
  void list_tool_values() {
    add_quantity("HEAD", "[1]");
    add_quantity("HOLDER", "[2]");
    add_quantity("TOOL", "[3]");
  }
  void list_functions() {
    for (const debuggee::Journal::Function& function : session_.journal().functions(present().blocks())) {
      std::string values;
      for (const execution::FunctionParameter& each : function.call.parameters)
        values += fmt::format("{}P{}={}", values.empty() ? "" : " ", each.number, show(each.value));
      variables.push_back({.name = fmt::format("[{}]", function.call.number),
                           .value = values,
                           .reference = kFunctions + function.call.number});
    }
  }
  void list_function(int number) {
    for (const debuggee::Journal::Function& function : session_.journal().functions(present().blocks())) {
      if (function.call.number != number) continue;
      for (const execution::FunctionParameter& each : function.call.parameters)
        add(fmt::format("P{}", each.number), show(each.value));
    }
  }

  void list_times() {
    add_quantity("TIME");
    add(in_language(kBlocks), std::to_string(present().blocks()));
    add_quantity("LINE");
  }

  /// The nearest obstacle first.
  void list_surroundings() {
    add_quantity("CLEARANCE");
    add_quantity("DEPTH");
    const std::vector<verification::Neighbor>& neighbors = session_.surroundings().neighbors_of(present());
    for (std::size_t i = 0; i < neighbors.size(); ++i) {
      const verification::Neighbor& each = neighbors[i];
      variables.push_back({.name = text::printable(each.whom.in(session_.language())),
                           .value = each.is_contact()
                                        ? session_.in_language(kHit, show_length(std::max(0.0, -each.distance)))
                                        : fmt::format("{} mm", show_length(each.distance)),
                           .reference = kNeighbors + static_cast<std::int64_t>(i)});
    }
  }
  /// What the block does to the material, and what is left of it.
  void list_material() {
    debuggee::MaterialHistory* const material = session_.surroundings().material();
    if (material == nullptr) return;
    add_quantity("REMOVED");
    add_quantity("INCUT");
    const removal::Removed removed = material->removed_at(present());
    add(in_language(kDepthOfCut), show_length(removed.depth), "mm");
    add(in_language(kWidthOfCut), show_length(removed.width), "mm");
    const double volume = material->stock_at(present()).volume();
    add(in_language(kLeft), fmt::format("{} %", show_length(100 * volume / material->blank_volume())),
        fmt::format("{} mm³", show_length(volume)));
  }
  void list_neighbor(std::size_t place) {
    const std::vector<verification::Neighbor>& neighbors = session_.surroundings().neighbors_of(present());
    if (place >= neighbors.size()) throw dap::RequestError(session_.in_language(kNoSuchVariables, kNeighbors + place));
    const verification::Neighbor& each = neighbors[place];
    add(in_language(kPart), text::printable(each.who.in(session_.language())));
    add(in_language(kDistance), show_length(std::max(0.0, each.distance)), "mm");
    add(in_language(kDepth), show_length(std::max(0.0, -each.distance)), "mm");
    const geometry::Vec3 point = moment_.state.frame_in_force().to_inner(each.point);
    add(in_language(kPoint),
        fmt::format("X {} Y {} Z {}", show_length(point.x()), show_length(point.y()), show_length(point.z())), "mm");
    if (each.described.file.empty()) return;
    add(in_language(kDescribed), fmt::format("{}:{}", text::printable(each.described.file), each.described.line + 1));
    variables.back().location = expressions::location_of_neighbor(place);
  }

 private:
  /// Distances are known to a hundredth.
  std::string show_length(double value) const {
    expressions::ValueFormat format = format_;
    format.decimals = std::min(format.decimals, 2);
    return expressions::show_value(value, format);
  }

  const simulation::Simulation& present() const { return session_.debuggee().present(); }

  std::string pose_text(const geometry::Pose& pose) const {
    return fmt::format("X {} Y {} Z {} B {} C {}", show(pose.tip.x()), show(pose.tip.y()), show(pose.tip.z()),
                       show(pose.b), show(pose.c));
  }
  std::string vector_text(const geometry::Vec3& vector) const {
    return fmt::format("X {} Y {} Z {}", show(vector.x()), show(vector.y()), show(vector.z()));
  }
  void add_vector(const geometry::Vec3& vector) {
    for (int axis = 0; axis < 3; ++axis) add(std::string(1, "XYZ"[axis]), show(vector[axis]), "mm");
  }

  std::string line_text(std::size_t line) const {
    return session_.in_language(kLine, session_.client().to_client_line(line));
  }

  /// The line that has set the mode in force, or how else it was set.
  std::string origin_of(ModalGroup group) const {
    const std::uint8_t number = moment_.state.mode(group);
    const debuggee::Journal& journal = session_.journal();
    if (const auto setting = journal.setting(group, present().blocks()))
      return setting->number == number ? line_text(setting->line) : in_language(kByHand);
    const bool is_written = (moment_.state.written & (1u << static_cast<unsigned>(group))) != 0;
    if (dialect::g_code(number)->is_default && !is_written) return in_language(kDefault);
    if (!journal.has_forgotten(group)) return in_language(kByHand);
    const auto line = find_setting_line(group, number);
    return line ? line_text(*line) : in_language(kLongAgo);
  }

  /// Searches the past for a setting that the journal has forgotten. Only a program that sets modes very often makes it
  /// forget any, so the line is near.
  std::optional<std::size_t> find_setting_line(ModalGroup group, std::uint8_t number) const {
    constexpr std::uint64_t kFar = 65536;
    const std::uint64_t blocks = present().blocks();
    std::size_t line = 0;
    const auto found =
        session_.debuggee().find_back(blocks - std::min(blocks, kFar), blocks, [&](const running::Block& block) {
          if (block.state.mode(group) == number) return false;
          line = block.line;
          return true;
        });
    return found ? std::optional(line) : std::nullopt;
  }

  void add_mode(ModalGroup group) {
    std::string value = in_language(kNoMotion);
    if (const dialect::GCode* const code = moment_.state.g(group))
      value = fmt::format("G{:02} {} ({})", code->number, in_language(code->name), origin_of(group));
    const dialect::ModalGroupNames& names = dialect::names_of(group);
    variables.push_back({.name = in_language(names.name),
                         .value = value,
                         .evaluate_name = std::string(names.variable),
                         .location = session_.location_of(*expressions::find_quantity(names.variable))});
  }

  const Session& session_;
  const expressions::Moment moment_;
  const expressions::ValueFormat format_;
};

/// A reference, and the function that lists its variables.
struct VariableList {
  std::int64_t reference = 0;
  void (Listing::*list)();
};

constexpr VariableList kPlaces[] = {
    {kPosition, &Listing::list_position},
    {kModes, &Listing::list_modes},
    {kFeedAndSpindle, &Listing::list_feed_and_spindle},
    {kTool, &Listing::list_tool},
    {kFrames, &Listing::list_frames},
    {kRegisters, &Listing::list_registers},
    {kGpl, &Listing::list_gpl},
    {kTimes, &Listing::list_times},
    {kMachinePosition, &Listing::list_machine_position},
    {kWorkpiecePosition, &Listing::list_workpiece_position},
    {kFacePosition, &Listing::list_face_position},
    {kJointPosition, &Listing::list_joints},
    {kToGo, &Listing::list_to_go},
    {kWorkpieceFrame, &Listing::list_workpiece_frame},
    {kFaceFrame, &Listing::list_face_frame},
    {kToolValues, &Listing::list_tool_values},
    {kFunctionParameters, &Listing::list_functions},
    {kSurroundings, &Listing::list_surroundings},
    {kMaterial, &Listing::list_material},
};

}  // namespace

std::vector<Scope> scopes_of(const Session& session) {
  std::vector<Scope> scopes(kScopes.begin(), kScopes.end());
  if (!session.surroundings().are_known())
    std::erase_if(scopes, [](const Scope& scope) { return scope.reference == kSurroundings; });
  if (!session.surroundings().has_material())
    std::erase_if(scopes, [](const Scope& scope) { return scope.reference == kMaterial; });
  return scopes;
}

std::vector<Variable> variables_of(const Session& session, std::int64_t reference,
                                   const expressions::ValueFormat& format) {
  session.stopped_debuggee();
  Listing listing(session, format);
  if (reference > kFunctions && reference < kFunctions + 1000) {
    listing.list_function(static_cast<int>(reference - kFunctions));
    return listing.variables;
  }
  if (reference >= kNeighbors) {
    listing.list_neighbor(static_cast<std::size_t>(reference - kNeighbors));
    return listing.variables;
  }
  for (const VariableList& place : kPlaces) {
    if (place.reference != reference) continue;
    (listing.*place.list)();
    return listing.variables;
  }
  throw dap::RequestError(session.in_language(kNoSuchVariables, reference));
}

}  // namespace isocnc::session
