#include "lsp/background/verification.h"

#include <exception>
#include <utility>

#include "lsp/background/work_title.h"

namespace isocnc::background {

using protocol::ClientPointer;
using protocol::VerifyWhen;

Verification::Verification(rpc::Loop& loop, rpc::Strand& strand, const VerificationOptions& options, std::string uri,
                           Callbacks callbacks)
    : loop_(loop), strand_(strand), options_(options), uri_(std::move(uri)), callbacks_(std::move(callbacks)) {}

void Verification::open(ClientPointer client) {
  ++edits_;
  end_present();
  start(client, options_.max_size);
}

void Verification::edit(ClientPointer client) {
  const std::uint64_t edit = ++edits_;
  end_present();
  if (client->settings.verifies != VerifyWhen::OnPause) return;
  loop_.post_at(Clock::now() + options_.pause, [weak = weak_from_this(), edit, client = std::move(client)] {
    const auto self = weak.lock();
    if (self && self->edits_ == edit && !self->is_slow_) self->start(client, self->options_.max_size);
  });
}

void Verification::save(ClientPointer client) {
  // One that has not started yet may turn out to be for shorter programs only.
  if (present_ && !present_->has_started) end_present();
  start(client, options_.max_saved_size);
}

void Verification::close() {
  ++edits_;
  end_present();
}

void Verification::cancel(std::uint64_t number) {
  if (present_ && present_->number == number) end_present();
}

void Verification::end_present() {
  if (!present_) return;
  present_->cancelled->store(true);
  if (present_->is_shown) callbacks_.progress(present_->number, std::nullopt);
  present_.reset();
}

namespace {

/// What a verification does on its strand.
struct Job {
  const VerificationOptions& options;
  std::shared_ptr<const std::atomic<bool>> cancelled;
  rpc::OnLoop<> started;
  rpc::OnLoop<VerificationResult, std::chrono::steady_clock::duration> ended;

  void run(const VerificationSubject& subject) const;
  std::shared_ptr<simulation::RunOutcome> outcome_of(const VerificationSubject& subject) const;
};

void Job::run(const VerificationSubject& subject) const {
  if (cancelled->load()) return ended({}, {});
  started();
  const auto start = std::chrono::steady_clock::now();
  VerificationResult result{.outcome = outcome_of(subject), .revision = subject.revision};
  ended(std::move(result), std::chrono::steady_clock::now() - start);
}

/// Null if the run was cancelled, or there is not enough memory for it.
std::shared_ptr<simulation::RunOutcome> Job::outcome_of(const VerificationSubject& subject) const {
  try {
    const auto scene = subject.settings.scene();
    verification::VerifiedRun verified = options.run(subject.text, *subject.settings.program, scene.get(),
                                                     {.stop = [this] { return cancelled->load(); }});
    if (!scene && subject.settings.has_mistaken_scene())
      verification::add_gap(verified, {.gap = verification::Gap::SetupMistaken}, subject.text);
    if (!cancelled->load()) return std::make_shared<simulation::RunOutcome>(std::move(verified.outcome));
  } catch (const std::exception&) {
    return nullptr;
  }
  return nullptr;
}

}  // namespace

/// Starts a verification, unless one of the present text is under way.
void Verification::start(const ClientPointer& client, std::size_t max_size) {
  if (present_ || client->settings.verifies == VerifyWhen::Never) return;
  const std::uint64_t number = ++times_started_;
  present_ = {.number = number, .cancelled = std::make_shared<std::atomic<bool>>(false)};
  const auto job =
      std::make_shared<const Job>(Job{.options = options_,
                                      .cancelled = present_->cancelled,
                                      .started = {loop_,
                                                  [weak = weak_from_this(), number, client] {
                                                    if (const auto self = weak.lock()) self->note_start(number, client);
                                                  }},
                                      .ended = {loop_, [weak = weak_from_this(), number, client](
                                                           const VerificationResult& result, Clock::duration duration) {
                                                  if (const auto self = weak.lock())
                                                    self->note_end(number, result, client, duration);
                                                }}});
  const rpc::OnWorker<std::optional<VerificationSubject>> take_subject(
      [&strand = strand_, job](std::optional<VerificationSubject> subject) {
        if (!subject) return job->ended({}, {});
        strand.post([job, subject = std::move(*subject)] { job->run(subject); });
      });
  callbacks_.order({.cancelled = present_->cancelled, .max_size = max_size}, take_subject);
}

/// The run has begun. What it waits for before, other documents, is not shown as its progress.
void Verification::note_start(std::uint64_t number, const ClientPointer& client) {
  if (!present_ || present_->number != number) return;
  present_->has_started = true;
  if (!client->can("/window/workDoneProgress")) return;
  loop_.post_at(Clock::now() + options_.shown_after, [weak = weak_from_this(), number, client] {
    static constexpr dialect::Text kVerifying = {"verifying {}", "verifica di {}"};
    const auto self = weak.lock();
    if (!self || !self->present_ || self->present_->number != number) return;
    self->present_->is_shown = true;
    self->callbacks_.progress(number, work_title(kVerifying, self->uri_, *client));
  });
}

void Verification::note_end(std::uint64_t number, const VerificationResult& result, const ClientPointer& client,
                            Clock::duration duration) {
  // One that was cancelled early does not say how long it would have taken.
  if (result.outcome) is_slow_ = duration >= options_.slow;
  if (!result.outcome && duration >= options_.slow) is_slow_ = true;
  if (!present_ || present_->number != number) return;
  end_present();
  if (result.outcome) callbacks_.take(result, client);
}

}  // namespace isocnc::background
