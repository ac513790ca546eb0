#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "analyzer/selection/verified.h"
#include "interpreter/simulation/run_findings.h"
#include "interpreter/system/process.h"
#include "lsp/documents/settings_store.h"
#include "lsp/protocol/client.h"
#include "lsp/rpc/loop.h"
#include "lsp/rpc/on_loop.h"
#include "lsp/rpc/strand.h"

namespace isocnc::background {

/// When open programs are verified, and how. Tests use other values.
struct VerificationOptions {
  std::chrono::milliseconds pause{1000};  ///< Time without an edit after which a program is verified.
  /// Programs whose verification has taken this long are not verified again before they are saved.
  std::chrono::milliseconds slow{2000};
  std::chrono::milliseconds shown_after{500};  ///< A verification that takes longer has its progress shown.
  std::size_t max_size = system::has_threads() ? kSlowSize : kShortSize;       ///< Longer ones wait for saving; bytes.
  std::size_t max_saved_size = system::has_threads() ? kAnySize : kShortSize;  ///< Longer ones are not verified; bytes.
  std::function<verification::VerifiedRun(std::string_view text, const selection::ProgramSettings& settings,
                                          const verification::Scene* scene, const selection::VerifyOptions& options)>
      run = selection::verified;

  /// Takes about 10 s without a scene: 2,000,000 lines of motions have 50 MB, and take 2 s.
  static constexpr std::size_t kSlowSize = std::size_t{256} << 20;
  /// Takes a moment, for which requests may wait where there are no threads.
  static constexpr std::size_t kShortSize = std::size_t{256} << 10;
  static constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();
};

/// A verification that is wanted of a document's worker.
struct VerificationOrder {
  std::shared_ptr<const std::atomic<bool>> cancelled;
  std::size_t max_size = 0;  ///< Longer programs are not verified; bytes.
};

/// A copy of a program that is to be verified.
struct VerificationSubject {
  std::string text;
  documents::DocumentSettings settings;
  std::uint64_t revision = 0;  ///< Of the document.
};

/// What a verification has shown.
struct VerificationResult {
  std::shared_ptr<simulation::RunOutcome> outcome;  ///< Null if it was cancelled.
  std::uint64_t revision = 0;
};

/// Decides when one open program is verified, by a run on the simulated machine. The run is made on a strand that all
/// documents share, so that one run at a time takes memory and a processor, and requests never wait for one. An edit
/// ends it. Used on the loop's thread only.
class Verification : public std::enable_shared_from_this<Verification> {
 public:
  /// What a verification asks of its document. Called on the loop's thread.
  struct Callbacks {
    /// The document's worker is to call start() with what is to be verified, or with nothing.
    std::function<void(VerificationOrder order, const rpc::OnWorker<std::optional<VerificationSubject>>& start)> order;
    std::function<void(VerificationResult result, protocol::ClientPointer client)> take;
    /// Shows the progress of a verification; without a title it has ended.
    std::function<void(std::uint64_t number, const std::optional<std::string>& title)> progress;
  };

  Verification(rpc::Loop& loop, rpc::Strand& strand, const VerificationOptions& options, std::string uri,
               Callbacks callbacks);

  /// The document has been opened, or its settings have changed. The latter ends a verification.
  void open(protocol::ClientPointer client);
  void edit(protocol::ClientPointer client);
  void save(protocol::ClientPointer client);
  /// Ends the verification, and plans no other: the document has been closed, or the server ends.
  void close();
  /// Ends the verification with this number, as the user wants. The next one begins as after an edit, or on saving.
  void cancel(std::uint64_t number);

 private:
  using Clock = std::chrono::steady_clock;

  /// A verification that has been ordered and has not ended.
  struct Present {
    std::uint64_t number = 0;
    std::shared_ptr<std::atomic<bool>> cancelled;
    bool has_started = false;
    bool is_shown = false;
  };

  void start(const protocol::ClientPointer& client, std::size_t max_size);
  void end_present();
  void note_start(std::uint64_t number, const protocol::ClientPointer& client);
  void note_end(std::uint64_t number, const VerificationResult& result, const protocol::ClientPointer& client,
                Clock::duration duration);

  rpc::Loop& loop_;
  rpc::Strand& strand_;
  const VerificationOptions& options_;
  const std::string uri_;
  const Callbacks callbacks_;
  std::uint64_t edits_ = 0;
  std::uint64_t times_started_ = 0;
  bool is_slow_ = false;  // Whether the last verification took long, whether or not it came to its end.
  std::optional<Present> present_;
};

}  // namespace isocnc::background
