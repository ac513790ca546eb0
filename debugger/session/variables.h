#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "debugger/session/session.h"

namespace isocnc::debugger::session {

/// A line of what the client shows of the machine.
struct Variable {
  std::string name;
  std::string value;
  std::string type;                    ///< What it is, and its unit.
  std::string evaluate_name;           ///< The expression that it is; empty for none.
  std::int64_t reference = 0;          ///< Of its own variables; 0: none.
  const Quantity* quantity = nullptr;  ///< That can be set; null for none.
};

/// A group of variables that a stack frame has.
struct Scope {
  dialect::Text name;
  std::int64_t reference = 0;
  std::string_view hint;  ///< `locals`, `registers`; empty for none.
};

std::span<const Scope> all_scopes();

/// What a scope, or a variable, holds. The references are always the same. Throws RequestError where there is none.
std::vector<Variable> variables_of(const Session& session, std::int64_t reference, const ValueFormat& format);

}  // namespace isocnc::debugger::session
