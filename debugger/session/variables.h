#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "debugger/session/session.h"

namespace isocnc::session {

/// A value or group of values that the client shows.
struct Variable {
  std::string name;
  std::string value;
  std::string type;                                 ///< Its meaning and its unit.
  std::string evaluate_name;                        ///< An expression with this value; empty for none.
  std::int64_t reference = 0;                       ///< Reference of the variables that it holds; 0 for none.
  std::int64_t location = 0;                        ///< Reference of the place where its value was set; 0 for none.
  const expressions::Quantity* quantity = nullptr;  ///< The quantity to set; null where it cannot be set.
};

/// A group of variables of a stack frame.
struct Scope {
  dialect::Text name;
  std::int64_t reference = 0;
  std::string_view hint;      ///< `locals`, `registers`; empty for none.
  bool is_expensive = false;  ///< Whether its variables take long to find.
};

/// Those that have something to show.
std::vector<Scope> scopes_of(const Session& session);

/// The variables that a scope or variable holds. The references are always the same. Throws RequestError for one that
/// does not exist.
std::vector<Variable> variables_of(const Session& session, std::int64_t reference,
                                   const expressions::ValueFormat& format);

}  // namespace isocnc::session
