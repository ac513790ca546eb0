#include "interpreter/motion/rounded_path.h"

namespace isocnc::motion {

void RoundedPath::append_curve(double begin, double length, double cap, std::span<const kinematics::CurveBound> forward,
                               std::span<const kinematics::CurveBound> backward) {
  bounds_.insert(bounds_.end(), forward.begin(), forward.end());
  bounds_.insert(bounds_.end(), backward.begin(), backward.end());
  steps_.push_back(RoundedStep::Curve);
  curves_.push_back(
      {begin, length, cap, static_cast<std::uint8_t>(forward.size()), static_cast<std::uint8_t>(backward.size())});
}

void RoundedPath::clear() {
  steps_.clear();
  lines_.clear();
  curves_.clear();
  bounds_.clear();
  levels_.clear();
  owners_.clear();
  paths_.clear();
  phases_.clear();
  waits_.clear();
}

void RoundedPathReader::hand_on(std::size_t end, const kinematics::Machine& machine, PathTimes& times) {
  times.begin_element();  // Which frees what is past.
  for (; step_ < end; ++step_) {
    switch (path_->steps_[step_]) {
      case RoundedPath::RoundedStep::Line: {
        const RoundedPath::LineSpan& line = path_->lines_[line_++];
        times.append_line(line.begin, line.length, line.limits);
        break;
      }
      case RoundedPath::RoundedStep::Curve: {
        const RoundedPath::CurveSpan& curve = path_->curves_[curve_++];
        const std::span<const kinematics::CurveBound> bounds = std::span(path_->bounds_).subspan(bound_);
        times.append_curve(curve.begin, curve.length, curve.cap, bounds.first(curve.forward_count),
                           bounds.subspan(curve.forward_count, curve.backward_count));
        bound_ += curve.forward_count + std::size_t{curve.backward_count};
        break;
      }
      case RoundedPath::RoundedStep::Level: {
        const RoundedPath::LevelSpan& level = path_->levels_[level_++];
        times.append_level(level.length, level.cap);
        break;
      }
      case RoundedPath::RoundedStep::Track:
        if (path_->keeps_paths_) {
          times.append_track(path_->paths_[track_], path_->owners_[track_]);
        } else {
          times.append_track(path_->owners_[track_]);
        }
        ++track_;
        break;
      case RoundedPath::RoundedStep::Phase: {
        const RoundedPath::TimedPiece& timed = path_->phases_[phase_++];
        times.append_phase(timed.piece, timed.phase);
        break;
      }
      case RoundedPath::RoundedStep::EndPhases:
        times.end_phases();
        break;
      case RoundedPath::RoundedStep::EndElement:
        times.end_element();
        break;
      case RoundedPath::RoundedStep::Rest:
        times.come_to_rest(machine);
        break;
      case RoundedPath::RoundedStep::Wait:
        times.wait(path_->waits_[wait_++]);
        break;
    }
  }
}

}  // namespace isocnc::motion
