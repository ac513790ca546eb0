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

/// From where to where an axis goes, in mm or degrees.
struct Travel {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();

  friend bool operator==(const Travel&, const Travel&) = default;
};

/// What the machine can do; infinite where its file does not tell.
struct Limits {
  std::array<Travel, 5> travel;                           ///< X, Y, Z of the tool tip in the machine frame, B and C.
  double feed = std::numeric_limits<double>::infinity();  ///< mm/min
  double rotary_speed = std::numeric_limits<double>::infinity();   ///< degrees/min
  double spindle_speed = std::numeric_limits<double>::infinity();  ///< rev/min

  friend bool operator==(const Limits&, const Limits&) = default;
};

/// From where on lint rules speak; no check of the control depends on it.
struct AdviceThresholds {
  double longest_dwell = 120;  ///< G04, seconds.
  double axis_angle = 1e-4;    ///< How far axis vectors may be from the right angle, degrees.
  double vector_error = 1e-3;  ///< How far the length of an axis vector may be from 1.
};

/// What the checks must know of the machine.
struct Setup {
  geometry::Pose home;          ///< Machine frame.
  double arc_tolerance = 0.01;  ///< mm (D35).
  /// The tools that the machine file lists; without a list any tool may be mounted (D46).
  std::optional<std::vector<ToolCode>> tools;
  Limits limits;
  /// The M functions that the machine file names; without a list any number may be one.
  std::optional<std::vector<int>> functions;
  /// mm: no rapid should go below this Z of the face frame.
  std::optional<double> clearance;
  /// Whether opinions are wanted on every motion, plain ones too.
  bool every_motion = false;
  AdviceThresholds advice;
};

}  // namespace isocnc::execution
