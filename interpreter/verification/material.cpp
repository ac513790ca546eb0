#include "interpreter/verification/material.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "interpreter/running/event.h"
#include "interpreter/verification/body_pairs.h"

namespace isocnc::verification {

using namespace dialect::literals;
using removal::IncidentKind;
using removal::ToolPart;

/// Dexels that a small blank has, up to half or twice as many, if they need not be finer than kFinest.
static constexpr double kDexels = 1e6;
static constexpr double kFinest = 0.1;
/// What others cut panels with; mm.
static constexpr double kUsual = 0.5;

/// Longer ways in feed that meet nothing are told (W159), mm.
static constexpr double kLongestAirCut = 50;

static stock::Blank blank_of(const SceneBody& body) {
  if (const auto* const cuboid = std::get_if<solids::Cuboid>(&body.shape)) return *cuboid;
  if (const auto* const cylinder = std::get_if<solids::Cylinder>(&body.shape)) return *cylinder;
  return std::get<std::shared_ptr<const solids::Mesh>>(body.shape).get();
}

static const SceneBody* body_for(const Scene& scene, BodyRole role) {
  const auto found =
      std::find_if(scene.setup.begin(), scene.setup.end(), [&](const SceneBody& body) { return body.role == role; });
  return found == scene.setup.end() ? nullptr : &*found;
}

/// The smallest spacing from a value on that a person would choose: 1, 2, 2.5 or 5 times a power of ten.
static double round_spacing_from(double spacing) {
  constexpr double kNoise = 1e-9;
  const double power = std::pow(10, std::floor(std::log10(spacing)));
  for (const double step : {1.0, 2.0, 2.5, 5.0})
    if (step * power >= spacing * (1 - kNoise)) return step * power;
  return 10 * power;
}

/// The spacing for a blank of which the user has said none.
static double usual_spacing(const removal::Workpiece& workpiece) {
  const stock::Blank& blank = workpiece.blank;
  if (const auto* const left = std::get_if<stock::LeftStock>(&blank)) return left->stock->spacing();
  const Eigen::Vector3d sizes = stock::bounds_of(blank, workpiece.window).sizes();
  const double fine = round_spacing_from(std::sqrt(sizes.x() * sizes.y() / kDexels / 2));
  const double fitting = stock::fitting_spacing(blank, kMaxStockMemory / 8, workpiece.window);
  return std::max(std::clamp(fine, kFinest, kUsual), round_spacing_from(fitting));
}

std::optional<removal::Workpiece> workpiece_of(const Scene& scene, const geometry::Vec3& origin,
                                               const MaterialOptions& options) {
  const SceneBody* const body = body_for(scene, BodyRole::Stock);
  if (!body || !options.is_cut) return std::nullopt;
  removal::Workpiece workpiece{.blank = scene.left_stock ? *scene.left_stock : blank_of(*body)};
  workpiece.window = options.window;
  workpiece.spacing = options.resolution ? *options.resolution
                      : scene.resolution ? *scene.resolution
                                         : usual_spacing(workpiece);
  if (options.max_dexels) {
    const Eigen::Vector3d sizes = stock::bounds_of(workpiece.blank, workpiece.window).sizes();
    workpiece.spacing = std::max(workpiece.spacing, std::sqrt(sizes.x() * sizes.y() / *options.max_dexels));
  }
  workpiece.clearance = scene.clearance;
  workpiece.longest_air_cut = kLongestAirCut;
  workpiece.tolerance = scene.target_tolerance;
  workpiece.origin = scene.is_in_workpiece_frame ? origin : geometry::Vec3::Zero();
  if (const SceneBody* const target = body_for(scene, BodyRole::Target)) workpiece.target = blank_of(*target);
  for (const SceneBody& each : scene.setup) {
    if (each.role == BodyRole::Fixture) workpiece.holding.push_back(bounds(each.shape));
    if (each.role == BodyRole::Spoilboard) workpiece.board_top = bounds(each.shape).max().z();
  }
  return workpiece;
}

std::optional<double> coarser_spacing(const removal::Workpiece& workpiece) {
  if (stock::required_memory(workpiece.blank, workpiece.spacing, workpiece.window) <= kMaxStockMemory)
    return std::nullopt;
  return round_spacing_from(stock::fitting_spacing(workpiece.blank, kMaxStockMemory, workpiece.window));
}

removal::CuttingTool cutting_tool(const Scene& scene, const MountedTool& tool) {
  const auto pointer = [](const std::optional<solids::RevolvedBody>& body) { return body ? &*body : nullptr; };
  // Without its length, nothing on the spindle is at its place.
  if (!(tool.length > 0)) return {};
  removal::CuttingTool cutting{.length = tool.length, .nose = pointer(scene.nose)};
  if (!tool.bodies) return cutting;
  cutting.cutter = pointer(tool.bodies->cutter);
  cutting.shank = pointer(tool.bodies->shank);
  cutting.holder = pointer(tool.bodies->holder);
  if (tool.bodies->max_depth) cutting.max_depth = *tool.bodies->max_depth;
  return cutting;
}

dialect::DiagnosticId diagnostic_of(IncidentKind kind) {
  switch (kind) {
    case IncidentKind::RapidInMaterial:
      return "rapid-in-material"_diag;
    case IncidentKind::BodyInMaterial:
      return "holder-in-material"_diag;
    case IncidentKind::NearMaterial:
      return "near-miss"_diag;
    case IncidentKind::SpindleStopped:
      return "cuts-with-spindle-stopped"_diag;
    case IncidentKind::EdgeTooShort:
    case IncidentKind::CutTooDeep:
      return "cut-too-deep"_diag;
    case IncidentKind::CutsNothing:
      return "cuts-nothing"_diag;
    case IncidentKind::MaterialLeft:
      return "material-left"_diag;
    case IncidentKind::LoosePiece:
      return "loose-piece"_diag;
  }
  return dialect::kNoDiagnostic;
}

Contact contact_of(const removal::Incident& incident, const Scene& scene) {
  Contact contact{.id = diagnostic_of(incident.kind),
                  .line = incident.line,
                  .end_line = incident.end_line,
                  .time = incident.time,
                  .end_time = incident.end_time,
                  .tool = incident.tool};
  const bool is_of_edge = incident.kind == IncidentKind::EdgeTooShort;
  const auto name = [&](ToolPart part) {
    return part_name(is_of_edge ? ToolPart::Cutter : part, running::tool_name(incident.tool));
  };
  contact.who = name(incident.part);
  contact.whom = dialect::GivenName::of({"the material", "il materiale"});
  contact.distance = incident.kind == IncidentKind::NearMaterial ? incident.amount : -incident.amount;
  contact.point = incident.point;
  contact.frame = incident.frame;
  contact.is_in_inches = incident.is_in_inches;
  contact.levels = incident.levels;
  for (removal::DepthLevel& level : contact.levels) {
    level.who = name(static_cast<ToolPart>(level.part));
    if (is_of_edge) level.deepest.depth += incident.limit;
  }
  if (contact.levels.empty())
    contact.levels.push_back(
        {.line = incident.line, .frame = incident.frame, .is_in_inches = incident.is_in_inches, .who = contact.who});
  contact.worst_line = incident.levels.empty() ? incident.line : incident.worst_line;
  contact.worst_time = incident.levels.empty() ? incident.time : std::max(incident.time, incident.worst_time);
  contact.is_of_material = true;
  contact.is_of_edge = is_of_edge;
  contact.limit = incident.limit;
  contact.volume = incident.volume;
  contact.enough = incident.enough;
  contact.shaped_by = incident.shaped_by;
  if (const SceneBody* const body = body_for(scene, BodyRole::Stock)) contact.described = body->described;
  return contact;
}

}  // namespace isocnc::verification
