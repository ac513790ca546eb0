#pragma once

#include <optional>
#include <vector>

#include "interpreter/kinematics/travel.h"

namespace isocnc::kinematics {

/// A motion as the machine makes it, with what the summary and the findings of a run both ask of it. That is computed
/// on the first request, since it takes longer than all else that is done with most motions, and not all runs ask.
class MadeMove {
 public:
  /// Refers to the machine and the motion.
  MadeMove(const Machine& machine, const Move& move) : machine_(machine), move_(move) {}

  const Move& move() const { return move_; }
  const std::vector<Overtravel>& overtravels() {
    if (!overtravels_) overtravels_ = kinematics::overtravels(machine_, move_);
    return *overtravels_;
  }
  const TipTravel& tip_travel() {
    if (!tip_travel_) tip_travel_ = kinematics::tip_travel(machine_, move_);
    return *tip_travel_;
  }

 private:
  const Machine& machine_;
  const Move& move_;
  std::optional<std::vector<Overtravel>> overtravels_;
  std::optional<TipTravel> tip_travel_;
};

}  // namespace isocnc::kinematics
