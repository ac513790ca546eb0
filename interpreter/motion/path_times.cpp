#include "interpreter/motion/path_times.h"

namespace isocnc::motion {

/// Number of returned tracks that triggers their removal.
static constexpr std::size_t kForgotten = 256;

PathTimes::PathTimes(const kinematics::Machine& machine) {
  if (kinematics::limits_jerk(machine)) jerk_limiter_.emplace();
}

void PathTimes::append_phase(const Piece& piece, const Phase& phase) {
  if (jerk_limiter_) return jerk_limiter_->append_phase(piece, phase);
  profile_.append_phase(piece.length, phase);
  tracks_.emplace_back(piece.path, TrackOwner{.tag = piece.tag, .ends_move = piece.ends_move});
}

void PathTimes::come_to_rest(const kinematics::Machine& machine) {
  profile_.come_to_rest();
  if (jerk_limiter_) jerk_limiter_->come_to_rest(machine);
}

void PathTimes::wait(double seconds) {
  profile_.wait(seconds);
  if (jerk_limiter_) jerk_limiter_->wait(seconds);
}

/// Frees the memory of stretches that are handed out, where that is worth its cost.
void PathTimes::forget_some() {
  if (profile_.holds_much_past()) profile_.forget_handed_out();
  if (handed_out_ >= kForgotten || handed_out_ == tracks_.size()) forget_tracks();
}

void PathTimes::forget_handed_out() {
  profile_.forget_handed_out();
  forget_tracks();
  if (jerk_limiter_) jerk_limiter_->forget_handed_out();
}

void PathTimes::forget_tracks() {
  tracks_.erase(tracks_.begin(), tracks_.begin() + static_cast<std::ptrdiff_t>(handed_out_));
  handed_out_ = 0;
}

/// Reduces the stretch of a blend to the half of one move: the first half belongs to the move before, the second to the
/// next.
static void keep_half(Stretch& stretch, bool second) {
  Phase& phase = stretch.phases[0];
  stretch.duration = phase.duration /= 2;
  if (!second) return;
  stretch.start += phase.duration;
  phase.from += phase.duration * phase.speed;
}

/// Appends a span's phases to a stretch, if the stretch can hold them. Two phases of constant speed are merged.
static bool extend(Stretch& stretch, const Profile::SpeedSpan& span) {
  const auto count = static_cast<std::size_t>(stretch.phase_count);
  const bool continues = count > 0 && span.phase_count > 0 && stretch.phases[count - 1].acceleration == 0 &&
                         span.phases[0].acceleration == 0;
  if (count + span.phase_count - (continues ? 1 : 0) > stretch.phases.size()) return false;
  if (continues) stretch.phases[count - 1].duration += span.phases[0].duration;
  for (std::size_t i = continues ? 1 : 0; i < span.phase_count; ++i)
    stretch.phases[static_cast<std::size_t>(stretch.phase_count++)] = span.phases[i];
  stretch.duration += span.duration;
  return true;
}

/// Returns a stretch with as many spans of a track as it can hold, or null while any of these is not planned. So the
/// choice of spans does not depend on when next() is called.
const Stretch* PathTimes::next() {
  if (jerk_limiter_) return jerk_limiter_->next();
  const Profile::SpeedSpan* span = profile_.front();
  if (!span) return nullptr;
  const Track& track = tracks_[handed_out_];
  const int left = track.owner.span_count - spans_out_;
  stretch_.phase_count = 0;
  stretch_.start = span->start;
  stretch_.duration = 0;
  int count = 0;
  for (; count < left; ++count) {
    span = profile_.front(static_cast<std::size_t>(count));
    if (!span) return nullptr;
    if (!extend(stretch_, *span)) break;
  }
  stretch_.tag = track.owner.tag;
  stretch_.ends_move = track.owner.ends_move && count == left;
  if (!half_out_) stretch_.path = track.path;
  if (track.owner.is_shared) {
    keep_half(stretch_, half_out_);
    if (half_out_) stretch_.tag = track.owner.next_tag;
    if (half_out_) stretch_.ends_move = false;
    half_out_ = !half_out_;
  }
  if (!half_out_) hand_out(count);
  return &stretch_;
}

void PathTimes::hand_out(int spans) {
  profile_.pop(static_cast<std::size_t>(spans));
  spans_out_ += spans;
  if (spans_out_ < tracks_[handed_out_].owner.span_count) return;
  spans_out_ = 0;
  ++handed_out_;
}

}  // namespace isocnc::motion
