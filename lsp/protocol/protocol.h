#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lsp/rpc/json.h"

/// The types of the language server protocol that several features use. A type for one feature is in that feature's
/// file.
namespace isocnc::protocol {

using rpc::Json;

/// A position as the client counts: line from 0, column in units of the agreed encoding. Snapshot converts it to a
/// syntax::Position and back.
struct ClientPosition {
  std::uint32_t line = 0;
  std::uint32_t character = 0;

  friend auto operator<=>(const ClientPosition&, const ClientPosition&) = default;
};

/// The end is exclusive.
struct ClientRange {
  ClientPosition start;
  ClientPosition end;

  friend auto operator<=>(const ClientRange&, const ClientRange&) = default;
};

struct Location {
  std::string uri;
  ClientRange range;
};

struct TextEdit {
  ClientRange range;
  std::string new_text;
};

/// Text in Markdown.
struct Markdown {
  std::string text;
};

/// Escapes text of a program or a configuration, so that Markdown shows it literally. Otherwise the editor would fetch
/// an image that a comment names.
std::string in_markdown(std::string_view text);

/// Parameters with a `{"textDocument": {"uri": ...}}`, by which most requests name a document.
struct DocumentParams {
  std::string uri;
};

struct PositionParams : DocumentParams {
  ClientPosition position;
};

struct RangeParams : DocumentParams {
  ClientRange range;
};

/// A result as JSON text, for results too long to be built as a tree.
struct RawJson {
  std::string text;
};

void to_json(Json& json, const ClientPosition& position);
void to_json(Json& json, const ClientRange& range);
void to_json(Json& json, const Location& location);
void to_json(Json& json, const TextEdit& edit);
void to_json(Json& json, const Markdown& markdown);

// The functions below throw an exception of nlohmann-json if a member is missing or of the wrong type: the client's
// parameters are invalid then. Numbers that are not valid in a position are wrong as well.
void from_json(const Json& json, ClientPosition& position);
void from_json(const Json& json, ClientRange& range);
void from_json(const Json& json, DocumentParams& params);
void from_json(const Json& json, PositionParams& params);
void from_json(const Json& json, RangeParams& params);

/// A member that may be missing or null.
template <class T>
std::optional<T> member(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() || found->is_null() ? std::nullopt : std::optional(found->template get<T>());
}

}  // namespace isocnc::protocol
