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
  Point,       ///< A list of numbers, one for each of `columns`.
  Rows,        ///< A list of such lists.
  NamedRows,   ///< Such lists of lists, with names chosen by the author.
  Message,     ///< A text, or an object with one for each language.
};

/// The meaning of a text, an element of a list or a name.
enum class TextKind : std::uint8_t {
  Any,
  Code,
  Pattern,
  Extension,
  Function,
  File,
  Name,     ///< Of a house rule: letters, digits and - . _
  Event,    ///< dialect::house_event()
  ModeOrM,  ///< Such an event that is a G or an M.
  Tool,     ///< dialect::tool_range()
};

/// The range of a key's numbers.
struct NumberRange {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusive_minimum = false;  ///< `minimum` itself is not in the range.
};

/// A number of a point or of a row.
struct Column {
  dialect::Text name;
  NumberRange range;
};

/// The index of a list's element, or of a named object; of a list within an element, the index of that element and its
/// own.
struct ElementIndex {
  std::size_t element = 0;
  std::size_t inner = 0;
};

/// The storage of a key's value, written by the reader and read by --show-config.
using ValueSlot =
    std::variant<std::monostate, double*, std::optional<double>*, int*, std::optional<int>*, bool*,
                 std::optional<bool>*, std::string*, std::optional<dialect::Language>*, std::vector<std::string>*,
                 std::vector<std::pair<std::string, std::string>>*, std::optional<geometry::Vec3>*,
                 std::optional<NumberRows>*, std::vector<NamedRows>*, std::optional<ShapeFile>*,
                 // Lists of objects.
                 std::optional<std::vector<Tool>>*, std::optional<std::vector<NamedFunction>>*,
                 std::vector<FileOverrides>*, std::vector<DescribedBody>*, std::vector<DescribedSetup>*,
                 std::vector<DescribedHouseRule>*, dialect::HouseWatch::BilingualText*,
                 // Objects that may be absent.
                 std::optional<Renumber>*, std::optional<DescribedCylinder>*, std::optional<DescribedStock>*,
                 std::optional<DescribedSpoilboard>*, std::optional<DescribedTarget>*>;

/// A mistake in an object whose keys are all valid, with the key to mark; an empty `member` marks the object itself.
struct Objection {
  std::string_view member;
  dialect::Text text;
  std::vector<Named> names;
  std::optional<std::size_t> row;     ///< Of a member with rows, the row to mark.
  std::optional<std::size_t> column;  ///< The number of that row to mark.
  std::optional<std::string> meant;   ///< Suggested correction.
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
  std::span<const Column> columns;
  std::size_t maximum_rows = 0;  ///< Rows need at least one.
  bool has_all_rows = false;     ///< Rows need `maximum_rows`.
  std::function<ValueSlot(Configuration& configuration, ElementIndex index)> slot;
  std::function<std::optional<Objection>(const Configuration& configuration, ElementIndex index)> objection;
  /// An objection that depends on other objects: asked for when the whole file has been read without a mistake.
  std::function<std::optional<Objection>(const Configuration& configuration, ElementIndex index)> final_objection;

  /// The last part of the path: `head`.
  std::string_view name() const { return std::string_view(path).substr(path.rfind('.') + 1); }
};

/// The table. Keys follow the key of the object they belong to.
const std::vector<Key>& all_keys();

/// The keys of an object, of list elements or of named objects; null means the whole file.
std::vector<const Key*> keys_below(const Key* key);

/// The common start of the paths of these keys: `machine.tools[].`
std::string prefix_of(const Key* key);

/// The index of the i-th element of a list, whose own object has the index `owner`.
ElementIndex element_index(const Key& list, ElementIndex owner, std::size_t i);

/// The number of elements of a list of objects; none if there is no list.
std::optional<std::size_t> element_count(const ValueSlot& slot);
/// Makes a list of objects that is empty.
void create_list(const ValueSlot& slot);
/// Adds an element to a list of objects, and returns its index.
std::size_t add_element(const ValueSlot& slot, const DescriptionPlace& place);
/// Makes an object that may be absent; does nothing for others.
void create_object(const ValueSlot& slot, const DescriptionPlace& place);
/// Whether an object that may be absent is.
bool is_absent(const ValueSlot& slot);

/// The number in a name such as M100; none if it is not a user M function (D48).
std::optional<int> function_number(std::string_view name);

}  // namespace isocnc::configuration
