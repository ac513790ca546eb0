#include "interpreter/verification/verifier_queue.h"

#include <utility>

namespace isocnc::verification {

/// What waits at most: about as much as is cut at once, so that each task cuts.
static constexpr std::size_t kMostWaiting = 4096;

VerifierQueue::VerifierQueue(Verifier& verifier, Alongside alongside)
    : verifier_(verifier), alongside_(std::move(alongside)) {}

void VerifierQueue::take(const motion::Stretch& stretch, const simulation::TimedEvent& event) {
  const removal::MotionFacts motion(event);
  if (!alongside_.start) return verifier_.take(stretch, motion);
  filling_.order.push_back(Kind::Stretch);
  filling_.stretches.push_back(stretch);
  filling_.motions.push_back(motion);
  if (filling_.stretches.size() == kMostWaiting) hand_over();
}

void VerifierQueue::take(const simulation::TimedEvent& event) {
  if (!alongside_.start) return verifier_.take(event);
  if (std::holds_alternative<running::MoveEvent>(event.event.what) && event.is_at_known_place()) {
    filling_.order.push_back(Kind::End);
    filling_.ends.push_back({removal::MotionFacts(event), event.start + event.duration});
  } else {
    filling_.order.push_back(Kind::Event);
    filling_.events.push_back(event);
  }
  if (filling_.order.size() >= 4 * kMostWaiting) hand_over();
}

void VerifierQueue::finish() {
  if (!alongside_.start) return;
  hand_over();
  alongside_.wait();
}

void VerifierQueue::hand_over() {
  alongside_.wait();
  std::swap(filling_, passing_);
  alongside_.start([this] { pass(passing_); });
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
