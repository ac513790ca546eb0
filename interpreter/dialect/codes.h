#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/letters.h"

namespace isocnc::dialect {

/// The modal groups of Tav. 2: one member of each is in force at a time. `None`: not modal (Tav. 3, I.3.9 to I.3.12).
enum class ModalGroup : std::uint8_t {
  Motion,
  Plane,
  Face,
  ProfileReduction,
  CutterCompensation,
  Interpolation,
  Units,
  Distance,
  Workpiece,
  FeedMode,
  None,
};

inline constexpr std::size_t kModalGroupCount = static_cast<std::size_t>(ModalGroup::None);

/// The names of a modal group.
struct ModalGroupNames {
  std::string_view key;       ///< In isocnc/state.
  std::string_view variable;  ///< In the debugger's expressions.
  Text name;                  ///< For people.
};

/// The names of all modal groups, by ModalGroup.
inline constexpr std::array<ModalGroupNames, kModalGroupCount> kModalGroups = {{
    {"motion", "MOTION", {"motion", "movimento"}},
    {"plane", "PLANE", {"arc plane", "piano di interpolazione"}},
    {"face", "FACE", {"face frame", "sistema di riferimento di faccia"}},
    {"profileReduction", "REDUCTION", {"profile reduction", "riduzione profilo"}},
    {"cutterCompensation", "COMPENSATION", {"cutter compensation", "correzione raggio fresa"}},
    {"interpolation", "INTERPOLATION", {"interpolation", "interpolazione"}},
    {"units", "UNITS", {"units", "unità di misura"}},
    {"distance", "DISTANCE", {"absolute or incremental", "dimensioni assolute o incrementali"}},
    {"workpiece", "WORKPIECE", {"workpiece frame", "sistema di riferimento di pezzo"}},
    {"feedMode", "FEEDMODE", {"feed mode", "modo del feed"}},
}};
static_assert(!kModalGroups.back().key.empty(), "each modal group has names");

constexpr const ModalGroupNames& names_of(ModalGroup group) { return kModalGroups[static_cast<std::size_t>(group)]; }

/// What a G does. A switch over the roles names all of them, so that the compiler lists every place to which a new role
/// matters. All roles but `Mode` and `Signal` belong to one G each.
enum class GRole : std::uint8_t {
  Rapid,
  Line,
  ClockwiseArc,
  CounterclockwiseArc,
  Dwell,
  ExactStop,
  PlaneXY,
  PlaneZX,
  PlaneYZ,
  FaceByAxes,  ///< Mounts a face frame, given by its origin and axes.
  DismountFace,
  FaceAtTip,     ///< Mounts a face frame, given by its axes; its origin is the tool tip.
  FaceByAngles,  ///< Mounts a face frame, given by its origin and two angles.
  CompensationOff,
  CompensationLeft,
  CompensationRight,
  Workpiece,
  Mode,        ///< Comes into force in its group; it has no further effect.
  Signal,      ///< Changes no state; its row says all about its effect (GSignal).
  PendingEnd,  ///< The control waits for the next program at the end of this one.
  ApplyMdi,
};

/// The effect of a G whose role is `Signal`: an event without data.
struct GSignal {
  std::string_view kind;       ///< Kind of the event in traces.
  bool stops_reading = false;  ///< The control executes all before it before it reads on, so the axes come to rest.
  Text message;                ///< What the debugger reports.
};

/// A G code: all its properties that do not depend on the state of the machine.
struct GCode {
  std::uint16_t number = 0;
  GRole role = GRole::Mode;
  Text name;
  ModalGroup group = ModalGroup::None;
  bool is_default = false;                 ///< Whether it is in force when a program starts.
  LetterSet arguments = 0;                 ///< Letters of its arguments.
  std::string_view axes;                   ///< Letters of the axis vectors i, j and k of a face, three each.
  DiagnosticId alone = kNoDiagnostic;      ///< Reported when it must be alone on its line and is not.
  DiagnosticId repeated = kNoDiagnostic;   ///< Reported when written again while in force.
  DiagnosticId misplaced = kNoDiagnostic;  ///< Reported when it follows dimensions on its line.
  GSignal signal;
  std::string_view section;

  constexpr bool is_motion() const { return group == ModalGroup::Motion; }
  constexpr bool is_feed_move() const { return is_motion() && role != GRole::Rapid; }
  constexpr bool is_arc() const { return role == GRole::ClockwiseArc || role == GRole::CounterclockwiseArc; }
  constexpr bool takes_arguments() const { return arguments != 0; }
  constexpr bool is_frame() const { return group == ModalGroup::Face || group == ModalGroup::Workpiece; }
  constexpr bool mounts_face() const { return group == ModalGroup::Face && role != GRole::DismountFace; }
  /// Whether its X Y Z are the origin of a frame, in the units in force.
  constexpr bool takes_origin() const { return is_frame() && takes_arguments() && role != GRole::FaceAtTip; }
};

/// All G codes of the dialect, by number.
inline constexpr GCode kGCodes[] = {
    {.number = 0,
     .role = GRole::Rapid,
     .name = {"rapid positioning", "posizionamento rapido"},
     .group = ModalGroup::Motion,
     .arguments = letters("XYZBC"),
     .section = "I.3.4.1"},
    {.number = 1,
     .role = GRole::Line,
     .name = {"linear interpolation", "interpolazione lineare"},
     .group = ModalGroup::Motion,
     .arguments = letters("XYZBC"),
     .section = "I.3.4.2"},
    {.number = 2,
     .role = GRole::ClockwiseArc,
     .name = {"clockwise arc or helix", "interpolazione circolare (elicoidale) oraria"},
     .group = ModalGroup::Motion,
     .arguments = letters("XYZBCIJKR"),
     .section = "I.3.4.3"},
    {.number = 3,
     .role = GRole::CounterclockwiseArc,
     .name = {"counterclockwise arc or helix", "interpolazione circolare (elicoidale) antioraria"},
     .group = ModalGroup::Motion,
     .arguments = letters("XYZBCIJKR"),
     .section = "I.3.4.3"},
    {.number = 4,
     .role = GRole::Dwell,
     .name = {"dwell", "attesa"},
     .arguments = letters("P"),
     .alone = "g04-not-alone"_diag,
     .section = "I.3.10"},
    {.number = 9,
     .role = GRole::ExactStop,
     .name = {"exact stop at the end of the block", "arresto a fine blocco"},
     .section = "I.3.8"},
    {.number = 17,
     .role = GRole::PlaneXY,
     .name = {"arc plane XY", "piano di interpolazione XY"},
     .group = ModalGroup::Plane,
     .is_default = true,
     .repeated = "redundant-modal"_diag,
     .section = "I.3.4.3.a"},
    {.number = 18,
     .role = GRole::PlaneZX,
     .name = {"arc plane ZX", "piano di interpolazione ZX"},
     .group = ModalGroup::Plane,
     .repeated = "redundant-modal"_diag,
     .section = "I.3.4.3.a"},
    {.number = 19,
     .role = GRole::PlaneYZ,
     .name = {"arc plane YZ", "piano di interpolazione YZ"},
     .group = ModalGroup::Plane,
     .repeated = "redundant-modal"_diag,
     .section = "I.3.4.3.a"},
    {.number = 24,
     .role = GRole::FaceByAxes,
     .name = {"mount a face frame: origin and axes", "faccia: origine e assi"},
     .group = ModalGroup::Face,
     .arguments = letters("XYZABCIJKPQR"),
     .axes = "ABCIJKPQR",
     .alone = "frame-not-alone"_diag,
     .section = "I.3.2"},
    {.number = 27,
     .role = GRole::DismountFace,
     .name = {"dismount the face frame", "smonta il sistema di riferimento di faccia"},
     .group = ModalGroup::Face,
     .is_default = true,
     .alone = "frame-not-alone"_diag,
     .section = "I.3.2"},
    {.number = 28,
     .role = GRole::FaceAtTip,
     .name = {"mount a face frame at the tool tip: axes", "faccia con origine nella posizione corrente: assi"},
     .group = ModalGroup::Face,
     .arguments = letters("XYZIJKPQR"),
     .axes = "XYZIJKPQR",
     .alone = "frame-not-alone"_diag,
     .section = "I.3.2"},
    {.number = 29,
     .role = GRole::FaceByAngles,
     .name = {"mount a face frame: origin and angles", "faccia: origine e angoli"},
     .group = ModalGroup::Face,
     .arguments = letters("XYZBC"),
     .alone = "frame-not-alone"_diag,
     .section = "I.3.2"},
    {.number = 38,
     .name = {"profile reduction off", "riduzione profilo non attiva"},
     .group = ModalGroup::ProfileReduction,
     .is_default = true,
     .section = "I.3"},
    {.number = 39,
     .name = {"profile reduction on", "riduzione profilo attiva"},
     .group = ModalGroup::ProfileReduction,
     .section = "I.3"},
    {.number = 40,
     .role = GRole::CompensationOff,
     .name = {"cutter compensation off", "nessuna correzione raggio fresa"},
     .group = ModalGroup::CutterCompensation,
     .is_default = true,
     .section = "I.3"},
    {.number = 41,
     .role = GRole::CompensationLeft,
     .name = {"cutter compensation left of the profile", "correzione raggio fresa a sinistra del profilo"},
     .group = ModalGroup::CutterCompensation,
     .section = "I.3"},
    {.number = 42,
     .role = GRole::CompensationRight,
     .name = {"cutter compensation right of the profile", "correzione raggio fresa a destra del profilo"},
     .group = ModalGroup::CutterCompensation,
     .section = "I.3"},
    {.number = 48,
     .name = {"three-axis interpolation", "interpolazione a 3 assi"},
     .group = ModalGroup::Interpolation,
     .is_default = true,
     .alone = "g48-g49-not-alone"_diag,
     .repeated = "redundant-modal"_diag,
     .section = "I.3.5"},
    {.number = 49,
     .name = {"five-axis interpolation", "interpolazione a 5 assi"},
     .group = ModalGroup::Interpolation,
     .alone = "g48-g49-not-alone"_diag,
     .repeated = "redundant-modal"_diag,
     .section = "I.3.5"},
    {.number = 70,
     .name = {"inches", "pollici"},
     .group = ModalGroup::Units,
     .repeated = "redundant-modal"_diag,
     .misplaced = "units-after-dimensions"_diag,
     .section = "I.3.1"},
    {.number = 71,
     .name = {"millimeters", "millimetri"},
     .group = ModalGroup::Units,
     .is_default = true,
     .repeated = "redundant-modal"_diag,
     .misplaced = "units-after-dimensions"_diag,
     .section = "I.3.1"},
    {.number = 90,
     .name = {"absolute dimensions", "dimensioni assolute"},
     .group = ModalGroup::Distance,
     .is_default = true,
     .misplaced = "distance-mode-after-dimensions"_diag,
     .section = "I.3.3"},
    {.number = 91,
     .name = {"incremental dimensions", "dimensioni incrementali"},
     .group = ModalGroup::Distance,
     .misplaced = "distance-mode-after-dimensions"_diag,
     .section = "I.3.3"},
    {.number = 92,
     .role = GRole::Workpiece,
     .name = {"workpiece frame", "sistema di riferimento di pezzo"},
     .group = ModalGroup::Workpiece,
     .is_default = true,
     .arguments = letters("XYZ"),
     .alone = "frame-not-alone"_diag,
     .section = "I.3.2"},
    {.number = 93,
     .name = {"feed rate as inverse time", "avanzamento come inverso del tempo"},
     .group = ModalGroup::FeedMode,
     .repeated = "redundant-modal"_diag,
     .section = "I.3.7"},
    {.number = 94,
     .name = {"feed rate per minute", "avanzamento in unità al minuto"},
     .group = ModalGroup::FeedMode,
     .is_default = true,
     .repeated = "redundant-modal"_diag,
     .section = "I.3.7"},
    {.number = 200,
     .role = GRole::PendingEnd,
     .name = {"wait for the next program at the end", "stato di attesa (pending) a fine programma"},
     .section = "I.3.12"},
    {.number = 909,
     .role = GRole::ApplyMdi,
     .name = {"apply MDI instructions", "applicazione istruzioni MDI"},
     .section = "I.3.9"},
    {.number = 990,
     .role = GRole::Signal,
     .name = {"update the technological parameters", "aggiornamento della parametrica tecnologica"},
     .signal = {.kind = "update",
                .stops_reading = true,
                .message = {"technological parameters are read anew", "aggiornamento della parametrica tecnologica"}},
     .section = "I.3.11"},
};

/// Row number of a G that the dialect does not know (E001, ISO007).
inline constexpr std::uint8_t kUnknownGCode = 255;

/// Row of kGCodes for each number up to 999; kUnknownGCode where there is none.
inline constexpr auto kGCodeRows = [] {
  std::array<std::uint8_t, 1000> rows{};
  rows.fill(kUnknownGCode);
  for (std::size_t i = 0; i < std::size(kGCodes); ++i) rows[kGCodes[i].number] = static_cast<std::uint8_t>(i);
  return rows;
}();

/// The G code of a number; null if the dialect has none.
constexpr const GCode* g_code(std::size_t number) {
  const std::uint8_t row = number < kGCodeRows.size() ? kGCodeRows[number] : kUnknownGCode;
  return row == kUnknownGCode ? nullptr : &kGCodes[row];
}

/// The G code of a role that one G has.
constexpr const GCode& g_code(GRole role) {
  return *std::find_if(std::begin(kGCodes), std::end(kGCodes), [&](const GCode& code) { return code.role == role; });
}

/// Numbers of modes (GRole::Mode) that a state can be asked for, or that rewrites put in force.
inline constexpr std::uint8_t kProfileReduction = 39;
inline constexpr std::uint8_t kFiveAxis = 49;
inline constexpr std::uint8_t kInches = 70;
/// Length of a unit of the program, mm: of an inch under G70.
constexpr double mm_per_unit(bool is_in_inches) { return is_in_inches ? 25.4 : 1; }
inline constexpr std::uint8_t kMillimeters = 71;
inline constexpr std::uint8_t kAbsolute = 90;
inline constexpr std::uint8_t kIncremental = 91;
inline constexpr std::uint8_t kInverseTime = 93;
inline constexpr std::uint8_t kPerMinute = 94;

/// Whether a number is that of a motion G: 0 to 3.
constexpr bool is_motion_number(double number) {
  constexpr auto kMotions =
      std::count_if(std::begin(kGCodes), std::end(kGCodes), [](const GCode& code) { return code.is_motion(); });
  return number >= 0 && number < static_cast<double>(kMotions);
}
static_assert(std::all_of(std::begin(kGCodes), std::end(kGCodes), [](const GCode& code) {
  const auto is_same = [&](const GCode& other) { return other.role == code.role; };
  const bool has_own_role = std::count_if(std::begin(kGCodes), std::end(kGCodes), is_same) == 1;
  const bool is_signal = code.role == GRole::Signal;
  return is_motion_number(code.number) == code.is_motion() && is_signal != code.signal.kind.empty() &&
         (has_own_role || is_signal || code.role == GRole::Mode);
}));

/// The G codes in force when a program starts, by modal group; kNoMotion where none is (I.3).
inline constexpr std::uint8_t kNoMotion = 255;
inline constexpr auto kDefaultModes = [] {
  std::array<std::uint8_t, kModalGroupCount> modes{};
  modes.fill(kNoMotion);
  for (const GCode& code : kGCodes)
    if (code.is_default) modes[static_cast<std::size_t>(code.group)] = static_cast<std::uint8_t>(code.number);
  return modes;
}();

/// An M that the control interprets itself (Tav. 4); all others are the user's (I.4.4).
struct MCode {
  std::uint16_t number = 0;
  Text name;
  DiagnosticId alone = kNoDiagnostic;
  std::string_view section;
};

inline constexpr MCode kMCodes[] = {
    {.number = 2, .name = {"end of program", "termine programma"}, .alone = "m02-not-alone"_diag, .section = "I.4.1"},
    {.number = 3, .name = {"spindle on, clockwise", "avvio mandrino, orario"}, .section = "I.4.2"},
    {.number = 4, .name = {"spindle on, counterclockwise", "avvio mandrino, antiorario"}, .section = "I.4.2"},
    {.number = 5, .name = {"spindle off", "arresto mandrino"}, .section = "I.4.2"},
    {.number = 6, .name = {"tool change", "cambio utensile"}, .section = "I.4.3"},
};

inline constexpr int kProgramEnd = 2;
inline constexpr int kToolChange = 6;
constexpr bool is_user_function(int m) {
  return std::none_of(std::begin(kMCodes), std::end(kMCodes), [m](const MCode& code) { return code.number == m; });
}

/// Maximum absolute value of B or C of a G29, degrees (I.3.2).
constexpr double max_face_angle(char letter) { return letter == 'B' ? 90 : 180; }

inline constexpr int kRegisterCount = 30;  ///< V1 to V30 (I.6).
constexpr bool is_register(double number) { return number >= 1 && number <= kRegisterCount; }

inline constexpr int kMaxFunctionParameters = 20;  ///< P1 to P20 (I.4.4).

}  // namespace isocnc::dialect
