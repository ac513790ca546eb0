#pragma once

#include <cstddef>
#include <map>

namespace isocnc::removal {

/// Decides which of many findings are kept, so that memory does not grow with a program that repeats a mistake: the
/// first ones of all, and then of each mistake the first ones. A mistake that is new is never lost behind others.
template <class Mistake>
class KeptRepeats {
 public:
  /// Whether one more is kept.
  bool keeps(const Mistake& mistake) {
    std::size_t& kept = kept_[mistake];
    if (all_ >= kMaxOfAll && kept >= kMaxOfMistake) {
      ++left_out_;
      return false;
    }
    ++all_;
    ++kept;
    return true;
  }
  std::size_t left_out() const { return left_out_; }

 private:
  static constexpr std::size_t kMaxOfAll = 10'000;
  static constexpr std::size_t kMaxOfMistake = 100;

  std::map<Mistake, std::size_t> kept_;  // By the mistake.
  std::size_t all_ = 0;
  std::size_t left_out_ = 0;
};

}  // namespace isocnc::removal
