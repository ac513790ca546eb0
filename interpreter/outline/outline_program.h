#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/running/runner.h"
#include "interpreter/timing/timing.h"

namespace isocnc::outline {

/// Around what the tools cut, seen from above.
enum class OutlineShape : std::uint8_t {
  Rectangle,  ///< The smallest rectangle along X and Y.
  Hull,       ///< The smallest convex shape.
  Path,       ///< The outlines of what is cut, one around each separate part.
};

/// The shape of that name: `rectangle`, `hull` or `path`.
std::optional<OutlineShape> outline_shape(std::string_view name);

/// Lengths in mm, feeds in mm/min.
struct OutlineOptions {
  running::RunOptions run;
  timing::TimedMachine machine;  ///< Its radii widen the outline; where the radius of a tool is not known it is 0.
  OutlineShape shape = OutlineShape::Rectangle;
  /// Z of the first workpiece frame at which the tip goes around. Without it: 5 mm above the highest point of all feed
  /// moves, or the machine's value (Setup::clearance), whichever is higher.
  std::optional<double> height;
  double feed = 1000;
  std::string name;                                         ///< Of the program, for the comment at the head.
  dialect::Language language = dialect::Language::English;  ///< Of the comments, which are ASCII in both.
};

/// Why there is no outline.
struct OutlineRefusal {
  running::RunResult run;  ///< With the error that ends it, or without one: then the program has no feed move.
};

/// Returns a program that goes around the job in feed, with the spindle off, in the first workpiece frame of the
/// program. The tool is the first one that cuts. It stands upright, comes from the highest point that the program and
/// the machine reach, and goes back there. No trial has been made of it.
std::variant<std::string, OutlineRefusal> outline_program(std::string_view text, const OutlineOptions& options);

}  // namespace isocnc::outline
