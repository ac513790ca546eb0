#include "interpreter/verification/verifier_queue.h"

#include <utility>

namespace isocnc::verification {

/// What is passed at once: an eighth of what is cut at once, so that the run often sees whether there is something to
/// help with.
static constexpr std::size_t kMostWaiting = 512;

VerifierQueue::VerifierQueue(Verifier& verifier, Alongside alongside)
    : verifier_(verifier), alongside_(std::move(alongside)) {}

void VerifierQueue::take(const motion::Stretch& stretch, const timing::TimedEvent& event) {
  const removal::MotionFacts motion(event);
  if (!alongside_.start) return verifier_.take(stretch, motion);
  filling_->order.push_back(Kind::Stretch);
  filling_->stretches.push_back(stretch);
  filling_->motions.push_back(motion);
  if (filling_->stretches.size() == kMostWaiting) hand_over();
}

void VerifierQueue::take(const timing::TimedEvent& event) {
  if (!alongside_.start) return verifier_.take(event);
  if (std::holds_alternative<running::MoveEvent>(event.event.what) && event.is_at_known_place()) {
    filling_->order.push_back(Kind::End);
    filling_->ends.push_back({removal::MotionFacts(event), event.start + event.duration});
  } else {
    filling_->order.push_back(Kind::Event);
    filling_->events.push_back(event);
  }
  if (filling_->order.size() >= 4 * kMostWaiting) hand_over();
}

void VerifierQueue::finish() {
  if (!alongside_.start) return;
  hand_over();
  alongside_.wait();
}

void VerifierQueue::hand_over() {
  std::shared_ptr<Delivery> next;
  {
    const std::lock_guard lock(mutex_);
    if (!emptied_.empty()) {
      next = std::move(emptied_.back());
      emptied_.pop_back();
    }
  }
  if (!next) next = std::make_shared<Delivery>();
  const std::shared_ptr<Delivery> full = std::exchange(filling_, std::move(next));
  alongside_.start([this, full] {
    pass(*full);
    const std::lock_guard lock(mutex_);
    emptied_.push_back(full);
  });
}

void VerifierQueue::pass(Delivery& delivery) {
  std::size_t stretch = 0;
  std::size_t end = 0;
  std::size_t event = 0;
  for (const Kind kind : delivery.order) {
    switch (kind) {
      case Kind::Stretch:
        verifier_.take(delivery.stretches[stretch], delivery.motions[stretch]);
        ++stretch;
        break;
      case Kind::End:
        verifier_.take_end(delivery.ends[end].motion, delivery.ends[end].time);
        ++end;
        break;
      case Kind::Event:
        verifier_.take(delivery.events[event++]);
        break;
    }
  }
  delivery.order.clear();
  delivery.stretches.clear();
  delivery.motions.clear();
  delivery.ends.clear();
  delivery.events.clear();
}

}  // namespace isocnc::verification
