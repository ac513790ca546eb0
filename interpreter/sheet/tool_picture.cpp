#include "interpreter/sheet/tool_picture.h"

#include <algorithm>
#include <cmath>

namespace isocnc::sheet {

namespace {

constexpr std::uint32_t kLineColor = 0x333333;
constexpr std::uint32_t kCutterColor = 0xF2C14E;
constexpr std::uint32_t kShankColor = 0xD9DCE0;
constexpr std::uint32_t kHolderColor = 0xB4BAC2;

/// Places of an outline: how high above the tip, and how far from the axis, mm.
using RadiusProfile = std::vector<std::pair<double, double>>;

struct ColoredProfile {
  RadiusProfile profile;
  std::uint32_t color = 0;
};

/// The radius of a piece at a height; negative where it is not there.
double radius_at(const solids::BodyPiece& piece, double z) {
  const solids::Frustum& core = piece.core;
  constexpr int kSteps = 32;
  double radius = -1;
  for (int i = 0; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps;
    const double above = z - (core.bottom + part * (core.top - core.bottom));
    const double left = piece.rounding * piece.rounding - above * above;
    const double step = (core.top - core.bottom) / kSteps;
    if (left < 0 && std::abs(above) > step / 2 + 1e-9) continue;
    radius = std::max(
        radius, core.bottom_radius + part * (core.top_radius - core.bottom_radius) + std::sqrt(std::max(0.0, left)));
  }
  return radius;
}

RadiusProfile profile_of(const solids::RevolvedBody& body) {
  constexpr int kSteps = 120;
  RadiusProfile profile;
  for (int i = 0; i <= kSteps; ++i) {
    const double z = body.bottom() + (body.top() - body.bottom()) * i / kSteps;
    double radius = 0;
    for (const solids::BodyPiece& piece : body.pieces()) radius = std::max(radius, radius_at(piece, z));
    profile.emplace_back(z, radius);
  }
  return profile;
}

std::vector<ColoredProfile> profiles_of(const verification::ToolBodies* bodies, const configuration::Tool* tool) {
  std::vector<ColoredProfile> profiles;
  if (bodies != nullptr) {
    if (bodies->cutter) profiles.push_back({profile_of(*bodies->cutter), kCutterColor});
    if (bodies->shank) profiles.push_back({profile_of(*bodies->shank), kShankColor});
    if (bodies->holder) profiles.push_back({profile_of(*bodies->holder), kHolderColor});
  }
  if (!profiles.empty() || tool == nullptr || !tool->radius || !tool->length || !(*tool->radius > 0)) return profiles;
  return {{{{0, *tool->radius}, {*tool->length, *tool->radius}}, kShankColor}};
}

}  // namespace

Drawing picture_of_tool(const verification::ToolBodies* bodies, const configuration::Tool* tool, double max_width,
                        double max_height) {
  const std::vector<ColoredProfile> profiles = profiles_of(bodies, tool);
  double height = 0;
  double radius = 0;
  for (const auto& [profile, color] : profiles)
    for (const auto& [z, r] : profile) {
      height = std::max(height, z);
      radius = std::max(radius, r);
    }
  if (!(height > 0) || !(radius > 0)) return {};
  const double scale = std::min(max_height / height, max_width / (2 * radius));
  Drawing drawing{.width = 2 * radius * scale, .height = height * scale, .lines = {}, .texts = {}};
  for (const auto& [profile, color] : profiles) {
    DrawnLine line{{.color = kLineColor, .width = 0.1, .fill = color}, {}};
    const auto add = [&](double z, double r) { line.points.push_back({(radius + r) * scale, (height - z) * scale}); };
    for (const auto& [z, r] : profile) add(z, r);
    for (auto each = profile.rbegin(); each != profile.rend(); ++each) add(each->first, -each->second);
    line.points.push_back(line.points.front());
    drawing.lines.push_back(std::move(line));
  }
  return drawing;
}

}  // namespace isocnc::sheet
