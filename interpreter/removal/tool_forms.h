#pragma once

#include <optional>

#include "interpreter/removal/workpiece.h"

namespace isocnc::removal {

/// The bodies of a tool as they are compared with the material. What is cut by pieces of a path, or by a body with a
/// rounded rim, leaves a skin of up to `skin` mm where a later motion along the same wall only passes: so what must not
/// meet material counts without its outermost `skin`.
class ToolForms {
 public:
  ToolForms(const CuttingTool& tool, double skin, double wall, double clearance);

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
