#pragma once

#include <string>
#include <string_view>

#include "debugger/session/session.h"

namespace isocnc::session {

/// Answers what a user types while the machine stands: the value of an expression, or what a block (MDI) did. Blocks
/// wait for a G909, unless they hold M functions and motions alone (I.3.9). What could be either is a block; an =
/// before it makes it an expression. Throws RequestError.
std::string enter(Session& session, std::string_view text);

/// The value of an expression, as text. Throws RequestError.
std::string evaluate(const Session& session, std::string_view text, const expressions::ValueFormat& format);
/// The value of an expression, as a number. Throws RequestError.
double number_of(const Session& session, std::string_view text);

}  // namespace isocnc::session
