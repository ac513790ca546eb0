#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/codes.h"
#include "interpreter/dialect/diagnostic.h"

namespace isocnc::dialect {

/// Something that happens in a program, as house rules name it: `M08`, `G90`, `toolChange`, `motion`, `rapid`, `cut`,
/// `end`.
struct HouseEvent {
  enum class Kind : std::uint8_t {
    G,           ///< A G, written; no motion.
    M,           ///< An M other than M02 and M06.
    ToolChange,  ///< M06.
    Motion,      ///< Any motion, by its G or continued.
    Rapid,       ///< One under G00.
    Cut,         ///< One under G01, G02 or G03.
    End,         ///< M02.
  };

  Kind kind = Kind::G;
  int number = 0;  ///< Of the G or M.

  friend bool operator==(const HouseEvent&, const HouseEvent&) = default;
};

/// The number after the letter of a code such as M08; nothing for another text.
inline std::optional<int> code_number(char letter, std::string_view text) {
  if (text.size() < 2 || text.size() > 4 || text.front() != letter) return std::nullopt;
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data() + 1, end, number);
  return error == std::errc() && read == end && number >= 0 ? std::optional(number) : std::nullopt;
}

/// The event with this name; nothing for a G that is no G of the dialect, or a motion, and for any other text.
inline std::optional<HouseEvent> house_event(std::string_view name) {
  using Kind = HouseEvent::Kind;
  if (name == "toolChange") return HouseEvent{.kind = Kind::ToolChange};
  if (name == "motion") return HouseEvent{.kind = Kind::Motion};
  if (name == "rapid") return HouseEvent{.kind = Kind::Rapid};
  if (name == "cut") return HouseEvent{.kind = Kind::Cut};
  if (name == "end") return HouseEvent{.kind = Kind::End};
  if (const std::optional<int> m = code_number('M', name); m && *m > 0) {
    if (*m == kToolChange) return HouseEvent{.kind = Kind::ToolChange};
    if (*m == kProgramEnd) return HouseEvent{.kind = Kind::End};
    return HouseEvent{.kind = Kind::M, .number = *m};
  }
  const std::optional<int> g = code_number('G', name);
  const GCode* const code = g ? g_code(static_cast<std::size_t>(*g)) : nullptr;
  if (!code || code->is_motion()) return std::nullopt;
  return HouseEvent{.kind = Kind::G, .number = *g};
}

/// Tools by the six digits after T, from the first to the last.
struct ToolRange {
  int first = 0;
  int last = 0;

  bool holds(int number) const { return first <= number && number <= last; }
  friend bool operator==(const ToolRange&, const ToolRange&) = default;
};

/// The tools that `T101003`, or `T101*` with any digits at its end, names.
inline std::optional<ToolRange> tool_range(std::string_view text) {
  constexpr std::size_t kDigits = 6;
  if (!text.starts_with('T')) return std::nullopt;
  text.remove_prefix(1);
  const bool is_open = text.ends_with('*');
  if (is_open) text.remove_suffix(1);
  const bool is_number = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!is_number || (is_open ? text.size() >= kDigits : text.size() != kDigits)) return std::nullopt;
  ToolRange range;
  for (std::size_t i = 0; i < kDigits; ++i) {
    const int digit = i < text.size() ? text[i] - '0' : 0;
    range.first = range.first * 10 + digit;
    range.last = range.last * 10 + (i < text.size() ? digit : 9);
  }
  return range;
}

/// What one house rule of a configuration watches for (W143). A rule that lists several words for the head or the end
/// of a program gives one watch for each.
struct HouseWatch {
  enum class Kind : std::uint8_t {
    Order,  ///< An event in `reported` while the watch is on; `started` turns it on, `ended` and `comment` off.
    Speed,  ///< An S outside of the range, with one of `tools` mounted; 1/min.
    Feed,   ///< An F likewise; mm/min.
    Depth,  ///< A motion that goes below `minimum` in Z of the frame in force, mm.
  };

  /// One text in both languages, which may be the same.
  struct BilingualText {
    std::string en;
    std::string it;
  };

  std::string rule;  ///< The id of the house rule.
  BilingualText message;
  Severity severity = Severity::Warning;
  Kind kind = Kind::Order;

  std::vector<HouseEvent> reported;
  std::vector<HouseEvent> started;
  std::vector<HouseEvent> ended;
  std::string comment;       ///< Pattern of a comment that turns the watch off; empty: none does.
  bool is_on_first = false;  ///< Whether the watch is on when the program starts.
  bool stays_on = false;     ///< Whether it stays on after a finding.

  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  std::vector<ToolRange> tools;  ///< Empty: all.
};

/// The maximum number of watches in a configuration.
inline constexpr std::size_t kMaxHouseWatches = 64;

}  // namespace isocnc::dialect
