#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lsp/features/feature.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/on_loop.h"
#include "lsp/rpc/strand.h"

namespace isocnc::background {

/// Shows the progress of some work to the user: with a title the work has started, without one it has ended. `work` is
/// its name, unique within the document.
using ReportProgress = rpc::OnLoop<std::string /*work*/, std::optional<std::string> /*title*/>;

/// A request that is being worked on. The code that sets `cancelled` has to answer the request itself.
struct WorkerRequest {
  std::shared_ptr<const std::atomic<bool>> cancelled;
  rpc::OnWorker<std::string> done;  ///< Gets the result, as JSON text.
  rpc::OnWorker<rpc::Error> failed;
};

/// Runs the work, unless the request has been cancelled, and turns an exception into the request's error.
void work_on(const WorkerRequest& request, const std::function<void()>& work);

/// The long requests of one document, which run one after another on a strand of their own. May be used on any thread.
class BackgroundRequests {
 public:
  BackgroundRequests(rpc::Pool& pool, ReportProgress report_progress);

  /// With a title, the progress is shown: as one work, from the first such request to the end of the last that waits.
  void post(features::BackgroundRequest work, WorkerRequest request, std::shared_ptr<const std::atomic<bool>> is_closed,
            const std::optional<std::string>& title);

 private:
  class ShownProgress;

  std::shared_ptr<ShownProgress> progress_;
  rpc::Strand strand_;
};

}  // namespace isocnc::background
