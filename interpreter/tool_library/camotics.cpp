#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "interpreter/tool_library/library_reader.h"

namespace isocnc::tool_library {

using configuration::JsonMember;
using configuration::JsonValue;

/// The `length` of a cutter is that of what cuts; nothing is said of how far it stands from the spindle.
static LibraryTool read_tool(const JsonMember& member, const std::string& path, LibraryFile& file) {
  const JsonValue& value = member.value;
  LibraryTool read;
  read.number = member.key;
  if (value.kind != JsonValue::Kind::Object) {
    file.fail(value.at, path, configuration::mistakes::kNeedsObject);
    return read;
  }
  read.tool.name = text_of(value, "description");
  double millimeters = 1;
  if (const JsonValue* const units = member_of(value, "units")) {
    if (units->string == "imperial" || units->string == "IMPERIAL") {
      millimeters = kInch;
    } else if (units->string != "metric" && units->string != "METRIC") {
      file.fail(units->at, path + ".units", problems::kUnknownUnit,
                {configuration::shortened(units->string), std::string("metric, imperial")});
      return read;
    }
  }
  const JsonTool geometry(value, path, millimeters, file);
  const std::optional<double> length = geometry.length("length");
  const std::optional<double> diameter = geometry.length("diameter");
  const double tip = geometry.length("snub_diameter").value_or(0) / 2;
  if (diameter) read.tool.radius = tidy(*diameter / 2);
  read.tool.cut_length = length;
  const std::string shape = in_small_letters(text_of(value, "shape"));
  if (shape == "cylindrical" || shape.empty()) {
    read.tool.shape = "flat";
  } else if (shape == "ballnose") {
    read.tool.shape = "ball";
  } else if (diameter && length && (shape == "conical" || (shape == "snubnose" && tip < *read.tool.radius))) {
    const double from = shape == "snubnose" ? tip : 0;
    set_cone(read.tool, 2 * std::atan((*read.tool.radius - from) / *length) * 180 / std::numbers::pi, from);
    // The angle is that of the length, to the last digit of the profile.
    if (read.tool.profile) read.tool.profile = {{0, from}, {*length, *read.tool.radius}};
  } else {
    read.kind_without_shape = shape;
  }
  return read;
}

std::vector<LibraryTool> read_camotics(const JsonValue& table, LibraryFile& file) {
  const JsonValue* const tools = member_of(table, "tools");  // In a project.
  std::vector<LibraryTool> read;
  for (const JsonMember& member : (tools == nullptr ? table : *tools).members) {
    const std::string path = (tools == nullptr ? "" : "tools.") + configuration::shortened(member.key);
    read.push_back(*file.entry([&] { return std::optional(read_tool(member, path, file)); }));
  }
  return read;
}

}  // namespace isocnc::tool_library
