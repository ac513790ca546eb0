#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "analyzer/formats/way_errors.h"
#include "interpreter/dialect/format.h"
#include "interpreter/restart/restart.h"
#include "lsp/extensions/extension.h"
#include "lsp/protocol/uri.h"

/// Restart: makes a new document, a program that resumes this one from a line.
namespace isocnc::extensions {

using dialect::Text;

static constexpr std::string_view kKind = "refactor.rewrite.isocnc.restart";

namespace {

struct RestartParams {
  std::size_t line = 0;  // The line to restart from, counted from 0 as in the whole protocol.
  std::optional<double> vgpl;
};

void from_json(const Json& json, RestartParams& params) {
  if (!json.at("line").is_number_unsigned()) throw Json::type_error::create(302, "the line is no line", &json);
  params.line = json.at("line");
  params.vgpl = protocol::member<double>(json, "vgpl");
}

/// The name of the file without its folder.
std::string name_of(const Snapshot& snapshot) {
  const std::string& uri = snapshot.uri();
  const auto path = protocol::path_of(uri);
  return path ? path->filename().generic_string() : uri.substr(uri.find_last_of("/:") + 1);
}

/// `part-from-120.iso` beside `part.iso`, with the line counted from 1.
std::string uri_of_restart(const std::string& uri, std::size_t line) {
  const std::size_t name = uri.find_last_of("/:") + 1;
  const std::size_t point = uri.find_last_of('.');
  const bool has_extension = point != std::string::npos && point > name;
  const std::size_t stem = has_extension ? point : uri.size();
  return fmt::format("{}-from-{}{}", uri.substr(0, stem), line + 1, uri.substr(stem));
}

/// The reason of the refusal, as a text for users.
std::string why_not(const restart::RestartRefusal& refusal, dialect::Language language) {
  static constexpr Text kError = {"the program stops at line {} with an error; correct it first",
                                  "il programma si ferma alla riga {} con un errore: va prima corretto"};
  if (refusal.obstacle == restart::RestartObstacle::ProgramError)
    return dialect::format(kError, language, refusal.run.line + 1);
  return message(refusal, language);
}

std::string restart_text(const Snapshot& snapshot, const RestartParams& params) {
  restart::RestartOptions options;
  options.run.setup = snapshot.setup();
  options.run.vgpl = params.vgpl.value_or(0);
  options.machine = snapshot.configuration().machine.timed;
  options.line = params.line;
  options.name = name_of(snapshot);
  options.language = snapshot.language();
  auto made = restart::restart_program(snapshot.document().text(), options);
  if (const auto* const refusal = std::get_if<restart::RestartRefusal>(&made))
    throw rpc::Error(rpc::ErrorCode::RequestFailed, why_not(*refusal, snapshot.language()));
  auto& program = std::get<std::string>(made);
  const std::shared_ptr<const verification::Scene> scene = snapshot.settings().scene();
  const std::string obstacle = formats::obstacle_on_the_way_there(
      program, snapshot.document().text(), options.run,
      {snapshot.configuration().machine.timed, scene.get(), snapshot.selection(), snapshot.language()});
  if (!obstacle.empty())
    throw rpc::Error(rpc::ErrorCode::RequestFailed, formats::restart_hits(options.line, obstacle, snapshot.language()));
  return std::move(program);
}

/// Whether the client can create documents by an edit.
bool makes_documents(const Client& client) {
  const Json operations =
      client.capabilities.value(Json::json_pointer("/workspace/workspaceEdit/resourceOperations"), Json::array());
  return client.can("/workspace/workspaceEdit/documentChanges") &&
         std::find(operations.begin(), operations.end(), Json("create")) != operations.end();
}

Json new_document(const std::string& uri, std::string text) {
  const Json nowhere = {{"line", 0}, {"character", 0}};
  const Json insertion = {{"range", {{"start", nowhere}, {"end", nowhere}}}, {"newText", std::move(text)}};
  return {{"documentChanges",
           {{{"kind", "create"}, {"uri", uri}},
            {{"textDocument", {{"uri", uri}, {"version", nullptr}}}, {"edits", Json::array({insertion})}}}}};
}

void offer_restart(const Snapshot& snapshot, const features::ActionParams& params,
                   std::vector<features::Action>& actions) {
  static constexpr Text kTitle = {"make a restart program from line {}",
                                  "creare un programma di ripresa dalla riga {}"};
  if (!makes_documents(snapshot.client()) || params.is_selection()) return;
  actions.push_back({.title = dialect::format(kTitle, snapshot.language(), params.first_line() + 1),
                     .kind = kKind,
                     .diagnostics = nullptr,
                     .data = {{"line", params.first_line()}}});
}

Json make(const Snapshot& snapshot, const Json& data) {
  const auto params = data.get<RestartParams>();
  return new_document(uri_of_restart(snapshot.uri(), params.line), restart_text(snapshot, params));
}

/// The edit that creates the document; for clients that cannot create documents, only its text.
Json restart_here(const Snapshot& snapshot, const RestartParams& params) {
  std::string text = restart_text(snapshot, params);
  if (!makes_documents(snapshot.client())) return {{"text", std::move(text)}};
  return {{"edit", new_document(uri_of_restart(snapshot.uri(), params.line), std::move(text))}};
}

}  // namespace

extern const features::Feature restart = {.commands = {on<&restart_here>("isocnc.restart")},
                                          .actions = {{.kind = kKind, .offer = offer_restart, .edit = make}}};

}  // namespace isocnc::extensions
