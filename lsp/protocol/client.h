#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/protocol/encoding.h"
#include "lsp/protocol/protocol.h"

namespace isocnc::protocol {

/// When open programs are verified by a run on the simulated machine.
enum class VerifyWhen : std::uint8_t {
  Never,
  OnSave,   ///< When they are opened and saved.
  OnPause,  ///< Also after a pause in typing.
};

/// The user's settings in the editor; a feature that can be switched off has a member here.
struct ClientSettings {
  std::optional<dialect::Language> language;
  bool checks_workspace =
      true;  ///< Whether to report findings in programs that are not open as well, if the client asks for them.
  VerifyWhen verifies = VerifyWhen::OnPause;
  bool shows_end_positions = true;    ///< Inlay hints: end positions of incremental motions.
  bool shows_section_times = true;    ///< Inlay hints: start times of the tool sections.
  bool shows_motion_in_force = true;  ///< Inlay hints: the G in force for coordinates without G.
};

/// Reads the object `isocnc` of the editor's settings. Unknown or invalid members count as not set.
ClientSettings read_settings(const Json& settings);

/// The properties of the client on which answers depend. They do not change while a request is answered.
struct Client {
  Encoding encoding = Encoding::Utf16;
  Json capabilities = Json::object();       ///< ClientCapabilities, as the client sent them.
  std::optional<dialect::Language> locale;  ///< The language of the editor's own texts.
  ClientSettings settings;
  std::optional<dialect::Language> commanded;  ///< The language given on the server's command line.

  /// Whether a capability, such as `/textDocument/hover/dynamicRegistration`, is present and not false.
  bool can(const char* capability) const;
  /// A text in a format that the client supports; it lists them at `formats`, such as
  /// `/textDocument/hover/contentFormat`. For a client that supports only plain text, the marks of Markdown are
  /// removed.
  Json in_format(const Markdown& text, const char* formats) const;
  /// The language of texts about a program: the editor's setting, else the command line's, else that of the program's
  /// configuration, else the editor's own, else the environment's.
  dialect::Language language(std::optional<dialect::Language> configured) const;
};
using ClientPointer = std::shared_ptr<const Client>;

/// Reads the parameters of `initialize`: the client's capabilities, its preferred encoding, its locale and the settings
/// in its initializationOptions.
Client read_client(const Json& initialize_params);

}  // namespace isocnc::protocol
