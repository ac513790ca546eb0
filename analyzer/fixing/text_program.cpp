#include "analyzer/fixing/text_program.h"

#include <algorithm>

#include "interpreter/syntax/formatter.h"
#include "interpreter/text/characters.h"

namespace isocnc::fixing {

using syntax::LineTree;

/// A check of the text, from top to bottom.
struct TextProgram::Walk {
  check::Checker checker;
  check::Outcome outcome;  // The findings, which are not used.
  syntax::TreeStore store;
  std::size_t line = 0;  // The next line.

  /// Checks the next line. `end` is that of the whole text: short of it the short cut for plain lines gives up.
  void step(std::string_view text, const char* end) {
    store.clear();
    store.append_line(text.data(), end);
    checker.check(store.tree(0, text.data()), line++, outcome);
    if (outcome.findings.size() + outcome.labels.size() + outcome.live_jumps.size() > 1'000) outcome.clear();
  }
};

TextProgram::TextProgram(std::string_view text, const rules::CheckSetup& setup, std::function<void()> on_line)
    : text_(text), setup_(setup), on_line_(std::move(on_line)) {}

TextProgram::~TextProgram() = default;

const std::vector<std::size_t>& TextProgram::starts() const {
  if (!starts_.empty()) return starts_;
  const char* const end = text_.data() + text_.size();
  starts_.push_back(0);
  for (const char* p = text_.data(); p != end;) {
    const char* const line_end = text::find_line_end(p, end);
    if (line_end == end) break;
    p = text::skip_line_end(line_end, end);
    starts_.push_back(static_cast<std::size_t>(p - text_.data()));
  }
  return starts_;
}

std::size_t TextProgram::line_count() const { return starts().size(); }

std::string_view TextProgram::text(std::size_t line) {
  if (on_line_) on_line_();
  const std::vector<std::size_t>& all = starts();
  const bool is_last = line + 1 == all.size();
  std::size_t end = is_last ? text_.size() : all[line + 1];
  if (!is_last) end -= line_end(line).size();
  return text_.substr(all[line], end - all[line]);
}

LineTree TextProgram::line(std::size_t line) {
  const std::string_view content = text(line);
  if (parsed_ != line) {
    tree_.clear();
    tree_.append_line(content.data(), content.data() + content.size());
    parsed_ = line;
  }
  return tree_.tree(0, content.data());
}

const check::JumpMap& TextProgram::jumps() {
  if (!jumps_) jumps_ = check::JumpMap::with_labels(text_);
  return *jumps_;
}

bool TextProgram::is_read(std::size_t line) {
  const check::Frontier& frontier = frontier_before(line);
  return !frontier.live.empty() || !frontier.live_at(syntax::ParsedLine(text(line)).tree()).empty();
}

bool TextProgram::is_jumped_to(std::uint64_t label) { return jumps().names(label); }

const check::Frontier& TextProgram::frontier_before(std::size_t line) {
  // NOLINTNEXTLINE(modernize-make-unique): made where it stays, since a Checker in it is large.
  if (!walk_ || walk_->line > line) walk_.reset(new Walk{.checker = check::Checker(setup_, jumps())});
  while (walk_->line < std::min(line, line_count())) walk_->step(text(walk_->line), text_.data() + text_.size());
  return walk_->checker.frontier;
}

std::optional<execution::State> TextProgram::state_before(std::size_t line) {
  const check::Frontier& frontier = frontier_before(line);
  const bool has_label = line < line_count() && !frontier.waiting().empty();
  const syntax::ParsedLine next(has_label ? text(line) : std::string_view());
  return frontier.state_at(next.tree());
}

std::uint64_t TextProgram::highest_line_number() {
  std::uint64_t highest = 0;
  syntax::TreeStore store;
  const char* const end = text_.data() + text_.size();
  for (const std::size_t start : starts()) {
    store.clear();
    store.append_line(text_.data() + start, end);
    const LineTree tree = store.tree(0, text_.data() + start);
    if (tree.has_label()) highest = std::max(highest, tree.label);
  }
  return highest;
}

std::size_t TextProgram::offset(const syntax::Position& position) const {
  return starts()[position.line] + position.column;
}

std::string_view TextProgram::line_end(std::size_t line) const {
  const std::vector<std::size_t>& all = starts();
  if (all.size() == 1) return "\n";
  const std::size_t end = all[std::min<std::size_t>(line + 1, all.size() - 1)];
  const bool is_pair = text_[end - 1] == '\n' && end > 1 && text_[end - 2] == '\r';
  return text_.substr(end - (is_pair ? 2 : 1), is_pair ? 2 : 1);
}

}  // namespace isocnc::fixing
