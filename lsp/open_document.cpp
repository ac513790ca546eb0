#include "lsp/open_document.h"

#include <utility>

#include "lsp/protocol/uri.h"

namespace isocnc::lsp {

OpenDocument::OpenDocument(rpc::Pool& pool, documents::SettingsStore& settings, std::string uri,
                           DocumentNotifier notifier, std::shared_ptr<DocumentSignals> signals)
    : uri_(std::move(uri)),
      is_configuration_(protocol::names_configuration(uri_)),
      signals_(std::move(signals)),
      worker_(pool, pool, settings, uri_, std::move(notifier), signals_) {}

void OpenDocument::open(rpc::CallPointer call, protocol::ClientPointer client) {
  ++signals_->edits_waiting;
  worker_.post(
      [call = std::move(call), client = std::move(client)](DocumentWorker& worker) { worker.open(*call, *client); });
}

void OpenDocument::edit(rpc::CallPointer call, protocol::ClientPointer client) {
  ++signals_->edits_waiting;
  worker_.post(
      [call = std::move(call), client = std::move(client)](DocumentWorker& worker) { worker.edit(*call, *client); });
}

void OpenDocument::reconfigure(protocol::ClientPointer client) {
  ++signals_->edits_waiting;
  worker_.post([client = std::move(client)](DocumentWorker& worker) { worker.reconfigure(*client); });
}

void OpenDocument::close() {
  signals_->is_closed = true;
  ++signals_->edits_waiting;
}

void OpenDocument::ask(features::Method method, rpc::Json params, protocol::ClientPointer client,
                       WorkerRequest request) {
  worker_.post([method, params = std::move(params), client = std::move(client), request = std::move(request)](
                   DocumentWorker& worker) { worker.answer(method, params, *client, request); });
}

}  // namespace isocnc::lsp
