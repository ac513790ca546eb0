#include "interpreter/removal/tool_forms.h"

#include <algorithm>

namespace isocnc::removal {

using solids::RevolvedBody;

RevolvedBody grown(const RevolvedBody& body, double distance) {
  std::vector<solids::BodyPiece> pieces(body.pieces().begin(), body.pieces().end());
  for (solids::BodyPiece& piece : pieces) piece.rounding += distance;
  return RevolvedBody(std::move(pieces));
}

/// The body with larger radii, and no higher or lower.
static RevolvedBody widened(const RevolvedBody& body, double distance) {
  std::vector<solids::BodyPiece> pieces(body.pieces().begin(), body.pieces().end());
  for (solids::BodyPiece& piece : pieces) {
    piece.core.bottom_radius += distance;
    piece.core.top_radius += distance;
  }
  return RevolvedBody(std::move(pieces));
}

ToolForms::ToolForms(const CuttingTool& tool, const CutSkin& skin, double wall, double clearance) : tool_(tool) {
  const auto reduced = [&](const RevolvedBody* body, ToolPart part) {
    if (!body) return Body();
    double& of_part = skins_[static_cast<std::size_t>(part)];
    of_part = skin.of_path;
    if (part == ToolPart::Cutter || part == ToolPart::Shank) of_part += skin.of_turn * body->reach(0);
    return body->reduced(of_part);
  };
  const auto with_clearance = [&](const RevolvedBody* body) {
    return body && clearance > 0 ? Body(grown(*body, clearance)) : Body();
  };
  passing_cutter_ = reduced(tool.cutter, ToolPart::Cutter);
  shank_ = reduced(tool.shank, ToolPart::Shank);
  holder_ = reduced(tool.holder, ToolPart::Holder);
  nose_ = reduced(tool.nose, ToolPart::Nose);
  holder_with_clearance_ = with_clearance(tool.holder);
  nose_with_clearance_ = with_clearance(tool.nose);
  if (tool.shank && tool.cutter && tool.shank->maximum_radius() >= tool.cutter->maximum_radius() - skin.of_path)
    shank_with_wall_ = widened(*tool.shank, wall);
  for (const RevolvedBody* body : {tool.cutter, tool.shank, tool.holder})
    if (body) reach_ = std::max(reach_, body->reach(0));
  if (tool.nose) reach_ = std::max(reach_, tool.nose->reach(-tool.length));
}

}  // namespace isocnc::removal
