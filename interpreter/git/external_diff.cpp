#include "interpreter/git/external_diff.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "interpreter/dialect/format.h"

namespace isocnc::git {

using dialect::Language;
using dialect::Text;

namespace {

constexpr Text kNew{"new", "nuovo"};
constexpr Text kDeleted{"deleted", "cancellato"};
constexpr Text kUnmerged{"with merge conflicts", "con conflitti di fusione"};
constexpr Text kMode{"mode {} -> {}", "modo {} -> {}"};

bool is_made_of(std::string_view digits, std::string_view text) {
  return text == "." || (!text.empty() && text.find_first_not_of(digits) == std::string_view::npos);
}

bool is_version(const DiffedVersion& version) {
  return !version.file.empty() && is_made_of("0123456789abcdef", version.object) &&
         is_made_of("01234567", version.mode);
}

}  // namespace

std::string ExternalDiff::heading(Language language) const {
  std::string names = old_version.path;
  if (new_version.path != old_version.path) names += " -> " + new_version.path;
  std::string remark;
  if (is_unmerged) {
    remark = kUnmerged.in(language);
  } else if (!old_version.is_there()) {
    remark = kNew.in(language);
  } else if (!new_version.is_there()) {
    remark = kDeleted.in(language);
  } else if (old_version.mode != new_version.mode) {
    remark = dialect::format(kMode, language, old_version.mode, new_version.mode);
  }
  return remark.empty() ? names : names + " (" + remark + ')';
}

std::optional<ExternalDiff> read_external_diff(std::span<const std::string> arguments) {
  if (arguments.size() == 1) {
    const DiffedVersion only{.path = arguments[0], .file = {}, .object = {}, .mode = {}};
    return ExternalDiff{.old_version = only, .new_version = only, .is_unmerged = true};
  }
  if (arguments.size() != 7 && arguments.size() != 9) return std::nullopt;
  const std::string& new_path = arguments.size() == 9 ? arguments[7] : arguments[0];
  ExternalDiff read;
  read.old_version = {.path = arguments[0], .file = arguments[1], .object = arguments[2], .mode = arguments[3]};
  read.new_version = {.path = new_path, .file = arguments[4], .object = arguments[5], .mode = arguments[6]};
  if (!is_version(read.old_version) || !is_version(read.new_version)) return std::nullopt;
  return read;
}

int diffs_before() {
  const char* const counter = std::getenv("GIT_DIFF_PATH_COUNTER");  // NOLINT(concurrency-mt-unsafe): nobody sets it.
  if (counter == nullptr) return 0;
  int count = 0;
  std::from_chars(counter, counter + std::strlen(counter), count);
  return std::max(0, count - 1);
}

bool is_for_all_files() {
  const char* const command = std::getenv("GIT_EXTERNAL_DIFF");  // NOLINT(concurrency-mt-unsafe): nobody sets it.
  return command != nullptr && *command != '\0';
}

}  // namespace isocnc::git
