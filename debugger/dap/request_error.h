#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/dialect/format.h"

namespace isocnc::dap {

/// A request cannot be fulfilled, and why, for people.
class RequestError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  /// The message, in that language where it has not been made in one.
  virtual std::string in(dialect::Language) const { return what(); }
};

/// An argument is not what it should be. It is found before the language is known, so the message is made when it is
/// shown.
class ArgumentError : public RequestError {
 public:
  /// The text has places for the key of the argument and for its value, and may leave out the last ones.
  ArgumentError(const dialect::Text& why, std::string key, std::string value = {})
      : RequestError(dialect::format(why, dialect::Language::English, key, value)),
        why_(why),
        key_(std::move(key)),
        value_(std::move(value)) {}

  std::string in(dialect::Language language) const override { return dialect::format(why_, language, key_, value_); }

 private:
  dialect::Text why_;
  std::string key_;
  std::string value_;
};

}  // namespace isocnc::dap
