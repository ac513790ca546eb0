#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace isocnc::support {

/// The splitmix64 generator: a seed gives the same numbers on every machine, so that a failure that names its seed can
/// be run again anywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t mixed = state_ += 0x9E3779B97F4A7C15u;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    return mixed ^ (mixed >> 31);
  }

  /// A number in [low, high].
  int between(int low, int high) {
    return low + static_cast<int>(next() % (static_cast<std::uint64_t>(high - low) + 1));
  }
  /// A number less than `size`, which is not 0.
  std::size_t below(std::size_t size) { return static_cast<std::size_t>(next() % size); }
  /// A number in [low, high).
  double real(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }
  bool one_in(int chances) { return between(1, chances) == 1; }
  char any_of(std::string_view characters) { return characters[below(characters.size())]; }
  std::string_view any_of(std::initializer_list<std::string_view> choices) {
    return choices.begin()[below(choices.size())];
  }

 private:
  std::uint64_t state_;
};

/// Whether properties run in full. Only then do tests check what only many programs show (that a limit is reached).
inline constexpr bool kTriesAll = ISOCNC_RUNS_FAST;

/// The number of tries: `count` in optimized builds, a quarter of it with sanitizers or without optimization.
inline constexpr std::uint64_t often(std::uint64_t count) { return kTriesAll ? count : (count + 3) / 4; }

/// The seeds of a property, often(count) of them, from 1. Failure messages name them.
inline std::vector<std::uint64_t> seeds(std::uint64_t count) {
  std::vector<std::uint64_t> all(often(count));
  for (std::uint64_t i = 0; i < all.size(); ++i) all[i] = i + 1;
  return all;
}

}  // namespace isocnc::support
