#include "analyzer/check/batch.h"

#include <algorithm>
#include <utility>

#include "interpreter/text/characters.h"

namespace isocnc::check {

bool is_over(const Frontier& frontier) { return frontier.finished() && frontier.dead_reported; }

// --- Batch

void Batch::parse(std::string_view text, const char* end) {
  text_ = text;
  trees_.clear();
  trees_.append_lines(text.data(), text.data() + text.size(), end);
}

std::size_t Batch::check(Checker& checker, std::size_t line, Outcome& outcome) const {
  const char* p = text_.data();
  const char* const end = p + text_.size();
  const auto after_line = [&](std::size_t index) { return text::skip_line_end(p + trees_.length(index), end); };
  for (std::size_t i = 0; i < trees_.size();) {
    const std::size_t plain = checker.check_plain_lines(trees_, i, line, outcome);
    line += plain;
    for (const std::size_t plain_end = i + plain; i < plain_end; ++i) p = after_line(i);
    if (i == trees_.size()) break;
    checker.check_any(trees_.tree(i, p), line++, outcome);
    if (is_over(checker.frontier)) return line;
    p = after_line(i++);
  }
  return line;
}

// --- Portion

std::ptrdiff_t Portion::bytes_for(std::size_t text, int threads) {
  constexpr std::size_t kLeast = 64 * 1024;
  constexpr std::size_t kMost = 1024 * 1024;
  return static_cast<std::ptrdiff_t>(std::clamp(text / (8 * static_cast<std::size_t>(threads)), kLeast, kMost));
}

std::string_view Portion::batch_at(const char* begin) const {
  return text::whole_lines(begin, kBatchBytes, text_.data() + text_.size());
}

void Portion::start(std::string_view text, const char* end) {
  text_ = text;
  end_ = end;
  ahead_.clear();
}

void Portion::check_ahead(Checker& checker, std::string_view above) {
  if (!above.empty()) {
    Outcome ignored;
    batch_.parse(above, end_);
    batch_.check(checker, 0, ignored);
  }
  const char* const end = text_.data() + text_.size();
  for (const char* p = text_.data(); p != end && !is_over(checker.frontier); p += batch_.text().size()) {
    Ahead& ahead = ahead_.emplace_back();
    ahead.before = checker.frontier;
    batch_.parse(batch_at(p), end_);
    ahead.lines = batch_.check(checker, 0, ahead.outcome);
  }
  after_ = checker.frontier;
}

/// Takes over batches from number `first` on, before which the frontier differs by `change` from the assumed one, as
/// long as they give the same findings. Returns the number of the batch after them; `checker` has the frontier there.
std::size_t Portion::take_over(std::size_t first, FrontierChange change, Checker& checker, std::size_t& line,
                               Outcome& outcome) {
  std::size_t i = first;
  for (; i < ahead_.size(); ++i) {
    auto& [before, found, lines] = ahead_[i];
    const rules::HouseRules* const rules = checker.setup().house_rules.get();
    if (!change.empty()) {
      if (!change.passes(found.positions, found.only_row, before, rules)) break;
      change.pass(found.positions, found.only_row, i + 1 == ahead_.size() ? after_ : ahead_[i + 1].before, rules);
    }
    outcome.append(std::move(found), line);
    line += lines;
  }
  if (i == first) return i;
  taken_over_ += i - first;
  checker.frontier = i == ahead_.size() ? after_ : ahead_[i].before;
  change.apply(checker.frontier);
  return i;
}

std::size_t Portion::check(Checker& checker, std::size_t line, Outcome& outcome) {
  taken_over_ = 0;
  executed_ = 0;
  std::size_t i = 0;
  const char* p = text_.data();
  for (const char* const end = p + text_.size(); p != end && !is_over(checker.frontier);) {
    if (i < ahead_.size()) {
      if (auto change = change_between(ahead_[i].before, checker.frontier)) {
        const std::size_t next = take_over(i, std::move(*change), checker, line, outcome);
        for (; i < next; ++i) p += batch_at(p).size();
        if (p == end || is_over(checker.frontier)) break;
      }
    }
    batch_.parse(batch_at(p), end_);
    line = batch_.check(checker, line, outcome);
    p += batch_.text().size();
    ++executed_;
    ++i;
  }
  return line;
}

}  // namespace isocnc::check
