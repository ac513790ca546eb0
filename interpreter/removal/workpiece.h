#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "interpreter/solids/revolved_body.h"
#include "interpreter/stock/blank.h"

namespace isocnc::removal {

/// A part of what turns in the spindle.
enum class ToolPart : std::uint8_t { Cutter, Shank, Holder, Nose };

/// The bodies of a mounted tool: z = 0 at the tip, growing to the spindle nose at z = `length`, mm. They outlive the
/// check that uses them.
struct CuttingTool {
  double length = 0;                                           ///< From the spindle nose to the tip.
  const solids::RevolvedBody* cutter = nullptr;                ///< Null: it cuts nothing that is known.
  const solids::RevolvedBody* shank = nullptr;                 ///< From the end of the cutter to the holder.
  const solids::RevolvedBody* holder = nullptr;                ///< Up to the spindle nose.
  const solids::RevolvedBody* nose = nullptr;                  ///< z = 0 at the spindle nose.
  double max_depth = std::numeric_limits<double>::infinity();  ///< How deep it may cut at once.
};

/// What is worked on, in the frame of the setup, mm.
struct Workpiece {
  stock::Blank blank;
  double spacing = 0.5;                      ///< Of the dexels.
  std::optional<stock::Window> window;       ///< The part of the blank that is looked at; all of it without.
  double clearance = 0;                      ///< Holder and nose should not come nearer to material.
  std::optional<stock::Blank> target;        ///< The finished part.
  double tolerance = 0;                      ///< What may be left on the target.
  std::vector<solids::BoundingBox> holding;  ///< What holds the workpiece: the boxes around cups, clamps, stops.
  double longest_air_cut = std::numeric_limits<double>::infinity();  ///< Longer ways in feed should meet material.
  std::optional<double> board_top;                 ///< The height of a board that holds whatever lies on it.
  geometry::Vec3 origin = geometry::Vec3::Zero();  ///< Of the setup's frame; machine frame of the program.
};

}  // namespace isocnc::removal
