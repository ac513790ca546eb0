#include "debugger/session/arguments.h"

#include <utility>

#include "debugger/session/request_error.h"

namespace isocnc::debugger::session {

static constexpr dialect::Text kMissing{"{} is missing", "manca {}"};
static constexpr dialect::Text kWrongType{"{} is not what it should be", "{} non è del tipo giusto"};

/// A member that is there and not null.
static const Json* find(const Json& arguments, const char* key) {
  if (!arguments.is_object()) return nullptr;
  const auto found = arguments.find(key);
  return found == arguments.end() || found->is_null() ? nullptr : &*found;
}

[[noreturn]] static void refuse(const dialect::Text& why, const char* key) { throw ArgumentError(why, key); }

std::optional<std::int64_t> find_integer(const Json& arguments, const char* key) {
  const Json* const found = find(arguments, key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_number_integer()) refuse(kWrongType, key);
  return found->get<std::int64_t>();
}

std::optional<double> find_number(const Json& arguments, const char* key) {
  const Json* const found = find(arguments, key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_number()) refuse(kWrongType, key);
  return found->get<double>();
}

std::optional<bool> find_flag(const Json& arguments, const char* key) {
  const Json* const found = find(arguments, key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_boolean()) refuse(kWrongType, key);
  return found->get<bool>();
}

std::optional<std::string> find_text(const Json& arguments, const char* key) {
  const Json* const found = find(arguments, key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_string()) refuse(kWrongType, key);
  return found->get<std::string>();
}

std::int64_t integer(const Json& arguments, const char* key) {
  const auto value = find_integer(arguments, key);
  if (!value) refuse(kMissing, key);
  return *value;
}

std::string text(const Json& arguments, const char* key) {
  auto value = find_text(arguments, key);
  if (!value) refuse(kMissing, key);
  return std::move(*value);
}

Json list(const Json& arguments, const char* key) {
  const Json* const found = find(arguments, key);
  if (found == nullptr) return Json::array();
  if (!found->is_array()) refuse(kWrongType, key);
  return *found;
}

}  // namespace isocnc::debugger::session
