#pragma once

#include <stdexcept>
#include <string>

namespace isocnc::debugger::session {

/// A request cannot be fulfilled, and why, for people.
class RequestError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace isocnc::debugger::session
