#include "interpreter/restart/restart_preamble.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/execution/execute.h"
#include "interpreter/execution/silent_sink.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/unicode.h"

namespace isocnc::restart {

using dialect::GRole;
using dialect::ModalGroup;
using dialect::Text;
using execution::State;
using geometry::Vec3;

/// Minimum height above a restart position reached in feed, in mm, at which the approach changes from rapid to feed.
static constexpr double kAboveWork = 5;
/// Distance from the cut, along a tilted tool, at which the approach changes from rapid to feed; mm.
static constexpr double kBesideWork = 50;

static constexpr Text kTitle{"; restart of {} before its line {}", "; ripresa di {} dalla riga {}"};
static constexpr Text kTitleOfPart{"; {} alone from line {} to {}", "; solo {} dalla riga {} alla {}"};
static constexpr Text kAssumed{"; assumed on the way there: {}", "; ipotesi sul percorso: {}"};
static constexpr Text kNotRepeated{"; not repeated: {} of line {}", "; non ripetuta: {} della riga {}"};
static constexpr Text kApproach{"; approach", "; avvicinamento"};
static constexpr Text kRest{"; the program from line {} on", "; il programma dalla riga {} in poi"};

/// A number as programs write it, exact: without exponent, with the fewest digits that give the same value.
static std::string exact(double value) {
  if (value == 0) value = 0;  // Turns -0 into 0.
  for (int decimals = 0;; ++decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    double read = 0;
    fast_float::from_chars(text.data(), text.data() + text.size(), read);
    if (read == value || std::isnan(value)) return text;
  }
}

/// Coordinates are rounded to a billionth: this hides the rounding errors of sums under G91 and is below every
/// tolerance.
static constexpr double kStepsPerUnit = 1e9;
static std::string coordinate(double value) { return exact(std::round(value * kStepsPerUnit) / kStepsPerUnit); }

static std::string shown(const running::FunctionEvent& function) {
  std::string text = fmt::format("M{}", function.number);
  for (const execution::FunctionParameter& parameter : function.parameters)
    text += fmt::format(" P{}={}", parameter.number, exact(parameter.value));
  return text;
}

namespace {

/// Writes line by line and tracks the state after the last line, so that nothing is written twice.
class Preamble {
 public:
  Preamble(const RestartPoint& point, const RestartOptions& options, std::string_view line_end)
      : point_(point),
        options_(options),
        line_end_(line_end),
        target_(state_at(point)),
        state_(execution::initial_state(options.run.setup)) {}

  std::string text() {
    write_assumed_path();
    set_modes();
    assign_registers();
    if (target_.workpiece_origin != Vec3::Zero()) add("G92" + lengths(target_.workpiece_origin));
    change_tool();
    if (!target_.motion()) {
      mount_face();
    } else {
      comment(kApproach.in(options_.language));
      approach();
    }
    restore_feed();
    restore_motion();
    restore_rest();
    comment(dialect::format(kRest, options_.language, options_.line + 1));
    return std::move(text_);
  }

 private:
  void add(const std::string& line) {
    text_.append(line).append(line_end_);
    execution::SilentSink sink;  // Errors need no report: the trial run finds them.
    execution::execute(syntax::ParsedLine(line).tree(), state_, options_.run.setup, sink);
  }
  void comment(std::string_view text) { text_.append(text).append(line_end_); }

  void write_assumed_path() {
    const dialect::Language language = options_.language;
    const std::string name = text::ascii(options_.name);
    comment(options_.end ? dialect::format(kTitleOfPart, language, name, options_.line + 1, *options_.end)
                         : dialect::format(kTitle, language, name, options_.line + 1));
    std::string assumed;
    for (const int variable : point_.assumed) {
      const double value = variable == syntax::Jump::kVgplVariable
                               ? options_.run.vgpl
                               : options_.run.registers[static_cast<std::size_t>(variable)];
      const std::string name = variable == syntax::Jump::kVgplVariable ? "VGPL" : fmt::format("V{}", variable);
      assumed += fmt::format("{}{} = {}", assumed.empty() ? "" : ", ", name, exact(value));
    }
    if (!assumed.empty()) comment(dialect::format(kAssumed, language, assumed));
    for (const running::Event& event : point_.functions)
      comment(
          dialect::format(kNotRepeated, language, shown(std::get<running::FunctionEvent>(event.what)), event.line + 1));
  }

  static State state_at(const RestartPoint& point) {
    State state = point.state;
    state.position.tip = point.tip;
    return state;
  }

  bool is_written(ModalGroup group) const { return (target_.written >> static_cast<unsigned>(group) & 1u) != 0; }
  bool differs(ModalGroup group) const { return state_.mode(group) != target_.mode(group); }
  /// Whether only G93 has had an F, which a later G94 takes over (D43).
  bool has_only_inverse_feeds() const { return target_.feed_per_minute.number == 0 && target_.last_feed.number > 0; }

  /// Whether a group is not simply written with its mode where that differs.
  static bool has_own_step(ModalGroup group) {
    switch (group) {
      case ModalGroup::Motion:
      case ModalGroup::Plane:
      case ModalGroup::Face:
      case ModalGroup::CutterCompensation:
      case ModalGroup::Interpolation:
      case ModalGroup::Units:
      case ModalGroup::Distance:
      case ModalGroup::Workpiece:
      case ModalGroup::FeedMode:
        return true;
      default:
        return false;
    }
  }

  /// Writes the modes that the program has written, defaults too. Otherwise writing them again further down would not
  /// be a repetition (W001).
  void set_modes() {
    std::string first;
    const auto write = [&](int g) { first += fmt::format("{}G{}", first.empty() ? "" : " ", g); };
    if (is_written(ModalGroup::Plane)) write(target_.mode(ModalGroup::Plane));
    if (is_written(ModalGroup::Units)) write(target_.mode(ModalGroup::Units));
    if (is_written(ModalGroup::Distance)) write(dialect::kAbsolute);
    if (is_written(ModalGroup::FeedMode) && !target_.inverse_time() && !has_only_inverse_feeds())
      write(dialect::kPerMinute);
    for (std::size_t i = 0; i < dialect::kModalGroupCount; ++i) {
      const auto group = static_cast<ModalGroup>(i);
      if (!has_own_step(group) && differs(group)) write(target_.mode(group));
    }
    if (!first.empty()) add(first);
    if (is_written(ModalGroup::Interpolation)) add(fmt::format("G{}", target_.mode(ModalGroup::Interpolation)));
  }

  void assign_registers() {
    std::string line;
    for (int number = 1; number <= dialect::kRegisterCount; ++number)
      if ((point_.known_registers >> static_cast<unsigned>(number) & 1u) != 0)
        line += fmt::format("{}V{}={}", line.empty() ? "" : " ", number,
                            exact(point_.registers[static_cast<std::size_t>(number)]));
    if (!line.empty()) add(line);
  }

  void change_tool() {
    if (target_.tool_selected) add("M06 " + running::tool_name(target_.tool));
    // A tool change stops the spindle, so a spindle start before it has no effect after it.
    const bool turns = target_.spindle_turns();
    const double speed = turns ? point_.turning_speed : target_.spindle_speed;
    std::string line;
    if (speed > 0) line = "S" + exact(speed);
    if (turns) line += fmt::format("{}M{:02}", line.empty() ? "" : " ", target_.spindle_function);
    if (!line.empty()) add(line);
    if (target_.spindle_speed != speed) add("S" + exact(target_.spindle_speed));  // For the next M03 or M04.
  }

  std::string length(char letter, double mm) const { return letter + coordinate(mm / state_.mm_per_unit()); }
  std::string lengths(const Vec3& point) const {
    std::string text;
    for (int axis = 0; axis < 3; ++axis) text += " " + length("XYZ"[axis], point[axis]);
    return text;
  }
  std::string across(const Vec3& point) const { return length('X', point.x()) + " " + length('Y', point.y()); }

  /// Whether the tool may touch the work. A rapid without a length, such as G00 Z-5 at this depth, does not take it
  /// out.
  bool cuts() const { return !target_.motion() || target_.motion()->is_feed_move() || point_.came_in_feed; }

  /// The height at which the tool changes from rapid to feed, Z of the frame in force.
  double height() const {
    const double depth = target_.position.tip.z();
    const double minimum = cuts() ? depth + kAboveWork : depth;
    if (options_.clearance) return std::max(*options_.clearance, minimum);
    const std::optional<double>& machine = options_.run.setup.clearance;
    return std::max({machine.value_or(minimum), point_.fed.max().z(), minimum});
  }

  /// A position beyond all cuts, on the axis of a tool that B tilts; the tool approaches along this axis. None if an
  /// approach along Z suffices.
  std::optional<Vec3> place_along_tool() const {
    const Vec3& tip = target_.position.tip;
    const Vec3 tool = geometry::axes_from_angles(target_.position.b, target_.position.c).col(2);
    const bool is_upright = tool.head<2>().norm() < geometry::kEqualCoordinate;
    if (target_.face_mounted || is_upright || point_.fed.isEmpty()) return std::nullopt;
    if (!cuts() && tip.z() >= height()) return std::nullopt;
    double way = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(tool[axis]) > geometry::kEqualCoordinate)
        way = std::min(way, ((tool[axis] > 0 ? point_.fed.max() : point_.fed.min())[axis] - tip[axis]) / tool[axis]);
    return rounded(tip + (std::max(way, 0.0) + kBesideWork) * tool);
  }

  /// The maximum Z of the workpiece frame to which the machine lifts the tip from home. Rounded down, in inches too, so
  /// that the written number is not past the end of the axis.
  double reach_up() const {
    const double highest = options_.machine.highest_tip(target_.tool, state_.position.b, state_.position.c);
    constexpr double kNoise = 1e-3;
    const double step = state_.mm_per_unit() / kStepsPerUnit;
    return std::floor((highest - state_.workpiece_origin.z()) / step + kNoise) * step;
  }

  static Vec3 rounded(const Vec3& place) { return (place * 1000).array().round() / 1000; }

  void approach() {
    const Vec3& tip = target_.position.tip;
    const std::optional<Vec3> beside = place_along_tool();
    const double above = std::max(height(), point_.highest_in_frame);
    Vec3 entry(tip.x(), tip.y(), target_.face_mounted ? above : height());
    if (target_.face_mounted) entry = rounded(target_.face.to_outer(entry));
    if (beside) entry = *beside;
    const double top = std::max(std::min(point_.highest - target_.workpiece_origin.z(), reach_up()), entry.z());
    add("G00 " + length('Z', top));
    if (point_.turns) add("B" + coordinate(target_.position.b) + " C" + coordinate(target_.position.c));
    add(across(entry));
    rapid_to(entry.z());
    mount_face();
    if (target_.face_mounted) {
      add("G00 " + across(tip) + " " + length('Z', above));
      rapid_to(height());
    }
    feed_down();
  }

  void rapid_to(double z) {
    if (std::abs(state_.position.tip.z() - z) > geometry::kEqualCoordinate) add(length('Z', z));
  }

  /// Goes down to the depth. Without any F the program has reached it in rapid, so the approach uses rapid.
  void feed_down() {
    const Vec3& tip = target_.position.tip;
    const Vec3 way = tip - state_.position.tip;
    if (!(way.norm() > geometry::kEqualCoordinate)) return;
    const bool is_straight = way.head<2>().norm() <= geometry::kEqualCoordinate;
    const std::string end = (is_straight ? "" : across(tip) + " ") + length('Z', tip.z());
    const execution::ProgrammedFeed& feed = target_.feed_per_minute;
    if (feed.number > 0) {
      const double unit = state_.mm_per_unit();
      const double minimum = std::min(options_.approach_feed, feed.number * feed.mm_per_unit) / unit;
      const bool is_feed = feed.mm_per_unit == unit && feed.number <= minimum;
      add("G01 " + end + " F" + (is_feed ? exact(feed.number) : rounded_feed(minimum)));
    } else if (target_.last_feed.number > 0) {
      set_feed_mode(dialect::kInverseTime);
      add("G01 " + end + " F" + rounded_feed(options_.approach_feed / way.norm()));
    } else {
      add(end);
    }
  }

  /// Rounds down to three significant digits, since the feed is a maximum; but never to 0.
  static std::string rounded_feed(double feed) {
    constexpr double kMinFeed = 1e-9;
    constexpr double kNoise = 1e-12;  // Keeps 12.3 although it is 122.99999999999999 tenths.
    feed = std::max(feed, kMinFeed);
    const double decimals = 2 - std::floor(std::log10(feed));
    const double scale = std::pow(10, std::abs(decimals));
    const double digits = std::floor((decimals < 0 ? feed / scale : feed * scale) * (1 + kNoise));
    return exact(decimals < 0 ? digits * scale : digits / scale);
  }

  /// Writes the face frame as in the program. A G28, whose origin is the tip's position, becomes the G24 of that
  /// origin.
  void mount_face() {
    if (!target_.face_mounted) return;
    const syntax::ParsedLine parsed(point_.face_line);
    const syntax::LineTree& tree = parsed.tree();
    const GRole role = target_.g(ModalGroup::Face)->role;
    std::string line = (role == GRole::FaceByAngles ? "G29" : "G24") + lengths(target_.face.origin);
    for (const syntax::Word& word : tree.words) {
      const bool is_origin = role != GRole::FaceAtTip && word.letter >= 'X' && word.letter <= 'Z';
      if (is_origin || word.letter == 'N' || word.letter == 'G') continue;
      const bool is_first_axis = word.letter >= 'X' && word.letter <= 'Z';
      const char letter = is_first_axis ? static_cast<char>(word.letter - 'X' + 'A') : word.letter;
      line += fmt::format(" {}{}", letter, exact(word.value));
    }
    add(line);
  }

  void set_units(double mm_per_unit) {
    if (state_.mm_per_unit() != mm_per_unit) add(mm_per_unit == 1 ? "G71" : "G70");
  }
  void set_feed_mode(int g) {
    if (state_.mode(ModalGroup::FeedMode) != g) add(fmt::format("G{}", g));
  }

  void restore_feed() {
    const double units = target_.mm_per_unit();
    if (has_only_inverse_feeds()) {
      // In G93 an F needs a motion; this one has no length.
      set_feed_mode(dialect::kInverseTime);
      set_units(target_.last_feed.mm_per_unit);
      add("G91 G01 Z0 F" + exact(target_.last_feed.number));
      if (!target_.incremental()) add("G90");
    } else if (target_.feed_per_minute.number > 0 && state_.feed_per_minute != target_.feed_per_minute) {
      set_units(target_.feed_per_minute.mm_per_unit);
      add("F" + exact(target_.feed_per_minute.number));
    }
    set_units(units);
  }

  /// Writes a motion without a length if coordinates without a G may follow. There is none for arcs (ArcContinues).
  void restore_motion() {
    const dialect::GCode* const motion = target_.motion();
    if (!point_.continues_motion || !motion || motion->is_arc() || !differs(ModalGroup::Motion)) return;
    add(fmt::format("G{:02} ", motion->number) + (state_.incremental() ? "Z0" : length('Z', target_.position.tip.z())));
  }

  void restore_rest() {
    if (state_.inverse_time() != target_.inverse_time()) set_feed_mode(target_.mode(ModalGroup::FeedMode));
    if (differs(ModalGroup::Distance)) add(fmt::format("G{}", target_.mode(ModalGroup::Distance)));
    if (point_.waits_at_end) add("G200");
  }

  const RestartPoint& point_;
  const RestartOptions& options_;
  const std::string_view line_end_;
  const State target_;  // With the actual tip position, which may differ from the programmed one.
  State state_;         // State after the last line written.
  std::string text_;
};

}  // namespace

std::string restart_preamble(const RestartPoint& point, const RestartOptions& options, std::string_view line_end) {
  return Preamble(point, options, line_end).text();
}

}  // namespace isocnc::restart
