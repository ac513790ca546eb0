#include "lsp/queries/state_table.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/dialect/codes.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/running/event.h"
#include "interpreter/text/unicode.h"

namespace isocnc::queries {

using dialect::format_value;
using dialect::Language;
using dialect::Text;
using execution::State;

static constexpr const char* kNothing = "-";
static constexpr const char* kUnknown = "?";

namespace {

/// A part of a value: `X1.5`, of which paths may agree on the letter alone.
struct CellPart {
  std::string_view letter;  ///< May be empty.
  std::string value;        ///< Empty for a part that is not there.
};
using StateCell = std::vector<CellPart>;

StateCell programmed_position(const State& state) {
  const geometry::Pose& pose = state.position;
  const double values[] = {pose.tip.x(), pose.tip.y(), pose.tip.z(), pose.b, pose.c};
  StateCell cell;
  for (std::size_t axis = 0; axis < std::size(values); ++axis) {
    const bool is_known = (state.unknown & execution::axis_bit(static_cast<execution::Axis>(axis))) == 0;
    cell.push_back({std::string_view("XYZBC").substr(axis, 1), is_known ? format_value(values[axis]) : kUnknown});
  }
  return cell;
}

StateCell place(const geometry::Vec3& at, execution::AxisSet unknown) {
  StateCell cell;
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_known = (unknown & execution::axis_bit(static_cast<execution::Axis>(axis))) == 0;
    cell.push_back({std::string_view("XYZ").substr(static_cast<std::size_t>(axis), 1),
                    is_known ? format_value(at[axis]) : kUnknown});
  }
  return cell;
}

StateCell machine_position(const State& state) {
  const bool is_known = (state.unknown & execution::kLinearAxes) == 0 && state.is_frame_known();
  return place(state.to_machine(state.position.tip), is_known ? 0 : execution::kLinearAxes);
}

StateCell workpiece_zero(const State& state) { return place(state.workpiece_origin, state.workpiece_unknown); }

StateCell tool(const State& state) {
  if (state.tool == execution::ToolCode{}) return {{"", kNothing}};
  return {{"", state.tool_known ? running::tool_name(state.tool) : kUnknown}};
}

StateCell spindle(const State& state) {
  const bool is_known = state.spindle != execution::Spindle::Unknown;
  StateCell cell = {{"", is_known ? fmt::format("M{:02d}", state.spindle_function) : kUnknown}};
  if (!state.speed_known) {
    cell.push_back({"S", kUnknown});
  } else {
    cell.push_back({"S", state.spindle_speed > 0 ? format_value(state.spindle_speed) : ""});
  }
  return cell;
}

StateCell feed(const State& state) {
  if (!state.feed_given) return {{"", kNothing}};
  const execution::ProgrammedFeed feed = execution::feed_in_force(state);
  return {{"F", feed.is_known ? format_value(feed.number * feed.mm_per_unit) : kUnknown}};
}

StateCell code_in_force(const State& state, dialect::ModalGroup group) {
  const dialect::GCode* const code = state.g(group);
  const bool is_illegible = group == dialect::ModalGroup::Motion && state.motion_illegible;
  if (is_illegible || state.is_in_doubt(group)) return {{"", kUnknown}};
  return {{"", code ? fmt::format("G{:02d}", code->number) : kNothing}};
}

/// What all cells agree on, part by part.
StateCell agreement(StateCell cell, const StateCell& other) {
  if (cell.size() != other.size()) return {{"", kUnknown}};
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const bool is_same = cell[i].letter == other[i].letter && cell[i].value == other[i].value;
    if (!is_same) cell[i].value = kUnknown;
  }
  return cell;
}

std::string text_of(const StateCell& cell) {
  const auto is_unknown = [](const CellPart& part) { return part.value == kUnknown; };
  if (std::all_of(cell.begin(), cell.end(), is_unknown)) return kUnknown;
  std::string text;
  for (const CellPart& part : cell)
    if (!part.value.empty()) text += fmt::format("{}{}{}", text.empty() ? "" : " ", part.letter, part.value);
  return text;
}

/// A name, and what it is before and after the line.
using TableRow = std::array<std::string, 3>;

std::size_t width(std::string_view text) { return text::column_of(text, text.size()) - 1; }

}  // namespace

std::string state_table(const std::vector<LineRun>& runs, Language language) {
  static constexpr Text kHead[] = {{"", ""}, {"before", "prima"}, {"after", "dopo"}};
  std::vector<TableRow> rows = {
      {std::string(kHead[0].in(language)), std::string(kHead[1].in(language)), std::string(kHead[2].in(language))}};
  const auto add = [&](const Text& name, const auto& cell) {
    const auto agreed = [&](const State LineRun::*state) {
      StateCell common = cell(runs.front().*state);
      for (const LineRun& run : runs) common = agreement(std::move(common), cell(run.*state));
      return text_of(common);
    };
    rows.push_back({std::string(name.in(language)), agreed(&LineRun::before), agreed(&LineRun::after)});
  };
  add({"position", "posizione"}, programmed_position);
  add({"machine position", "posizione macchina"}, machine_position);
  add({"workpiece zero", "zero pezzo"}, workpiece_zero);
  add({"tool", "utensile"}, tool);
  add({"spindle", "mandrino"}, spindle);
  add({"feed", "avanzamento"}, feed);
  for (std::size_t group = 0; group < dialect::kModalGroupCount; ++group)
    add(dialect::kModalGroups[group].name,
        [&](const State& state) { return code_in_force(state, static_cast<dialect::ModalGroup>(group)); });

  std::array<std::size_t, 3> widths{};
  for (const TableRow& row : rows)
    for (std::size_t column = 0; column < row.size(); ++column)
      widths[column] = std::max(widths[column], width(row[column]));
  std::string table;
  for (const TableRow& row : rows) {
    const bool is_changed = &row != &rows.front() && row[1] != row[2];
    std::string line = is_changed ? "*" : " ";
    for (std::size_t column = 0; column < row.size(); ++column) {
      line += column == 0 ? " " : "  ";
      line += row[column] + std::string(widths[column] - width(row[column]), ' ');
    }
    table += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return table;
}

}  // namespace isocnc::queries
