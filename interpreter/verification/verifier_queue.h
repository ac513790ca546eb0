#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "interpreter/verification/verifier.h"

namespace isocnc::verification {

/// How work is done while its caller goes on.
struct Alongside {
  std::function<void(std::function<void()> task)> start;  ///< One task after the other, in their order.
  std::function<void()> wait;                             ///< Returns when all have ended.
};

/// Passes what a run tells to a verifier, in its order, while the run goes on.
class VerifierQueue {
 public:
  /// Refers to the verifier. Without `alongside`, passes everything at once.
  explicit VerifierQueue(Verifier& verifier, Alongside alongside = {});

  /// Takes a stretch of motion, with its event.
  void take(const motion::Stretch& stretch, const timing::TimedEvent& event);
  /// Takes an event that has been made.
  void take(const timing::TimedEvent& event);
  /// Returns when the verifier has taken everything.
  void finish();

 private:
  enum class Kind : std::uint8_t { Stretch, End, Event };

  /// The end of a motion.
  struct EndOfMotion {
    removal::MotionFacts motion;
    double time = 0;
  };

  /// What waits, by its kind: most is stretches, and events take much memory.
  struct Delivery {
    std::vector<Kind> order;
    std::vector<motion::Stretch> stretches;
    std::vector<removal::MotionFacts> motions;  ///< Of the stretches.
    std::vector<EndOfMotion> ends;
    std::vector<timing::TimedEvent> events;
  };

  void pass(Delivery& delivery);
  void hand_over();

  Verifier& verifier_;
  Alongside alongside_;
  std::shared_ptr<Delivery> filling_ = std::make_shared<Delivery>();
  std::mutex mutex_;
  std::vector<std::shared_ptr<Delivery>> emptied_;  ///< Guarded by the mutex. They keep their memory.
};

}  // namespace isocnc::verification
