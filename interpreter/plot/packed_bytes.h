#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace isocnc::plot {

/// Numbers in a variable number of bytes: seven bits in each, the least significant first, with the eighth bit set if
/// more follow.
class PackedBytes {
 public:
  void put(std::uint64_t number);
  /// Writes 0, -1, 1, -2, ... as 0, 1, 2, 3, ...
  void put_signed(std::int64_t number) {
    put((static_cast<std::uint64_t>(number) << 1) ^ (number < 0 ? ~std::uint64_t{0} : 0));
  }
  std::string_view bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// The value rounded to whole multiples of `unit`, clamped to ±2^50, so that a reader with floating-point numbers only
/// can subtract two of them exactly. NaN gives 0.
std::int64_t in_units(double value, double unit);

/// Base64 of RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace isocnc::plot
