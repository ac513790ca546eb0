#include "interpreter/system/glob.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace isocnc::system {

namespace {

struct CharacterClass {
  std::string_view name;
  int (*contains)(int);
};
constexpr CharacterClass kCharacterClasses[] = {
    {"alnum", ::isalnum}, {"alpha", ::isalpha}, {"blank", ::isblank}, {"cntrl", ::iscntrl},
    {"digit", ::isdigit}, {"graph", ::isgraph}, {"lower", ::islower}, {"print", ::isprint},
    {"punct", ::ispunct}, {"space", ::isspace}, {"upper", ::isupper}, {"xdigit", ::isxdigit},
};

std::size_t index(char c) { return static_cast<unsigned char>(c); }

}  // namespace

/// Reads a pattern from left to right. A malformed pattern, which matches nothing, gives no pieces.
class GlobReader {
  using ByteSet = Glob::ByteSet;
  using GlobPiece = Glob::GlobPiece;

 public:
  explicit GlobReader(std::string_view text) : text_(text) {}

  std::optional<std::vector<GlobPiece>> read(bool whole_path) {
    std::vector<GlobPiece> pieces;
    while (!at_end()) {
      const std::optional<GlobPiece> piece = read_piece(whole_path);
      if (!piece) return std::nullopt;
      pieces.push_back(*piece);
    }
    return pieces;
  }

 private:
  bool at_end() const { return at_ == text_.size(); }
  bool sees(char c) const { return !at_end() && text_[at_] == c; }
  char take() { return text_[at_++]; }
  static ByteSet only(char c) { return ByteSet{}.set(index(c)); }
  bool take_if(char c) {
    if (!sees(c)) return false;
    ++at_;
    return true;
  }

  std::optional<GlobPiece> read_piece(bool whole_path) {
    if (sees('*')) return GlobPiece{read_stars(whole_path), {}};
    if (take_if('?')) return GlobPiece{GlobPiece::Kind::Byte, ~only('/')};
    const std::optional<ByteSet> bytes = take_if('[') ? read_set() : read_byte();
    if (!bytes) return std::nullopt;
    return GlobPiece{GlobPiece::Kind::Byte, *bytes};
  }

  GlobPiece::Kind read_stars(bool whole_path) {
    const bool starts_name = at_ == 0 || text_[at_ - 1] == '/';
    const std::size_t begin = at_;
    while (take_if('*')) {
    }
    if (!whole_path || at_ - begin < 2 || !starts_name) return GlobPiece::Kind::Star;
    if (at_end()) return GlobPiece::Kind::Everything;
    return take_if('/') ? GlobPiece::Kind::Directories : GlobPiece::Kind::Star;
  }

  /// Reads a byte or escaped byte; none if nothing follows the backslash.
  std::optional<char> read_character() {
    take_if('\\');
    if (at_end()) return std::nullopt;
    return take();
  }

  std::optional<ByteSet> read_byte() {
    const std::optional<char> c = read_character();
    if (!c) return std::nullopt;
    return only(*c);
  }

  /// Reads the set between brackets. A closing bracket in first place belongs to the set.
  std::optional<ByteSet> read_set() {
    const bool negated = take_if('!') || take_if('^');
    ByteSet set;
    do {
      const std::optional<ByteSet> member = read_member();
      if (!member) return std::nullopt;
      set |= *member;
    } while (!sees(']'));
    take();
    if (negated) set.flip();
    return set & ~only('/');
  }

  std::optional<ByteSet> read_member() {
    if (at_end()) return std::nullopt;
    if (const std::optional<std::string_view> name = take_class_name()) return class_named(*name);
    const std::optional<char> first = read_character();
    if (!first) return std::nullopt;
    const bool is_range = sees('-') && at_ + 1 < text_.size() && text_[at_ + 1] != ']';
    if (!is_range) return only(*first);
    take();
    const std::optional<char> last = read_character();
    if (!last) return std::nullopt;
    return range(*first, *last);
  }

  /// As in git, the first byte belongs to the range even if the last comes before it.
  static ByteSet range(char first, char last) {
    ByteSet set = only(first);
    for (std::size_t c = index(first); c <= index(last); ++c) set.set(c);
    return set;
  }

  /// Reads the name in `[:name:]`.
  std::optional<std::string_view> take_class_name() {
    const std::string_view rest = text_.substr(at_);
    if (!rest.starts_with("[:")) return std::nullopt;
    const std::size_t end = rest.find(']', 2);
    if (end == std::string_view::npos || end < 3 || rest[end - 1] != ':') return std::nullopt;
    at_ += end + 1;
    return rest.substr(2, end - 3);
  }

  static std::optional<ByteSet> class_named(std::string_view name) {
    const auto* const found = std::find_if(std::begin(kCharacterClasses), std::end(kCharacterClasses),
                                           [&](const CharacterClass& c) { return c.name == name; });
    if (found == std::end(kCharacterClasses)) return std::nullopt;
    ByteSet set;
    for (int c = 0; c < 0x80; ++c) set.set(static_cast<std::size_t>(c), found->contains(c) != 0);
    return set;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Matches a pattern with a text. A star first matches nothing and extends only when the rest does not fit. Only the
/// last star extends, since it can match everything that an earlier one could.
class GlobMatch {
  using GlobPiece = Glob::GlobPiece;

 public:
  GlobMatch(const std::vector<GlobPiece>& pattern, std::string_view text) : pattern_(pattern), text_(text) {}

  bool found() {
    while (piece_ < pattern_.size() || at_ < text_.size()) {
      if (piece_ < pattern_.size() && pattern_[piece_].kind == GlobPiece::Kind::Everything) return true;
      if (!step() && !lengthen_star() && !lengthen_directories()) return false;
    }
    return true;
  }

 private:
  /// The point to resume at when a star has matched everything up to `at`.
  struct Resume {
    std::size_t piece = 0;
    std::size_t at = 0;
  };

  bool step() {
    if (piece_ == pattern_.size()) return false;
    const GlobPiece& piece = pattern_[piece_];
    if (piece.kind == GlobPiece::Kind::Byte) {
      if (at_ == text_.size() || !piece.bytes[index(text_[at_])]) return false;
      ++at_;
      ++piece_;
      return true;
    }
    ++piece_;
    if (piece.kind == GlobPiece::Kind::Directories) {
      directories_ = {piece_, at_};
      star_.reset();
    } else {
      star_ = {piece_, at_};
    }
    return true;
  }

  bool lengthen_star() {
    if (!star_ || star_->at == text_.size() || text_[star_->at] == '/') return false;
    ++star_->at;
    return resume(*star_);
  }

  bool lengthen_directories() {
    if (!directories_) return false;
    const std::size_t slash = text_.find('/', directories_->at);
    if (slash == std::string_view::npos) return false;
    directories_->at = slash + 1;
    star_.reset();
    return resume(*directories_);
  }

  bool resume(Resume from) {
    piece_ = from.piece;
    at_ = from.at;
    return true;
  }

  const std::vector<GlobPiece>& pattern_;
  std::string_view text_;
  std::size_t piece_ = 0;
  std::size_t at_ = 0;
  std::optional<Resume> star_;
  std::optional<Resume> directories_;
};

std::optional<Glob> Glob::parse(std::string_view pattern, bool whole_path) {
  std::optional<std::vector<GlobPiece>> pieces = GlobReader(pattern).read(whole_path);
  if (!pieces) return std::nullopt;
  Glob glob;
  glob.pieces_ = std::move(*pieces);
  return glob;
}

bool Glob::matches(std::string_view text) const { return GlobMatch(pieces_, text).found(); }

}  // namespace isocnc::system
