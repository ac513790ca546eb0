#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>

namespace isocnc::running {

/// The start of a line of a program.
struct LinePlace {
  std::size_t line = 0;    ///< From 0.
  std::size_t offset = 0;  ///< Offset of the line's first byte.

  friend bool operator==(const LinePlace&, const LinePlace&) = default;
};

/// The text of a program and the targets of its jumps. Each target is searched once, when a run first takes the jump.
/// Logically const: runs can share it, also across threads. The text must outlive it; a UTF-8 byte-order mark is not
/// part of the text.
class Program {
 public:
  explicit Program(std::string_view text) : text_(text) {}

  std::string_view text() const { return text_; }

  /// The first line below the jump's that has the label (D50).
  std::optional<LinePlace> jump_target(const LinePlace& jump, std::uint64_t label) const;

  /// Whether the jump's line, or one above it, has the label (E005).
  bool has_label_above(const LinePlace& jump, std::uint64_t label) const;

 private:
  std::optional<LinePlace> find_label(std::uint64_t label, LinePlace from, std::size_t end_line) const;

  std::string_view text_;
  mutable std::mutex mutex_;
  mutable std::map<std::size_t, std::optional<LinePlace>> jump_targets_;  ///< Targets by the offset of the jump.
};

}  // namespace isocnc::running
