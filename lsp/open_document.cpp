#include "lsp/open_document.h"

#include <utility>

#include "lsp/protocol/uri.h"

namespace isocnc::lsp {

using background::Verification;
using background::VerificationOrder;
using background::VerificationResult;
using background::VerificationSubject;
using background::WorkerRequest;

OpenDocument::OpenDocument(rpc::Loop& loop, rpc::Pool& pool, documents::SettingsStore& settings, std::string uri,
                           DocumentNotifier notifier, std::shared_ptr<DocumentSignals> signals,
                           const VerificationMeans& means)
    : uri_(std::move(uri)),
      is_configuration_(protocol::names_configuration(uri_)),
      signals_(std::move(signals)),
      worker_(pool, pool, settings, uri_, std::move(notifier), signals_),
      verification_(is_configuration_ ? nullptr
                                      : std::make_shared<Verification>(loop, means.strand, means.options, uri_,
                                                                       verification_callbacks(means))) {}

Verification::Callbacks OpenDocument::verification_callbacks(const VerificationMeans& means) {
  const auto order = [this](VerificationOrder order, const rpc::OnWorker<std::optional<VerificationSubject>>& start) {
    worker_.post(
        [order = std::move(order), start](DocumentWorker& worker) { worker.order_verification(order, start); });
  };
  const auto take = [this](VerificationResult result, protocol::ClientPointer client) {
    worker_.post([result = std::move(result), client = std::move(client)](DocumentWorker& worker) {
      worker.take_verification(result, *client);
    });
  };
  return {.order = order, .take = take, .progress = means.progress};
}

/// What changes the document is reported once no further change waits.
template <class Change>
void OpenDocument::change(Change change, const protocol::ClientPointer& client) {
  ++signals_->edits_waiting;
  worker_.post([change = std::move(change), client](DocumentWorker& worker) { change(worker, *client); });
  worker_.post_in_parts([client, change = std::optional<std::uint64_t>()](DocumentWorker& worker,
                                                                          const rpc::OthersWait& others_wait) mutable {
    if (!change) change = worker.change_count();
    return worker.report_change(*change, *client, others_wait);
  });
}

void OpenDocument::open(rpc::CallPointer call, protocol::ClientPointer client) {
  change([call = std::move(call)](DocumentWorker& worker, const protocol::Client& of) { worker.open(*call, of); },
         client);
  if (verification_) verification_->open(std::move(client));
}

void OpenDocument::edit(rpc::CallPointer call, protocol::ClientPointer client) {
  change([call = std::move(call)](DocumentWorker& worker, const protocol::Client& of) { worker.edit(*call, of); },
         client);
  if (verification_) verification_->edit(std::move(client));
}

void OpenDocument::reconfigure(protocol::ClientPointer client) {
  change([](DocumentWorker& worker, const protocol::Client& of) { worker.reconfigure(of); }, client);
  if (verification_) verification_->open(std::move(client));
}

void OpenDocument::save(protocol::ClientPointer client) {
  if (verification_) verification_->save(std::move(client));
}

void OpenDocument::report_again() {
  worker_.post([](DocumentWorker& worker) { worker.report_again(); });
}

void OpenDocument::stop_verification() {
  if (verification_) verification_->close();
}

void OpenDocument::cancel_verification(std::uint64_t number) {
  if (verification_) verification_->cancel(number);
}

void OpenDocument::close() {
  stop_verification();
  signals_->is_closed = true;
  ++signals_->edits_waiting;
}

void OpenDocument::ask(features::Method method, rpc::CallPointer call, rpc::Json params, protocol::ClientPointer client,
                       WorkerRequest request) {
  worker_.post_in_parts([method, call = std::move(call), params = std::move(params), client = std::move(client),
                         request = std::move(request), asked = std::optional<std::uint64_t>()](
                            DocumentWorker& worker, const rpc::OthersWait& others_wait) mutable {
    if (!asked) asked = worker.revision();
    return worker.answer(method, call->message.with_texts(params), *client, request, {*asked, others_wait});
  });
}

}  // namespace isocnc::lsp
