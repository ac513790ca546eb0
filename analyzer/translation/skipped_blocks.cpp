#include "analyzer/translation/translation_run.h"

namespace isocnc::translation {

using geometry::Vec3;
using enum ForeignRole;

/// Whether a G changes nothing.
bool TranslationRun::is_in_force(const CurrentBlock& current, int tenths, ForeignRole role) const {
  if (role == Motion || role == Cycle) return motion_ == tenths / 10;
  if (role == CycleEnd) return motion_ < 0;
  if (role == Plane) return now_.plane == tenths / 10;
  if (role == Inches || role == Millimeters) return now_.inches == (role == Inches);
  if (role == Absolute || role == Incremental) return now_.incremental == (role == Incremental);
  if (role == CentersAbsolute || role == CentersRelative) return centers_absolute_ == (role == CentersAbsolute);
  if (role == InverseTime || role == PerMinute)
    return now_.inverse_time == (role == InverseTime) && !suspended_by_.contains(PerTurn);
  if (role == RetractInitial || role == RetractR) return retracts_to_r_ == (role == RetractR);
  if (role == Compensation || role == CompensationOff) return compensation_ == tenths / 10;
  if (role == RotationOff) return !frames_.rotation;
  if (role == ZeroPoint) return frames_.selected == tenths && !is_further_zero(current, role);
  if (role == ClearShift || role == SuspendShift) return frames_.shift == Vec3::Zero();
  return false;
}

/// A block that the operator may skip: whether what it changes holds from there on is not known.
void TranslationRun::forget_what_it_sets(const CurrentBlock& current) {
  for (const auto& [tenths, role] : current.gs) {
    if (is_in_force(current, tenths, role)) continue;
    if (const auto mode = mode_of(role)) unknown_.insert(*mode);
    if (suspends_motions(role)) suspended_by_.insert(role);
    if (role == Compensation || role == CompensationOff) suspended_by_.insert(Compensation);
    if (role == Rotation || role == RotationOff) suspended_by_.insert(Rotation);
    if (role == ZeroPoint || role == FurtherZero) unknown_.insert(UnknownMode::ZeroPoint);
    if (role == Motion || role == Cycle || role == CycleEnd) motion_ = -1;
    forget_frame(current, tenths, role);
  }
  if (!holds_cycle()) cycle_ = {};
  const ForeignWord* const f = current.find('F');
  if (f != nullptr && (f->is_formula || length_of(*f) != feed_)) feed_.reset();
  const ForeignWord* const t = current.find('T');
  if (t != nullptr && (t->is_formula || t->value != prepared_tool_)) prepared_tool_ = -1;
}

}  // namespace isocnc::translation
