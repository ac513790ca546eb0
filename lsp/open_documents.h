#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lsp/open_document.h"
#include "lsp/outbox.h"

namespace isocnc::lsp {

/// The documents that the client has open, and what is reported about them. Used on the loop's thread only.
class OpenDocuments {
 public:
  OpenDocuments(rpc::Loop& loop, rpc::Pool& pool, documents::SettingsStore& settings, Outbox& outbox,
                background::VerificationOptions verification)
      : loop_(loop),
        pool_(pool),
        settings_(settings),
        outbox_(outbox),
        verification_(std::move(verification)),
        verifications_(pool) {}

  /// `call` is the notification `textDocument/didOpen`.
  void open(const rpc::CallPointer& call, const protocol::ClientPointer& client);
  void close(const std::string& uri, const protocol::Client& client);
  bool contains(const std::string& uri) const { return documents_.contains(uri); }
  /// The document that the parameters of a call name; null if they name none that is open.
  OpenDocument* find(const rpc::Json& params) const;
  /// The open documents that are programs.
  std::vector<OpenDocument*> programs() const;
  /// The client's settings or the configuration files have changed.
  void reconfigure(const protocol::ClientPointer& client);
  /// Ends the verification whose progress has this token, as the user wants.
  void cancel_progress(const rpc::Json& token);
  /// Ends all verifications: the server ends.
  void stop_verifications();
  /// Withdraws the diagnostics of configuration files: those that still exist are reported again.
  void withdraw_configuration_diagnostics();

 private:
  DocumentNotifier notifier_of(const std::shared_ptr<const DocumentSignals>& signals);
  enum class Cancellable : bool { No, Yes };
  void report_progress(const std::string& token, const std::optional<std::string>& title, Cancellable cancellable);
  std::unique_ptr<OpenDocument> make_document(const std::string& uri);
  void report_configuration(const std::string& uri, const std::string& params);

  rpc::Loop& loop_;
  rpc::Pool& pool_;
  documents::SettingsStore& settings_;
  Outbox& outbox_;
  std::map<std::string, std::unique_ptr<OpenDocument>> documents_;  // By URI.
  std::size_t times_opened_ = 0;
  const background::VerificationOptions verification_;
  rpc::Strand verifications_;
  /// A verification whose progress is shown.
  struct ShownVerification {
    std::string uri;
    std::uint64_t number = 0;
  };
  std::map<std::string, ShownVerification> shown_verifications_;  // By the token of its progress.
  std::set<std::string> reported_configurations_;  // URIs of isocnc.json files whose diagnostics may have been sent.
};

/// Whether the parameters are an item that the client sends back: a code lens, a completion item.
bool is_item_of_ours(const rpc::Json& params);

}  // namespace isocnc::lsp
