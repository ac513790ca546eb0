#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lsp/background/verification.h"
#include "lsp/document_worker.h"
#include "lsp/features/feature.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/strand_bound.h"

namespace isocnc::lsp {

/// What the verifications of all documents share.
struct VerificationMeans {
  rpc::Strand& strand;  ///< On which they run, one at a time.
  const background::VerificationOptions& options;
  /// Shows the progress of a document's verification with this number; without a title it has ended.
  std::function<void(std::uint64_t number, const std::optional<std::string>& title)> progress;
};

/// A document that the client has open, as the loop's thread sees it. All work on the document runs on its strand:
/// edits and requests in the order of their arrival, in parallel to other documents. So each answer is about the text
/// that the client saw when it asked.
///
/// The editor may also have an isocnc.json open: then its diagnostics are about the text in the editor, saved or not.
class OpenDocument {
 public:
  /// `signals` are new, and used for this document only.
  OpenDocument(rpc::Loop& loop, rpc::Pool& pool, documents::SettingsStore& settings, std::string uri,
               DocumentNotifier notifier, std::shared_ptr<DocumentSignals> signals, const VerificationMeans& means);

  const std::string& uri() const { return uri_; }
  bool is_configuration() const { return is_configuration_; }

  void open(rpc::CallPointer call, protocol::ClientPointer client);
  void edit(rpc::CallPointer call, protocol::ClientPointer client);
  void save(protocol::ClientPointer client);
  /// Reports the diagnostics of a configuration again: more is known of what it describes.
  void report_again();
  /// Ends work on the document: the editor has closed it.
  void close();
  /// The client's settings or the configuration files have changed.
  void reconfigure(protocol::ClientPointer client);
  /// `params` are those of the call, or a part of them.
  void ask(features::Method method, rpc::CallPointer call, rpc::Json params, protocol::ClientPointer client,
           background::WorkerRequest request);
  /// Ends a verification that is under way.
  void stop_verification();
  /// Ends the verification whose progress has this number.
  void cancel_verification(std::uint64_t number);

 private:
  template <class Change>
  void change(Change change, const protocol::ClientPointer& client);
  background::Verification::Callbacks verification_callbacks(const VerificationMeans& means);

  const std::string uri_;
  const bool is_configuration_;
  const std::shared_ptr<DocumentSignals> signals_;
  rpc::StrandBound<DocumentWorker> worker_;
  const std::shared_ptr<background::Verification> verification_;  // Null for an isocnc.json.
};

}  // namespace isocnc::lsp
