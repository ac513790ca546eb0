#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace isocnc::fixing {

/// Writes a unified diff of two texts whose lines arrive in parallel; keeps only a few lines in memory. For diff and
/// patch only LF ends a line: lines that end with CR alone are shown together with the next one that ends with LF.
class UnifiedDiff {
 public:
  /// Parts of the diff go to `write`. After a byte-order mark, the first line of both texts begins with it.
  UnifiedDiff(std::string name, bool has_byte_order_mark, std::function<void(std::string_view)> write)
      : name_(std::move(name)), has_byte_order_mark_(has_byte_order_mark), write_(std::move(write)) {}

  /// Adds the next lines, with their ends: the same number of lines in both texts.
  void add(std::string_view before, std::string_view after);
  /// Adds a line, with its end, that only one of the texts has.
  void remove(std::string_view line) { take(line, {}); }
  void insert(std::string_view line) { take({}, line); }
  /// Call after the last line.
  void finish();
  bool has_changes() const { return has_changes_; }

 private:
  std::string marked(std::string_view line, bool is_first) const;
  void write_names();
  void take(std::string_view before, std::string_view after);
  void compare(std::string_view before, std::string_view after);
  void begin_change();
  void keep(std::string_view line);
  void take_away(std::string_view line);
  void put_in(std::string_view line);
  void write_hunk();

  static constexpr std::size_t kContext = 3;

  std::string name_;  // The name of the file; empty after it has been written.
  const bool has_byte_order_mark_;
  std::function<void(std::string_view)> write_;
  bool has_changes_ = false;
  /// The position in one of the texts.
  struct Side {
    std::size_t line = 0;  // The next line, from 0.
    std::size_t hunk_first = 0;
    std::size_t hunk_lines = 0;

    std::string range() const;
  };
  Side before_;
  Side after_;

  // The lines since the last LF at which both texts ended together.
  std::string open_before_;
  std::string open_after_;

  // The unwritten hunk, and the unchanged lines before or after it.
  std::vector<std::string> context_;
  std::string hunk_;
  std::string removed_;  // A run of changed lines: all old ones come before the new ones.
  std::string added_;
  bool in_hunk_ = false;
};

}  // namespace isocnc::fixing
