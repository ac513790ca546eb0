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

/// What the value of a key is.
enum class KeyKind : std::uint8_t {
  Object,   ///< Keys of its own.
  Objects,  ///< A list of objects, whose keys stand below `PATH[]`.
  Named,    ///< Objects by names that the author chooses, whose keys stand below `PATH.*`.
  Number,
  Integer,
  Boolean,
  Text,
  Choice,      ///< One of `choices`.
  Texts,       ///< A list.
  Severities,  ///< A severity for each code.
};

/// What a text, an element of a list or a name is.
enum class TextKind : std::uint8_t { Any, Code, Pattern, Extension, Function };

/// The numbers that a key takes.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusive_minimum = false;  ///< `least` itself is none of them.
};

/// Where the value of a key is kept: what reading fills and showing reads.
using Slot =
    std::variant<std::monostate, double*, std::optional<double>*, int*, std::optional<int>*, bool*, std::string*,
                 std::optional<dialect::Language>*, std::vector<std::string>*,
                 std::vector<std::pair<std::string, std::string>>*, std::optional<std::vector<Tool>>*,
                 std::optional<std::vector<NamedFunction>>*, std::vector<FileOverrides>*, std::optional<Renumber>*>;

/// What is wrong with an object whose keys are all right, and which of them shows it; empty: the object itself.
struct Objection {
  std::string_view member;
  const dialect::Text& text;
};

/// A row of the table of keys: all that is known of a key. Reading, the JSON schema, the page of keys and
/// `--show-config` follow from it.
struct Key {
  std::string path;  ///< `machine.tools[].head`
  KeyKind kind = KeyKind::Object;
  TextKind text = TextKind::Any;
  Range range;
  std::string_view unit;
  std::span<const std::string_view> choices;
  std::string_view documentation;
  bool is_required = false;
  bool is_never_empty = false;  ///< A list that would mean nothing without an element.
  /// Below a list, `index` is the element's.
  std::function<Slot(Configuration& configuration, std::size_t index)> slot;
  std::function<std::optional<Objection>(const Configuration& configuration, std::size_t index)> objection;

  /// `head`
  std::string_view name() const { return std::string_view(path).substr(path.rfind('.') + 1); }
};

/// The table. Keys stand behind the one that they belong to.
const std::vector<Key>& all_keys();

/// The keys of an object, of the elements of a list or of named objects; empty is the whole file.
std::vector<const Key*> keys_below(const Key* key);

/// What the paths of these keys begin with: `machine.tools[].`
std::string prefix_of(const Key* key);

/// The number of M100; none when it is no M of the user's (D48).
std::optional<int> function_number(std::string_view name);

}  // namespace isocnc::configuration
