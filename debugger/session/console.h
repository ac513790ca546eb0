#pragma once

#include <string>
#include <string_view>

#include "debugger/session/session.h"

namespace isocnc::debugger::session {

/// What somebody types while the machine stands: expressions, which are answered, and blocks (MDI), which are run.
/// Blocks wait for a G909, unless they hold M functions and motions alone (I.3.9). What could be either is a block; an
/// = before it makes it an expression.
///
/// What is to be said to it. Throws RequestError.
std::string enter(Session& session, std::string_view text);

/// The value of an expression, as it is shown. Throws RequestError.
std::string evaluate(const Session& session, std::string_view text, const ValueFormat& format);
/// The number. Throws RequestError.
double number_of(const Session& session, std::string_view text);

}  // namespace isocnc::debugger::session
