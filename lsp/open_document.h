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

/// A document that the client has open, and the strand that runs all work on it: edits and requests in the order of
/// their arrival, in parallel to other documents. So there is one analysis, without a lock, and each answer is about
/// the text that the client saw when it asked.
///
/// The editor may also have an isocnc.json open: then its diagnostics are about the text in the editor, saved or not.
///
/// Member functions are called on the loop's thread; the work runs on the strand, and callbacks are called there.
class OpenDocument : public std::enable_shared_from_this<OpenDocument> {
 public:
  using ClientPointer = std::shared_ptr<const documents::Client>;

  /// Reports the diagnostics of a configuration file, at its own URI.
  using ReportConfiguration = std::function<void(std::string uri, std::string params)>;

  /// Shows the progress of some work to the user: with a title the work has started, without one it has ended. `work`
  /// is its name, unique within the document.
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
  /// Ends work on the document: the editor has closed it. The caller has to drop notifications that still arrive.
  void close() {
    is_closed_ = true;
    ++edits_waiting_;
  }
  /// The client's settings or the configuration files have changed.
  void reconfigure(ClientPointer client);
  /// The code that sets `cancelled` has to answer the request itself.
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
  const bool is_configuration_;  // Whether this is an isocnc.json, which is never read as a program.
  documents::SettingsStore& settings_;
  const Notifier notifier_;
  std::atomic<int> edits_waiting_ = 0;
  std::atomic<bool> is_closed_ = false;
  bool is_long_ = false;                  // Whether the text was long when opened. Used on the strand only.
  bool shows_progress_ = false;           // Used on the strand only.
  documents::AnalyzedDocument document_;  // Used on the strand only.
  rpc::Strand strand_;
  rpc::Strand background_requests_;  // Runs the background requests one after another.
  std::mutex background_mutex_;
  int background_waiting_ =
      0;  // Number of unfinished requests that are shown. The mutex guards this and the next member.
  int times_shown_ = 0;
};

}  // namespace isocnc::lsp
