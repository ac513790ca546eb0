#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lsp/rpc/json.h"

/// What the messages of the language server protocol are made of, as far as features share it. What one feature alone
/// needs stands in its own file.
namespace isocnc::lsp::documents {

using rpc::Json;

/// A place as the client counts: line from 0, column in the units of the encoding that has been agreed on. Snapshot
/// turns it into a syntax::Position and back.
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

/// Text that may be formatted.
struct Markdown {
  std::string text;
};

/// Words of a program or a configuration within it, which are to show as they stand. Else an image that a comment names
/// would be fetched by the editor that shows it.
std::string in_markdown(std::string_view text);

/// `{"textDocument": {"uri": ...}}`, and whatever else: most requests name a document so.
struct DocumentParams {
  std::string uri;
};

struct PositionParams : DocumentParams {
  ClientPosition position;
};

struct RangeParams : DocumentParams {
  ClientRange range;
};

/// A result that is JSON already, for those too long to be built as a tree.
struct RawJson {
  std::string text;
};

void to_json(Json& json, const ClientPosition& position);
void to_json(Json& json, const ClientRange& range);
void to_json(Json& json, const Location& location);
void to_json(Json& json, const TextEdit& edit);
void to_json(Json& json, const Markdown& markdown);

// These throw what nlohmann-json throws where a member is missing or of the wrong kind: the caller's parameters are
// invalid then. Numbers that no place can have are wrong, too.
void from_json(const Json& json, ClientPosition& position);
void from_json(const Json& json, ClientRange& range);
void from_json(const Json& json, DocumentParams& params);
void from_json(const Json& json, PositionParams& params);
void from_json(const Json& json, RangeParams& params);

/// A member that may be missing, or null.
template <class T>
std::optional<T> member(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() || found->is_null() ? std::nullopt : std::optional(found->template get<T>());
}

}  // namespace isocnc::lsp::documents
