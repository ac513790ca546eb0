#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::tool_library {

/// Asks for what a machine should tell first, in the order of docs/machine.md: kind, travel, speeds, clearance, times.
/// A question shows its unit and what holds without an answer; an empty line leaves it open, and what the file may not
/// say is asked again. Returns `text`, an isocnc.json without a machine or nothing, with the machine in it and a
/// comment at each key; none if the answers end early.
std::optional<std::string> ask_for_machine(std::string_view text, std::istream& answers, std::ostream& questions,
                                           dialect::Language language);

/// Whether the text of an isocnc.json that is valid has a machine.
bool has_machine(std::string_view text);

}  // namespace isocnc::tool_library
