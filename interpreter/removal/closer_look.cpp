#include "interpreter/removal/closer_look.h"

#include <algorithm>
#include <cmath>

namespace isocnc::removal {

using geometry::Vec3;
using solids::RevolvedBody;
using stock::Stock;
using stock::Sweep;
using stock::SweepOutcome;
using stock::SweepPath;
using stock::SweepPurpose;
using Role = SweepRole;

/// How exactly the first touch is told, as a part of its stretch.
static constexpr int kHalvings = 16;
/// The same where each look cuts.
static constexpr int kHalvingsOfCuts = 8;
/// Lengths that do not count, and how much of a motion a rounded corner may take, mm.
static constexpr double kNear = 0.01;
static constexpr double kCorner = 0.2;

ToolPart part_of(SweepRole role) {
  switch (role) {
    case Role::Shank:
    case Role::ShankWall:
      return ToolPart::Shank;
    case Role::Holder:
    case Role::HolderNear:
      return ToolPart::Holder;
    case Role::Nose:
    case Role::NoseNear:
      return ToolPart::Nose;
    case Role::Cut:
    case Role::Rest:
    case Role::RapidCutter:
    case Role::StandingCutter:
      break;
  }
  return ToolPart::Cutter;
}

const RevolvedBody* whole_body(const CuttingTool& tool, ToolPart part) {
  switch (part) {
    case ToolPart::Cutter:
      return tool.cutter;
    case ToolPart::Shank:
      return tool.shank;
    case ToolPart::Holder:
      return tool.holder;
    case ToolPart::Nose:
      break;
  }
  return tool.nose;
}

bool is_lying(const Vec3& axis) { return std::abs(axis.z()) < std::sqrt(0.5); }

static SweepOutcome asked(const Stock& stock, const RevolvedBody& body, const SweepPath& path, SweepPurpose purpose) {
  Stock copy = stock;  // Asking changes nothing; the copy is a pointer.
  const Sweep sweep{.body = &body, .path = path, .purpose = purpose};
  return copy.apply({&sweep, 1}).front();
}

SweepOutcome ask(const Stock& stock, const RevolvedBody& body, const SweepPath& path) {
  return asked(stock, body, path, SweepPurpose::Ask);
}

bool meets(const Stock& stock, const RevolvedBody& body, const SweepPath& path) {
  return asked(stock, body, path, SweepPurpose::Find).meets();
}

/// The least rise that is free of material, of those up to `most` mm; none if that is not.
template <class IsFree>
static std::optional<double> least_free_rise(double most, IsFree is_free) {
  if (!is_free(most)) return std::nullopt;
  double free = most;
  for (double met = 0; free - met > 0.005;) {
    const double middle = (met + free) / 2;
    (is_free(middle) ? free : met) = middle;
  }
  return free;
}

/// A rise that leads above all of a stock, mm.
static double rise_above(const Stock& stock) { return stock.bounds().sizes().norm() + 1; }

std::optional<double> enough_rise(const Stock& stock, const RevolvedBody& body, const SweepPath& path, const Vec3& up) {
  return least_free_rise(rise_above(stock), [&](double rise) { return !meets(stock, body, moved(path, rise * up)); });
}

CloserLook::CloserLook(const SweepSetting& setting, kinematics::RapidMotion rapid_motion, const MotionSweeps& sweeps,
                       std::span<const UncutStretch> waiting)
    : setting_(setting),
      rapid_motion_(rapid_motion),
      sweeps_(sweeps.sweeps()),
      uses_(sweeps.uses()),
      waiting_(waiting) {}

SweepPath CloserLook::tip_path(std::size_t sweep) const {
  const bool is_nose = part_of(uses_[sweep].role) == ToolPart::Nose;
  return shifted_along_axis(sweeps_[sweep].path, is_nose ? -setting_.forms.tool().length : 0);
}

/// When something begins to hold of the pieces of the tip's path, workpiece frame, from the start of a sweep's
/// stretches on, seconds; where it never does, at their end. To the `halvings`th part of one half of a stretch.
double CloserLook::first_time(const SweepUse& use, int halvings, const HoldsOfPieces& holds) const {
  std::vector<TipPath> pieces;
  const auto from_of = [&](std::size_t stretch) { return stretch == use.first ? use.from : waiting_[stretch].from; };
  const auto to_of = [&](std::size_t stretch) { return stretch == use.last ? use.to : waiting_[stretch].to; };
  const auto holds_from_to = [&](std::size_t stretch, double from, double to) {
    pieces.clear();
    append_tip_paths(setting_.kinematics, waiting_[stretch].stretch.path, from, to,
                     {.distance = setting_.forms.reach()}, setting_.spacing * kPathShare, pieces);
    for (TipPath& piece : pieces) piece.path = moved(std::move(piece.path), -setting_.origin);
    return holds(pieces);
  };
  // One piece for several stretches may hold it where none of them does.
  std::size_t stretch = use.first;
  while (stretch < use.last && !holds_from_to(stretch, from_of(stretch), to_of(stretch))) ++stretch;
  const double begin = from_of(stretch);
  double before = begin;
  double after = to_of(stretch);
  for (int i = 0; i < halvings; ++i) {
    const double middle = (before + after) / 2;
    (holds_from_to(stretch, begin, middle) ? after : before) = middle;
  }
  return waiting_[stretch].stretch.time_at(after);
}

double CloserLook::first_touch(std::size_t sweep, const Stock& before) const {
  const SweepUse& use = uses_[sweep];
  const Sweep& of = sweeps_[sweep];
  const int halvings = use.role == Role::Cut ? kHalvingsOfCuts : kHalvings;
  return first_time(use, halvings, [&](const std::vector<TipPath>& pieces) {
    return std::any_of(pieces.begin(), pieces.end(), [&](const TipPath& piece) {
      if (use.role != Role::Cut) return meets(before, *of.body, placed(setting_.forms, piece.path, use.role));
      Sweep part = of;
      part.path = piece.path;
      Stock copy = before;
      return copy.apply({&part, 1}).front().inside_depth > of.depth_limit;
    });
  });
}

double CloserLook::first_time_as_deep(std::size_t sweep, const Stock& before, double depth) const {
  constexpr int kRoughHalvings = 8;
  constexpr double kAsDeep = 0.01;  // mm
  const SweepUse& use = uses_[sweep];
  const RevolvedBody& body = *whole_body(setting_.forms.tool(), part_of(use.role));
  return first_time(use, kRoughHalvings, [&](const std::vector<TipPath>& pieces) {
    return std::any_of(pieces.begin(), pieces.end(), [&](const TipPath& piece) {
      return ask(before, body, placed(setting_.forms, piece.path, use.role)).depth > depth - kAsDeep;
    });
  });
}

bool CloserLook::has_body_been_there(std::size_t sweep, const Stock& before) const {
  Stock without = before;
  std::size_t first = sweep;  // What a rapid asks stands in a row.
  while (first > 0 && uses_[first - 1].role == uses_[sweep].role) --first;
  const solids::AxisPlacement start = start_of(sweeps_[first].path);
  bool is_in = false;
  for (const auto& [part, role] : {std::pair(ToolPart::Shank, Role::Shank), std::pair(ToolPart::Holder, Role::Holder),
                                   std::pair(ToolPart::Nose, Role::Nose)}) {
    const RevolvedBody* const body = whole_body(setting_.forms.tool(), part);
    if (!body) continue;
    const Sweep sweep{.body = body, .path = placed(setting_.forms, stock::StraightPath{start, start.origin}, role)};
    is_in = without.apply({&sweep, 1}).front().meets() || is_in;
  }
  return is_in && !meets(without, *setting_.forms.passing_cutter(), sweeps_[sweep].path);
}

std::optional<double> CloserLook::enough_level(std::size_t sweep, const Stock& found, const geometry::Frame& frame,
                                               double margin) const {
  const SweepUse& use = uses_[sweep];
  const UncutStretch& stretch = waiting_[use.last];
  // A rapid is asked for as a whole; of other motions, what comes before does not depend on how they are cut.
  std::size_t first = sweep;
  std::size_t last = sweep;
  const auto is_of_motion = [&](std::size_t i) {
    const SweepUse& other = uses_[i];
    return other.role == use.role && waiting_[other.last].stretch.tag == stretch.stretch.tag;
  };
  while (use.role == Role::RapidCutter && first > 0 && is_of_motion(first - 1)) --first;
  while (use.role == Role::RapidCutter && last + 1 < uses_.size() && is_of_motion(last + 1)) ++last;

  const RevolvedBody& body = *sweeps_[sweep].body;
  const auto meets_body = [&](const SweepPath& tip) {
    return meets(found, body, placed(setting_.forms, tip, use.role));
  };
  const Vec3 up = frame.axes.col(2);
  ProgrammedMotion motion = stretch.programmed;
  motion.from -= setting_.origin;
  motion.to -= setting_.origin;
  const Vec3 axis = axis_of(sweeps_[first].path);
  const RaisedMotion raised(motion, up,
                            {.axes_alone = !stretch.is_feed && rapid_motion_ == kinematics::RapidMotion::Independent,
                             .starts_inside = meets_body(stock::StraightPath{{motion.from, axis}, motion.from})});
  if (!raised.can_help()) return std::nullopt;
  // Of a slanted motion, or where the axis turns, a part that is less deep may need a higher end: all of it must be
  // known.
  const SweepPath tip = tip_path(sweep);
  const Vec3 way = motion.to - motion.from;
  const bool is_slanted = std::abs(up.dot(way)) > kNear && up.cross(way).norm() > kNear;
  const bool is_whole =
      (start_of(tip).origin - motion.from).norm() < kCorner && (end_of(tip) - motion.to).norm() < kCorner;
  const bool varies = is_slanted || std::holds_alternative<stock::TurningPath>(tip);
  if (use.role != Role::RapidCutter && varies && !is_whole) return std::nullopt;

  std::vector<SweepPath> paths;
  const auto is_free = [&](double rise) {
    paths.clear();
    for (std::size_t i = first; i <= last; ++i) raised.append(tip_path(i), rise, paths);
    return std::none_of(paths.begin(), paths.end(),
                        [&](const SweepPath& each) { return meets_body(moved(each, -margin * up)); });
  };
  const std::optional<double> rise = least_free_rise(std::min(rise_above(found), raised.most_rise()), is_free);
  if (!rise) return std::nullopt;
  return up.dot(stretch.programmed.to - frame.origin) + *rise;
}

}  // namespace isocnc::removal
