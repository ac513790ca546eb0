#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "debugger/session/session.h"
#include "interpreter/dialect/given_name.h"

namespace isocnc::session {

/// A reference to the place where the program has set the present value of a quantity: a mode, F, S, T or a register;
/// 0 where it has not. It is valid until the machine moves on.
std::int64_t location_of(const Session& session, const expressions::Quantity& quantity);
/// A reference to the place where an obstacle is described; `place` is that among all obstacles, nearest first.
std::int64_t location_of_neighbor(std::size_t place);

/// The place behind a reference, a `LocationsResponse` of the protocol. Throws RequestError for one that leads nowhere.
Json location(const Session& session, std::int64_t reference);

}  // namespace isocnc::session
