#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "lsp/documents/analyzed_document.h"
#include "lsp/features/feature.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/strand.h"

namespace isocnc::lsp {

/// A document that the client holds open, and the strand on which everything about it is done: edits and requests in
/// the order in which they came, while other documents go their own way. So there is one analysis, without a lock, and
/// each answer is about the text that the client saw when it asked.
///
/// The editor may also hold an isocnc.json open: then what is told of it is what is wrong with its text, saved or not.
///
/// Called on the loop's thread; the work, and the answers, come on the strand.
class OpenDocument : public std::enable_shared_from_this<OpenDocument> {
 public:
  using ClientPointer = std::shared_ptr<const documents::Client>;

  /// What is wrong with a configuration file, told as diagnostics of its own.
  using ReportConfiguration = std::function<void(std::string uri, std::string params)>;

  /// Work on the document goes on that the user may want to see, under a title; without one it is over. No two works of
  /// a document have the same name.
  using ReportProgress = std::function<void(std::string work, std::optional<std::string> title)>;

  struct Notifier {
    features::Notify notify;
    ReportConfiguration configuration;
    ReportProgress progress;
  };

  OpenDocument(rpc::Pool& pool, documents::SettingsStore& settings, std::string uri, Notifier notifier);

  const std::string& uri() const { return uri_; }
  bool is_configuration() const { return is_configuration_; }

  void open(std::shared_ptr<const rpc::Call> call, const ClientPointer& client);
  void edit(std::shared_ptr<const rpc::Call> call, const ClientPointer& client);
  /// Nobody looks at the document any more. What it still has to say is for the caller to drop.
  void close() {
    is_closed_ = true;
    ++edits_waiting_;
  }
  /// The client's settings or the configuration files have changed.
  void reconfigure(ClientPointer client);
  /// Whoever sets `cancelled` answers the request, too.
  void ask(features::Method method, rpc::Json params, ClientPointer client,
           std::shared_ptr<const std::atomic<bool>> cancelled, std::function<void(std::string result)> done,
           std::function<void(rpc::Error error)> failed);

 private:
  struct Request;
  static void work_on(const std::shared_ptr<Request>& request, const std::function<void()>& work);

  void post_edit(std::function<void()> edit, ClientPointer client);
  void report_change(const documents::Client& client);
  void start_progress(const documents::Client& client);
  void end_progress();
  std::string titled(const documents::Client& client, const dialect::Text& title) const;
  void post_background_request(features::BackgroundRequest study, const documents::Client& client,
                               std::shared_ptr<Request> request);
  void report_configuration(const documents::Client& client);
  void report_as_configuration(const documents::Client& client);
  void log(const std::exception& error);

  const std::string uri_;
  const bool is_configuration_;  // An isocnc.json, in which no program is looked for.
  documents::SettingsStore& settings_;
  const Notifier notifier_;
  std::atomic<int> edits_waiting_ = 0;
  std::atomic<bool> is_closed_ = false;
  bool is_long_ = false;                  // Of the strand: the text, when it was opened.
  bool shows_progress_ = false;           // Of the strand.
  documents::AnalyzedDocument document_;  // Of the strand.
  rpc::Strand strand_;
  rpc::Strand background_requests_;  // What takes long, one after another.
  std::mutex background_mutex_;
  int background_waiting_ = 0;  // Those that are shown, as all below: guarded by the mutex.
  int times_shown_ = 0;
};

}  // namespace isocnc::lsp
