#pragma once

#include <array>
#include <limits>
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

/// The range of positions of an axis, in mm or degrees.
struct Travel {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();

  friend bool operator==(const Travel&, const Travel&) = default;
};

/// The limits of the machine; infinite where the machine file gives none.
struct Limits {
  std::array<Travel, 5> travel;                           ///< X, Y, Z of the tool tip in the machine frame, B and C.
  double feed = std::numeric_limits<double>::infinity();  ///< mm/min
  double rotary_speed = std::numeric_limits<double>::infinity();   ///< degrees/min
  double spindle_speed = std::numeric_limits<double>::infinity();  ///< rev/min

  friend bool operator==(const Limits&, const Limits&) = default;
};

/// The data of the machine that the checks need.
struct Setup {
  geometry::Pose home;          ///< Machine frame.
  double arc_tolerance = 0.01;  ///< mm (D35).
  /// The tools that the machine file lists; without a list any tool may be mounted (D46).
  std::optional<std::vector<ToolCode>> tools;
  Limits limits;
  /// The M functions that the machine file names; without a list any number is accepted.
  std::optional<std::vector<int>> functions;
  /// Minimum Z of rapids in the face frame, mm.
  std::optional<double> clearance;
};

}  // namespace isocnc::execution
