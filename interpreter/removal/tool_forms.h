#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "interpreter/removal/workpiece.h"

namespace isocnc::removal {

/// What a cut may leave of what its program says, where a later motion along the same wall only passes: so what must
/// not meet material counts without that much of its outside.
struct CutSkin {
  double of_path = 0;  ///< By pieces of a path, by a rounded rim and at rounded corners, mm.
  /// At a corner where B or C turns, radians: the more the farther from the tip. Of cutter and shank, which go along
  /// what they have cut; nobody leads a holder along it.
  double of_turn = 0;
};

/// The bodies of a tool as they are compared with the material.
class ToolForms {
 public:
  ToolForms(const CuttingTool& tool, const CutSkin& skin, double wall, double clearance);

  /// How much thinner a part counts than it is, all around, mm; 0 for one that is not there.
  double skin(ToolPart part) const { return skins_[static_cast<std::size_t>(part)]; }
  /// The greatest of these.
  double greatest_skin() const { return *std::max_element(skins_.begin(), skins_.end()); }

  const CuttingTool& tool() const { return tool_; }
  const solids::RevolvedBody* cutter() const { return tool_.cutter; }
  /// What counts of a cutter that must not cut.
  const solids::RevolvedBody* passing_cutter() const { return pointer(passing_cutter_); }
  const solids::RevolvedBody* shank() const { return pointer(shank_); }
  /// The shank with what stands beside it at once; null where it is so much thinner than the cutter that no wall of a
  /// cut does.
  const solids::RevolvedBody* shank_with_wall() const { return pointer(shank_with_wall_); }
  const solids::RevolvedBody* holder() const { return pointer(holder_); }
  const solids::RevolvedBody* holder_with_clearance() const { return pointer(holder_with_clearance_); }
  const solids::RevolvedBody* nose() const { return pointer(nose_); }
  const solids::RevolvedBody* nose_with_clearance() const { return pointer(nose_with_clearance_); }
  /// The largest distance of any point of the tool and the nose from the tip, mm.
  double reach() const { return reach_; }
  /// The same of the cutter alone; 0 without one.
  double cutter_reach() const { return tool_.cutter ? tool_.cutter->reach(0) : 0; }

 private:
  using Body = std::optional<solids::RevolvedBody>;
  static const solids::RevolvedBody* pointer(const Body& body) { return body ? &*body : nullptr; }

  CuttingTool tool_;
  std::array<double, 4> skins_{};  ///< By ToolPart.
  Body passing_cutter_;
  Body shank_;
  Body shank_with_wall_;
  Body holder_;
  Body holder_with_clearance_;
  Body nose_;
  Body nose_with_clearance_;
  double reach_ = 0;
};

/// The body with all points that are within `distance` mm of it.
solids::RevolvedBody grown(const solids::RevolvedBody& body, double distance);

}  // namespace isocnc::removal
