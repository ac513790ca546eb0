#include "interpreter/command_line/progress.h"

#include <algorithm>

#include <fmt/format.h>

#include "interpreter/system/descriptor.h"
#include "interpreter/system/terminal.h"

namespace isocnc::command_line {

static constexpr std::chrono::milliseconds kProgressDelay{500};
static constexpr std::chrono::milliseconds kPace{100};
static constexpr std::string_view kErase = "\r\x1b[K";

Progress::Progress(std::function<void(std::string_view)> write, std::uint64_t total_bytes,
                   std::function<Clock::time_point()> now)
    : write_(std::move(write)), now_(std::move(now)), total_(total_bytes), next_(now_() + kProgressDelay) {}

std::string Progress::bar(std::uint64_t done) const {
  constexpr std::uint64_t kWidth = 30;
  const std::uint64_t filled = kWidth * done / total_;
  return fmt::format("{}[{:#<{}}{:.<{}}] {:3} %", kErase, "", filled, "", kWidth - filled, 100 * done / total_);
}

void Progress::add(std::uint64_t bytes) {
  const std::uint64_t done = done_ += bytes;
  if (!write_ || total_ == 0) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;  // Another thread is drawing.
  const Clock::time_point now = now_();
  if (now < next_) return;
  next_ = now + kPace;
  write_(bar(std::min(done, total_)));
  is_drawn_ = true;
}

void Progress::clear() {
  const std::lock_guard lock(mutex_);
  if (is_drawn_) write_(kErase);
  is_drawn_ = false;
}

std::function<void(std::string_view)> terminal_writer() {
  if (!system::can_redraw(system::kStandardError)) return {};
  return [](std::string_view text) {
    system::write_some(system::kStandardError, text);  // A failure to draw the bar is ignored.
  };
}

}  // namespace isocnc::command_line
