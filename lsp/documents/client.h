#pragma once

#include <optional>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/documents/encoding.h"
#include "lsp/documents/protocol.h"

namespace isocnc::lsp::documents {

/// What the user has set in the editor; a feature that can be switched has its member here.
struct ClientSettings {
  std::optional<dialect::Language> language;
  bool checks_workspace = true;       ///< Tells of programs that are not open, too, where the client asks for them.
  bool shows_end_positions = true;    ///< Inlay hints: where incremental motions lead.
  bool shows_section_times = true;    ///< Inlay hints: when the tool sections begin.
  bool shows_motion_in_force = true;  ///< Inlay hints: the G that coordinates alone go on with.
};

/// Reads the object `isocnc` of the editor's settings. What it does not know, or cannot read, counts as not set.
ClientSettings read_settings(const Json& settings);

/// The other side, as far as answers depend on it. It does not change while a request is answered.
struct Client {
  Encoding encoding = Encoding::Utf16;
  Json capabilities = Json::object();       ///< ClientCapabilities, as the client sent them.
  std::optional<dialect::Language> locale;  ///< Of the editor's own texts.
  ClientSettings settings;
  std::optional<dialect::Language> commanded;  ///< By the server's command line.

  /// Whether a capability, `/textDocument/hover/dynamicRegistration`, is there and not false.
  bool can(const char* capability) const;
  /// A text in a format that the client takes, by those that it tells at `/textDocument/hover/contentFormat`: without
  /// the marks of Markdown where it takes plain text alone.
  Json in_format(const Markdown& text, const char* formats) const;
  /// The language that a program's texts are told in: the editor's setting, else the command's, else what the program's
  /// configuration says, else the editor's own, else the environment's.
  dialect::Language language(std::optional<dialect::Language> configured) const;
};

/// What the client said in `initialize`: its capabilities, the encoding that it likes best, its locale and the
/// settings in its initializationOptions.
Client read_client(const Json& initialize_params);

}  // namespace isocnc::lsp::documents
