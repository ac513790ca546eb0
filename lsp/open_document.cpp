#include "lsp/open_document.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/configuration/configurations.h"
#include "interpreter/dialect/format.h"
#include "lsp/documents/configuration_diagnostics.h"
#include "lsp/documents/uri.h"

namespace isocnc::lsp {

using documents::Client;
using documents::ContentChange;
using documents::Interest;
using documents::Snapshot;
using rpc::Json;

/// In bytes. Shorter texts open faster than a user could read a progress message.
static constexpr std::size_t kLongText = 16 << 20;

OpenDocument::OpenDocument(rpc::Pool& pool, documents::SettingsStore& settings, std::string uri, Notifier notifier)
    : uri_(uri),
      is_configuration_(documents::names_configuration(uri)),
      settings_(settings),
      notifier_(std::move(notifier)),
      document_(std::move(uri), settings),
      strand_(pool),
      background_requests_(pool) {}

static std::int64_t version_of(const Json& params) {
  return documents::member<std::int64_t>(params.at("textDocument"), "version").value_or(0);
}

void OpenDocument::open(std::shared_ptr<const rpc::Call> call, const ClientPointer& client) {
  post_edit(
      [this, call = std::move(call), client] {
        const Json& params = call->params();
        const std::string text = call->message.text(params.at("textDocument").at("text"));
        is_long_ = text.size() >= kLongText;
        start_progress(*client);
        document_.open(version_of(params), text);
      },
      client);
}

static std::vector<ContentChange> changes_in(const rpc::Call& call) {
  std::vector<ContentChange> changes;
  for (const Json& change : call.params().at("contentChanges"))
    changes.push_back(
        {documents::member<documents::ClientRange>(change, "range"), call.message.text(change.at("text"))});
  return changes;
}

void OpenDocument::edit(std::shared_ptr<const rpc::Call> call, const ClientPointer& client) {
  post_edit([this, call = std::move(call),
             encoding = client->encoding] { document_.edit(version_of(call->params()), changes_in(*call), encoding); },
            client);
}

void OpenDocument::reconfigure(ClientPointer client) {
  post_edit([this] { document_.reread_settings(); }, std::move(client));
}

/// Reports the change to features only after the last of the waiting edits.
void OpenDocument::post_edit(std::function<void()> edit, ClientPointer client) {
  ++edits_waiting_;
  strand_.post([self = shared_from_this(), edit = std::move(edit), client = std::move(client)] {
    try {
      edit();
    } catch (const std::exception& error) {
      self->log(error);
    }
    if (--self->edits_waiting_ == 0) self->report_change(*client);
    if (self->edits_waiting_ == 0 || self->is_closed_) self->end_progress();
  });
}

std::string OpenDocument::titled(const Client& client, const dialect::Text& title) const {
  const auto path = documents::path_of(uri_);
  return dialect::format(title, client.language({}), path ? path->filename().string() : uri_);
}

void OpenDocument::start_progress(const Client& client) {
  if (!is_long_ || !client.can("/window/workDoneProgress")) return;
  static constexpr dialect::Text kOpening = {"opening {}", "apertura di {}"};
  notifier_.progress("opening", titled(client, kOpening));
  shows_progress_ = true;
}

void OpenDocument::end_progress() {
  if (std::exchange(shows_progress_, false)) notifier_.progress("opening", std::nullopt);
}

void OpenDocument::log(const std::exception& error) {
  notifier_.notify("window/logMessage",
                   rpc::write({{"type", 1}, {"message", fmt::format("{}: {}", uri_, error.what())}}));
}

void OpenDocument::report_change(const Client& client) {
  if (is_configuration_) return report_as_configuration(client);
  try {
    report_configuration(client);
    const Snapshot snapshot(document_, client, Interest{nullptr, &edits_waiting_});
    for (const features::Feature* const feature : features::all_features())
      if (feature->changed) feature->changed(snapshot, notifier_.notify);
  } catch (const rpc::Error&) {
    return;  // Another edit has arrived, and its change will be reported.
  } catch (const std::exception& error) {
    log(error);
  }
}

static std::string published(const std::string& uri, Json diagnostics) {
  return rpc::write({{"uri", uri}, {"diagnostics", std::move(diagnostics)}});
}

/// Reports the findings in the program's configuration file, once for all programs that use it.
void OpenDocument::report_configuration(const Client& client) {
  const configuration::Configuration& found = *document_.settings().configuration;
  if (found.file.empty() || !settings_.claim(found.file)) return;
  const std::filesystem::path file = configuration::real_path(found.file);
  const auto language = client.language(found.language);
  notifier_.configuration(
      documents::uri_of(file),
      published(documents::uri_of(file), documents::configuration_diagnostics(file, client.encoding, language)));
}

void OpenDocument::report_as_configuration(const Client& client) {
  const std::filesystem::path folder = configuration::real_path(documents::path_of(uri_)->parent_path());
  notifier_.notify("textDocument/publishDiagnostics",
                   published(uri_, documents::configuration_diagnostics(document_.document().text(), folder,
                                                                        client.encoding, client.language({}))));
}

struct OpenDocument::Request {
  std::shared_ptr<const std::atomic<bool>> cancelled;
  std::function<void(std::string result)> done;
  std::function<void(rpc::Error error)> failed;
};

/// Runs the work and turns an exception into the request's error.
void OpenDocument::work_on(const std::shared_ptr<Request>& request, const std::function<void()>& work) {
  if (request->cancelled->load()) return;
  try {
    work();
  } catch (const rpc::Error& error) {
    request->failed(error);
  } catch (const Json::exception& error) {
    request->failed(rpc::Error(rpc::ErrorCode::InvalidParams, error.what()));
  } catch (const std::exception& error) {
    request->failed(rpc::Error(rpc::ErrorCode::InternalError, error.what()));
  }
}

void OpenDocument::ask(features::Method method, Json params, ClientPointer client,
                       std::shared_ptr<const std::atomic<bool>> cancelled, std::function<void(std::string result)> done,
                       std::function<void(rpc::Error error)> failed) {
  const auto request = std::make_shared<Request>(Request{std::move(cancelled), std::move(done), std::move(failed)});
  strand_.post([self = shared_from_this(), method, params = std::move(params), client = std::move(client), request] {
    work_on(request, [&] {
      const Snapshot snapshot(self->document_, *client, Interest{request->cancelled.get(), &self->edits_waiting_});
      if (!method.begin) return request->done(method.answer(snapshot, params));
      self->post_background_request(method.begin(snapshot, params), *client, request);
    });
  });
}

/// Progress is shown for background requests of a long program, as one work while there are any.
void OpenDocument::post_background_request(features::BackgroundRequest study, const Client& client,
                                           std::shared_ptr<Request> request) {
  static constexpr dialect::Text kRunning = {"running {}", "esecuzione di {}"};
  const bool is_shown = is_long_ && client.can("/window/workDoneProgress");
  const auto name = [this] { return fmt::format("running {}", times_shown_); };
  if (is_shown) {
    const std::lock_guard lock(background_mutex_);
    if (background_waiting_++ == 0) {
      ++times_shown_;
      notifier_.progress(name(), titled(client, kRunning));
    }
  }
  background_requests_.post(
      [self = shared_from_this(), study = std::move(study), request = std::move(request), is_shown, name] {
        work_on(request, [&] { request->done(study([&] { return request->cancelled->load() || self->is_closed_; })); });
        if (!is_shown) return;
        const std::lock_guard lock(self->background_mutex_);
        if (--self->background_waiting_ == 0) self->notifier_.progress(name(), std::nullopt);
      });
}

}  // namespace isocnc::lsp
