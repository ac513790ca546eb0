#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include "lsp/closed_programs.h"
#include "lsp/documents/settings_store.h"
#include "lsp/feature_list.h"
#include "lsp/open_documents.h"
#include "lsp/outbox.h"
#include "lsp/pending_requests.h"
#include "lsp/posted_programs.h"
#include "lsp/protocol/client.h"
#include "lsp/protocol/uri.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/on_loop.h"
#include "lsp/rpc/serve.h"
#include "lsp/rpc/strand.h"
#include "lsp/rpc/strand_bound.h"

namespace isocnc::lsp {

/// The language server: handles the lifecycle of the protocol and dispatches messages. It runs on the loop's thread and
/// does only short work there. The types say where everything else runs: a rpc::StrandBound value on its strand, a
/// rpc::OnWorker callback on the strand that calls it, a rpc::OnLoop callback on the loop's thread again.
class Server final : public rpc::Peer {
 public:
  /// `language` takes precedence over the languages of configurations and of the editor's own texts.
  Server(rpc::Loop& loop, rpc::Send send, std::optional<dialect::Language> language = {},
         background::VerificationOptions verification = {});
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Called on the loop's thread.
  void receive(rpc::MessageFrame frame) override;
  /// Ends the server as the notification `exit` does.
  void end() override;
  /// Ends the server when the process that started it no longer exists.
  void idle() override;

  /// 0 after `shutdown` and `exit`, 1 after any other end.
  int exit_status() const override { return exit_status_; }

 private:
  /// Returns the function that gets a request's result.
  using TakerOf = std::function<rpc::OnWorker<std::string>(const PendingRequest& request)>;

  void dispatch(const rpc::CallPointer& call);
  bool is_allowed(const rpc::Call& call);
  void call_method(const rpc::CallPointer& call);

  // Messages of the lifecycle.
  void initialize(const rpc::CallPointer& call);
  void initialized(const rpc::CallPointer& call);
  void shut_down(const rpc::CallPointer& call);
  void cancel(const rpc::CallPointer& call);
  void cancel_progress(const rpc::CallPointer& call);
  void ignore(const rpc::CallPointer&) {}
  // Notifications about documents.
  void open(const rpc::CallPointer& call);
  void edit(const rpc::CallPointer& call);
  void close(const rpc::CallPointer& call);
  void save(const rpc::CallPointer& call);
  // Messages about the workspace.
  void change_folders(const rpc::CallPointer& call);
  void change_settings(const rpc::CallPointer& call);
  void look_at_changed_files(const rpc::CallPointer& call);
  void execute_command(const rpc::CallPointer& call);
  void write_text(const rpc::CallPointer& call);

  void reconfigure_all();
  void reconfigure_documents();
  void refresh(const std::function<bool(const features::Refresh&)>& is_needed);
  void watch_files();
  void ask(const features::Method& method, const rpc::CallPointer& call, rpc::Json params, const TakerOf& taker_of);
  void ask_closed(const features::Method& method, const rpc::CallPointer& call, const std::string& uri);
  void ask_for_text(const protocol::TextAboutProgram& text, const rpc::CallPointer& call, const TakerOf& taker_of);
  void show_text(const rpc::CallPointer& call, const rpc::Json& argument);
  void refresh_texts_about(const std::string& program);
  void ask_workspace(const features::WorkspaceRequest& workspace_request, const rpc::CallPointer& call);
  rpc::OnLoop<std::string> edit_applier(const std::string& command, const PendingRequest& request);
  ClosedPrograms::Folders folders_of_workspace() const;

  enum class LifecyclePhase { Starting, Running, ShutDown, Ended };
  using Handler = void (Server::*)(const rpc::CallPointer& call);

  static const std::unordered_map<std::string_view, Handler>& handlers();

  rpc::Loop& loop_;
  Outbox outbox_;
  const std::optional<dialect::Language> language_;
  LifecyclePhase phase_ = LifecyclePhase::Starting;
  int exit_status_ = 1;
  int parent_ = 0;  // The id of the process that started the server; 0 if unknown.
  protocol::ClientPointer client_ = std::make_shared<const protocol::Client>();
  std::set<std::string> folders_;  // URIs of the workspace's folders.
  std::unordered_map<std::string_view, features::Method> methods_;
  std::unordered_map<std::string_view, features::WorkspaceRequest> workspace_requests_;
  std::unordered_map<std::string_view, features::Method> commands_;
  std::unordered_map<std::string_view, features::Method> texts_;  // By their kind.
  /// The URIs of texts that the client has got since its program has last changed, by the URI of the program. A client
  /// that still shows one asks again once it is told of the change.
  std::map<std::string, std::set<std::string>> current_texts_;
  documents::SettingsStore settings_;  // The one member that several threads use.
  PendingRequests pending_requests_{loop_, outbox_};
  PostedPrograms posted_programs_{loop_, pool_, outbox_, settings_, [this] {
                                    refresh([](const features::Refresh& refresh) { return refresh.covers_closed; });
                                  }};
  OpenDocuments open_documents_;
  rpc::StrandBound<ClosedPrograms> closed_programs_{pool_, settings_};
  rpc::Pool pool_;  // Last, so that its threads end before other members are destroyed.
};

}  // namespace isocnc::lsp
