#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/execution/setup.h"
#include "interpreter/geometry/frame.h"
#include "interpreter/removal/depth_levels.h"
#include "interpreter/removal/workpiece.h"

namespace isocnc::removal {

/// What goes wrong with the material.
enum class IncidentKind : std::uint8_t {
  RapidInMaterial,  ///< The cutter goes through material in rapid (E150).
  BodyInMaterial,   ///< Shank, holder or nose is in material (E151).
  NearMaterial,     ///< Holder or nose comes nearer to material than the clearance (W154).
  SpindleStopped,   ///< The cutter removes material while the spindle stands (E158).
  EdgeTooShort,     ///< Material stands beside the shank, above the edge (W157).
  CutTooDeep,       ///< More is cut at once than the tool's greatest depth (W157).
  CutsNothing,      ///< Feed motions that meet no material (W159).
  MaterialLeft,     ///< Material that stands on the target at the end (W156).
  LoosePiece,       ///< A piece comes free that nothing holds (W161).
};

/// One of these, from its first moment to its last.
struct Incident {
  IncidentKind kind = IncidentKind::RapidInMaterial;
  ToolPart part = ToolPart::Cutter;
  std::size_t line = 0;      ///< Where it begins; from 0.
  std::size_t end_line = 0;  ///< Where it ends.
  double time = 0;           ///< When it begins, seconds since the start of the run.
  double end_time = 0;
  execution::ToolCode tool;  ///< All 0: none is mounted.
  /// The greatest length of material that is met along the tool's axis, mm. NearMaterial: the smallest distance.
  /// EdgeTooShort and CutTooDeep: the depth of the cut. CutsNothing: the length of the way. MaterialLeft: the greatest
  /// height of what is left beyond the tolerance. LoosePiece: the height of the piece.
  double amount = 0;
  std::optional<double> volume;  ///< MaterialLeft, LoosePiece: mm^3.
  std::size_t worst_line = 0;    ///< Where it is worst; from 0.
  double worst_time = 0;  ///< When it is worst, of what is not looked at closely when that motion begins; seconds.
  std::vector<DepthLevel> levels;  ///< How deep it goes, roughly; none of what is found at the end of the run alone.
  double level = 0;                ///< The lowest Z of the tip there, in that frame; mm.
  /// EdgeTooShort, CutTooDeep: the depth that the tool allows. MaterialLeft: the tolerance. mm.
  double limit = 0;
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< Where it is worst; machine frame of the program, mm.
  geometry::Frame frame;                          ///< In force there; in the machine frame.
  bool is_in_inches = false;                      ///< G70 is in force there.
  /// The Z, in that frame, with which nothing would have been met, mm; none where another Z is no help.
  std::optional<double> enough;
  /// RapidInMaterial: a shank, holder or nose was there already when the rapid began, so that all of this goes with it.
  bool follows_body = false;
  std::optional<std::size_t> shaped_by;  ///< The line that has cut last where it happens, or has stopped the spindle.
};

/// What a tool has removed.
struct Removed {
  double volume = 0;  ///< mm^3
  double depth = 0;   ///< Greatest depth of cut, along the tool's axis, mm.
  double width = 0;   ///< Greatest width of cut across the motion, mm.
  /// Whether depth and width are those of what is cut at the sides and the ends of the tool's way alone. Such a cut
  /// does not count beside another one: rounding leaves skins there, as high as the wall.
  bool is_at_rim = true;

  void add(const Removed& other) {
    volume += other.volume;
    if (other.is_at_rim && !is_at_rim) return;
    const bool counts_alone = is_at_rim && !other.is_at_rim;
    depth = counts_alone ? other.depth : std::max(depth, other.depth);
    width = counts_alone ? other.width : std::max(width, other.width);
    is_at_rim = other.is_at_rim;
  }
};

/// What a tool has removed, and how long it was at it.
struct RemovedByTool {
  execution::ToolCode tool;
  Removed removed;
  double seconds = 0;  ///< Of motions that removed material.
};

}  // namespace isocnc::removal
