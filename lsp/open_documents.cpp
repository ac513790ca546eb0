#include "lsp/open_documents.h"

#include <utility>

#include <fmt/format.h>

#include "lsp/feature_list.h"

namespace isocnc::lsp {

using rpc::Json;

/// What the document's worker calls. A document that the editor has closed meanwhile notifies no more.
DocumentNotifier OpenDocuments::notifier_of(const std::shared_ptr<const DocumentSignals>& signals) {
  const std::size_t number = times_opened_;
  const rpc::OnLoop<std::string> send(loop_, [this, signals](std::string body) {
    if (!signals->is_closed) outbox_.send(std::move(body));
  });
  const auto notify = [send](std::string_view method, const std::string& params) {
    send(rpc::notification_message(method, params));
  };
  const auto configuration = [this](const std::string& uri, const std::string& params) {
    report_configuration(uri, params);
  };
  const auto progress = [this, number](const std::string& work, const std::optional<std::string>& title) {
    report_progress(fmt::format("{} of {}", work, number), title, Cancellable::No);
  };
  const auto request = [this, signals](const std::string& method) {
    if (!signals->is_closed) outbox_.request(method, nullptr);
  };
  return {.notify = notify,
          .configuration = {loop_, configuration},
          .progress = {loop_, progress},
          .request = {loop_, request}};
}

std::unique_ptr<OpenDocument> OpenDocuments::make_document(const std::string& uri) {
  const auto signals = std::make_shared<DocumentSignals>();
  const std::size_t number = ++times_opened_;
  const auto progress = [this, uri, number](std::uint64_t verification, const std::optional<std::string>& title) {
    const std::string token = fmt::format("verifying {} of {}", verification, number);
    if (title) {
      shown_verifications_[token] = {uri, verification};
    } else {
      shown_verifications_.erase(token);
    }
    report_progress(token, title, Cancellable::Yes);
  };
  return std::make_unique<OpenDocument>(loop_, pool_, settings_, uri, notifier_of(signals), signals,
                                        VerificationMeans{verifications_, verification_, progress});
}

void OpenDocuments::open(const rpc::CallPointer& call, const protocol::ClientPointer& client) {
  const Json& params = call->params().at("textDocument");
  const std::string uri = params.at("uri");
  if (!params.at("text").is_string()) throw Json::type_error::create(302, "the text is no string", &params);
  std::unique_ptr<OpenDocument>& document = documents_[uri];
  if (document) document->close();
  document = make_document(uri);
  document->open(call, client);
}

void OpenDocuments::close(const std::string& uri, const protocol::Client& client) {
  const auto found = documents_.find(uri);
  if (found == documents_.end()) return;
  found->second->close();
  // From now on the text of a configuration's file counts, not that of the editor.
  if (found->second->is_configuration()) reported_configurations_.insert(uri);
  const bool is_program = !found->second->is_configuration();
  documents_.erase(found);
  if (!is_program) return;
  for (const features::Feature* const feature : all_features())
    if (feature->closed)
      feature->closed(uri, client,
                      [&](std::string_view method, const std::string& params) { outbox_.notify(method, params); });
}

static const Json::json_pointer kPlaceInData("/data/uri");

bool is_item_of_ours(const Json& params) { return params.is_object() && params.contains(kPlaceInData); }

OpenDocument* OpenDocuments::find(const Json& params) const {
  if (!params.is_object()) return nullptr;
  static const Json::json_pointer kPlaces[] = {Json::json_pointer("/textDocument/uri"), kPlaceInData,
                                               Json::json_pointer("/item/data/uri"), Json::json_pointer("/uri")};
  for (const Json::json_pointer& place : kPlaces) {
    if (!params.contains(place) || !params.at(place).is_string()) continue;
    const auto found = documents_.find(params.at(place).get_ref<const std::string&>());
    return found == documents_.end() ? nullptr : found->second.get();
  }
  return nullptr;
}

std::vector<OpenDocument*> OpenDocuments::programs() const {
  std::vector<OpenDocument*> programs;
  for (const auto& [uri, document] : documents_)
    if (!document->is_configuration()) programs.push_back(document.get());
  return programs;
}

void OpenDocuments::reconfigure(const protocol::ClientPointer& client) {
  for (const auto& [uri, document] : documents_) document->reconfigure(client);
}

void OpenDocuments::withdraw_configuration_diagnostics() {
  for (const std::string& uri : std::exchange(reported_configurations_, {}))
    if (!documents_.contains(uri))
      outbox_.notify("textDocument/publishDiagnostics", rpc::write({{"uri", uri}, {"diagnostics", Json::array()}}));
}

void OpenDocuments::report_progress(const std::string& token, const std::optional<std::string>& title,
                                    Cancellable cancellable) {
  if (title) outbox_.request("window/workDoneProgress/create", {{"token", token}});
  const Json value = title
                         ? Json{{"kind", "begin"}, {"title", *title}, {"cancellable", cancellable == Cancellable::Yes}}
                         : Json{{"kind", "end"}};
  outbox_.notify("$/progress", rpc::write({{"token", token}, {"value", value}}));
}

void OpenDocuments::cancel_progress(const Json& token) {
  const auto shown =
      token.is_string() ? shown_verifications_.find(token.get<std::string>()) : shown_verifications_.end();
  if (shown == shown_verifications_.end()) return;
  const ShownVerification verification = shown->second;  // Cancelling it erases it.
  const auto document = documents_.find(verification.uri);
  if (document != documents_.end()) document->second->cancel_verification(verification.number);
}

void OpenDocuments::stop_verifications() {
  for (const auto& [uri, document] : documents_) document->stop_verification();
}

/// Of a configuration that the editor has open, the text in the editor counts.
void OpenDocuments::report_configuration(const std::string& uri, const std::string& params) {
  if (const auto open = documents_.find(uri); open != documents_.end()) return open->second->report_again();
  reported_configurations_.insert(uri);
  outbox_.notify("textDocument/publishDiagnostics", params);
}

}  // namespace isocnc::lsp
