#include "interpreter/configuration/tool_bodies.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "interpreter/dialect/near_names.h"
#include "interpreter/solids/tool_shapes.h"

namespace isocnc::configuration {

using solids::FormPoint;
using solids::RevolvedBody;
using solids::ShapeProblem;
using solids::ShapeValue;
using verification::ToolBodies;

namespace {

using MaybeObjection = std::optional<Objection>;
using MaybeBody = std::optional<RevolvedBody>;

std::string shown(double number) { return fmt::format("{:.7g}", number); }
std::string millimeters(double number) { return fmt::format("{:.7g} mm", number); }

Objection objection(std::string_view member, const dialect::Text& text, std::vector<Named> names = {}) {
  return {.member = member, .text = text, .names = std::move(names), .row = {}, .column = {}, .meant = {}};
}

Objection row_objection(std::string_view member, const dialect::Text& text, std::size_t row,
                        std::vector<Named> names = {}) {
  return {.member = member, .text = text, .names = std::move(names), .row = row, .column = 0, .meant = {}};
}

const NamedRows* find_holder(const MachineConfiguration& machine, const std::string& name) {
  const auto found =
      std::find_if(machine.holders.begin(), machine.holders.end(), [&](const auto& each) { return each.name == name; });
  return found == machine.holders.end() ? nullptr : &*found;
}

Objection unknown_holder(const MachineConfiguration& machine, const std::string& name) {
  std::vector<std::string> names;
  for (const NamedRows& holder : machine.holders) names.push_back(holder.name);
  Objection result = objection("body", mistakes::kUnknownHolder, {shortened(name)});
  result.meant = dialect::nearest_name(name, names);
  return result;
}

/// Keys that need another one.
MaybeObjection lacks_key(const Tool& tool) {
  const auto lacks = [](std::string_view key, std::string_view needed) {
    return objection(key, mistakes::kNeedsKey, {std::string(needed)});
  };
  if (!tool.length) {
    if (!tool.shape.empty()) return lacks("shape", "length");
    if (tool.profile) return lacks("profile", "length");
    if (tool.shank) return lacks("shank", "length");
    if (!tool.body.empty()) return lacks("body", "length");
  }
  if (tool.shank && !tool.profile && !tool.cut_length) return lacks("shank", "cutLength");
  if (tool.shape.empty()) return std::nullopt;
  if (!tool.radius) return lacks("shape", "radius");
  if (tool.shape == "bull" && !tool.corner_radius) return lacks("shape", "cornerRadius");
  if ((tool.shape == "cone" || tool.shape == "drill") && !tool.tip_angle) return lacks("shape", "tipAngle");
  if (tool.shape == "disc" && !tool.cut_length) return lacks("shape", "cutLength");
  if (tool.shape == "disc" && !tool.shank) return lacks("shape", "shank");
  return std::nullopt;
}

/// Keys that contradict each other.
MaybeObjection contradiction_in(const Tool& tool) {
  if (tool.profile && !tool.shape.empty()) return objection("profile", mistakes::kSecondShape, {std::string("shape")});
  if (tool.corner_radius.value_or(0) > 0 && tool.shape != "bull")
    return objection("cornerRadius", mistakes::kNotOfShape, {std::string("bull")});
  // Lists of tools from CAM systems give every tool a tip angle; where the shape has none, it means nothing.
  return std::nullopt;
}

solids::BodyOrProblem shape_body(const Tool& tool, double length) {
  const double radius = *tool.radius;
  if (tool.shape == "ball") return solids::ball_body(radius, length);
  if (tool.shape == "bull") return solids::bull_body(radius, *tool.corner_radius, length);
  if (tool.shape == "cone") return solids::cone_body(radius, 0, *tool.tip_angle, length);
  if (tool.shape == "drill") return solids::drill_body(radius, *tool.tip_angle, length);
  if (tool.shape == "disc") return solids::disc_body(radius, length);
  return solids::flat_body(radius, length);
}

/// The ranges of the keys leave no other problem of a shape.
Objection shape_objection(const ShapeProblem& problem, const Tool& tool) {
  if (problem.value == ShapeValue::CornerRadius)
    return objection("cornerRadius", mistakes::kTooBig, {shown(problem.found), millimeters(problem.limit)});
  if (tool.cut_length)
    return objection("cutLength", mistakes::kTooSmall, {shown(problem.found), millimeters(problem.limit)});
  return objection("length", mistakes::kTooShortForShape, {shown(problem.found), shown(problem.limit)});
}

MaybeObjection profile_objection(const std::vector<FormPoint>& points, double reach) {
  if (points.front().z != 0) return row_objection("profile", mistakes::kNotAtTip, 0, {millimeters(points.front().z)});
  const auto body = solids::form_body(points);
  if (const auto* const problem = std::get_if<ShapeProblem>(&body)) {
    if (problem->kind != ShapeProblem::Kind::NotAscending) return objection("profile", mistakes::kNoVolume);
    return row_objection("profile", mistakes::kBelowRowBefore, problem->row,
                         {shown(problem->found), shown(problem->limit)});
  }
  if (points.back().z <= reach) return std::nullopt;
  return row_objection("profile", mistakes::kInsideHolder, points.size() - 1, {shown(points.back().z), shown(reach)});
}

/// Divides an outline at a z within it.
std::pair<std::vector<FormPoint>, std::vector<FormPoint>> divided(const std::vector<FormPoint>& points, double z) {
  const auto above = std::find_if(points.begin(), points.end(), [&](const FormPoint& point) { return point.z > z; });
  std::pair<std::vector<FormPoint>, std::vector<FormPoint>> parts{{points.begin(), above}, {above, points.end()}};
  if (above == points.begin() || above == points.end()) return parts;
  const FormPoint& low = *(above - 1);
  const FormPoint between{z, low.radius + (above->radius - low.radius) * (z - low.z) / (above->z - low.z)};
  parts.first.push_back(between);
  parts.second.insert(parts.second.begin(), between);
  return parts;
}

MaybeBody body_of(const std::vector<FormPoint>& points) {
  auto body = solids::form_body(points);
  auto* const found = std::get_if<RevolvedBody>(&body);
  return found ? MaybeBody(std::move(*found)) : std::nullopt;
}

/// Adds cutter and shank, of which `reach` mm are outside the holder.
class CutterMaker {
 public:
  CutterMaker(const Tool& tool, double reach, ToolBodies& bodies) : tool_(tool), reach_(reach), bodies_(bodies) {}

  MaybeObjection make() {
    if (tool_.cut_length && *tool_.cut_length > reach_)
      return objection("cutLength", mistakes::kInsideHolder, {shown(*tool_.cut_length), shown(reach_)});
    if (tool_.profile) return make_profile();
    const double end = tool_.cut_length.value_or(reach_);
    if (!tool_.shape.empty()) {
      auto cutter = shape_body(tool_, end);
      if (const auto* const problem = std::get_if<ShapeProblem>(&cutter)) return shape_objection(*problem, tool_);
      bodies_.cutter = std::get<RevolvedBody>(std::move(cutter));
      add_shank({}, end, bodies_.cutter->maximum_radius());
    } else if (tool_.shank) {
      add_shank({}, end, 0);
    }
    return std::nullopt;
  }

 private:
  MaybeObjection make_profile() {
    std::vector<FormPoint> points;
    for (const std::vector<double>& row : *tool_.profile) points.push_back({row[0], row[1]});
    if (MaybeObjection found = profile_objection(points, reach_)) return found;
    const double end = points.back().z;
    if (tool_.cut_length && *tool_.cut_length > end)
      return objection("cutLength", mistakes::kTooBig, {shown(*tool_.cut_length), millimeters(end)});
    auto [cutting, rest] = divided(points, tool_.cut_length.value_or(end));
    bodies_.cutter = body_of(cutting);
    if (!bodies_.cutter) return objection("cutLength", mistakes::kNoVolume);
    add_shank(std::move(rest), end, points.back().radius);
    return std::nullopt;
  }

  /// A shank with the outline of `points`, and from `end` on a cylinder.
  void add_shank(std::vector<FormPoint> points, double end, double radius) {
    if (tool_.shank) radius = *tool_.shank / 2;
    if (end < reach_) {
      points.push_back({end, radius});
      points.push_back({reach_, radius});
    }
    bodies_.shank = body_of(points);
  }

  const Tool& tool_;
  double reach_;
  ToolBodies& bodies_;
};

}  // namespace

std::variant<RevolvedBody, Objection> stack_body(const NumberRows& rows, double base) {
  std::vector<solids::StackRow> stack;
  for (const std::vector<double>& row : rows) stack.push_back({row[0], row[1], row[2]});
  auto body = solids::stacked_body(stack, base);
  if (auto* const found = std::get_if<RevolvedBody>(&body)) return std::move(*found);
  return objection("", mistakes::kNoVolume);
}

std::variant<ToolBodies, Objection> tool_bodies(const MachineConfiguration& machine, const Tool& tool) {
  if (MaybeObjection found = contradiction_in(tool)) return *std::move(found);
  if (MaybeObjection found = lacks_key(tool)) return *std::move(found);
  ToolBodies bodies;
  if (!tool.length) return bodies;
  bodies.length = *tool.length;
  bodies.max_depth = tool.max_depth;
  double reach = bodies.length;
  if (!tool.body.empty()) {
    const NamedRows* const holder = find_holder(machine, tool.body);
    if (holder == nullptr) return unknown_holder(machine, tool.body);
    double height = 0;
    for (const std::vector<double>& row : holder->rows) height += row[0];
    if (height >= bodies.length)
      return objection("body", mistakes::kHolderTooHigh, {shown(height), shown(bodies.length)});
    reach -= height;
    auto stack = stack_body(holder->rows, reach);
    if (auto* const found = std::get_if<Objection>(&stack)) return std::move(*found);
    bodies.holder = std::get<RevolvedBody>(std::move(stack));
  }
  if (MaybeObjection found = CutterMaker(tool, reach, bodies).make()) return *std::move(found);
  return bodies;
}

}  // namespace isocnc::configuration
