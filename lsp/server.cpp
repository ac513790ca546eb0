#include "lsp/server.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "interpreter/configuration/configurations.h"
#include "lsp/documents/uri.h"

namespace isocnc::lsp {

using documents::Client;
using rpc::Call;
using rpc::ErrorCode;
using rpc::Json;

/// The maximum number of threads, each for one busy document; further documents wait for a thread.
static constexpr std::size_t kMaxThreads = 32;

Server::Server(rpc::Loop& loop, rpc::Send send, std::optional<dialect::Language> language)
    : loop_(loop), send_(std::move(send)), language_(language), pool_(kMaxThreads) {
  for (const features::Feature* const feature : features::all_features()) {
    for (const features::Method& method : feature->methods) methods_[method.name] = method;
    for (const features::WorkspaceRequest& workspace_request : feature->workspace_requests)
      workspace_requests_[workspace_request.name] = workspace_request;
    for (const features::Method& command : feature->commands) commands_[command.name] = command;
  }
}

const std::unordered_map<std::string_view, Server::Handler>& Server::handlers() {
  static const std::unordered_map<std::string_view, Handler> kHandlers = {
      {"initialize", &Server::initialize},
      {"initialized", &Server::initialized},
      {"shutdown", &Server::shut_down},
      {"$/cancelRequest", &Server::cancel},
      {"$/setTrace", &Server::ignore},
      {"textDocument/didOpen", &Server::open},
      {"textDocument/didChange", &Server::edit},
      {"textDocument/didClose", &Server::close},
      {"textDocument/didSave", &Server::save},
      {"workspace/didChangeConfiguration", &Server::change_settings},
      {"workspace/didChangeWorkspaceFolders", &Server::change_folders},
      {"workspace/didChangeWatchedFiles", &Server::look_at_changed_files},
      {"workspace/executeCommand", &Server::execute_command},
  };
  return kHandlers;
}

void Server::receive(rpc::Frame frame) {
  switch (frame.problem) {
    case rpc::Frame::Problem::NoLength:
      return send_(rpc::error_message(nullptr, ErrorCode::ParseError, "a header tells no Content-Length"));
    case rpc::Frame::Problem::TooLong:
      return send_(rpc::error_message(nullptr, ErrorCode::ParseError, "the message is longer than any that is taken"));
    case rpc::Frame::Problem::None:
      break;
  }
  rpc::Message message = rpc::read_message(std::move(frame.body));
  if (const auto* const bad = std::get_if<rpc::BadMessage>(&message))
    return send_(rpc::error_message(bad->id, bad->error.code(), bad->error.what()));
  if (auto* const call = std::get_if<Call>(&message)) dispatch(std::make_shared<const Call>(std::move(*call)));
}

/// Whether the call is valid in the present phase; refuses a request that is not.
bool Server::is_allowed(const Call& call) {
  const bool is_initialize = call.method == "initialize";
  if (phase_ == Phase::Starting && !is_initialize) {
    refuse(call, ErrorCode::ServerNotInitialized, "initialize comes first");
    return false;
  }
  if (phase_ == Phase::ShutDown) {
    refuse(call, ErrorCode::InvalidRequest, "the server has been shut down");
    return false;
  }
  if (phase_ == Phase::Running && is_initialize) {
    refuse(call, ErrorCode::InvalidRequest, "the server is initialized already");
    return false;
  }
  return phase_ != Phase::Ended;
}

void Server::dispatch(const CallPointer& call) {
  if (call->method == "exit") return end();
  if (!is_allowed(*call)) return;
  try {
    const auto handler = handlers().find(call->method);
    if (handler != handlers().end()) return (this->*handler->second)(call);
    call_method(call);
  } catch (const Json::exception& error) {
    refuse(*call, ErrorCode::InvalidParams, error.what());
    if (call->is_notification()) log(fmt::format("{}: {}", call->method, error.what()));
  }
}

void Server::call_method(const CallPointer& call) {
  if (call->is_notification()) return;
  if (const auto method = methods_.find(call->method); method != methods_.end())
    return ask(method->second, call, call->params());
  if (const auto workspace_request = workspace_requests_.find(call->method);
      workspace_request != workspace_requests_.end())
    return ask_workspace(workspace_request->second, call);
  refuse(*call, ErrorCode::MethodNotFound, fmt::format("there is no method {}", call->method));
}

// --- Lifecycle

/// The server's capabilities: its own part and that of each feature.
static Json capabilities_for(const Client& client) {
  Json all = {{"positionEncoding", documents::name_of(client.encoding)},
              {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", {{"includeText", false}}}}},
              {"workspace", {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}}}}};
  Json commands = Json::array();
  for (const features::Feature* const feature : features::all_features()) {
    if (feature->capabilities) all.update(feature->capabilities(client), true);
    for (const features::Method& command : feature->commands) commands.push_back(command.name);
  }
  if (!commands.empty()) all["executeCommandProvider"] = {{"commands", commands}};
  return all;
}

/// The folders in the parameters of `initialize`; older clients send a single folder.
static std::set<std::string> folders_in(const Json& params) {
  std::set<std::string> folders;
  for (const Json& folder : documents::member<Json>(params, "workspaceFolders").value_or(Json::array()))
    folders.insert(folder.at("uri").get<std::string>());
  if (const auto root = documents::member<std::string>(params, "rootUri"); root && !params.contains("workspaceFolders"))
    folders.insert(*root);
  return folders;
}

void Server::initialize(const CallPointer& call) {
  if (call->is_notification()) return;
  const Json& params = call->params();
  Client client = documents::read_client(params);
  client.commanded = language_;
  folders_ = folders_in(params);
  client_ = std::make_shared<const Client>(std::move(client));
  if (const auto parent = params.find("processId"); parent != params.end() && parent->is_number_integer())
    parent_ = *parent;
  phase_ = Phase::Running;
  reply(*call, {{"capabilities", capabilities_for(*client_)},
                {"serverInfo", {{"name", "isols"}, {"version", ISOCNC_VERSION}}}});
}

void Server::initialized(const CallPointer&) {
  if (!client_->can("/workspace/didChangeWatchedFiles/dynamicRegistration")) return;
  const Json watcher = {{"globPattern", fmt::format("**/{}", configuration::kFileName)}};
  const Json registration = {{"id", "configuration files"},
                             {"method", "workspace/didChangeWatchedFiles"},
                             {"registerOptions", {{"watchers", Json::array({watcher})}}}};
  request("client/registerCapability", {{"registrations", Json::array({registration})}});
}

void Server::shut_down(const CallPointer& call) {
  if (call->is_notification()) return;
  phase_ = Phase::ShutDown;
  reply(*call, nullptr);
}

void Server::end() {
  if (phase_ == Phase::Ended) return;
  exit_status_ = phase_ == Phase::ShutDown ? 0 : 1;
  phase_ = Phase::Ended;
  for (const auto& [id, cancel_flag] : cancel_flags_) cancel_flag->store(true);
  loop_.stop();
}

void Server::idle() {
  if (parent_ > 0 && ::kill(parent_, 0) != 0 && errno == ESRCH) end();
}

void Server::cancel(const CallPointer& call) {
  const Json& id = call->params().at("id");
  const auto found = cancel_flags_.find(rpc::write(id));
  if (found == cancel_flags_.end()) return;
  found->second->store(true);
  cancel_flags_.erase(found);
  send_(rpc::error_message(id, ErrorCode::RequestCancelled, "the request has been cancelled"));
}

// --- Documents

features::Notify Server::notifier_of(const std::string& uri, std::size_t generation) {
  return [this, uri, generation](std::string_view method, const std::string& params) {
    loop_.post([this, uri, generation, body = rpc::notification_message(method, params)]() mutable {
      const auto found = open_documents_.find(uri);
      if (found != open_documents_.end() && found->second.generation == generation) send_(std::move(body));
    });
  };
}

void Server::open(const CallPointer& call) {
  const Json& document = call->params().at("textDocument");
  const std::string uri = document.at("uri");
  if (!document.at("text").is_string()) throw Json::type_error::create(302, "the text is no string", &document);
  const std::size_t generation = ++generations_;
  const auto tell_configuration = [this](const std::string& file, const std::string& params) {
    loop_.post([this, file, params] { report_configuration(file, params); });
  };
  Opened& opened = open_documents_[uri];
  const auto tell_progress = [this, generation](const std::string& work, const std::optional<std::string>& title) {
    loop_.post([this, token = fmt::format("{} of {}", work, generation), title] { report_progress(token, title); });
  };
  opened = {std::make_shared<OpenDocument>(
                pool_, settings_, uri,
                OpenDocument::Notifier{notifier_of(uri, generation), tell_configuration, tell_progress}),
            generation};
  opened.document->open(call, client_);
}

void Server::report_progress(const std::string& token, const std::optional<std::string>& title) {
  if (title) request("window/workDoneProgress/create", {{"token", token}});
  const Json value = title ? Json{{"kind", "begin"}, {"title", *title}, {"cancellable", false}} : Json{{"kind", "end"}};
  notify("$/progress", rpc::write({{"token", token}, {"value", value}}));
}

/// For a configuration that the editor has open, its OpenDocument reports the diagnostics.
void Server::report_configuration(const std::string& uri, const std::string& params) {
  if (open_documents_.contains(uri)) return;
  reported_configurations_.insert(uri);
  notify("textDocument/publishDiagnostics", params);
}

/// The document's URI in items that clients send back: code lenses, completion items.
static const Json::json_pointer kPlaceInData("/data/uri");

OpenDocument* Server::find_document(const Json& params) const {
  if (!params.is_object()) return nullptr;
  static const Json::json_pointer kPlaces[] = {Json::json_pointer("/textDocument/uri"), kPlaceInData,
                                               Json::json_pointer("/item/data/uri"), Json::json_pointer("/uri")};
  for (const Json::json_pointer& place : kPlaces) {
    if (!params.contains(place) || !params.at(place).is_string()) continue;
    const auto found = open_documents_.find(params.at(place).get_ref<const std::string&>());
    return found == open_documents_.end() ? nullptr : found->second.document.get();
  }
  return nullptr;
}

void Server::edit(const CallPointer& call) {
  if (OpenDocument* const document = find_document(call->params())) document->edit(call, client_);
}

void Server::close(const CallPointer& call) {
  OpenDocument* const document = find_document(call->params());
  if (!document) return;
  const std::string uri = document->uri();
  const bool is_configuration = document->is_configuration();
  document->close();
  open_documents_.erase(uri);
  if (is_configuration) {
    // From now on the text of the file counts, not that of the editor.
    reported_configurations_.insert(uri);
    return reconfigure_all();
  }
  for (const features::Feature* const feature : features::all_features())
    if (feature->closed)
      feature->closed(uri, *client_,
                      [&](std::string_view method, const std::string& params) { notify(method, params); });
}

void Server::save(const CallPointer& call) {
  const Json& params = call->params();
  if (documents::names_configuration(params.at("textDocument").at("uri").get<std::string>())) reconfigure_all();
}

// --- Workspace

void Server::change_folders(const CallPointer& call) {
  const Json& event = call->params().at("event");
  for (const Json& folder : event.at("removed")) folders_.erase(folder.at("uri").get<std::string>());
  for (const Json& folder : event.at("added")) folders_.insert(folder.at("uri").get<std::string>());
}

void Server::change_settings(const CallPointer& call) {
  const Json& params = call->params();
  Client changed = *client_;
  const Json settings = params.is_object() && params.contains("settings") ? params["settings"] : Json();
  changed.settings = documents::read_settings(settings.is_object() ? settings.value("isocnc", settings) : settings);
  client_ = std::make_shared<const Client>(std::move(changed));
  reconfigure_documents();
}

void Server::look_at_changed_files(const CallPointer& call) {
  for (const Json& change : call->params().at("changes"))
    if (documents::names_configuration(change.at("uri").get<std::string>())) return reconfigure_all();
}

void Server::reconfigure_all() {
  settings_.forget();
  // Findings that still exist are reported again.
  for (const std::string& uri : std::exchange(reported_configurations_, {}))
    if (!open_documents_.contains(uri))
      notify("textDocument/publishDiagnostics", rpc::write({{"uri", uri}, {"diagnostics", Json::array()}}));
  reconfigure_documents();
}

/// Updates the documents and asks the editor to repeat its requests, since earlier answers may be outdated.
void Server::reconfigure_documents() {
  for (const auto& [uri, opened] : open_documents_) opened.document->reconfigure(client_);
  for (const features::Feature* const feature : features::all_features())
    if (feature->refresh && client_->can(feature->refresh->capability)) request(feature->refresh->method, nullptr);
}

/// The first argument names the document. If the result has an edit, the client is asked to apply it.
void Server::execute_command(const CallPointer& call) {
  const Json& params = call->params();
  const std::string name = params.at("command");
  const auto command = commands_.find(name);
  if (command == commands_.end())
    return refuse(*call, ErrorCode::InvalidParams, fmt::format("there is no command {}", name));
  const Json arguments = params.value("arguments", Json::array());
  ask(command->second, call, arguments.empty() ? Json::object() : arguments.at(0), [this, name](std::string result) {
    const Json json = Json::parse(result, nullptr, false);
    if (!json.is_object() || !json.contains("edit")) return result;
    request("workspace/applyEdit", {{"label", name}, {"edit", json["edit"]}});
    return std::string("null");
  });
}

// --- Requests

Server::CancelFlag Server::begin(const Call& call) {
  auto cancel_flag = std::make_shared<std::atomic<bool>>(false);
  if (cancel_flags_.try_emplace(rpc::write(*call.id), cancel_flag).second) return cancel_flag;
  refuse(call, ErrorCode::InvalidRequest, "a request with this id has no answer yet");
  return nullptr;
}

void Server::finish(const Json& id, const CancelFlag& cancel_flag, std::string body) {
  const auto found = cancel_flags_.find(rpc::write(id));
  if (found == cancel_flags_.end() || found->second != cancel_flag) return;  // Cancelled, and so answered.
  cancel_flags_.erase(found);
  send_(std::move(body));
}

void Server::ask(const features::Method& method, const CallPointer& call, Json params,
                 const std::function<std::string(std::string)>& finish_result) {
  if (call->is_notification()) return;
  OpenDocument* const document = find_document(params);
  if (!document && method.serves_closed) return ask_closed(method, call, params.at("textDocument").at("uri"));
  if (document && document->is_configuration() && !method.of_configuration.empty())
    return send_(rpc::result_message(*call->id, method.of_configuration));
  if (!document || document->is_configuration()) {
    // The client may send back an item of a document that has just been closed: that is not an error of the client.
    const bool is_of_ours = params.is_object() && params.contains(kPlaceInData);
    return refuse(*call, is_of_ours ? ErrorCode::ContentModified : ErrorCode::InvalidParams,
                  "this document is not open");
  }
  const CancelFlag cancel_flag = begin(*call);
  if (!cancel_flag) return;
  const Json id = *call->id;
  const auto done = [this, id, cancel_flag, finish_result](std::string result) {
    std::string body = finish_result ? std::string() : rpc::result_message(id, result);
    loop_.post([this, id, cancel_flag, finish_result, result = finish_result ? std::move(result) : std::string(),
                body = std::move(body)]() mutable {
      finish(id, cancel_flag,
             finish_result ? rpc::result_message(id, finish_result(std::move(result))) : std::move(body));
    });
  };
  const auto failed = [this, id, cancel_flag](const rpc::Error& error) {
    loop_.post([this, id, cancel_flag, body = rpc::error_message(id, error.code(), error.what())] {
      finish(id, cancel_flag, body);
    });
  };
  document->ask(method, std::move(params), client_, cancel_flag, done, failed);
}

std::vector<std::filesystem::path> Server::folders_of_workspace() const {
  std::vector<std::filesystem::path> folders;
  for (const std::string& uri : folders_)
    if (const auto path = documents::path_of(uri)) folders.push_back(*path);
  return folders;
}

/// Reads only files in the folders that the user has opened, whatever file the message names.
void Server::ask_closed(const features::Method& method, const CallPointer& call, const std::string& uri) {
  if (documents::names_configuration(uri)) return send_(rpc::result_message(*call->id, method.of_configuration));
  const CancelFlag cancel_flag = begin(*call);
  if (!cancel_flag) return;
  closed_programs_.ask_one(
      method, call->params(), uri, folders_of_workspace(), client_, cancel_flag,
      [this, id = *call->id, cancel_flag](const std::optional<std::string>& result) {
        // The file may just have been closed or removed, which is not worth a message to the user.
        loop_.post([this, id, cancel_flag,
                    body = result ? rpc::result_message(id, *result)
                                  : rpc::error_message(id, ErrorCode::ContentModified,
                                                       "there is no such program in the workspace")] {
          finish(id, cancel_flag, body);
        });
      });
}

/// Collects the results of all programs as they arrive.
struct Server::Aggregate {
  std::vector<std::string> results;
  std::size_t awaited = 0;
};

/// Joins JSON arrays into one.
static std::string joined(const std::vector<std::string>& arrays) {
  std::string all = "[";
  for (const std::string& array : arrays) {
    const std::string_view items = std::string_view(array).substr(1, array.size() - 2);
    if (items.empty()) continue;
    if (all.size() > 1) all += ',';
    all += items;
  }
  return all + "]";
}

/// A function that sends each program's result as soon as it is known; empty if the client has given no token for
/// partial results.
std::function<void(const std::string& result)> Server::partial_result_notifier(
    const features::WorkspaceRequest& workspace_request, const CallPointer& call, const CancelFlag& cancel_flag) {
  const auto token = documents::member<Json>(call->params(), "partialResultToken");
  if (!token) return {};
  return [this, workspace_request, call, cancel_flag, token = *token](const std::string& result) {
    if (result == "[]") return;
    std::string part;
    try {
      part = workspace_request.combine(result, call->params(), features::AggregateScope::Some);
    } catch (const Json::exception&) {
      return;  // The error in the parameters is reported with the final answer.
    }
    std::string params = fmt::format(R"({{"token":{},"value":{}}})", rpc::write(token), part);
    loop_.post([this, cancel_flag, params = std::move(params)] {
      if (!cancel_flag->load()) notify("$/progress", params);
    });
  };
}

void Server::ask_workspace(const features::WorkspaceRequest& workspace_request, const CallPointer& call) {
  const CancelFlag cancel_flag = begin(*call);
  if (!cancel_flag) return;
  const Json id = *call->id;
  const auto aggregate = std::make_shared<Aggregate>();
  const auto report_part = partial_result_notifier(workspace_request, call, cancel_flag);
  std::set<std::string> open;
  for (const auto& [uri, opened] : open_documents_)
    if (!opened.document->is_configuration()) open.insert(uri);
  aggregate->awaited = open.size() + 1;
  const auto combine = [this, id, cancel_flag, aggregate, workspace_request, call,
                        is_reported = static_cast<bool>(report_part)] {
    // Runs in the pool, since the results may be long.
    pool_.post([this, id, cancel_flag, aggregate, workspace_request, call, is_reported] {
      std::string body;
      try {
        body = rpc::result_message(id, workspace_request.combine(joined(aggregate->results), call->params(),
                                                                 is_reported ? features::AggregateScope::Rest
                                                                             : features::AggregateScope::All));
      } catch (const Json::exception& error) {
        body = rpc::error_message(id, ErrorCode::InvalidParams, error.what());
      }
      loop_.post(
          [this, id, cancel_flag, body = std::move(body)]() mutable { finish(id, cancel_flag, std::move(body)); });
    });
  };
  const auto take = [this, aggregate, combine](std::vector<std::string> results) {
    loop_.post([aggregate, combine, results = std::move(results)]() mutable {
      std::move(results.begin(), results.end(), std::back_inserter(aggregate->results));
      if (--aggregate->awaited == 0) combine();
    });
  };
  const auto take_one = [take, report_part](std::string result) {
    if (report_part) report_part(result);
    take({std::move(result)});
  };
  const features::Method method = {
      .name = workspace_request.name, .answer = workspace_request.answer, .begin = nullptr};
  for (const std::string& uri : open)
    // A document that is being edited gives no results.
    open_documents_[uri].document->ask(method, call->params(), client_, cancel_flag, take_one,
                                       [take](const rpc::Error&) { take({}); });
  closed_programs_.ask({.request = workspace_request,
                        .take_one = report_part,
                        .folders = folders_of_workspace(),
                        .open = std::move(open),
                        .client = client_,
                        .cancelled = cancel_flag},
                       take);
}

// --- Messages

void Server::reply(const Call& call, const Json& result) {
  if (call.id) send_(rpc::result_message(*call.id, rpc::write(result)));
}

void Server::refuse(const Call& call, ErrorCode code, const std::string& message) {
  if (call.id) send_(rpc::error_message(*call.id, code, message));
}

void Server::notify(std::string_view method, const std::string& params) {
  send_(rpc::notification_message(method, params));
}

void Server::request(std::string_view method, const Json& params) {
  send_(rpc::request_message(next_request_++, method, params.is_null() ? std::string() : rpc::write(params)));
}

void Server::log(const std::string& message) {
  notify("window/logMessage", rpc::write({{"type", 1}, {"message", message}}));
}

}  // namespace isocnc::lsp
