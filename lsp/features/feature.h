#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "lsp/documents/protocol.h"
#include "lsp/documents/snapshot.h"
#include "lsp/rpc/message.h"

namespace isocnc::lsp::features {

using documents::Client;
using documents::ClientPosition;
using documents::ClientRange;
using documents::Json;
using documents::Snapshot;

/// Work that takes long, and sees no document any more: the result, as JSON. Asked now and then whether to `stop`, it
/// may throw rpc::Error.
using BackgroundRequest = std::function<std::string(const std::function<bool()>& stop)>;

/// A request about one document: which one stands in `params.textDocument.uri`, or, where an item that we have handed
/// out comes back (resolve), in its `data.uri`. It is answered on the document's strand.
struct Method {
  std::string_view name;
  /// The result, as JSON. May throw rpc::Error, and what nlohmann-json throws where the params are wrong.
  std::string (*answer)(const Snapshot& snapshot, const Json& params) = nullptr;
  /// In its place, for what takes long: takes with it what it needs of the snapshot. Edits and other requests go on
  /// beside the study.
  BackgroundRequest (*begin)(const Snapshot& snapshot, const Json& params) = nullptr;
  /// Whether `answer` is wanted of files that are not open, too: editors show tabs whose files they have not opened
  /// yet.
  bool serves_closed = false;
  /// The result for an isocnc.json, which is no program; without one the request is refused.
  std::string_view of_configuration = {};
};

/// Which results a WorkspaceRequest concludes from.
enum class AggregateScope {
  All,
  Some,  ///< The client is told of some programs while others are still being asked.
  Rest,  ///< Of all, but the client has been told of each of them: what is left to say.
};

/// A request about the whole workspace: asked of every open document on its strand, and of the programs in the
/// workspace's folders that are not open.
struct WorkspaceRequest {
  std::string_view name;
  /// An array. Programs that are not open are asked without params, for what they answer is kept.
  std::string (*answer)(const Snapshot& snapshot, const Json& params) = nullptr;
  /// Makes of the results, put together to one array, what the client gets.
  std::string (*combine)(const std::string& results, const Json& params, AggregateScope scope) = nullptr;
};

/// What an editor wants to know of code actions.
struct ActionParams : documents::RangeParams {
  std::vector<std::string> only;  ///< Kinds, with all below them; empty is all.
  std::vector<Json> diagnostics;  ///< That it shows there.

  std::size_t first_line() const { return range.start.line; }
  /// Where a selection ends at the start of a line, that line is not meant.
  std::size_t last_line() const {
    return range.end.line - (range.end.character == 0 && range.end.line > range.start.line ? 1u : 0u);
  }
  bool is_selection() const { return range.start != range.end; }
  bool wants(std::string_view kind) const;
};

void from_json(const Json& json, ActionParams& params);

/// An action that the editor may offer.
struct Action {
  std::string title;
  std::string_view kind;  ///< `quickfix`, `refactor.rewrite`, ...
  bool is_preferred = false;
  Json diagnostics;          ///< Those of the editor that it mends; null for none.
  std::optional<Json> edit;  ///< A WorkspaceEdit; else the source makes it of `data` when it is wanted.
  Json data;
};

/// Whoever has actions to offer: code_actions asks all of them.
struct ActionSource {
  std::string_view kind;  ///< That all of its actions have.
  void (*offer)(const Snapshot& snapshot, const ActionParams& params, std::vector<Action>& actions) = nullptr;
  /// The edit of an action that has none, of its data. Throws rpc::Error, RequestFailed, where there is none.
  Json (*edit)(const Snapshot& snapshot, const Json& data) = nullptr;
};

/// Sends a notification: method and params, as JSON.
using Notify = std::function<void(std::string_view method, std::string params)>;

/// How the editor is asked to ask again, and the capability by which it tells that it can be.
struct Refresh {
  std::string_view method;
  const char* capability = nullptr;
};

/// Something that the editor can do because of us. Each has a file of its name in this folder, which defines it under
/// that name (`extern const Feature hover`); the build gathers them. A feature knows neither threads nor files nor
/// other features.
struct Feature {
  /// Its part of ServerCapabilities, for this client.
  Json (*capabilities)(const Client& client) = nullptr;
  std::vector<Method> methods;
  std::vector<WorkspaceRequest> workspace_requests;
  /// What `workspace/executeCommand` offers. The params are the command's first argument: an object whose `uri` names
  /// the document. Where the result has an `edit`, the client is asked to apply it.
  std::vector<Method> commands;
  std::vector<ActionSource> actions;
  /// Called when a document has been opened or edited and no further edit waits.
  void (*changed)(const Snapshot& snapshot, const Notify& notify) = nullptr;
  /// For answers that depend on settings or the configuration: sent when these have changed.
  std::optional<Refresh> refresh;
  /// Called when a document has been closed.
  void (*closed)(const std::string& uri, const Client& client, const Notify& notify) = nullptr;
};

template <class Result>
std::string write_result(const Result& result) {
  if constexpr (std::is_same_v<Result, documents::RawJson>) {
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

/// The same, of files that are not open as well, and of configurations.
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

/// A method that takes long, by `BackgroundRequest handle(const Snapshot&, const Params&)`.
template <auto handle>
Method in_background(std::string_view name) {
  return {.name = name, .answer = nullptr, .begin = BackgroundRequestOf<handle>::kStart};
}

/// A gathering by its handler, whose Result is a list.
template <auto handle>
WorkspaceRequest workspace_request(std::string_view name,
                                   std::string (*combine)(const std::string& results, const Json& params,
                                                          AggregateScope scope)) {
  return {name, MethodOf<handle>::kAnswer, combine};
}

/// All features, in the order of their files' names.
std::span<const Feature* const> all_features();

}  // namespace isocnc::lsp::features
