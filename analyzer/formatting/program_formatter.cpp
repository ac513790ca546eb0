#include "analyzer/formatting/program_formatter.h"

#include <algorithm>

#include "interpreter/text/characters.h"

namespace isocnc::formatting {

using syntax::Instruction;
using syntax::InstructionKind;
using syntax::LineChange;
using syntax::LineTree;

/// The bytes of a piece: enough to write at once, few enough to stay in the cache.
static constexpr std::ptrdiff_t kPieceBytes = 64 * 1024;

ProgramStyle style_by(const configuration::Format& format) {
  ProgramStyle style;
  style.line.max_decimals = format.decimals;
  style.line.word_order = format.word_order;
  if (format.g_digits) style.line.g_digits = *format.g_digits == 1 ? syntax::GDigits::One : syntax::GDigits::Two;
  if (format.modal == "write") style.motions = MotionStyle::Write;
  if (format.modal == "fold") style.motions = MotionStyle::Fold;
  if (const auto& renumber = format.renumber)
    style.numbers = {static_cast<std::uint64_t>(renumber->start), static_cast<std::uint64_t>(renumber->step),
                     renumber->all_lines};
  return style;
}

LinesFormatter::LinesFormatter(const ProgramStyle& style, const EachLine& each_line)
    : motions_(style.motions), orders_words_(style.line.word_order), formatter_(style.line) {
  if (!style.numbers) return;
  numbers_.emplace(each_line, *style.numbers);
  obstacle_ = numbers_->obstacle();
}

LineChange LinesFormatter::next(const LineTree& line) {
  LineChange change;
  if (motions_ == MotionStyle::Keep && !orders_words_ && !numbers_) return change;
  motion_.enter(line);
  change.motion = motion_change(line);
  change.motion_in_force = motion_.in_force();
  change.keeps_order = motion_.may_go_on(line);
  if (numbers_) numbers_->change(line, change.keeps_order, change);
  motion_.leave(line);
  return change;
}

/// Changes a motion only if all paths to the line agree on it, it takes all the line's words, an arc has a circle, and
/// the block above lacks nothing: other lines have findings, whose place would change.
LineChange::MotionEdit LinesFormatter::motion_change(const LineTree& line) const {
  if (motions_ == MotionStyle::Keep || motion_.follows_lack() || !motion_.is_known() || !line.findings.empty())
    return LineChange::MotionEdit::Keep;
  const dialect::GCode& in_force = *dialect::g_code(motion_.in_force());
  const bool writes = motions_ == MotionStyle::Write;
  const auto fits = [&](const Instruction& instruction) {
    if (writes) return instruction.kind == InstructionKind::Continuation;
    return instruction.kind == InstructionKind::G && instruction.g() == &in_force;
  };
  const auto motion = std::find_if(line.instructions.begin(), line.instructions.end(), fits);
  if (motion == line.instructions.end()) return LineChange::MotionEdit::Keep;
  if (!is_sound(line, *motion, in_force)) return LineChange::MotionEdit::Keep;
  return writes ? LineChange::MotionEdit::Write : LineChange::MotionEdit::Drop;
}

ProgramFormatter::ProgramFormatter(std::string_view text, const ProgramStyle& style)
    : lines_(style, each_line_of(text)), begin_(text.data()), next_(text.data()), end_(text.data() + text.size()) {
  if (lines_.obstacle()) next_ = end_;
}

std::optional<FormattedPiece> ProgramFormatter::next() {
  if (next_ == end_) return std::nullopt;
  const char* const begin = next_;
  after_.clear();
  copied_ = begin;
  while (next_ != end_ && next_ - begin < kPieceBytes) {
    store_.clear();
    const char* const line_end = store_.append_line(next_, end_);
    add_line(store_.tree(0, next_));
    next_ = text::skip_line_end(line_end, end_);
  }
  const std::string_view before(begin, static_cast<std::size_t>(next_ - begin));
  if (copied_ == begin) return FormattedPiece{before, before};
  after_.append(copied_, next_);
  return FormattedPiece{before, after_};
}

/// Unchanged lines, and all line ends, are copied together when a changed line comes. Blanks alone stay between CR and
/// LF, which without them would end one line.
void ProgramFormatter::add_line(const LineTree& line) {
  const std::string_view formatted = lines_.written(line, lines_.next(line));
  if (formatted == line.text) return;
  const char* const line_begin = line.text.data();
  const char* const line_end = line_begin + line.text.size();
  const bool parts_line_ends = line_begin != begin_ && line_begin[-1] == '\r' && line_end != end_ && *line_end == '\n';
  if (formatted.empty() && parts_line_ends) return;
  after_.append(copied_, line.text.data());
  after_.append(formatted);
  copied_ = line.text.data() + line.text.size();
}

}  // namespace isocnc::formatting
