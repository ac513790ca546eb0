#include "lsp/document_worker.h"

#include <filesystem>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/system/paths.h"
#include "lsp/background/work_title.h"
#include "lsp/documents/configuration_diagnostics.h"
#include "lsp/feature_list.h"
#include "lsp/protocol/uri.h"

namespace isocnc::lsp {

using namespace dialect::literals;
using background::VerificationOrder;
using background::VerificationResult;
using background::VerificationSubject;
using background::work_on;
using background::work_title;
using background::WorkerRequest;
using documents::ContentChange;
using documents::Interest;
using documents::Snapshot;
using protocol::Client;
using rpc::Json;

/// In bytes. Shorter texts open faster than a user could read a progress message.
static constexpr std::size_t kLongText = 16 << 20;

DocumentWorker::DocumentWorker(rpc::Pool& pool, documents::SettingsStore& settings, std::string uri,
                               DocumentNotifier notifier, std::shared_ptr<DocumentSignals> signals)
    : uri_(uri),
      is_configuration_(protocol::names_configuration(uri)),
      settings_(settings),
      notifier_(std::move(notifier)),
      signals_(std::move(signals)),
      document_(std::move(uri), settings),
      background_requests_(pool, notifier_.progress) {}

static std::int64_t version_of(const Json& params) {
  return protocol::member<std::int64_t>(params.at("textDocument"), "version").value_or(0);
}

void DocumentWorker::open(const rpc::Call& call, const Client& client) {
  make_edit([&] {
    const std::string text = call.message.text(call.params().at("textDocument").at("text"));
    is_long_ = text.size() >= kLongText;
    start_progress(client);
    document_.open(version_of(call.params()), text);
  });
}

static std::vector<ContentChange> changes_in(const rpc::Call& call) {
  std::vector<ContentChange> changes;
  for (const Json& change : call.params().at("contentChanges"))
    changes.push_back({protocol::member<protocol::ClientRange>(change, "range"), call.message.text(change.at("text"))});
  return changes;
}

void DocumentWorker::edit(const rpc::Call& call, const Client& client) {
  make_edit([&] { document_.edit(version_of(call.params()), changes_in(call), client.encoding); });
}

void DocumentWorker::reconfigure(const Client& client) {
  make_edit([&] {
    document_.reread_settings();
    if (client.settings.verifies == protocol::VerifyWhen::Never) document_.drop_run();
  });
}

void DocumentWorker::make_edit(const std::function<void()>& edit) {
  try {
    edit();
  } catch (const std::exception& error) {
    log(error);
  }
  is_report_begun_ = false;
  ++change_count_;
  --signals_->edits_waiting;
}

/// Reports the change to features only after the last of the waiting edits.
bool DocumentWorker::report_change(std::uint64_t change, const Client& client, const rpc::OthersWait& others_wait) {
  if (change != change_count_) return true;
  const bool has_ended = signals_->edits_waiting != 0 || report_all(client, others_wait);
  if (has_ended && (signals_->edits_waiting == 0 || signals_->is_closed)) end_progress();
  return has_ended;
}

bool DocumentWorker::shows_progress_to(const Client& client) const {
  return is_long_ && client.can("/window/workDoneProgress");
}

void DocumentWorker::start_progress(const Client& client) {
  if (!shows_progress_to(client)) return;
  static constexpr dialect::Text kOpening = {"opening {}", "apertura di {}"};
  notifier_.progress("opening", work_title(kOpening, uri_, client));
  is_progress_shown_ = true;
}

void DocumentWorker::end_progress() {
  if (std::exchange(is_progress_shown_, false)) notifier_.progress("opening", std::nullopt);
}

void DocumentWorker::log(const std::exception& error) {
  notifier_.notify("window/logMessage",
                   rpc::write({{"type", 1}, {"message", fmt::format("{}: {}", uri_, error.what())}}));
}

bool DocumentWorker::report_all(const Client& client, const rpc::OthersWait& others_wait) {
  if (is_configuration_) {
    report_as_configuration(client);
    return true;
  }
  try {
    if (!std::exchange(is_report_begun_, true)) report_so_far(client);
    const Snapshot snapshot(document_, client, Interest{nullptr, &signals_->edits_waiting, others_wait});
    snapshot.analysis();
    for (const features::Feature* const feature : all_features())
      if (feature->changed) feature->changed(snapshot, notifier_.notify);
  } catch (const documents::Postponed&) {
    return false;
  } catch (const rpc::Error&) {
    return true;  // Another edit has arrived, and its change will be reported.
  } catch (const std::exception& error) {
    log(error);
  }
  return true;
}

/// Where an edit has many lines checked again, the first of them are reported at once: among them is the one in which
/// the user types.
void DocumentWorker::report_so_far(const Client& client) {
  report_configuration(client);
  const auto is_moment_over = [chunks = 0]() mutable { return ++chunks == check::Analysis::kChunksInAMoment; };
  if (document_.update(is_moment_over) || !document_.has_known_findings()) return;
  const Snapshot known(document_, client, {}, Snapshot::ShownFindings::Known);
  for (const features::Feature* const feature : all_features())
    if (feature->changed_so_far) feature->changed_so_far(known, notifier_.notify);
}

static std::string published(const std::string& uri, Json diagnostics) {
  return rpc::write({{"uri", uri}, {"diagnostics", std::move(diagnostics)}});
}

/// Reports the findings in the files that describe the program's machine and setup, once for all programs that use
/// them.
void DocumentWorker::report_configuration(const Client& client) {
  const documents::DocumentSettings& settings = document_.settings();
  const std::filesystem::path& found = settings.configuration->file;
  if (!found.empty() && settings_.claim(settings, found)) report_described(found, client);
  if (settings.file.empty()) return;
  const std::filesystem::path setup = configuration::setup_file(settings.file);
  std::error_code error;
  if (std::filesystem::exists(std::filesystem::symlink_status(setup, error)) && settings_.claim(settings, setup))
    report_described(setup, client);
}

/// Reports the findings in a file beside the program.
void DocumentWorker::report_described(const std::filesystem::path& shown, const Client& client) {
  const documents::DocumentSettings& settings = document_.settings();
  const std::filesystem::path file = configuration::real_path(shown.parent_path()) / shown.filename();
  const std::string uri = protocol::uri_of(file);
  const std::unique_lock turn = settings_.turn_to_report(settings, file);
  if (!turn.owns_lock()) return;
  notifier_.configuration(
      uri, published(uri, documents::configuration_diagnostics(file, *settings.scenes, client.encoding,
                                                               client.language(settings.configuration->language))));
}

/// A run has read the files with shapes around the program, and knows what is wrong with them. The files that describe
/// other programs are reported with those.
void DocumentWorker::report_shapes(const Client& client) {
  const documents::DocumentSettings& settings = document_.settings();
  std::set<std::string> own = {system::generic_name(settings.configuration->file)};
  if (!settings.file.empty()) own.insert(system::generic_name(configuration::setup_file(settings.file)));
  std::set<std::string> files;
  for (const configuration::SurroundingsMistake& each : settings.scenes->all_mistakes())
    if (each.is_of_shape && own.contains(each.file)) files.insert(each.file);
  for (const std::string& file : files) report_described(file, client);
}

void DocumentWorker::report_as_configuration(const Client& client) {
  last_client_ = client;
  notifier_.notify("textDocument/publishDiagnostics",
                   published(uri_, documents::configuration_diagnostics(
                                       document_.document().text(), *protocol::path_of(uri_),
                                       *document_.settings().scenes, client.encoding, client.language({}))));
}

void DocumentWorker::report_again() {
  if (is_configuration_ && last_client_) report_as_configuration(*last_client_);
}

bool DocumentWorker::answer(const features::Method& method, const Json& params, const Client& client,
                            const WorkerRequest& request, const AnswerTurn& turn) {
  static constexpr dialect::Text kRunning = {"running {}", "esecuzione di {}"};
  bool is_answered = true;
  work_on(request, [&] {
    if (turn.asked != document_.revision()) throw documents::edited();
    const Snapshot snapshot(document_, client,
                            Interest{request.cancelled.get(), &signals_->edits_waiting, turn.others_wait});
    try {
      if (!method.begin) return request.done(method.answer(snapshot, params));
      std::optional<std::string> title;
      if (shows_progress_to(client)) title = work_title(kRunning, uri_, client);
      const std::shared_ptr<const std::atomic<bool>> is_closed(signals_, &signals_->is_closed);
      background_requests_.post(method.begin(snapshot, params), request, is_closed, title);
    } catch (const documents::Postponed&) {
      is_answered = false;
    }
  });
  return is_answered;
}

void DocumentWorker::order_verification(const VerificationOrder& order,
                                        const rpc::OnWorker<std::optional<VerificationSubject>>& start) {
  const bool is_verified = document_.run() && document_.run()->is_current();
  if (order.cancelled->load() || is_verified || document_.size() > order.max_size) return start(std::nullopt);
  start(VerificationSubject{
      .text = document_.document().text(), .settings = document_.settings(), .revision = document_.revision()});
}

void DocumentWorker::take_verification(const VerificationResult& result, const Client& client) {
  if (result.revision != document_.revision()) return;
  // The error at which the run has stopped is shown itself.
  std::erase_if(result.outcome->findings, [](const simulation::RunFinding& each) {
    return each.finding.has(dialect::Cause("not-verified"_diag));
  });
  document_.take_run(std::move(*result.outcome));
  report_verification(client);
  report_shapes(client);
}

void DocumentWorker::report_verification(const Client& client) {
  try {
    const Snapshot snapshot(document_, client, Interest{nullptr, &signals_->edits_waiting});
    for (const features::Feature* const feature : all_features()) {
      if (!feature->verified || !feature->verified(snapshot, notifier_.notify)) continue;
      if (feature->refresh && client.can(feature->refresh->capability))
        notifier_.request(std::string(feature->refresh->method));
    }
  } catch (const rpc::Error&) {
    return;  // An edit has arrived, and its change will be reported with what is left of the findings.
  } catch (const std::exception& error) {
    log(error);
  }
}

}  // namespace isocnc::lsp
