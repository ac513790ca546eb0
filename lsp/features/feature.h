#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "lsp/documents/snapshot.h"
#include "lsp/protocol/protocol.h"
#include "lsp/rpc/message.h"

namespace isocnc::features {

using documents::Snapshot;
using protocol::Client;
using protocol::ClientPosition;
using protocol::ClientRange;
using rpc::Json;

/// Long work, done without access to the document; returns the result as JSON. It calls `stop` at intervals and throws
/// rpc::Error when that returns true.
using BackgroundRequest = std::function<std::string(const std::function<bool()>& stop)>;

/// A request about one document, answered on the document's strand. `params.textDocument.uri` names the document, or,
/// when the client sends back an item that we returned (resolve), its `data.uri`.
struct Method {
  std::string_view name;
  /// Returns the result as JSON. May throw rpc::Error, and an exception of nlohmann-json if the params are wrong.
  std::string (*answer)(const Snapshot& snapshot, const Json& params) = nullptr;
  /// Replaces `answer` in long requests: copies what it needs of the snapshot and returns the work. Edits and other
  /// requests continue meanwhile.
  BackgroundRequest (*begin)(const Snapshot& snapshot, const Json& params) = nullptr;
  /// Whether `answer` also serves files that are not open: editors show tabs whose files they have not opened yet.
  bool serves_closed = false;
  /// The result for an isocnc.json, which is not a program. If empty, requests of ours are refused, and those of the
  /// protocol get null: an editor that has the file open asks for everything, and would show each refusal.
  std::string_view of_configuration = {};
};

/// Which results `WorkspaceRequest::combine` gets.
enum class AggregateScope {
  All,
  Some,  ///< The results of some programs, to be sent while others are still being asked.
  Rest,  ///< All results, each of which the client already has: only the remainder is to be sent.
};

/// A request about the whole workspace. It is passed to every open document, on its strand, and to the programs in the
/// workspace's folders that are not open.
struct WorkspaceRequest {
  std::string_view name;
  /// Returns an array as JSON. For programs that are not open, `params` is null, since their answers are cached.
  std::string (*answer)(const Snapshot& snapshot, const Json& params) = nullptr;
  /// Turns the results, joined into one array, into the answer to the client.
  std::string (*combine)(const std::string& results, const Json& params, AggregateScope scope) = nullptr;
};

/// The parameters of a request for code actions.
struct ActionParams : protocol::RangeParams {
  std::vector<std::string> only;  ///< The wanted kinds, each with its subkinds; empty for all.
  std::vector<Json> diagnostics;  ///< The diagnostics that the editor shows in the range.

  std::size_t first_line() const { return range.start.line; }
  /// The last selected line. A selection that ends at the start of a line excludes that line.
  std::size_t last_line() const {
    return range.end.line - (range.end.character == 0 && range.end.line > range.start.line ? 1u : 0u);
  }
  bool is_selection() const { return range.start != range.end; }
  bool wants(std::string_view kind) const;
  /// Whether the client wants this kind or one of its subkinds.
  bool may_want(std::string_view kind) const;
};

void from_json(const Json& json, ActionParams& params);

/// An action that the editor may offer.
struct Action {
  std::string title;
  std::string_view kind;  ///< `quickfix`, `refactor.rewrite`, ...
  bool is_preferred = false;
  Json diagnostics;          ///< The editor's diagnostics that the action fixes; null for none.
  std::optional<Json> edit;  ///< A WorkspaceEdit; if absent, `ActionSource::edit` makes it from `data` on request.
  Json data;
};

/// A provider of code actions: `lsp/code_actions.cpp` asks all of them.
struct ActionSource {
  std::string_view kind;  ///< The kind of all its actions.
  void (*offer)(const Snapshot& snapshot, const ActionParams& params, std::vector<Action>& actions) = nullptr;
  /// Makes the edit of an action from its data. Throws rpc::Error, RequestFailed, if there is nothing to edit.
  Json (*edit)(const Snapshot& snapshot, const Json& data) = nullptr;
};

/// The text of a document that the server writes.
struct TextContent {
  std::string text;
};

void to_json(Json& json, const TextContent& content);

/// Sends a notification: method and params, as JSON.
using Notify = std::function<void(std::string_view method, std::string params)>;

/// The request that makes the editor repeat its requests, and the capability by which the editor announces support.
struct Refresh {
  std::string_view method;
  const char* capability = nullptr;
  bool covers_closed = false;  ///< Whether the answers are also about programs that are not open.
};

/// One ability of the language server. Each has a file in this folder, which defines it under the file's name (`extern
/// const Feature hover`); the build lists them (lsp/feature_list.h). A feature knows neither threads nor files nor
/// other features.
struct Feature {
  /// The feature's part of ServerCapabilities, for this client.
  Json (*capabilities)(const Client& client) = nullptr;
  std::vector<Method> methods;
  std::vector<WorkspaceRequest> workspace_requests;
  /// Commands for `workspace/executeCommand`. The params are the command's first argument: an object whose `uri` names
  /// the document. If the result has an `edit`, the client is asked to apply it.
  std::vector<Method> commands;
  /// Texts about a program, by their kind, for `workspace/textDocumentContent`. The params have `line`, from 0, if the
  /// text is about one line; the result is a `TextContent`.
  std::vector<Method> texts;
  std::vector<ActionSource> actions;
  /// Called after a document has been opened or edited, once no further edit waits.
  void (*changed)(const Snapshot& snapshot, const Notify& notify) = nullptr;
  /// Called before `changed` where an edit has more lines checked again than in a moment, with what is known so far.
  void (*changed_so_far)(const Snapshot& snapshot, const Notify& notify) = nullptr;
  /// Called after a verification has ended, unless an edit waits. Returns whether answers to earlier requests are
  /// outdated now, so that `refresh` is to be sent.
  bool (*verified)(const Snapshot& snapshot, const Notify& notify) = nullptr;
  /// For answers that depend on settings or the configuration: sent after these have changed.
  std::optional<Refresh> refresh;
  /// Called after a document has been closed.
  void (*closed)(const std::string& uri, const Client& client, const Notify& notify) = nullptr;
};

template <class Result>
std::string write_result(const Result& result) {
  if constexpr (std::is_same_v<Result, protocol::RawJson>) {
    return result.text;
  } else if constexpr (requires { result.has_value(); }) {
    return result ? write_result(*result) : "null";
  } else {
    return rpc::write(Json(result));
  }
}

template <class Params, class Result, Result (*handle)(const Snapshot&, const Params&)>
std::string answer_with(const Snapshot& snapshot, const Json& params) {
  return write_result(handle(snapshot, params.get<Params>()));
}

template <auto handle>
struct MethodOf;

template <class Params, class Result, Result (*handle)(const Snapshot&, const Params&)>
struct MethodOf<handle> {
  static constexpr auto kAnswer = answer_with<Params, Result, handle>;
};

/// A method by its handler, `Result handle(const Snapshot&, const Params&)`, where Params can be read from JSON and
/// Result written as JSON. An empty optional is null.
template <auto handle>
Method on(std::string_view name) {
  return {.name = name, .answer = MethodOf<handle>::kAnswer, .begin = nullptr};
}

/// Like on(), but also serves files that are not open, and configurations.
template <auto handle>
Method on_any(std::string_view name, std::string_view of_configuration) {
  return {.name = name,
          .answer = MethodOf<handle>::kAnswer,
          .begin = nullptr,
          .serves_closed = true,
          .of_configuration = of_configuration};
}

template <class Params, BackgroundRequest (*handle)(const Snapshot&, const Params&)>
BackgroundRequest start_with(const Snapshot& snapshot, const Json& params) {
  return handle(snapshot, params.get<Params>());
}

template <auto handle>
struct BackgroundRequestOf;

template <class Params, BackgroundRequest (*handle)(const Snapshot&, const Params&)>
struct BackgroundRequestOf<handle> {
  static constexpr auto kStart = start_with<Params, handle>;
};

/// A long method by its handler, `BackgroundRequest handle(const Snapshot&, const Params&)`.
template <auto handle>
Method in_background(std::string_view name) {
  return {.name = name, .answer = nullptr, .begin = BackgroundRequestOf<handle>::kStart};
}

/// A workspace request by its handler, whose Result is a list.
template <auto handle>
WorkspaceRequest workspace_request(std::string_view name,
                                   std::string (*combine)(const std::string& results, const Json& params,
                                                          AggregateScope scope)) {
  return {name, MethodOf<handle>::kAnswer, combine};
}

}  // namespace isocnc::features
