#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "debugger/dap/request_error.h"
#include "lsp/rpc/json.h"

namespace isocnc::dap {

using rpc::Json;

/// The member with this key; null where there is none, or where it is null.
const Json* find_member(const Json& arguments, const char* key);

[[noreturn]] void refuse_missing(const char* key);
[[noreturn]] void refuse_type(const char* key);

template <class T>
inline constexpr bool kIsList = false;
template <class T>
inline constexpr bool kIsList<std::vector<T>> = true;

/// Whether the value is of the kind that T is read from. An object may be anything: its members are read one by one.
template <class T>
bool has_type(const Json& value) {
  if constexpr (std::is_same_v<T, bool>) return value.is_boolean();
  if constexpr (std::is_same_v<T, std::int64_t>) return value.is_number_integer();
  if constexpr (std::is_same_v<T, double>) return value.is_number();
  if constexpr (std::is_same_v<T, std::string>) return value.is_string();
  if constexpr (kIsList<T>) return value.is_array();
  return true;
}

/// A member of a request's arguments; none where it is missing or null. Throws ArgumentError where it is of another
/// type.
template <class T>
std::optional<T> member(const Json& arguments, const char* key) {
  const Json* const found = find_member(arguments, key);
  if (found == nullptr) return std::nullopt;
  if (!has_type<T>(*found)) refuse_type(key);
  return found->get<T>();
}

/// A member that has to be there. Throws ArgumentError.
template <class T>
T required(const Json& arguments, const char* key) {
  auto value = member<T>(arguments, key);
  if (!value) refuse_missing(key);
  return *std::move(value);
}

/// An element of a list that is judged by itself: a mistake in it leaves the others alone.
template <class T>
class Item {
 public:
  Item() = default;
  explicit Item(T value) : read_(std::move(value)) {}
  explicit Item(const ArgumentError& error) : read_(error) {}

  /// Throws the ArgumentError where it could not be read.
  const T& get() const {
    if (const auto* const error = std::get_if<ArgumentError>(&read_)) throw ArgumentError(*error);
    return std::get<T>(read_);
  }

 private:
  std::variant<T, ArgumentError> read_;
};

template <class T>
void from_json(const Json& json, Item<T>& item) {
  try {
    item = Item<T>(json.get<T>());
  } catch (const ArgumentError& error) {
    item = Item<T>(error);
  }
}

}  // namespace isocnc::dap
