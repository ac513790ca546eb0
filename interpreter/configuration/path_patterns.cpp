#include "interpreter/configuration/path_patterns.h"

#include <algorithm>

#include "interpreter/system/paths.h"

namespace isocnc::configuration {

namespace fs = std::filesystem;

/// Names are found in upper and lower case, as programs by their extensions: a PART.ISO has the setup for *.iso.
static std::string without_case(std::string_view text) {
  std::string folded(text);
  for (char& c : folded)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return folded;
}

std::optional<PathPatterns::Pattern> PathPatterns::parse(std::string_view text) {
  Pattern pattern;
  pattern.only_directories = text.ends_with('/');
  if (pattern.only_directories) text.remove_suffix(1);
  if (text.starts_with("./")) text.remove_prefix(1);
  pattern.whole_path = text.find('/') != std::string_view::npos;
  if (text.starts_with('/')) text.remove_prefix(1);
  if (text.empty()) return std::nullopt;
  std::optional<system::Glob> glob = system::Glob::parse(without_case(text), pattern.whole_path);
  if (!glob) return std::nullopt;
  pattern.glob = std::move(*glob);
  return pattern;
}

bool PathPatterns::is_well_formed(std::string_view pattern) { return parse(pattern).has_value(); }

PathPatterns::PathPatterns(fs::path folder, const std::vector<std::string>& patterns) : folder_(std::move(folder)) {
  for (const std::string& text : patterns)
    if (std::optional<Pattern> pattern = parse(text)) patterns_.push_back(std::move(*pattern));
}

bool PathPatterns::name(const fs::path& path, bool is_directory) const {
  if (patterns_.empty()) return false;
  const fs::path below = path.lexically_relative(folder_);
  const bool is_below = !below.empty() && *below.begin() != "..";
  return std::any_of(patterns_.begin(), patterns_.end(), [&](const Pattern& pattern) {
    if (pattern.only_directories && !is_directory) return false;
    if (!pattern.whole_path) return pattern.glob.matches(without_case(path.filename().generic_string()));
    return is_below && pattern.glob.matches(without_case(system::generic_name(below)));
  });
}

bool PathPatterns::match(const fs::path& file) const {
  if (name(file, false)) return true;
  const auto is_above_folder = [&](const fs::path& path) {
    const fs::path up = folder_.lexically_relative(path);
    return path == folder_ || (!up.empty() && *up.begin() != "..");
  };
  for (fs::path above = file.parent_path(); above.has_relative_path() && !is_above_folder(above);
       above = above.parent_path())
    if (name(above, true)) return true;
  return false;
}

}  // namespace isocnc::configuration
