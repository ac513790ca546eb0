#include "interpreter/motion/path_times.h"

#include <tuple>

namespace isocnc::motion {

/// Number of returned tracks that triggers their removal.
static constexpr std::size_t kForgotten = 256;

PathTimes::PathTimes(const kinematics::Machine& machine, bool keeps_paths) : keeps_paths_(keeps_paths) {
  if (kinematics::limits_jerk(machine)) jerk_limiter_.emplace();
}

void PathTimes::append_phase(const Piece& piece, const Phase& phase) {
  if (jerk_limiter_) return jerk_limiter_->append_phase(piece, phase);
  profile_.append_phase(piece.length, phase);
  append_track(piece.path, {.tag = piece.tag, .ends_move = piece.ends_move});
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
  const auto past = static_cast<std::ptrdiff_t>(handed_out_);
  tracks_.erase(tracks_.begin(), tracks_.begin() + past);
  if (keeps_paths_) paths_.erase(paths_.begin(), paths_.begin() + past);
  handed_out_ = 0;
}

/// Reduces the phase of a blend to the half of one move: the first half belongs to the move before, the second to the
/// next.
static void keep_half(Stretch& stretch, bool is_second) {
  Phase& phase = stretch.phases[0];
  phase.duration /= 2;
  if (!is_second) return;
  stretch.start += phase.duration;
  phase.from += phase.duration * phase.speed;
}

namespace {

/// Counts the phases of a stretch. Two phases of constant speed in a row are one.
class PhaseCounter {
 public:
  /// Whether the first phase of a span continues the last one.
  bool continues(const Profile::SpeedSpan& span) const {
    return is_level_ && span.phase_count > 0 && span.phases[0].acceleration == 0;
  }

  /// Adds the phases of a span, if the stretch can hold them.
  bool take(const Profile::SpeedSpan& span) {
    const std::size_t count = count_ + span.phase_count - (continues(span) ? 1 : 0);
    if (count > std::tuple_size_v<decltype(Stretch::phases)>) return false;
    count_ = count;
    if (span.phase_count > 0) is_level_ = span.phases[span.phase_count - std::size_t{1}].acceleration == 0;
    return true;
  }

 private:
  std::size_t count_ = 0;
  bool is_level_ = false;  ///< Whether the last phase has constant speed.
};

}  // namespace

/// Chooses as many spans of a track as a stretch can hold, or returns false while any of these is not planned. So the
/// choice of spans does not depend on when it is asked for. `on_span` is called for each, with whether its first phase
/// continues the last one. A blend that two moves share gives each of them a half.
template <class OnSpan>
bool PathTimes::choose_next(StretchTime& time, const OnSpan& on_span) {
  if (!profile_.front()) return false;
  const TrackOwner& owner = tracks_[handed_out_];
  const int left = owner.span_count - spans_out_;
  time.duration = 0;
  PhaseCounter phases;
  int count = 0;
  for (; count < left; ++count) {
    const Profile::SpeedSpan* const span = profile_.front(static_cast<std::size_t>(count));
    if (!span) return false;
    const bool continues = phases.continues(*span);
    if (!phases.take(*span)) break;
    time.duration += span->duration;
    on_span(*span, continues);
  }
  time.tag = half_out_ ? owner.next_tag : owner.tag;
  time.ends_move = !half_out_ && owner.ends_move && count == left;
  if (owner.is_shared) {
    time.duration /= 2;
    half_out_ = !half_out_;
  }
  if (!half_out_) hand_out(count);
  return true;
}

const StretchTime* PathTimes::next_time() {
  if (jerk_limiter_) return jerk_limiter_->next();
  return choose_next(stretch_, [](const Profile::SpeedSpan&, bool) {}) ? &stretch_ : nullptr;
}

const Stretch* PathTimes::next() {
  if (jerk_limiter_) return jerk_limiter_->next();
  const std::size_t track = handed_out_;
  const bool is_second_half = half_out_;
  if (const Profile::SpeedSpan* const first = profile_.front()) stretch_.start = first->start;
  stretch_.phase_count = 0;
  const auto append_phases = [&](const Profile::SpeedSpan& span, bool continues) {
    auto count = static_cast<std::size_t>(stretch_.phase_count);
    if (continues) stretch_.phases[count - 1].duration += span.phases[0].duration;
    for (std::size_t i = continues ? 1 : 0; i < span.phase_count; ++i) stretch_.phases[count++] = span.phases[i];
    stretch_.phase_count = static_cast<int>(count);
  };
  if (!choose_next(stretch_, append_phases)) return nullptr;
  if (!is_second_half) stretch_.path = paths_[track];
  if (tracks_[track].is_shared) keep_half(stretch_, is_second_half);
  return &stretch_;
}

void PathTimes::hand_out(int spans) {
  profile_.pop(static_cast<std::size_t>(spans));
  spans_out_ += spans;
  if (spans_out_ < tracks_[handed_out_].span_count) return;
  spans_out_ = 0;
  ++handed_out_;
}

}  // namespace isocnc::motion
