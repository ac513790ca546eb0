#include "lsp/queries/state_table.h"

#include <algorithm>
#include <array>
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

static std::string programmed_position(const State& state) {
  const geometry::Pose& pose = state.position;
  const double values[] = {pose.tip.x(), pose.tip.y(), pose.tip.z(), pose.b, pose.c};
  std::string text;
  for (int axis = 0; axis < execution::kAxisCount; ++axis) {
    const bool is_known = (state.unknown & execution::axis_bit(static_cast<execution::Axis>(axis))) == 0;
    text +=
        fmt::format("{}{}{}", axis == 0 ? "" : " ", "XYZBC"[axis], is_known ? format_value(values[axis]) : kUnknown);
  }
  return text;
}

static std::string place(const geometry::Vec3& at) {
  return fmt::format("X{} Y{} Z{}", format_value(at.x()), format_value(at.y()), format_value(at.z()));
}

static std::string machine_position(const State& state) {
  const bool is_known = (state.unknown & execution::kLinearAxes) == 0 && state.is_frame_known();
  return is_known ? place(state.to_machine(state.position.tip)) : kUnknown;
}

static std::string tool(const State& state) {
  if (state.tool == execution::ToolCode{}) return kNothing;
  if (!state.tool_known) return kUnknown;
  return running::tool_name(state.tool);
}

static std::string spindle(const State& state) {
  if (state.spindle == execution::Spindle::Unknown) return kUnknown;
  const std::string function = fmt::format("M{:02d}", state.spindle_function);
  return state.spindle_speed > 0 ? fmt::format("{} S{}", function, format_value(state.spindle_speed)) : function;
}

static std::string feed(const State& state) {
  const execution::ProgrammedFeed feed = execution::feed_in_force(state);
  return state.feed_given ? fmt::format("F{}", format_value(feed.number * feed.mm_per_unit)) : kNothing;
}

static std::string code_in_force(const State& state, std::size_t group) {
  const dialect::GCode* const code = state.g(static_cast<dialect::ModalGroup>(group));
  return code ? fmt::format("G{:02d}", code->number) : kNothing;
}

/// A name, and what it is before and after the line.
using TableRow = std::array<std::string, 3>;

static std::size_t width(std::string_view text) { return text::column_of(text, text.size()) - 1; }

static std::string table_of(const std::vector<LineRun>& runs, bool are_joined, Language language) {
  static constexpr Text kHead[] = {{"", ""}, {"before", "prima"}, {"after", "dopo"}};
  std::vector<TableRow> rows = {
      {std::string(kHead[0].in(language)), std::string(kHead[1].in(language)), std::string(kHead[2].in(language))}};
  const auto add = [&](const Text& name, const auto& value) {
    const auto agreed = [&](const State LineRun::*state) {
      const std::string first = value(runs.front().*state);
      const bool is_same =
          std::all_of(runs.begin(), runs.end(), [&](const LineRun& run) { return value(run.*state) == first; });
      return is_same ? first : std::string(kUnknown);
    };
    rows.push_back({std::string(name.in(language)), agreed(&LineRun::before), agreed(&LineRun::after)});
  };
  add({"position", "posizione"}, programmed_position);
  add({"machine position", "posizione macchina"}, machine_position);
  add({"workpiece zero", "zero pezzo"}, [](const State& state) { return place(state.workpiece_origin); });
  const auto add_if_certain = [&](const Text& name, std::string (*value)(const State&)) {
    add(name, [&](const State& state) { return are_joined ? std::string(kUnknown) : value(state); });
  };
  add_if_certain({"tool", "utensile"}, tool);
  add_if_certain({"spindle", "mandrino"}, spindle);
  add_if_certain({"feed", "avanzamento"}, feed);
  for (std::size_t group = 0; group < dialect::kModalGroupCount; ++group)
    add(dialect::kModalGroups[group].name, [&](const State& state) { return code_in_force(state, group); });

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

std::string state_table(const LineRun& run, Language language) { return table_of({run}, false, language); }

std::string state_table(const std::vector<LineRun>& runs, Language language) { return table_of(runs, true, language); }

}  // namespace isocnc::queries
