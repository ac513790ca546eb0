#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace isocnc::plot {

/// Numbers in as few bytes as they need: seven bits in each, the least first, the eighth set when more follow.
class PackedBytes {
 public:
  void put(std::uint64_t number);
  /// 0, -1, 1, -2, ... as 0, 1, 2, 3, ...
  void put_signed(std::int64_t number) {
    put((static_cast<std::uint64_t>(number) << 1) ^ (number < 0 ? ~std::uint64_t{0} : 0));
  }
  std::string_view bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// `value` in whole units of `unit`, the nearest, held to what a reader whose numbers are all floating can tell apart
/// when two of them are subtracted: 2^50 either way. What is no number is 0.
std::int64_t in_units(double value, double unit);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace isocnc::plot
