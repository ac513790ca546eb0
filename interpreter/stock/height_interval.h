#pragma once

#include <cmath>
#include <limits>

namespace isocnc::stock {

/// A piece of a vertical line, mm in the workpiece frame. Empty unless `bottom` is below `top`.
struct HeightInterval {
  double bottom = std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();

  bool is_empty() const { return !(bottom < top); }
  double length() const { return is_empty() ? 0 : top - bottom; }
  /// Extends the interval so that it holds `other` as well, and all between.
  void include(const HeightInterval& other) {
    bottom = std::fmin(bottom, other.bottom);
    top = std::fmax(top, other.top);
  }
  void include(double z) { include({z, z}); }
  /// Leaves what `other` has, too.
  void clip(const HeightInterval& other) {
    bottom = std::fmax(bottom, other.bottom);
    top = std::fmin(top, other.top);
  }
};

/// The nearest float that is not below `value`: a cut that is rounded so leaves too much rather than too little.
inline float rounded_up(double value) {
  const auto near = static_cast<float>(value);
  return near < value ? std::nextafter(near, std::numeric_limits<float>::infinity()) : near;
}

/// The nearest float that is not above `value`.
inline float rounded_down(double value) { return -rounded_up(-value); }

}  // namespace isocnc::stock
