#pragma once

#include <memory>
#include <string>

#include "lsp/document_worker.h"
#include "lsp/features/feature.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/strand_bound.h"

namespace isocnc::lsp {

/// A document that the client has open, as the loop's thread sees it. All work on the document runs on its strand:
/// edits and requests in the order of their arrival, in parallel to other documents. So each answer is about the text
/// that the client saw when it asked.
///
/// The editor may also have an isocnc.json open: then its diagnostics are about the text in the editor, saved or not.
class OpenDocument {
 public:
  /// `signals` are new, and used for this document only.
  OpenDocument(rpc::Pool& pool, documents::SettingsStore& settings, std::string uri, DocumentNotifier notifier,
               std::shared_ptr<DocumentSignals> signals);

  const std::string& uri() const { return uri_; }
  bool is_configuration() const { return is_configuration_; }

  void open(rpc::CallPointer call, protocol::ClientPointer client);
  void edit(rpc::CallPointer call, protocol::ClientPointer client);
  /// Ends work on the document: the editor has closed it.
  void close();
  /// The client's settings or the configuration files have changed.
  void reconfigure(protocol::ClientPointer client);
  void ask(features::Method method, rpc::Json params, protocol::ClientPointer client, WorkerRequest request);

 private:
  const std::string uri_;
  const bool is_configuration_;
  const std::shared_ptr<DocumentSignals> signals_;
  rpc::StrandBound<DocumentWorker> worker_;
};

}  // namespace isocnc::lsp
