#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lsp/background/background_requests.h"
#include "lsp/background/verification.h"
#include "lsp/documents/analyzed_document.h"
#include "lsp/features/feature.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/on_loop.h"
#include "lsp/rpc/strand.h"
#include "lsp/rpc/strand_bound.h"

namespace isocnc::lsp {

/// What an open document reports to the client by itself.
struct DocumentNotifier {
  features::Notify notify;
  rpc::OnLoop<std::string /*uri*/, std::string /*params*/>
      configuration;  ///< The diagnostics of an isocnc.json or setup.
  background::ReportProgress progress;
  rpc::OnLoop<std::string /*method*/> request;  ///< Sends a request without parameters.
};

/// By these the loop's thread ends work on a document that is no longer wanted.
struct DocumentSignals {
  std::atomic<int> edits_waiting = 0;
  std::atomic<bool> is_closed = false;  ///< Whether the editor has closed the document.
};

/// All work on one open document. It belongs to the document's strand (rpc::StrandBound in OpenDocument), so there is
/// one analysis, without a lock.
class DocumentWorker {
 public:
  DocumentWorker(rpc::Pool& pool, documents::SettingsStore& settings, std::string uri, DocumentNotifier notifier,
                 std::shared_ptr<DocumentSignals> signals);

  /// `call` is the notification `textDocument/didOpen`, and `textDocument/didChange` below.
  void open(const rpc::Call& call, const protocol::Client& client);
  void edit(const rpc::Call& call, const protocol::Client& client);
  /// The client's settings or the configuration files have changed.
  void reconfigure(const protocol::Client& client);
  /// The number of calls of these three.
  std::uint64_t change_count() const { return change_count_; }
  /// After each of these three: reports that change, unless a later one has been made or waits. False if it is to be
  /// called again after the other work that waits.
  bool report_change(std::uint64_t change, const protocol::Client& client, const rpc::OthersWait& others_wait);

  /// A number that changes with each edit.
  std::uint64_t revision() const { return document_.revision(); }
  /// When a request was made, and what waits for it.
  struct AnswerTurn {
    std::uint64_t asked;  ///< The revision that the client saw.
    const rpc::OthersWait& others_wait;
  };
  /// False if it is to be called again after the other work that waits.
  bool answer(const features::Method& method, const rpc::Json& params, const protocol::Client& client,
              const background::WorkerRequest& request, const AnswerTurn& turn);
  /// Calls `start` with what is to be verified, or with nothing: where the program has been verified as it is, or is
  /// too long.
  void order_verification(const background::VerificationOrder& order,
                          const rpc::OnWorker<std::optional<background::VerificationSubject>>& start);
  void take_verification(const background::VerificationResult& result, const protocol::Client& client);
  /// More is known of what a configuration describes.
  void report_again();

 private:
  void make_edit(const std::function<void()>& edit);
  bool report_all(const protocol::Client& client, const rpc::OthersWait& others_wait);
  void report_so_far(const protocol::Client& client);
  void report_verification(const protocol::Client& client);
  void start_progress(const protocol::Client& client);
  void end_progress();
  bool shows_progress_to(const protocol::Client& client) const;
  void report_configuration(const protocol::Client& client);
  void report_described(const std::filesystem::path& shown, const protocol::Client& client);
  void report_shapes(const protocol::Client& client);
  void report_as_configuration(const protocol::Client& client);
  void log(const std::exception& error);

  const std::string uri_;
  const bool is_configuration_;  // Whether this is an isocnc.json or a setup, never read as a program.
  documents::SettingsStore& settings_;
  const DocumentNotifier notifier_;
  const std::shared_ptr<DocumentSignals> signals_;
  bool is_long_ = false;  // Whether the text was long when opened.
  bool is_progress_shown_ = false;
  bool is_report_begun_ = false;  // Whether what was known first of the last change has been reported.
  std::uint64_t change_count_ = 0;
  documents::AnalyzedDocument document_;
  std::optional<protocol::Client> last_client_;  // Of a configuration: the one that was last reported to.
  background::BackgroundRequests background_requests_;
};

}  // namespace isocnc::lsp
