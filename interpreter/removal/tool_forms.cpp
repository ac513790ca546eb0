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

ToolForms::ToolForms(const CuttingTool& tool, double skin, double wall, double clearance) : tool_(tool) {
  const auto reduced = [&](const RevolvedBody* body) { return body ? body->reduced(skin) : Body(); };
  const auto with_clearance = [&](const RevolvedBody* body) {
    return body && clearance > 0 ? Body(grown(*body, clearance)) : Body();
  };
  passing_cutter_ = reduced(tool.cutter);
  shank_ = reduced(tool.shank);
  holder_ = reduced(tool.holder);
  nose_ = reduced(tool.nose);
  holder_with_clearance_ = with_clearance(tool.holder);
  nose_with_clearance_ = with_clearance(tool.nose);
  if (tool.shank && tool.cutter && tool.shank->maximum_radius() >= tool.cutter->maximum_radius() - skin)
    shank_with_wall_ = widened(*tool.shank, wall);
  for (const RevolvedBody* body : {tool.cutter, tool.shank, tool.holder})
    if (body) reach_ = std::max(reach_, body->reach(0));
  if (tool.nose) reach_ = std::max(reach_, tool.nose->reach(-tool.length));
}

}  // namespace isocnc::removal
