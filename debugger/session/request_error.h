#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/dialect/format.h"

namespace isocnc::debugger::session {

/// A request cannot be fulfilled, and why, for people.
class RequestError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument is not what it should be. Whoever answers knows the language to tell it in.
class ArgumentError : public RequestError {
 public:
  ArgumentError(const dialect::Text& why, std::string key)
      : RequestError(dialect::format(why, dialect::Language::English, key)), why_(why), key_(std::move(key)) {}

  std::string in(dialect::Language language) const { return dialect::format(why_, language, key_); }

 private:
  dialect::Text why_;
  std::string key_;
};

}  // namespace isocnc::debugger::session
