#include "lsp/server.h"

#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "interpreter/configuration/configurations.h"
#include "interpreter/system/process.h"
#include "lsp/workspace_aggregate.h"

namespace isocnc::lsp {

using protocol::Client;
using rpc::Call;
using rpc::ErrorCode;
using rpc::Json;

/// The maximum number of threads, each for one busy document; further documents wait for a thread.
static constexpr std::size_t kMaxThreads = 32;

Server::Server(rpc::Loop& loop, rpc::Send send, std::optional<dialect::Language> language,
               background::VerificationOptions verification)
    : loop_(loop),
      outbox_(std::move(send)),
      language_(language),
      open_documents_(loop_, pool_, settings_, outbox_, std::move(verification)),
      pool_(loop, kMaxThreads) {
  for (const features::Feature* const feature : all_features()) {
    for (const features::Method& method : feature->methods) methods_[method.name] = method;
    for (const features::WorkspaceRequest& workspace_request : feature->workspace_requests)
      workspace_requests_[workspace_request.name] = workspace_request;
    for (const features::Method& command : feature->commands) commands_[command.name] = command;
    for (const features::Method& text : feature->texts) texts_[text.name] = text;
  }
}

const std::unordered_map<std::string_view, Server::Handler>& Server::handlers() {
  static const std::unordered_map<std::string_view, Handler> kHandlers = {
      {"initialize", &Server::initialize},
      {"initialized", &Server::initialized},
      {"shutdown", &Server::shut_down},
      {"$/cancelRequest", &Server::cancel},
      {"$/setTrace", &Server::ignore},
      {"window/workDoneProgress/cancel", &Server::cancel_progress},
      {"textDocument/didOpen", &Server::open},
      {"textDocument/didChange", &Server::edit},
      {"textDocument/didClose", &Server::close},
      {"textDocument/didSave", &Server::save},
      {"workspace/didChangeConfiguration", &Server::change_settings},
      {"workspace/didChangeWorkspaceFolders", &Server::change_folders},
      {"workspace/didChangeWatchedFiles", &Server::look_at_changed_files},
      {"workspace/executeCommand", &Server::execute_command},
      {"workspace/textDocumentContent", &Server::write_text},
  };
  return kHandlers;
}

void Server::receive(rpc::MessageFrame frame) {
  switch (frame.error) {
    case rpc::MessageFrame::FramingError::NoLength:
      return outbox_.send(rpc::error_message(nullptr, ErrorCode::ParseError, "a header has no Content-Length"));
    case rpc::MessageFrame::FramingError::TooLong:
      return outbox_.send(
          rpc::error_message(nullptr, ErrorCode::ParseError, "the message is longer than any that is taken"));
    case rpc::MessageFrame::FramingError::None:
      break;
  }
  rpc::Message message = rpc::read_message(std::move(frame.body));
  if (const auto* const bad = std::get_if<rpc::BadMessage>(&message))
    return outbox_.send(rpc::error_message(bad->id, bad->error.code(), bad->error.what()));
  if (auto* const call = std::get_if<Call>(&message)) dispatch(std::make_shared<const Call>(std::move(*call)));
}

/// Whether the call is valid in the present phase; refuses a request that is not.
bool Server::is_allowed(const Call& call) {
  const bool is_initialize = call.method == "initialize";
  if (phase_ == LifecyclePhase::Starting && !is_initialize) {
    outbox_.refuse(call, ErrorCode::ServerNotInitialized, "initialize comes first");
    return false;
  }
  if (phase_ == LifecyclePhase::ShutDown) {
    outbox_.refuse(call, ErrorCode::InvalidRequest, "the server has been shut down");
    return false;
  }
  if (phase_ == LifecyclePhase::Running && is_initialize) {
    outbox_.refuse(call, ErrorCode::InvalidRequest, "the server is initialized already");
    return false;
  }
  return phase_ != LifecyclePhase::Ended;
}

void Server::dispatch(const rpc::CallPointer& call) {
  if (call->method == "exit") return end();
  if (!is_allowed(*call)) return;
  try {
    const auto handler = handlers().find(call->method);
    if (handler != handlers().end()) return (this->*handler->second)(call);
    call_method(call);
  } catch (const Json::exception& error) {
    outbox_.refuse(*call, ErrorCode::InvalidParams, error.what());
    if (call->is_notification()) outbox_.log(fmt::format("{}: {}", call->method, error.what()));
  }
}

static rpc::OnWorker<std::string> answerer(const PendingRequest& request) {
  return rpc::OnWorker<std::string>([request](const std::string& result) { request.answer(result); });
}

static rpc::OnWorker<rpc::Error> failer(const PendingRequest& request) {
  return rpc::OnWorker<rpc::Error>([request](const rpc::Error& error) { request.fail(error); });
}

void Server::call_method(const rpc::CallPointer& call) {
  if (call->is_notification()) return;
  if (const auto method = methods_.find(call->method); method != methods_.end())
    return ask(method->second, call, call->params(), answerer);
  if (const auto workspace_request = workspace_requests_.find(call->method);
      workspace_request != workspace_requests_.end())
    return ask_workspace(workspace_request->second, call);
  outbox_.refuse(*call, ErrorCode::MethodNotFound, fmt::format("there is no method {}", call->method));
}

// --- Lifecycle

/// The command that shows a text about a program: the server's own, since the text belongs to some feature.
static constexpr const char* kShowText = "isocnc.showText";

/// The server's capabilities: its own part and that of each feature.
static Json capabilities_for(const Client& client) {
  Json all = {{"positionEncoding", protocol::name_of(client.encoding)},
              {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", {{"includeText", false}}}}},
              {"workspace",
               {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}},
                {"textDocumentContent", {{"schemes", Json::array({protocol::kTextScheme})}}}}}};
  Json commands = Json::array({kShowText});
  for (const features::Feature* const feature : all_features()) {
    if (feature->capabilities) all.update(feature->capabilities(client), true);
    for (const features::Method& command : feature->commands) commands.push_back(command.name);
  }
  all["executeCommandProvider"] = {{"commands", commands}};
  return all;
}

/// The folders in the parameters of `initialize`; older clients send a single folder.
static std::set<std::string> folders_in(const Json& params) {
  std::set<std::string> folders;
  for (const Json& folder : protocol::member<Json>(params, "workspaceFolders").value_or(Json::array()))
    folders.insert(folder.at("uri").get<std::string>());
  if (const auto root = protocol::member<std::string>(params, "rootUri"); root && !params.contains("workspaceFolders"))
    folders.insert(*root);
  return folders;
}

void Server::initialize(const rpc::CallPointer& call) {
  if (call->is_notification()) return;
  const Json& params = call->params();
  Client client = protocol::read_client(params);
  client.commanded = language_;
  folders_ = folders_in(params);
  client_ = std::make_shared<const Client>(std::move(client));
  if (const auto parent = params.find("processId"); parent != params.end() && parent->is_number_integer())
    parent_ = *parent;
  phase_ = LifecyclePhase::Running;
  outbox_.reply(*call, {{"capabilities", capabilities_for(*client_)},
                        {"serverInfo", {{"name", "isols"}, {"version", ISOCNC_VERSION}}}});
}

void Server::initialized(const rpc::CallPointer&) { watch_files(); }

/// Programs are watched for a client that would pull their diagnostics again.
void Server::watch_files() {
  if (!client_->can("/workspace/didChangeWatchedFiles/dynamicRegistration")) return;
  posted_programs_.watch(folders_of_workspace(),
                         client_->settings.checks_workspace && client_->can("/workspace/diagnostics/refreshSupport"));
}

void Server::shut_down(const rpc::CallPointer& call) {
  if (call->is_notification()) return;
  phase_ = LifecyclePhase::ShutDown;
  // A client that sends `exit` at once would wait for their answers in vain.
  pending_requests_.refuse_all();
  outbox_.reply(*call, nullptr);
}

void Server::end() {
  if (phase_ == LifecyclePhase::Ended) return;
  exit_status_ = phase_ == LifecyclePhase::ShutDown ? 0 : 1;
  phase_ = LifecyclePhase::Ended;
  pending_requests_.cancel_all();
  open_documents_.stop_verifications();
  loop_.stop();
}

void Server::idle() {
  if (parent_ > 0 && !system::is_running(parent_)) end();
}

void Server::cancel(const rpc::CallPointer& call) { pending_requests_.cancel(call->params().at("id")); }

void Server::cancel_progress(const rpc::CallPointer& call) {
  open_documents_.cancel_progress(call->params().at("token"));
}

// --- Documents

void Server::open(const rpc::CallPointer& call) {
  open_documents_.open(call, client_);
  // A text may be shown from before the program was closed.
  refresh_texts_about(call->params().at("textDocument").at("uri"));
}

void Server::edit(const rpc::CallPointer& call) {
  OpenDocument* const document = open_documents_.find(call->params());
  if (!document) return;
  document->edit(call, client_);
  refresh_texts_about(std::string(document->uri()));
}

void Server::close(const rpc::CallPointer& call) {
  const OpenDocument* const document = open_documents_.find(call->params());
  if (!document) return;
  const bool is_configuration = document->is_configuration();
  open_documents_.close(std::string(document->uri()), *client_);
  if (is_configuration) reconfigure_all();
}

void Server::save(const rpc::CallPointer& call) {
  const Json& params = call->params();
  if (protocol::names_configuration(params.at("textDocument").at("uri").get<std::string>())) return reconfigure_all();
  if (OpenDocument* const document = open_documents_.find(params)) document->save(client_);
}

// --- Workspace

void Server::change_folders(const rpc::CallPointer& call) {
  const Json& event = call->params().at("event");
  for (const Json& folder : event.at("removed")) folders_.erase(folder.at("uri").get<std::string>());
  for (const Json& folder : event.at("added")) folders_.insert(folder.at("uri").get<std::string>());
  watch_files();
}

void Server::change_settings(const rpc::CallPointer& call) {
  const Json& params = call->params();
  Client changed = *client_;
  const Json settings = params.is_object() && params.contains("settings") ? params["settings"] : Json();
  changed.settings = protocol::read_settings(settings.is_object() ? settings.value("isocnc", settings) : settings);
  changed.settings.checks_workspace = client_->settings.checks_workspace;  // As at the start.
  client_ = std::make_shared<const Client>(std::move(changed));
  reconfigure_all();  // The mistakes in configurations have another language, too.
}

void Server::look_at_changed_files(const rpc::CallPointer& call) {
  std::vector<std::string> files;
  for (const Json& change : call->params().at("changes")) files.push_back(change.at("uri"));
  const auto describes_programs = [](const std::string& uri) {
    return protocol::names_configuration(uri) || protocol::names_shape(uri);
  };
  if (std::erase_if(files, describes_programs) > 0) reconfigure_all();
  posted_programs_.note_changes(files);
}

void Server::reconfigure_all() {
  settings_.forget();
  open_documents_.withdraw_configuration_diagnostics();
  reconfigure_documents();
  watch_files();
}

/// Updates the documents and asks the editor to repeat its requests, since earlier answers may be outdated.
void Server::reconfigure_documents() {
  open_documents_.reconfigure(client_);
  refresh([](const features::Refresh&) { return true; });
  std::vector<std::string> programs;
  for (const auto& [program, texts] : current_texts_) programs.push_back(program);
  for (const std::string& program : programs) refresh_texts_about(program);
}

void Server::refresh(const std::function<bool(const features::Refresh&)>& is_needed) {
  for (const features::Feature* const feature : all_features())
    if (feature->refresh && is_needed(*feature->refresh) && client_->can(feature->refresh->capability))
      outbox_.request(feature->refresh->method, nullptr);
}

/// The first argument names the document. If the result has an edit, the client is asked to apply it.
void Server::execute_command(const rpc::CallPointer& call) {
  const Json& params = call->params();
  const std::string name = params.at("command");
  const Json arguments = params.value("arguments", Json::array());
  const Json argument = arguments.empty() ? Json::object() : arguments.at(0);
  if (name == kShowText) return show_text(call, argument);
  const auto command = commands_.find(name);
  if (command == commands_.end())
    return outbox_.refuse(*call, ErrorCode::InvalidParams, fmt::format("there is no command {}", name));
  ask(command->second, call, argument,
      [this, name](const PendingRequest& request) { return rpc::OnWorker<std::string>(edit_applier(name, request)); });
}

rpc::OnLoop<std::string> Server::edit_applier(const std::string& command, const PendingRequest& request) {
  return {loop_, [this, command, request](const std::string& result) {
            const Json json = Json::parse(result, nullptr, false);
            if (!json.is_object() || !json.contains("edit")) return request.answer(result);
            outbox_.request("workspace/applyEdit", {{"label", command}, {"edit", json["edit"]}});
            request.answer("null");
          }};
}

// --- Texts about programs

/// The maximum number of texts about one program that are kept up to date: more than a client shows.
static constexpr std::size_t kMaxTexts = 100;

void Server::write_text(const rpc::CallPointer& call) {
  if (call->is_notification()) return;
  const std::string uri = call->params().at("uri");
  const std::optional<protocol::TextAboutProgram> text = protocol::read_text_uri(uri);
  if (!text) return outbox_.refuse(*call, ErrorCode::InvalidParams, "the URI names no text about a program");
  if (open_documents_.contains(text->program) && client_->can("/workspace/textDocumentContent")) {
    std::set<std::string>& texts = current_texts_[text->program];
    if (texts.size() == kMaxTexts) texts.erase(texts.begin());
    texts.insert(uri);
  }
  ask_for_text(*text, call, answerer);
}

void Server::ask_for_text(const protocol::TextAboutProgram& text, const rpc::CallPointer& call,
                          const TakerOf& taker_of) {
  const auto method = texts_.find(text.kind);
  if (method == texts_.end())
    return outbox_.refuse(*call, ErrorCode::InvalidParams, fmt::format("there is no text {}", text.kind));
  Json params = {{"textDocument", {{"uri", text.program}}}};
  if (text.line) params["line"] = *text.line;
  ask(method->second, call, std::move(params), taker_of);
}

/// What is shown is written first, so that what cannot be written is refused. A client that cannot show documents of
/// the server gets the text itself.
void Server::show_text(const rpc::CallPointer& call, const Json& argument) {
  protocol::TextAboutProgram text = {.kind = argument.at("text"), .program = argument.at("uri"), .line = {}};
  if (const auto line = argument.find("line"); line != argument.end())  // Valid as that of a position is.
    text.line = Json{{"line", *line}, {"character", 0u}}.get<protocol::ClientPosition>().line;
  const bool is_shown = client_->can("/workspace/textDocumentContent") && client_->can("/window/showDocument/support");
  if (!is_shown) return ask_for_text(text, call, answerer);
  const std::string uri = protocol::uri_of(text);
  ask_for_text(text, call, [this, uri](const PendingRequest& request) {
    return rpc::OnWorker<std::string>(rpc::OnLoop<std::string>(loop_, [this, uri, request](const std::string&) {
      outbox_.request("window/showDocument", {{"uri", uri}, {"takeFocus", false}});
      request.answer("null");
    }));
  });
}

void Server::refresh_texts_about(const std::string& program) {
  const auto found = current_texts_.find(program);
  if (found == current_texts_.end()) return;
  const std::set<std::string> outdated = std::move(found->second);
  current_texts_.erase(found);
  for (const std::string& uri : outdated) outbox_.request("workspace/textDocumentContent/refresh", {{"uri", uri}});
}

// --- Requests

void Server::ask(const features::Method& method, const rpc::CallPointer& call, Json params, const TakerOf& taker_of) {
  if (call->is_notification()) return;
  OpenDocument* const document = open_documents_.find(params);
  if (!document && method.serves_closed) return ask_closed(method, call, params.at("textDocument").at("uri"));
  const bool is_of_protocol = method.name.starts_with("textDocument/");
  if (document && document->is_configuration() && (is_of_protocol || !method.of_configuration.empty()))
    return outbox_.send(
        rpc::result_message(*call->id, method.of_configuration.empty() ? "null" : method.of_configuration));
  if (!document || document->is_configuration()) {
    // The client may send back an item of a document that has just been closed: that is not an error of the client.
    const ErrorCode code = is_item_of_ours(params) ? ErrorCode::ContentModified : ErrorCode::InvalidParams;
    return outbox_.refuse(*call, code, "this document is not open");
  }
  if (const auto request = pending_requests_.add(*call))
    document->ask(method, call, std::move(params), client_,
                  {request->cancel_flag(), taker_of(*request), failer(*request)});
}

ClosedPrograms::Folders Server::folders_of_workspace() const {
  ClosedPrograms::Folders folders;
  for (const std::string& uri : folders_)
    if (const auto path = protocol::path_of(uri)) folders.push_back(*path);
  return folders;
}

/// Reads only files in the folders that the user has opened, whatever file the message names.
void Server::ask_closed(const features::Method& method, const rpc::CallPointer& call, const std::string& uri) {
  if (protocol::names_configuration(uri)) return outbox_.send(rpc::result_message(*call->id, method.of_configuration));
  const auto request = pending_requests_.add(*call);
  if (!request) return;
  closed_programs_.post([method, call, uri, folders = folders_of_workspace(), client = client_,
                         request = *request](ClosedPrograms& programs) {
    const auto result = programs.answer_of(method, call->params(), uri, folders, *client, *request.cancel_flag());
    if (result) return request.answer(*result);
    // The file may just have been closed or removed, which is not worth a message to the user.
    request.fail(rpc::Error(ErrorCode::ContentModified, "there is no such program in the workspace"));
  });
}

void Server::ask_workspace(const features::WorkspaceRequest& workspace_request, const rpc::CallPointer& call) {
  const auto request = pending_requests_.add(*call);
  if (!request) return;
  const std::vector<OpenDocument*> open = open_documents_.programs();
  const auto aggregate = std::make_shared<WorkspaceAggregate>(workspace_request, call, *request, open.size() + 1);
  const auto report_part = aggregate->part_notifier(loop_, outbox_);
  const auto take = aggregate->taker(loop_, pool_);
  const rpc::OnWorker<std::string> take_one([take, report_part](std::string result) {
    if (report_part) (*report_part)(result);
    take({std::move(result)});
  });
  // A document that is being edited gives no results.
  const rpc::OnWorker<rpc::Error> take_none([take](const rpc::Error&) { take({}); });
  const features::Method method = {
      .name = workspace_request.name, .answer = workspace_request.answer, .begin = nullptr};
  ClosedPrograms::WorkspaceQuery query = {.request = workspace_request,
                                          .take_one = report_part,
                                          .folders = folders_of_workspace(),
                                          .open = {},
                                          .unsettled = posted_programs_.unsettled(),
                                          .client = client_,
                                          .cancelled = request->cancel_flag()};
  for (OpenDocument* const document : open) {
    query.open.insert(document->uri());
    document->ask(method, call, call->params(), client_, {request->cancel_flag(), take_one, take_none});
  }
  closed_programs_.post([query = std::move(query), take](ClosedPrograms& programs) {
    if (auto results = programs.answers(query)) take(std::move(*results));
  });
}

}  // namespace isocnc::lsp
