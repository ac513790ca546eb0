#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/configuration/mistake.h"

namespace isocnc::configuration {

/// The type of a key's value.
enum class KeyKind : std::uint8_t {
  Object,   ///< An object with its own keys.
  Objects,  ///< A list of objects, whose keys are listed as `PATH[].KEY`.
  Named,    ///< Objects with names chosen by the author, whose keys are listed as `PATH.*.KEY`.
  Number,
  Integer,
  Boolean,
  Text,
  Choice,      ///< One of `choices`.
  Texts,       ///< A list of texts.
  Severities,  ///< A severity for each code.
};

/// The meaning of a text, an element of a list or a name.
enum class TextKind : std::uint8_t { Any, Code, Pattern, Extension, Function };

/// The range of a key's numbers.
struct NumberRange {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusive_minimum = false;  ///< `minimum` itself is not in the range.
};

/// The storage of a key's value, written by the reader and read by --show-config.
using ValueSlot =
    std::variant<std::monostate, double*, std::optional<double>*, int*, std::optional<int>*, bool*, std::string*,
                 std::optional<dialect::Language>*, std::vector<std::string>*,
                 std::vector<std::pair<std::string, std::string>>*, std::optional<std::vector<Tool>>*,
                 std::optional<std::vector<NamedFunction>>*, std::vector<FileOverrides>*, std::optional<Renumber>*>;

/// A mistake in an object whose keys are all valid, with the key to mark; an empty `member` marks the object itself.
struct Objection {
  std::string_view member;
  const dialect::Text& text;
};

/// A row of the table of keys, with all facts about a key. The reader, the JSON schema, the documentation and
/// `--show-config` are derived from it.
struct Key {
  std::string path;  ///< For example `machine.tools[].head`.
  KeyKind kind = KeyKind::Object;
  TextKind text = TextKind::Any;
  NumberRange range;
  dialect::Text unit;
  std::span<const std::string_view> choices;
  dialect::Text documentation;
  bool is_required = false;
  bool is_never_empty = false;  ///< The list must have an element.
  /// For keys of list elements, `index` is the index of the element.
  std::function<ValueSlot(Configuration& configuration, std::size_t index)> slot;
  std::function<std::optional<Objection>(const Configuration& configuration, std::size_t index)> objection;

  /// The last part of the path: `head`.
  std::string_view name() const { return std::string_view(path).substr(path.rfind('.') + 1); }
};

/// The table. Keys follow the key of the object they belong to.
const std::vector<Key>& all_keys();

/// The keys of an object, of list elements or of named objects; null means the whole file.
std::vector<const Key*> keys_below(const Key* key);

/// The common start of the paths of these keys: `machine.tools[].`
std::string prefix_of(const Key* key);

/// The number in a name such as M100; none if it is not a user M function (D48).
std::optional<int> function_number(std::string_view name);

}  // namespace isocnc::configuration
