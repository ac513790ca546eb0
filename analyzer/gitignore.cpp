#include "analyzer/gitignore.h"

#include <algorithm>
#include <bitset>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace isocnc::analyzer {

namespace fs = std::filesystem;

namespace {

using ByteSet = std::bitset<256>;

/// A piece of a pattern.
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

struct Rule {
  std::vector<Piece> pattern;
  bool includes = false;          ///< `!pattern`
  bool only_directories = false;  ///< `pattern/`
  bool whole_path = false;        ///< Of the path below the file of rules; else of its last name alone.
};

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

ByteSet only(char c) { return ByteSet{}.set(index(c)); }

/// Reads a pattern from left to right. A malformed one, which names nothing, gives no pieces at all.
class PatternReader {
 public:
  explicit PatternReader(std::string_view text) : text_(text) {}

  std::optional<std::vector<Piece>> read(bool whole_path) {
    std::vector<Piece> pieces;
    while (!at_end()) {
      const std::optional<Piece> piece = read_piece(whole_path);
      if (!piece) return std::nullopt;
      pieces.push_back(*piece);
    }
    return pieces;
  }

 private:
  bool at_end() const { return at_ == text_.size(); }
  bool sees(char c) const { return !at_end() && text_[at_] == c; }
  char take() { return text_[at_++]; }
  bool take_if(char c) {
    if (!sees(c)) return false;
    ++at_;
    return true;
  }

  std::optional<Piece> read_piece(bool whole_path) {
    if (sees('*')) return Piece{read_stars(whole_path), {}};
    if (take_if('?')) return Piece{Piece::Kind::Byte, ~only('/')};
    const std::optional<ByteSet> bytes = take_if('[') ? read_set() : read_byte();
    if (!bytes) return std::nullopt;
    return Piece{Piece::Kind::Byte, *bytes};
  }

  Piece::Kind read_stars(bool whole_path) {
    const bool starts_name = at_ == 0 || text_[at_ - 1] == '/';
    const std::size_t begin = at_;
    while (take_if('*')) {
    }
    if (!whole_path || at_ - begin < 2 || !starts_name) return Piece::Kind::Star;
    if (at_end()) return Piece::Kind::Everything;
    return take_if('/') ? Piece::Kind::Directories : Piece::Kind::Star;
  }

  /// Byte or escaped byte; none when nothing follows the backslash.
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

  /// What stands between brackets. A closing one that comes first belongs to the set.
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

  /// As in git, the first is in it even when the last comes before it.
  static ByteSet range(char first, char last) {
    ByteSet set = only(first);
    for (std::size_t c = index(first); c <= index(last); ++c) set.set(c);
    return set;
  }

  /// Of `[:name:]`.
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

/// Tries a pattern on a text. A star first stands for nothing and takes more only when the rest does not fit; it is the
/// last star that takes more, since whatever an earlier one could take, the later one can take as well.
class Match {
 public:
  Match(const std::vector<Piece>& pattern, std::string_view text) : pattern_(pattern), text_(text) {}

  bool found() {
    while (piece_ < pattern_.size() || at_ < text_.size()) {
      if (piece_ < pattern_.size() && pattern_[piece_].kind == Piece::Kind::Everything) return true;
      if (!step() && !lengthen_star() && !lengthen_directories()) return false;
    }
    return true;
  }

 private:
  /// Where to go on when a star has taken all up to `at`.
  struct Resume {
    std::size_t piece = 0;
    std::size_t at = 0;
  };

  bool step() {
    if (piece_ == pattern_.size()) return false;
    const Piece& piece = pattern_[piece_];
    if (piece.kind == Piece::Kind::Byte) {
      if (at_ == text_.size() || !piece.bytes[index(text_[at_])]) return false;
      ++at_;
      ++piece_;
      return true;
    }
    ++piece_;
    if (piece.kind == Piece::Kind::Directories) {
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

  const std::vector<Piece>& pattern_;
  std::string_view text_;
  std::size_t piece_ = 0;
  std::size_t at_ = 0;
  std::optional<Resume> star_;
  std::optional<Resume> directories_;
};

}  // namespace

/// The rules of one file.
struct GitIgnore::Rules {
  std::string prefix;  // The file's directory and a slash.
  std::vector<Rule> rules;
  std::shared_ptr<const Rules> outer;

  /// Whether `path` is ignored, where these rules say anything of it: the last one that names it decides.
  std::optional<bool> verdict(std::string_view path, bool is_directory) const;
};

std::optional<bool> GitIgnore::Rules::verdict(std::string_view path, bool is_directory) const {
  if (!path.starts_with(prefix)) return std::nullopt;
  const std::string_view below = path.substr(prefix.size());
  const std::string_view name = path.substr(path.rfind('/') + 1);
  for (auto rule = rules.rbegin(); rule != rules.rend(); ++rule) {
    if (rule->only_directories && !is_directory) continue;
    if (Match(rule->pattern, rule->whole_path ? below : name).found()) return !rule->includes;
  }
  return std::nullopt;
}

/// Blanks at the end do not count, but for those behind a backslash.
static std::string_view without_trailing_blanks(std::string_view line) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == ' ') continue;
    if (line[i] == '\\') ++i;
    end = std::min(i + 1, line.size());
  }
  return line.substr(0, end);
}

/// None for blank lines, comments and patterns that name nothing.
static std::optional<Rule> parse_rule(std::string_view line) {
  if (line.starts_with('#')) return std::nullopt;
  if (line.ends_with('\r')) line.remove_suffix(1);
  line = without_trailing_blanks(line);
  Rule rule;
  rule.includes = line.starts_with('!');
  if (rule.includes) line.remove_prefix(1);
  rule.only_directories = line.ends_with('/');
  if (rule.only_directories) line.remove_suffix(1);
  rule.whole_path = line.find('/') != std::string_view::npos;
  if (line.starts_with('/')) line.remove_prefix(1);
  if (line.empty()) return std::nullopt;
  std::optional<std::vector<Piece>> pattern = PatternReader(line).read(rule.whole_path);
  if (!pattern) return std::nullopt;
  rule.pattern = std::move(*pattern);
  return rule;
}

static std::vector<Rule> parse_rules(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<Rule> rules;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (std::optional<Rule> rule = parse_rule(text.substr(0, end))) rules.push_back(std::move(*rule));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return rules;
}

/// Empty when it cannot be read, as for git.
static std::string contents(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return {};
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

static bool starts_work_tree(const fs::path& directory) {
  std::error_code error;
  return fs::exists(fs::symlink_status(directory / ".git", error));
}

/// What a file of one line says behind `key`.
static std::string value_in(const fs::path& file, std::string_view key) {
  const std::string text = contents(file);
  if (!text.starts_with(key)) return {};
  return text.substr(key.size(), text.find_first_of("\r\n") - key.size());
}

/// The directory in which git keeps what holds for the whole repository: the work tree's `.git`, unless that is a file,
/// which a submodule and a linked work tree have in its place.
static fs::path git_directory(const fs::path& work_tree) {
  const std::string elsewhere = value_in(work_tree / ".git", "gitdir: ");
  if (elsewhere.empty()) return work_tree / ".git";
  const fs::path git = work_tree / elsewhere;
  return git / value_in(git / "commondir", "");
}

GitIgnore GitIgnore::at(const fs::path& directory) {
  std::vector<fs::path> downward{directory};
  while (!starts_work_tree(downward.back())) {
    if (!downward.back().has_relative_path()) return {};
    downward.push_back(downward.back().parent_path());
  }
  std::reverse(downward.begin(), downward.end());
  GitIgnore rules;
  for (const fs::path& step : downward) rules = rules.entering(step);
  return rules;
}

/// Git does not follow a .gitignore that is a symlink.
GitIgnore GitIgnore::entering(const fs::path& directory) const {
  GitIgnore rules = *this;
  if (starts_work_tree(directory)) {
    rules = GitIgnore{}.with(contents(git_directory(directory) / "info" / "exclude"), directory);
  }
  const fs::path file = directory / ".gitignore";
  std::error_code error;
  if (!rules.innermost_ || !fs::is_regular_file(fs::symlink_status(file, error))) return rules;
  return rules.with(contents(file), directory);
}

GitIgnore GitIgnore::with(std::string_view text, const fs::path& directory) const {
  GitIgnore rules;
  rules.innermost_ = std::make_shared<const Rules>(Rules{(directory / "").native(), parse_rules(text), innermost_});
  return rules;
}

bool GitIgnore::ignores(const fs::path& path, bool is_directory) const {
  for (const Rules* rules = innermost_.get(); rules; rules = rules->outer.get())
    if (const std::optional<bool> verdict = rules->verdict(path.native(), is_directory)) return *verdict;
  return false;
}

}  // namespace isocnc::analyzer
