#include <cmath>

#include <fmt/format.h>

#include "interpreter/tool_library/library_reader.h"

namespace isocnc::tool_library {

using configuration::JsonValue;
using configuration::Tool;
using Kind = JsonValue::Kind;

namespace {

/// How many mm a unit has; none after a mistake.
std::optional<double> unit_of(const JsonValue& object, const std::string& path, double otherwise, LibraryFile& file) {
  const JsonValue* const value = member_of(object, "unit");
  if (value == nullptr) return otherwise;
  if (value->string == "millimeters") return 1;
  if (value->string == "inches") return kInch;
  file.fail(value->at, path + ".unit", problems::kUnknownUnit,
            {configuration::shortened(value->string), std::string("millimeters, inches")});
  return std::nullopt;
}

/// The holder: the segments stand in the file from the collet up, the reverse of the dialog. Those above the gauge line
/// are inside the spindle, and do not count.
std::optional<configuration::NamedRows> read_holder(const JsonValue& holder, const std::string& path, double unit,
                                                    LibraryFile& file) {
  const std::optional<double> millimeters = unit_of(holder, path, unit, file);
  const JsonValue* const segments = member_of(holder, "segments");
  if (!millimeters || segments == nullptr) return std::nullopt;
  if (segments->kind != Kind::List) {
    file.fail(segments->at, path + ".segments", configuration::mistakes::kNeedsList);
    return std::nullopt;
  }
  const std::optional<double> gauge = JsonTool(holder, path, *millimeters, file).length("gaugeLength");
  configuration::NamedRows rows{text_of(holder, "description"), {}};
  double height = 0;
  for (std::size_t i = 0; i < segments->elements.size(); ++i) {
    const JsonTool segment(segments->elements[i], fmt::format("{}.segments[{}]", path, i), *millimeters, file);
    const std::optional<double> own = segment.length("height");
    if (!own) continue;
    const double lower = segment.length("lower-diameter").value_or(0);
    double upper = segment.length("upper-diameter").value_or(0);
    double kept = *own;
    if (gauge && height + kept > *gauge) {  // The gauge line is within it, or below.
      kept = tidy(*gauge - height);
      if (kept <= 0) break;
      upper = tidy(lower + (upper - lower) * kept / *own);
    }
    rows.rows.push_back({kept, lower, upper});
    height = tidy(height + kept);
  }
  if (rows.rows.empty()) return std::nullopt;
  if (rows.name.empty()) rows.name = fmt::format("holder {:.7g}", height);
  return rows;
}

/// Which shape a type of Fusion has, in the geometry of the tool.
void set_shape(std::string_view type, const JsonTool& geometry, LibraryTool& read) {
  Tool& tool = read.tool;
  const auto is = [&](std::string_view each) { return type == each; };
  if (is("flat end mill") || is("bull nose end mill") || is("face mill") || is("reamer") || is("boring bar") ||
      type.starts_with("tap ")) {
    set_end_mill(tool, geometry.length("RE"));
  } else if (is("ball end mill")) {
    tool.shape = "ball";
  } else if (is("drill") || is("spot drill")) {
    tool.tip_angle = geometry.angle("SIG");
    if (tool.tip_angle) tool.shape = "drill";
  } else if (is("chamfer mill") || is("counter sink")) {
    const std::optional<double> side = geometry.angle("TA");
    const std::optional<double> whole = side ? std::optional(*side * 2) : geometry.angle("SIG");
    if (whole && *whole < 179) set_cone(tool, *whole, geometry.length("tip-diameter").value_or(0) / 2);
  } else if (is("tapered mill")) {
    const std::optional<double> side = geometry.angle("TA");
    if (side && *side < 80 && tool.radius && !geometry.length("RE")) set_taper(tool, *tool.radius, *side);
  } else if (is("slot mill") && tool.cut_length && tool.shank) {
    tool.shape = "disc";
  }
  if (tool.shape.empty() && !tool.profile) read.kind_without_shape = type;
}

/// None for an entry that is no tool.
std::optional<LibraryTool> read_tool(const JsonValue& value, const std::string& path, double otherwise,
                                     LibraryFile& file) {
  if (value.kind != Kind::Object) {
    file.fail(value.at, path, configuration::mistakes::kNeedsObject);
    return std::nullopt;
  }
  const std::string type = text_of(value, "type");
  if (type == "holder") return std::nullopt;
  LibraryTool read;
  Tool& tool = read.tool;
  tool.name = text_of(value, "description");
  if (tool.name.empty()) tool.name = type;
  if (const JsonValue* const post = member_of(value, "post-process")) {
    const JsonValue* const number = member_of(*post, "number");
    if (number != nullptr && number->kind == Kind::Number && number->number == std::floor(number->number) &&
        number->number >= 0 && number->number < 1e9)
      read.number = fmt::format("{:.0f}", number->number);
  }
  const std::optional<double> unit = unit_of(value, path, otherwise, file);
  if (!unit) return read;
  static const JsonValue kNoGeometry;
  const JsonValue* const found = member_of(value, "geometry");
  const JsonTool geometry(found == nullptr ? kNoGeometry : *found, path + ".geometry", *unit, file);
  if (const auto diameter = geometry.length("DC")) tool.radius = tidy(*diameter / 2);
  tool.cut_length = geometry.length("LCF");
  tool.shank = geometry.length("SFDM");
  std::optional<double> gauge_length;  // Of the holder.
  if (const JsonValue* const holder = member_of(value, "holder"); holder != nullptr && holder->kind == Kind::Object) {
    read.holder = read_holder(*holder, path + ".holder", *unit, file);
    if (read.holder) {
      gauge_length = 0;
      for (const auto& row : read.holder->rows) *gauge_length += row[0];
      tool.body = read.holder->name;
    }
  }
  // From the spindle nose to the tip: what sticks out of the holder, and the holder.
  const std::optional<double> stick_out = geometry.length("LB");
  tool.length = geometry.length("assemblyGaugeLength");
  if (gauge_length && stick_out) tool.length = tidy(*gauge_length + *stick_out);
  set_shape(type, geometry, read);
  return read;
}

}  // namespace

std::vector<LibraryTool> read_fusion(const JsonValue& library, double millimeters, LibraryFile& file) {
  std::vector<LibraryTool> tools;
  const JsonValue& data = *member_of(library, "data");
  if (data.kind != Kind::List) file.fail(data.at, "data", configuration::mistakes::kNeedsList);
  for (std::size_t i = 0; i < data.elements.size(); ++i)
    if (auto tool =
            file.entry([&] { return read_tool(data.elements[i], fmt::format("data[{}]", i), millimeters, file); }))
      tools.push_back(*std::move(tool));
  return tools;
}

}  // namespace isocnc::tool_library
