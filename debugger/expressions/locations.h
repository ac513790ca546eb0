#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "debugger/debuggee/journal.h"
#include "debugger/expressions/quantities.h"
#include "interpreter/dialect/given_name.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::expressions {

/// A reference to the place where the program has set the present value of a quantity: a mode, F, S, T or a register;
/// 0 where it has not. It is valid until the machine moves on.
std::int64_t location_of(const Quantity& quantity, const debuggee::Journal& journal,
                         const simulation::Simulation& present);
/// A reference to the place where an obstacle is described; `place` is that among all obstacles, nearest first.
std::int64_t location_of_neighbor(std::size_t place);

/// What a reference leads to: a word of the program, or a place in another file.
struct LinkedPlace {
  std::size_t line = 0;              ///< Of the program, from 0.
  std::optional<syntax::Span> word;  ///< On that line; none where no word of it sets the value by itself.
  std::optional<dialect::FilePlace> other_file;
};

/// None for a reference that leads nowhere.
std::optional<LinkedPlace> find_location(std::int64_t reference, const debuggee::Debuggee& debuggee,
                                         const debuggee::Surroundings& surroundings);

}  // namespace isocnc::expressions
