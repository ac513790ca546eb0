#include "interpreter/tool_library/json_edits.h"

#include <algorithm>
#include <iterator>

namespace isocnc::tool_library {

using configuration::JsonValue;
using nlohmann::ordered_json;

std::string in_one_line(const ordered_json& value) {
  if (!value.is_structured()) return value.dump();
  std::string line(1, value.is_object() ? '{' : '[');
  for (auto part = value.begin(); part != value.end(); ++part) {
    if (part != value.begin()) line += ", ";
    if (value.is_object()) line += ordered_json(part.key()).dump() + ": ";
    line += in_one_line(*part);
  }
  return line + (value.is_object() ? '}' : ']');
}

JsonEdits::JsonEdits(std::string_view text) : text_(text) {
  const std::size_t end = text.find('\n');
  line_end_ = end != std::string_view::npos && end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

void JsonEdits::replace(const JsonValue& value, std::string text) {
  edits_.push_back({value.at, value.end - value.at, std::move(text)});
}

std::string JsonEdits::indentation_at(std::size_t at) const {
  const std::size_t line = text_.substr(0, at).rfind('\n') + 1;  // npos + 1 is 0.
  const std::size_t end = std::min(text_.find_first_not_of(" \t", line), at);
  return std::string(text_.substr(line, end - line));
}

std::size_t JsonEdits::end_of_comments_on_line(std::size_t at) const {
  while (true) {
    const std::size_t next = text_.find_first_not_of(" \t", at);
    if (next == std::string_view::npos) return at;
    const std::string_view rest = text_.substr(next);
    if (rest.starts_with("//")) return std::min(text_.find_first_of("\r\n", next), text_.size());
    const std::size_t end = rest.starts_with("/*") ? rest.find("*/", 2) : std::string_view::npos;
    if (end == std::string_view::npos || rest.substr(0, end).find('\n') != std::string_view::npos) return at;
    at = next + end + 2;
  }
}

void JsonEdits::add_parts(const JsonValue& container, std::pair<std::size_t, std::size_t> last,
                          const std::vector<std::string>& parts) {
  if (parts.empty()) return;
  const bool is_empty = last.second == container.at;
  const std::string outer = indentation_at(container.at);
  const bool is_on_lines =
      is_empty || text_.substr(container.at, last.first - container.at).find('\n') != std::string_view::npos;
  const std::string before =
      is_on_lines ? std::string(line_end_) + (is_empty ? outer + "  " : indentation_at(last.first)) : " ";
  std::string joined;
  for (const std::string& part : parts) {
    if (!joined.empty()) joined += ',';
    joined += before + part;
  }
  if (is_empty) {
    const std::size_t bracket = container.end - 1;
    // Comments in the empty brackets stay before what is added.
    const std::size_t blank = text_.substr(0, bracket).find_last_not_of(" \t\r\n") + 1;
    edits_.push_back({blank, bracket - blank, joined + std::string(line_end_) + outer});
    return;
  }
  if (!is_on_lines) {
    edits_.push_back({last.second, 0, "," + joined});
    return;
  }
  // A comment behind the last part belongs to it.
  edits_.push_back({last.second, 0, ","});
  edits_.push_back({end_of_comments_on_line(last.second), 0, joined});
}

void JsonEdits::add_members(const JsonValue& object, const std::vector<NewMember>& members) {
  std::vector<std::string> parts;
  for (const NewMember& member : members) parts.push_back(ordered_json(member.key).dump() + ": " + member.value);
  const bool is_empty = object.members.empty();
  add_parts(
      object,
      is_empty ? std::pair(object.at, object.at) : std::pair(object.members.back().at, object.members.back().value.end),
      parts);
}

void JsonEdits::add_elements(const JsonValue& list, const std::vector<std::string>& elements) {
  const bool is_empty = list.elements.empty();
  add_parts(list, is_empty ? std::pair(list.at, list.at) : std::pair(list.elements.back().at, list.elements.back().end),
            elements);
}

std::string JsonEdits::apply() const {
  std::vector<Splice> edits = edits_;
  std::stable_sort(edits.begin(), edits.end(), [](const Splice& a, const Splice& b) { return a.at < b.at; });
  std::string changed;
  std::size_t at = 0;
  for (const Splice& edit : edits) {
    changed += text_.substr(at, edit.at - at);
    changed += edit.inserted;
    at = edit.at + edit.removed;
  }
  changed += text_.substr(at);
  return changed;
}

}  // namespace isocnc::tool_library
