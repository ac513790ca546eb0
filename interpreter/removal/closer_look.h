#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/geometry/frame.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/removal/motion_sweeps.h"

namespace isocnc::removal {

/// The part of a tool that a sweep in a role is of.
ToolPart part_of(SweepRole role);

/// A part as it is, not made thinner; null where the tool has none.
const solids::RevolvedBody* whole_body(const CuttingTool& tool, ToolPart part);

/// Whether a tool with this axis lies flatter than 45 degrees.
bool is_lying(const geometry::Vec3& axis);

/// What a body meets on a path, in a stock as it is.
stock::SweepOutcome ask(const stock::Stock& stock, const solids::RevolvedBody& body, const stock::SweepPath& path);

/// Whether it meets anything.
bool meets(const stock::Stock& stock, const solids::RevolvedBody& body, const stock::SweepPath& path);

/// The height by which a path must be raised so that a body meets nothing, mm; none if that does not help.
std::optional<double> enough_rise(const stock::Stock& stock, const solids::RevolvedBody& body,
                                  const stock::SweepPath& path, const geometry::Vec3& up);

/// Sweeps of a batch looked at one by one, as closely as each takes, in the stock that it has found. What is answered
/// does not depend on what else is in the batch.
class CloserLook {
 public:
  /// Refers to what it is given.
  CloserLook(const SweepSetting& setting, kinematics::RapidMotion rapid_motion, const MotionSweeps& sweeps,
             std::span<const UncutStretch> waiting);

  /// The way of the tip, also where another body is what is swept.
  stock::SweepPath tip_path(std::size_t sweep) const;
  /// When a body first meets material, or a cut is first too deep, seconds.
  double first_touch(std::size_t sweep, const stock::Stock& before) const;
  /// When the whole body is first as deep as it gets, seconds.
  double first_time_as_deep(std::size_t sweep, const stock::Stock& before, double depth) const;
  /// Whether shank, holder and nose were already, at the start of a rapid, in all that the cutter meets on a piece of
  /// it.
  bool has_body_been_there(std::size_t sweep, const stock::Stock& before) const;
  /// The Z at the end of a motion, in a frame, with which a body that meets something on it meets nothing, also
  /// `margin` mm lower; none if another Z is no help.
  std::optional<double> enough_level(std::size_t sweep, const stock::Stock& found, const geometry::Frame& frame,
                                     double margin) const;

 private:
  using HoldsOfPieces = std::function<bool(const std::vector<TipPath>& pieces)>;
  double first_time(const SweepUse& use, int halvings, const HoldsOfPieces& holds) const;

  SweepSetting setting_;
  kinematics::RapidMotion rapid_motion_;
  std::span<const stock::Sweep> sweeps_;
  std::span<const SweepUse> uses_;
  std::span<const UncutStretch> waiting_;
};

}  // namespace isocnc::removal
