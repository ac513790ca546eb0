#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace isocnc::system {

/// A pattern of file names as in gitignore(5): `*` matches any characters but slashes, `?` one character, `[a-z]` one
/// of a set; a backslash makes the next character literal. In patterns of whole paths `**/` matches any number of
/// folders, including none, and `/**` at the end any rest.
class Glob {
 public:
  /// Returns none if the pattern is malformed and could match nothing.
  static std::optional<Glob> parse(std::string_view pattern, bool whole_path);

  bool matches(std::string_view text) const;

 private:
  friend class GlobReader;
  friend class GlobMatch;

  using ByteSet = std::bitset<256>;

  struct GlobPiece {
    enum class Kind : std::uint8_t {
      Byte,         ///< One of `bytes`.
      Star,         ///< `*`: any bytes but slashes.
      Directories,  ///< `**/`: any number of whole directories, including none.
      Everything,   ///< `/**` at the end: any rest.
    };

    Kind kind = Kind::Byte;
    ByteSet bytes;
  };

  std::vector<GlobPiece> pieces_;
};

}  // namespace isocnc::system
