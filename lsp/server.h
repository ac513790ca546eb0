#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lsp/closed_programs.h"
#include "lsp/documents/client.h"
#include "lsp/documents/settings_store.h"
#include "lsp/features/feature.h"
#include "lsp/open_document.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/serve.h"
#include "lsp/rpc/strand.h"

namespace isocnc::lsp {

/// The language server: handles the lifecycle of the protocol and dispatches messages. It runs on the loop's thread and
/// does only short work there; work on a document runs on the strand of its OpenDocument, and the answer returns as a
/// task of the loop.
class Server final : public rpc::Peer {
 public:
  /// `language` takes precedence over the languages of configurations and of the editor's own texts.
  Server(rpc::Loop& loop, rpc::Send send, std::optional<dialect::Language> language = {});
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Called on the loop's thread.
  void receive(rpc::Frame frame) override;
  /// Ends the server as the notification `exit` does.
  void end() override;
  /// Ends the server when the process that started it no longer exists.
  void idle() override;

  /// 0 after `shutdown` and `exit`, 1 after any other end.
  int exit_status() const override { return exit_status_; }

 private:
  using CallPointer = std::shared_ptr<const rpc::Call>;
  /// The flag of a request that has no answer yet, set when the request is cancelled.
  using CancelFlag = std::shared_ptr<std::atomic<bool>>;
  struct Aggregate;

  void dispatch(const CallPointer& call);
  bool is_allowed(const rpc::Call& call);
  void call_method(const CallPointer& call);

  // Messages of the lifecycle.
  void initialize(const CallPointer& call);
  void initialized(const CallPointer& call);
  void shut_down(const CallPointer& call);
  void cancel(const CallPointer& call);
  void ignore(const CallPointer&) {}
  // Notifications about documents.
  void open(const CallPointer& call);
  void edit(const CallPointer& call);
  void close(const CallPointer& call);
  void save(const CallPointer& call);
  // Messages about the workspace.
  void change_folders(const CallPointer& call);
  void change_settings(const CallPointer& call);
  void look_at_changed_files(const CallPointer& call);
  void execute_command(const CallPointer& call);

  void reconfigure_all();
  void reconfigure_documents();
  void ask(const features::Method& method, const CallPointer& call, rpc::Json params,
           const std::function<std::string(std::string)>& finish_result = {});
  std::vector<std::filesystem::path> folders_of_workspace() const;
  void ask_closed(const features::Method& method, const CallPointer& call, const std::string& uri);
  void ask_workspace(const features::WorkspaceRequest& workspace_request, const CallPointer& call);
  std::function<void(const std::string& result)> partial_result_notifier(
      const features::WorkspaceRequest& workspace_request, const CallPointer& call, const CancelFlag& cancel_flag);
  CancelFlag begin(const rpc::Call& call);
  void finish(const rpc::Json& id, const CancelFlag& cancel_flag, std::string body);
  void reply(const rpc::Call& call, const rpc::Json& result);
  void refuse(const rpc::Call& call, rpc::ErrorCode code, const std::string& message);
  void notify(std::string_view method, const std::string& params);
  void request(std::string_view method, const rpc::Json& params);
  void log(const std::string& message);
  void report_progress(const std::string& token, const std::optional<std::string>& title);
  void report_configuration(const std::string& uri, const std::string& params);
  OpenDocument* find_document(const rpc::Json& params) const;
  features::Notify notifier_of(const std::string& uri, std::size_t generation);

  enum class Phase { Starting, Running, ShutDown, Ended };
  using Handler = void (Server::*)(const CallPointer& call);

  static const std::unordered_map<std::string_view, Handler>& handlers();

  rpc::Loop& loop_;
  const rpc::Send send_;
  const std::optional<dialect::Language> language_;
  Phase phase_ = Phase::Starting;
  int exit_status_ = 1;
  int parent_ = 0;  // The id of the process that started the server; 0 if unknown.
  std::shared_ptr<const documents::Client> client_ = std::make_shared<const documents::Client>();
  documents::SettingsStore settings_;
  struct Opened {
    std::shared_ptr<OpenDocument> document;
    std::size_t generation = 0;
  };
  std::unordered_map<std::string, Opened> open_documents_;  // The open documents by URI.
  std::size_t generations_ = 0;
  std::set<std::string>
      reported_configurations_;  // URIs of configuration files for which diagnostics may have been sent.
  std::unordered_map<std::string, CancelFlag> cancel_flags_;  // The flags by request id, as JSON text.
  std::unordered_map<std::string_view, features::Method> methods_;
  std::unordered_map<std::string_view, features::WorkspaceRequest> workspace_requests_;
  std::unordered_map<std::string_view, features::Method> commands_;
  std::int64_t next_request_ = 1;
  std::set<std::string> folders_;  // URIs of the workspace's folders.
  ClosedPrograms closed_programs_{pool_, settings_};
  rpc::Pool pool_;  // Last, so that its threads end before other members are destroyed.
};

}  // namespace isocnc::lsp
