#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace isocnc::system {

/// A pattern of file names as gitignore(5) has them: `*` is any characters but slashes, `?` is one, `[a-z]` is one of a
/// set; a backslash takes the character behind it as it is. In patterns of whole paths `**/` is any folders, also none,
/// and `/**` at the end whatever follows.
class Glob {
 public:
  /// None when the pattern is malformed, so that it could name nothing.
  static std::optional<Glob> parse(std::string_view pattern, bool whole_path);

  bool matches(std::string_view text) const;

 private:
  friend class GlobReader;
  friend class GlobMatch;

  using ByteSet = std::bitset<256>;

  struct Piece {
    enum class Kind : std::uint8_t {
      Byte,         ///< `bytes`: one of them.
      Star,         ///< `*`: any bytes but slashes.
      Directories,  ///< `**/`: any number of whole directories, also none.
      Everything,   ///< `/**` at the end: whatever follows.
    };

    Kind kind = Kind::Byte;
    ByteSet bytes;
  };

  std::vector<Piece> pieces_;
};

}  // namespace isocnc::system
