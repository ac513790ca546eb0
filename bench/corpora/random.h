#pragma once

#include <cstdint>

namespace isocnc::bench {

/// The splitmix64 generator: the same numbers from the same seed on every machine, which the standard library's
/// distributions do not promise.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// Another sequence, which may be drawn from without changing what this one gives later.
  Random split() { return Random(next()); }

  /// In [low, high], both included.
  int between(int low, int high) {
    return low + static_cast<int>(next() % (static_cast<std::uint64_t>(high - low) + 1));
  }

  bool one_in(int chances) { return between(1, chances) == 1; }

  /// As `between`, but never 0: a step that does move.
  int step(int low, int high) {
    const int value = between(low, high);
    return value != 0 ? value : high;
  }

 private:
  std::uint64_t next() {
    std::uint64_t mixed = state_ += 0x9E3779B97F4A7C15u;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    return mixed ^ (mixed >> 31);
  }

  std::uint64_t state_;
};

}  // namespace isocnc::bench
