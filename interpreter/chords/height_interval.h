#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace isocnc::chords {

/// A piece of a vertical line, mm in the workpiece frame. Empty unless `bottom` is below `top`.
struct HeightInterval {
  double bottom = std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();

  bool is_empty() const { return !(bottom < top); }
  double length() const { return is_empty() ? 0 : top - bottom; }
  /// Extends the interval so that it holds `other` as well, and all between.
  void include(const HeightInterval& other) {
    if (other.bottom < bottom) bottom = other.bottom;
    if (other.top > top) top = other.top;
  }
  void include(double z) { include({z, z}); }
  /// Leaves what `other` has, too.
  void clip(const HeightInterval& other) {
    if (other.bottom > bottom) bottom = other.bottom;
    if (other.top < top) top = other.top;
  }
};

/// The nearest float that is not below `value`: a cut that is rounded so leaves too much rather than too little.
inline float rounded_up(double value) {
  const auto near = static_cast<float>(value);
  if (!(near < value)) return near;
  if (near == 0) return std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<std::uint32_t>(near);
  return std::bit_cast<float>(near > 0 ? bits + 1 : bits - 1);
}

/// The nearest float that is not above `value`.
inline float rounded_down(double value) { return -rounded_up(-value); }

}  // namespace isocnc::chords
