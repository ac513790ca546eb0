#include "lsp/background/background_requests.h"

#include <mutex>
#include <utility>

#include <fmt/format.h>

namespace isocnc::background {

void work_on(const WorkerRequest& request, const std::function<void()>& work) {
  if (request.cancelled->load()) return;
  try {
    work();
  } catch (const rpc::Error& error) {
    request.failed(error);
  } catch (const rpc::Json::exception& error) {
    request.failed(rpc::Error(rpc::ErrorCode::InvalidParams, error.what()));
  } catch (const std::exception& error) {
    request.failed(rpc::Error(rpc::ErrorCode::InternalError, error.what()));
  }
}

/// Counts the requests that are shown and have not ended.
class BackgroundRequests::ShownProgress {
 public:
  explicit ShownProgress(ReportProgress report) : report_(std::move(report)) {}

  void start(const std::string& title) {
    const std::lock_guard lock(mutex_);
    if (waiting_++ > 0) return;
    ++times_shown_;
    report_(name(), title);
  }
  void end() {
    const std::lock_guard lock(mutex_);
    if (--waiting_ == 0) report_(name(), std::nullopt);
  }

 private:
  std::string name() const { return fmt::format("running {}", times_shown_); }

  const ReportProgress report_;
  std::mutex mutex_;  // Guards the members below.
  int waiting_ = 0;
  int times_shown_ = 0;
};

BackgroundRequests::BackgroundRequests(rpc::Pool& pool, ReportProgress report_progress)
    : progress_(std::make_shared<ShownProgress>(std::move(report_progress))), strand_(pool) {}

void BackgroundRequests::post(features::BackgroundRequest work, WorkerRequest request,
                              std::shared_ptr<const std::atomic<bool>> is_closed,
                              const std::optional<std::string>& title) {
  if (title) progress_->start(*title);
  strand_.post([work = std::move(work), request = std::move(request), is_closed = std::move(is_closed),
                is_shown = title.has_value(), progress = progress_] {
    const auto stop = [&] { return request.cancelled->load() || is_closed->load(); };
    work_on(request, [&] { request.done(work(stop)); });
    if (is_shown) progress->end();
  });
}

}  // namespace isocnc::background
