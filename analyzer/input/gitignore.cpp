#include "analyzer/input/gitignore.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "interpreter/system/glob.h"
#include "interpreter/system/paths.h"

namespace isocnc::input {

namespace fs = std::filesystem;

namespace {

struct IgnoreRule {
  system::Glob pattern;
  bool includes = false;          ///< `!pattern`
  bool only_directories = false;  ///< `pattern/`
  bool whole_path = false;        ///< Whether it matches the path below the rules' directory, not the last name alone.
};

}  // namespace

/// The rules of one file.
struct GitIgnore::IgnoreRules {
  std::string prefix;  // The file's directory with a trailing slash.
  std::vector<IgnoreRule> rules;
  std::shared_ptr<const IgnoreRules> outer;

  /// Whether `path` is ignored; nothing if no rule matches it. The last rule that matches decides.
  std::optional<bool> ignored_state(std::string_view path, bool is_directory) const;
};

std::optional<bool> GitIgnore::IgnoreRules::ignored_state(std::string_view path, bool is_directory) const {
  if (!path.starts_with(prefix)) return std::nullopt;
  const std::string_view below = path.substr(prefix.size());
  const std::string_view name = path.substr(path.rfind('/') + 1);
  for (auto rule = rules.rbegin(); rule != rules.rend(); ++rule) {
    if (rule->only_directories && !is_directory) continue;
    if (rule->pattern.matches(rule->whole_path ? below : name)) return !rule->includes;
  }
  return std::nullopt;
}

/// Removes blanks at the end, except those after a backslash.
static std::string_view without_trailing_blanks(std::string_view line) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == ' ') continue;
    if (line[i] == '\\') ++i;
    end = std::min(i + 1, line.size());
  }
  return line.substr(0, end);
}

/// Returns nothing for blank lines, comments and patterns that match nothing.
static std::optional<IgnoreRule> parse_rule(std::string_view line) {
  if (line.starts_with('#')) return std::nullopt;
  if (line.ends_with('\r')) line.remove_suffix(1);
  line = without_trailing_blanks(line);
  IgnoreRule rule;
  rule.includes = line.starts_with('!');
  if (rule.includes) line.remove_prefix(1);
  rule.only_directories = line.ends_with('/');
  if (rule.only_directories) line.remove_suffix(1);
  rule.whole_path = line.find('/') != std::string_view::npos;
  if (line.starts_with('/')) line.remove_prefix(1);
  if (line.empty()) return std::nullopt;
  std::optional<system::Glob> pattern = system::Glob::parse(line, rule.whole_path);
  if (!pattern) return std::nullopt;
  rule.pattern = std::move(*pattern);
  return rule;
}

static std::vector<IgnoreRule> parse_rules(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<IgnoreRule> rules;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (std::optional<IgnoreRule> rule = parse_rule(text.substr(0, end))) rules.push_back(std::move(*rule));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return rules;
}

/// The maximum size of a file of rules; it is git's limit too.
static constexpr std::uintmax_t kLargestFile = 100 << 20;

/// The contents of a file; empty if it cannot be read, as in git.
static std::string contents(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > kLargestFile) return {};
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

static bool starts_work_tree(const fs::path& directory) {
  std::error_code error;
  return fs::exists(fs::symlink_status(directory / ".git", error));
}

/// The value after `key` in a file of one line.
static std::string value_in(const fs::path& file, std::string_view key) {
  const std::string text = contents(file);
  if (!text.starts_with(key)) return {};
  return text.substr(key.size(), text.find_first_of("\r\n") - key.size());
}

/// The directory where git keeps data of the whole repository: the work tree's `.git`, or the one that a `.git` file
/// refers to, as in a submodule or linked work tree.
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

/// Skips a .gitignore that is a symlink, as git does.
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
  rules.innermost_ = std::make_shared<const IgnoreRules>(
      IgnoreRules{system::generic_name(directory / ""), parse_rules(text), innermost_});
  return rules;
}

bool GitIgnore::ignores(const fs::path& path, bool is_directory) const {
  for (const IgnoreRules* rules = innermost_.get(); rules; rules = rules->outer.get())
    if (const std::optional<bool> ignored_state = rules->ignored_state(system::generic_name(path), is_directory))
      return *ignored_state;
  return false;
}

}  // namespace isocnc::input
