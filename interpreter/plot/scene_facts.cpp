#include "interpreter/plot/scene_facts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "interpreter/plot/packed_bytes.h"
#include "interpreter/running/runner.h"
#include "interpreter/running/vector_json.h"
#include "interpreter/verification/verification_report.h"

namespace isocnc::plot {

using geometry::Vec3;
using running::array;
using verification::SceneBody;
using OrderedJson = nlohmann::ordered_json;

/// The radius of a piece at the height z; negative where it is not.
static double radius_at(const solids::BodyPiece& piece, double z) {
  const solids::Frustum& core = piece.core;
  const double rounding = piece.rounding;
  if (z < core.bottom - rounding || z > core.top + rounding) return -1;
  const double height = core.top - core.bottom;
  const double slope = height > 0 ? (core.top_radius - core.bottom_radius) / height : 0;
  // The point of the core whose sphere reaches farthest out at z.
  const double best = z + slope * rounding / std::hypot(1, slope);
  const double center = std::clamp(best, std::max(core.bottom, z - rounding), std::min(core.top, z + rounding));
  const double widest =
      height > 0 ? core.bottom_radius + slope * (center - core.bottom) : std::max(core.bottom_radius, core.top_radius);
  const double above = z - center;
  return widest + std::sqrt(std::max(0.0, rounding * rounding - above * above));
}

static double radius_at(const solids::RevolvedBody& body, double z) {
  double radius = 0;
  for (const solids::BodyPiece& piece : body.pieces()) radius = std::max(radius, radius_at(piece, z));
  return radius;
}

/// Heights between which a straight line shows the outline well enough.
static std::vector<double> heights(const solids::RevolvedBody& body) {
  constexpr int kSteps = 16;  // Of a quarter of a circle.
  std::vector<double> heights;
  for (const solids::BodyPiece& piece : body.pieces()) {
    heights.push_back(piece.core.bottom);
    heights.push_back(piece.core.top);
    for (int i = 0; i <= kSteps && piece.rounding > 0; ++i) {
      const double part = std::cos(i * std::numbers::pi / 2 / kSteps);
      heights.push_back(piece.core.bottom - piece.rounding * part);
      heights.push_back(piece.core.top + piece.rounding * part);
    }
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

/// From the lower end to the upper one, with a step where the radius has one.
static OrderedJson outline(const std::optional<solids::RevolvedBody>& body) {
  if (!body) return nullptr;
  const std::vector<double> at = heights(*body);
  OrderedJson points = OrderedJson::array();
  const auto add = [&](double z, double radius) {
    const double kStep = 1e-4;  // mm
    const OrderedJson point = {std::round(z / kStep) * kStep, std::round(radius / kStep) * kStep};
    if (points.empty() || points.back() != point) points.push_back(point);
  };
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double inside = (at[i + 1] - at[i]) * 1e-9;
    add(at[i], radius_at(*body, at[i] + inside));
    add(at[i + 1], radius_at(*body, at[i + 1] - inside));
  }
  return points;
}

/// Nine floats for each triangle, little endian, in base64.
static std::string positions(const solids::Mesh& mesh) {
  std::string bytes;
  bytes.reserve(mesh.triangles().size() * 36);
  for (const solids::Triangle& triangle : mesh.triangles())
    for (const Vec3& corner : triangle.corners)
      for (const double coordinate : corner) {
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(coordinate));
        for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xFF);
      }
  return base64(bytes);
}

static void put_shape(OrderedJson& json, const verification::BodyShape& shape) {
  if (const auto* const box = std::get_if<solids::Cuboid>(&shape)) {
    json["box"] = {array(box->minimum), array(box->maximum)};
  } else if (const auto* const cylinder = std::get_if<solids::Cylinder>(&shape)) {
    json["cylinder"] = {{"at", array(cylinder->at.origin)},
                        {"axis", array(cylinder->at.axis)},
                        {"height", cylinder->height},
                        {"radius", cylinder->radius}};
  } else {
    json["mesh"] = {{"positions", positions(*std::get<std::shared_ptr<const solids::Mesh>>(shape))}};
  }
}

static OrderedJson body_facts(const SceneBody& body, std::string_view on, const Vec3& at) {
  static constexpr std::string_view kRoles[] = {"fixture", "spoilboard", "target", "stock", "machine"};
  OrderedJson json = {
      {"name", body.name}, {"role", kRoles[static_cast<std::size_t>(body.role)]}, {"on", on}, {"at", array(at)}};
  put_shape(json, body.shape);
  return json;
}

OrderedJson scene_facts(const verification::Scene& scene, const kinematics::Kinematics& kinematics,
                        const Vec3& origin) {
  static constexpr std::string_view kKinds[] = {"threeAxis", "head", "table"};
  static constexpr std::string_view kLinks[] = {"machine", "X", "Y", "Z", "C", "B"};
  OrderedJson json = {{"name", scene.name},
                      {"kinematics",
                       {{"type", kKinds[static_cast<std::size_t>(kinematics.kind)]},
                        {"pivot", kinematics.pivot},
                        {"spindleFromB", array(kinematics.spindle_from_b)},
                        {"bFromC", array(kinematics.b_from_c)},
                        {"bPoint", array(kinematics.b_point)},
                        {"cPoint", array(kinematics.c_point)}}},
                      {"nose", outline(scene.nose)},
                      {"tools", OrderedJson::object()},
                      {"bodies", OrderedJson::array()}};
  for (const auto& [code, tool] : scene.tools)
    json["tools"][running::tool_name(code)] = {{"length", tool.length},
                                               {"cutter", outline(tool.cutter)},
                                               {"shank", outline(tool.shank)},
                                               {"holder", outline(tool.holder)}};
  for (const SceneBody& body : scene.machine)
    json["bodies"].push_back(body_facts(body, kLinks[static_cast<std::size_t>(body.on)], Vec3::Zero()));
  const Vec3 at = scene.is_in_workpiece_frame ? origin : Vec3(Vec3::Zero());
  for (const SceneBody& body : scene.setup) json["bodies"].push_back(body_facts(body, "workpiece", at));
  return json;
}

/// As exactly as a reader can see.
static double rounded(double value) { return std::round(value * 1000) / 1000; }

OrderedJson stock_facts(const StockRecording& cuts, const verification::MaterialReport& material,
                        const verification::Scene& scene, const kinematics::Kinematics& kinematics) {
  const stock::DexelGrid& grid = cuts.grid();
  const Vec3 first = Vec3(grid.first.x(), grid.first.y(), 0) + material.origin;
  OrderedJson json = {{"first", OrderedJson::array({first.x(), first.y()})},
                      {"spacing", OrderedJson::array({grid.spacing.x(), grid.spacing.y()})},
                      {"columns", grid.columns},
                      {"rows", grid.rows},
                      {"onTable", kinematics.kind == kinematics::MachineKind::Table},
                      {"hasTarget", cuts.has_target()},
                      {"tolerance", scene.target_tolerance},
                      {"volume", material.stock.volume()},
                      {"blankVolume", material.blank_volume},
                      {"resolution", material.stock.spacing()},
                      {"removed", OrderedJson::array()}};
  for (const simulation::RemovedOnLine& each : material.by_line)
    json["removed"].push_back({{"line", each.line},
                               {"volume", rounded(each.volume)},
                               {"depth", rounded(each.depth)},
                               {"width", rounded(each.width)}});
  return json;
}

OrderedJson contact_facts(const verification::VerifiedRun& run) {
  OrderedJson json = OrderedJson::array();
  for (const verification::Contact& contact : run.contacts) {
    if (contact.is_hint()) continue;
    const dialect::DiagnosticDef& def = dialect::definition(contact.id);
    json.push_back({{"code", def.code},
                    {"severity", dialect::severity_name(def.severity, dialect::Language::English)},
                    {"line", contact.line + 1},
                    {"endLine", contact.end_line + 1},
                    {"time", contact.time},
                    {"endTime", contact.end_time},
                    {"tool", running::tool_name(contact.tool)},
                    {"who", contact.who.in(dialect::Language::English)},
                    {"whom", contact.whom.in(dialect::Language::English)},
                    {"point", array(contact.point)},
                    {"distance", contact.distance},
                    {"message", in_both_languages(contact)}});
  }
  return json;
}

}  // namespace isocnc::plot
