#pragma once

#include <variant>

#include "interpreter/configuration/configuration.h"
#include "interpreter/configuration/keys.h"
#include "interpreter/solids/revolved_body.h"
#include "interpreter/verification/scene.h"

namespace isocnc::configuration {

/// The bodies of a tool, or why it cannot be as it is described. The cutter goes from the tip up to the cutting length,
/// or to the holder; the shank from there to the holder; and the holder ends at the spindle nose. What the description
/// leaves open has no body, and a tool without a length has none at all. Requires values within the ranges of the keys.
std::variant<verification::ToolBodies, Objection> tool_bodies(const MachineConfiguration& machine, const Tool& tool);

/// A stack of rows (height, lower diameter, upper diameter) from z = `base` up, or why the rows are none.
std::variant<solids::RevolvedBody, Objection> stack_body(const NumberRows& rows, double base);

}  // namespace isocnc::configuration
