#include "lsp/protocol/client.h"

#include <algorithm>
#include <string>

#include "interpreter/dialect/locale.h"
#include "interpreter/system/user_language.h"

namespace isocnc::protocol {

using dialect::Language;

/// The member of an object, or null.
static const Json& find(const Json& json, const char* key) {
  static const Json kNothing;
  if (!json.is_object()) return kNothing;
  const auto found = json.find(key);
  return found == json.end() ? kNothing : *found;
}

static std::string text_of(const Json& json) { return json.is_string() ? json.get<std::string>() : std::string(); }

static bool is_on(const Json& json) { return !json.is_boolean() || json.get<bool>(); }

static VerifyWhen read_verify(const Json& json) {
  const std::string when = text_of(json);
  if (when == "off") return VerifyWhen::Never;
  return when == "onSave" ? VerifyWhen::OnSave : VerifyWhen::OnPause;
}

ClientSettings read_settings(const Json& settings) {
  const Json& hints = find(settings, "inlayHints");
  return {.language = dialect::language_named(text_of(find(settings, "language"))),
          .checks_workspace = is_on(find(settings, "workspaceDiagnostics")),
          .verifies = read_verify(find(settings, "verify")),
          .shows_end_positions = is_on(find(hints, "endPosition")),
          .shows_section_times = is_on(find(hints, "sectionTime")),
          .shows_motion_in_force = is_on(find(hints, "motionInForce"))};
}

bool Client::can(const char* capability) const {
  const Json::json_pointer pointer(capability);
  if (!capabilities.contains(pointer)) return false;
  const Json& found = capabilities.at(pointer);
  return !found.is_null() && found != Json(false);
}

/// Removes the Markdown that the server writes: bold, code, and the escapes of in_markdown().
static std::string without_marks(const std::string& markdown) {
  std::string text;
  for (std::size_t i = 0; i < markdown.size(); ++i) {
    if (markdown[i] == '\\' && i + 1 < markdown.size()) {
      text += markdown[++i];
      continue;
    }
    const bool is_bold = markdown.compare(i, 2, "**") == 0;
    if (!is_bold && markdown[i] != '`') text += markdown[i];
    if (is_bold) ++i;
  }
  return text;
}

Json Client::in_format(const Markdown& text, const char* formats) const {
  const Json known = capabilities.value(Json::json_pointer(formats), Json());
  const bool is_markdown = !known.is_array() || std::find(known.begin(), known.end(), Json("markdown")) != known.end();
  if (is_markdown) return text;
  return {{"kind", "plaintext"}, {"value", without_marks(text.text)}};
}

Language Client::language(std::optional<Language> configured) const {
  if (settings.language) return *settings.language;
  if (commanded) return *commanded;
  if (configured) return *configured;
  return locale.value_or(system::user_language());
}

/// The first of the client's encodings that we support; UTF-16 if it lists none.
static Encoding best_encoding(const Json& capabilities) {
  const Json& wanted = find(find(capabilities, "general"), "positionEncodings");
  for (const Json& name : wanted.is_array() ? wanted : Json::array())
    if (const auto encoding = encoding_named(text_of(name))) return *encoding;
  return Encoding::Utf16;
}

Client read_client(const Json& initialize_params) {
  const Json& capabilities = find(initialize_params, "capabilities");
  Client client;
  if (capabilities.is_object()) client.capabilities = capabilities;
  client.encoding = best_encoding(capabilities);
  if (const std::string locale = text_of(find(initialize_params, "locale")); !locale.empty())
    client.locale = dialect::language_of_locale(locale);
  client.settings = read_settings(find(initialize_params, "initializationOptions"));
  return client;
}

}  // namespace isocnc::protocol
