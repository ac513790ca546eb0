#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace isocnc::analyzer {

/// Writes a unified diff of two texts that have the same lines but for some that were changed in place, as they come
/// along: what is kept is a few lines.
class UnifiedDiff {
 public:
  /// Parts of the diff go to `write`.
  UnifiedDiff(std::string name, std::function<void(std::string_view)> write)
      : name_(std::move(name)), write_(std::move(write)) {}

  /// The next lines, whole ones with their ends, as many before as after.
  void add(std::string_view before, std::string_view after);
  /// Behind the last line.
  void finish();
  bool has_changes() const { return has_changes_; }

 private:
  void add_line(std::string_view before, std::string_view after);
  void write_hunk();

  static constexpr std::size_t kContext = 3;

  std::string name_;
  std::function<void(std::string_view)> write_;
  bool has_changes_ = false;
  std::uint64_t line_ = 0;  // From 0: the next one.

  // The hunk that is being gathered, and the unchanged lines before or behind it.
  std::vector<std::string> context_;
  std::string hunk_;
  std::string removed_;  // A run of changed lines: all old ones are shown before the new ones.
  std::string added_;
  std::uint64_t hunk_first_ = 0;
  std::uint64_t hunk_lines_ = 0;
};

}  // namespace isocnc::analyzer
