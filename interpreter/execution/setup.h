#pragma once

#include <optional>
#include <vector>

#include "interpreter/geometry/vectors.h"

namespace isocnc::execution {

/// The tool code of a T word: head, holder and tool (I.4.3).
struct ToolCode {
  int head = 0;
  int holder = 0;
  int tool = 0;

  friend bool operator==(const ToolCode&, const ToolCode&) = default;
  friend auto operator<=>(const ToolCode&, const ToolCode&) = default;
};

constexpr ToolCode tool_code(int number) { return {number / 100000, number / 1000 % 100, number % 1000}; }

/// What the checks must know of the machine.
struct Setup {
  geometry::Pose home;          ///< Machine frame.
  double arc_tolerance = 0.01;  ///< mm (D35).
  /// The tools that the machine file lists; without a list any tool may be mounted (D46).
  std::optional<std::vector<ToolCode>> tools;
};

}  // namespace isocnc::execution
