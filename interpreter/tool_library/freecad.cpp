#include <algorithm>
#include <numbers>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include "interpreter/tool_library/library_reader.h"

namespace isocnc::tool_library {

using configuration::JsonValue;
using configuration::Tool;

namespace {

struct Unit {
  std::string_view name;
  double factor;
};
constexpr Unit kLengthUnits[] = {{"mm", 1},     {"cm", 10},    {"m", 1000}, {"um", 0.001},
                                 {"in", kInch}, {"\"", kInch}, {"", 1}};
constexpr Unit kAngleUnits[] = {{"\xC2\xB0", 1}, {"deg", 1}, {"rad", 180 / std::numbers::pi}, {"", 1}};

/// The parameters of a bit: quantities such as `5.0000 mm`, `0,125 in` or `45.0000 °`.
class Parameters {
 public:
  Parameters(const JsonValue& object, LibraryFile& file) : object_(object), file_(file) {}

  std::optional<double> length(std::string_view key) const {
    const std::optional<double> value = quantity(key, kLengthUnits, "mm, cm, m, um, in");
    if (!value || *value == 0) return std::nullopt;
    const double length = tidy(*value);
    if (length > 0 && length <= kLongest) return length;
    fail(key, problems::kNeedsLength);
    return std::nullopt;
  }

  std::optional<double> angle(std::string_view key) const {
    const std::optional<double> value = quantity(key, kAngleUnits, "\xC2\xB0, deg, rad");
    if (!value || *value == 0) return std::nullopt;
    if (*value > 0 && *value < 180) return tidy(*value);
    fail(key, problems::kNeedsAngle);
    return std::nullopt;
  }

 private:
  void fail(std::string_view key, const dialect::Text& why) const {
    const JsonValue& value = *member_of(object_, key);
    file_.fail(value.at, fmt::format("parameter.{}", key), why, {configuration::shortened(value.string)});
  }

  std::optional<double> quantity(std::string_view key, std::span<const Unit> units, std::string_view names) const {
    const JsonValue* const value = member_of(object_, key);
    if (value == nullptr || value->kind == JsonValue::Kind::Null) return std::nullopt;
    if (value->kind == JsonValue::Kind::Number) return value->number;
    std::string text = text_of(object_, key);
    std::replace(text.begin(), text.end(), ',', '.');
    double number = 0;
    const auto read = fast_float::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc{}) {
      fail(key, units.front().name == "mm" ? problems::kNeedsLength : problems::kNeedsAngle);
      return std::nullopt;
    }
    std::string_view rest(read.ptr, static_cast<std::size_t>(text.data() + text.size() - read.ptr));
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    const auto unit = std::find_if(units.begin(), units.end(), [&](const Unit& each) { return each.name == rest; });
    if (unit != units.end()) return number * unit->factor;
    file_.fail(value->at, fmt::format("parameter.{}", key), problems::kUnknownUnit,
               {configuration::shortened(std::string(rest)), std::string(names)});
    return std::nullopt;
  }

  const JsonValue& object_;
  LibraryFile& file_;
};

/// The name of the shape's file, without folder and ending: `endmill`.
std::string shape_name(const JsonValue& bit) {
  std::string name = text_of(bit, "shape");
  name.erase(0, name.find_last_of("/\\") + 1);
  name.resize(std::min(name.find('.'), name.size()));
  return in_small_letters(name);
}

void set_shape(std::string_view shape, const Parameters& parameters, LibraryTool& read) {
  Tool& tool = read.tool;
  if (shape == "endmill") {
    set_end_mill(tool, {});
  } else if (shape == "ballend") {
    tool.shape = "ball";
  } else if (shape == "bullnose" || shape == "torus") {
    std::optional<double> corner = parameters.length("CornerRadius");
    // By its name the radius of the flat; FreeCAD itself takes it for that of the corner. Only where both are the same
    // it tells a shape.
    const std::optional<double> flat = corner ? std::nullopt : parameters.length("FlatRadius");
    if (flat && tool.radius && tidy(*flat * 2) == *tool.radius) corner = flat;
    if (corner) set_end_mill(tool, corner);
  } else if (shape == "drill") {
    tool.tip_angle = parameters.angle("TipAngle");
    if (tool.tip_angle) tool.shape = "drill";
  } else if (shape == "v-bit" || shape == "vbit" || shape == "chamfer") {
    const std::optional<double> angle = parameters.angle("CuttingEdgeAngle");
    // The height of its edge may be less than that of the cone.
    tool.cut_length.reset();
    if (angle && *angle < 179) set_cone(tool, *angle, parameters.length("TipDiameter").value_or(0) / 2);
  } else if (shape == "slittingsaw") {
    tool.cut_length = parameters.length("BladeThickness");
    if (tool.cut_length && tool.shank) tool.shape = "disc";
  }
  if (tool.shape.empty() && !tool.profile) read.kind_without_shape = shape;
}

}  // namespace

std::optional<LibraryTool> read_freecad_bit(const JsonValue& bit, LibraryFile& file) {
  const JsonValue* const found = member_of(bit, "parameter");
  if (found == nullptr || found->kind != JsonValue::Kind::Object) {
    file.fail(found == nullptr ? bit.at : found->at, "parameter", configuration::mistakes::kNeedsObject);
    return std::nullopt;
  }
  const Parameters parameters(*found, file);
  LibraryTool read;
  Tool& tool = read.tool;
  tool.name = text_of(bit, "name");
  if (const auto diameter = parameters.length("Diameter")) tool.radius = tidy(*diameter / 2);
  tool.cut_length = parameters.length("CuttingEdgeHeight");
  tool.shank = parameters.length("ShankDiameter");
  set_shape(shape_name(bit), parameters, read);
  return read;
}

}  // namespace isocnc::tool_library
