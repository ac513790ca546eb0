#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "interpreter/configuration/json_value.h"

namespace isocnc::tool_library {

/// A value as people write it on one line: `{"head": 1, "name": "ball 6"}`.
std::string in_one_line(const nlohmann::ordered_json& value);

/// A member that is added to an object, with its value as text.
struct NewMember {
  std::string key;
  std::string value;
};

/// Changes of a JSON text that leave its comments and its layout as they are. All places are those of the text before
/// any change.
class JsonEdits {
 public:
  /// `text` must outlive this object.
  explicit JsonEdits(std::string_view text);

  void replace(const configuration::JsonValue& value, std::string text);
  /// Removes the bytes from one place up to another.
  void remove(std::size_t from, std::size_t to) { edits_.push_back({from, to - from, {}}); }
  /// Adds members after the last one of an object, each on a line of its own where those before are, or where there is
  /// none. At most once for each object.
  void add_members(const configuration::JsonValue& object, const std::vector<NewMember>& members);
  /// Likewise, for the elements of a list.
  void add_elements(const configuration::JsonValue& list, const std::vector<std::string>& elements);

  /// The indentation of the line on which a value starts.
  std::string indentation_at(std::size_t at) const;
  /// The end of a line, as most of the text has it.
  std::string_view line_end() const { return line_end_; }

  /// The changed text.
  std::string apply() const;

 private:
  struct Splice {
    std::size_t at = 0;
    std::size_t removed = 0;
    std::string inserted;
  };

  /// `last` is the first byte of the last part, and the end of that part.
  void add_parts(const configuration::JsonValue& container, std::pair<std::size_t, std::size_t> last,
                 const std::vector<std::string>& parts);
  std::size_t end_of_comments_on_line(std::size_t at) const;

  std::string_view text_;
  std::string_view line_end_;
  std::vector<Splice> edits_;
};

}  // namespace isocnc::tool_library
