#include "interpreter/syntax/formatter.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <stdexcept>

#include "interpreter/dialect/letters.h"
#include "interpreter/text/characters.h"

namespace isocnc::syntax {

/// Padding after the text that is parsed again: the fast path of the parser reads ahead.
static constexpr std::string_view kLookAheadPadding = "\n               ";

/// Index of the word with the line's number; without one, the number of words.
static std::size_t line_number_word(const LineTree& tree) {
  const Word* const word = tree.label_word();
  return word == nullptr ? tree.words.size() : static_cast<std::size_t>(word - tree.words.data());
}

static bool is_argument(const LineTree& tree, const Instruction& instruction, std::size_t index) {
  const bool is_command = instruction.kind != InstructionKind::Continuation && index == instruction.command;
  return tree.words[index].owner == instruction.number && !is_command;
}

/// Whether the word consists of its letter and the characters of its number only.
static bool is_compact(const Word& word) {
  const std::uint32_t characters =
      1 + word.digits + (word.has(Word::kSigned) ? 1 : 0) + (word.has(Word::kPoint) ? 1 : 0);
  return word.letter >= 'A' && word.end - word.begin == characters;
}

/// Whether the characters of the line need no change: compact words in upper case, one blank between them, and at most
/// a comment after them.
static bool is_tidy(const LineTree& tree) {
  const char* const text = tree.text.data();
  std::uint32_t after = 0;
  for (const Word& word : tree.words) {
    const std::uint32_t gap = after == 0 ? 0 : 1;
    if (!is_compact(word) || word.begin != after + gap || text[word.begin] != word.letter ||
        (gap != 0 && text[after] != ' '))
      return false;
    after = word.end;
  }
  if (tree.comments.empty()) return after == tree.text.size();
  const Span comment = tree.comments.front();
  const bool stands_apart = tree.words.empty() || comment.begin > after;
  return tree.comments.size() == 1 && stands_apart && comment.end == tree.text.size();
}

namespace {

/// Compares the meaning of a line before and after formatting.
class Rereading {
 public:
  Rereading(const LineTree& before, const LineTree& after, const LineChange& change)
      : before_(before), after_(after), change_(change) {}

  bool has_same_meaning() const {
    return after_.findings.empty() && has_same_label() && has_same_jump() && has_same(before_.feed, after_.feed) &&
           has_same(before_.spindle, after_.spindle) && has_same_comments() && has_same_instructions();
  }

 private:
  bool has_same_label() const {
    const bool has_label = before_.has_label() || change_.line_number;
    return has_label == after_.has_label() &&
           (!has_label || after_.label == change_.line_number.value_or(before_.label));
  }

  bool has_same_jump() const {
    const Jump* const before = before_.jump;
    const Jump* const after = after_.jump;
    if (before == nullptr || after == nullptr) return before == after;
    return before->variable == after->variable && before->comparison == after->comparison &&
           before->value == after->value && after->has_target == before->has_target &&
           after->target == change_.target.value_or(before->target);
  }

  static bool is_same_number(const Word& a, const Word& b) {
    return a.value == b.value || (!a.known() && !b.known() && a.digits == b.digits);
  }

  bool has_same(std::int32_t before, std::int32_t after) const {
    if (before < 0 || after < 0) return before == after;
    return is_same_number(before_.words[static_cast<std::size_t>(before)],
                          after_.words[static_cast<std::size_t>(after)]);
  }

  bool has_same_comments() const {
    return std::equal(before_.comments.begin(), before_.comments.end(), after_.comments.begin(), after_.comments.end(),
                      [&](Span a, Span b) { return before_.text_of(a) == after_.text_of(b); });
  }

  bool has_same_instructions() const {
    return std::equal(before_.instructions.begin(), before_.instructions.end(), after_.instructions.begin(),
                      after_.instructions.end(),
                      [&](const Instruction& a, const Instruction& b) { return is_equivalent(a, b); });
  }

  bool is_equivalent(const Instruction& a, const Instruction& b) const {
    if (a.is_motion() && b.is_motion()) return is_same_motion(a, b) && has_same_arguments(a, b);
    // That it comes first on its line matters only to a G09 and a T.
    const bool first_counts = a.is(dialect::GRole::ExactStop) || a.kind == InstructionKind::StrayTool;
    const int ignored = first_counts ? 0 : Instruction::kFirst;
    if (a.kind != b.kind || a.row != b.row || (a.flags | ignored) != (b.flags | ignored)) return false;
    if (a.kind == InstructionKind::G) return has_same_arguments(a, b);
    return a.kind == InstructionKind::Jump || has_same_words(a, b);  // The words of a jump are compared by its Jump.
  }

  bool is_same_motion(const Instruction& a, const Instruction& b) const {
    switch (change_.motion) {
      case LineChange::MotionEdit::Keep:
        break;
      case LineChange::MotionEdit::Write:
        if (a.kind != InstructionKind::Continuation) break;
        return b.kind == InstructionKind::G && b.g()->number == change_.motion_in_force;
      case LineChange::MotionEdit::Drop:
        return a.kind == InstructionKind::G && b.kind == InstructionKind::Continuation;
    }
    return a.kind == b.kind && a.row == b.row;
  }

  /// Arguments may come in any order, and no letter comes twice (D16, D19).
  bool has_same_arguments(const Instruction& a, const Instruction& b) const {
    std::size_t left = 0;
    for (std::size_t i = b.begin; i < b.end; ++i) left += is_argument(after_, b, i) ? 1 : 0;
    for (std::size_t i = a.begin; i < a.end; ++i) {
      if (!is_argument(before_, a, i)) continue;
      const Word& wanted = before_.words[i];
      const auto is_wanted = [&](std::size_t at) {
        return is_argument(after_, b, at) && after_.words[at].letter == wanted.letter;
      };
      std::size_t at = b.begin + (i - a.begin);  // The usual position.
      if (at >= b.end || !is_wanted(at)) {
        at = b.begin;
        while (at < b.end && !is_wanted(at)) ++at;
      }
      if (left == 0 || at == b.end || !is_same_number(wanted, after_.words[at])) return false;
      --left;
    }
    return left == 0;
  }

  bool has_same_words(const Instruction& a, const Instruction& b) const {
    const auto is_owned = [](const LineTree& tree, const Instruction& owner, std::size_t index) {
      return index < owner.end && tree.words[index].owner != owner.number;
    };
    std::size_t i = a.begin;
    std::size_t j = b.begin;
    for (;; ++i, ++j) {
      while (is_owned(before_, a, i)) ++i;
      while (is_owned(after_, b, j)) ++j;
      if (i >= a.end || j >= b.end) return i >= a.end && j >= b.end;
      const Word& before = before_.words[i];
      const Word& after = after_.words[j];
      const bool digits_count = before.letter == 'T';  // A T has exactly six digits.
      if (before.letter != after.letter || !is_same_number(before, after) ||
          (digits_count && before.digits != after.digits))
        return false;
    }
  }

  const LineTree& before_;
  const LineTree& after_;
  const LineChange& change_;
};

}  // namespace

std::string_view Formatter::format(const LineTree& tree, const LineChange& change) {
  if (!tree.findings.empty()) return tree.text;
  const bool is_plain_style = !style_.max_decimals && style_.g_digits == GDigits::Keep && !style_.word_order;
  const bool changes_nothing = !change.line_number && !change.target && change.motion == LineChange::MotionEdit::Keep;
  if (!is_plain_style || !changes_nothing) return rewrite(tree, change);
  if (is_tidy(tree)) return tree.text;
  if (!std::all_of(tree.words.begin(), tree.words.end(), is_compact)) return rewrite(tree, change);
  // Only the case of letters and the blanks between words change, which cannot change the meaning.
  start(tree);
  write_words(tree, change);
  return written();
}

/// Omits changes that would alter the meaning. New line numbers and labels must not be omitted, because other lines
/// depend on them.
std::string_view Formatter::rewrite(const LineTree& tree, const LineChange& change) {
  const bool orders = style_.word_order && !change.keeps_order;
  if (write(tree, change, orders ? Order::Canonical : Order::AsWritten)) return written();
  LineChange less = change;
  less.motion = LineChange::MotionEdit::Keep;
  if (write(tree, change, Order::AsWritten) || write(tree, less, Order::AsWritten)) return written();
  if (change.line_number || change.target) throw std::logic_error("a line number could not be written");
  return tree.text;
}

/// Writes the line; false if the result has another meaning.
bool Formatter::write(const LineTree& tree, const LineChange& change, Order order) {
  start(tree);
  if (order == Order::Canonical) choose_order(tree, change);
  write_words(tree, change);
  if (tree.text == written()) return true;
  const std::size_t length = line_.size();
  put(kLookAheadPadding);
  written_.clear();
  const char* const end = written_.append_line(line_.data(), line_.data() + line_.size());
  while (line_.size() > length) line_.pop_back();
  return end == line_.data() + length && Rereading(tree, written_.tree(0, line_.data()), change).has_same_meaning();
}

/// Starts a line, with memory for everything that may be added: blanks up to the column of a comment, and a few
/// characters for each word or comment.
void Formatter::start(const LineTree& tree) {
  constexpr std::size_t kForEach = 5;
  constexpr std::size_t kOnce = 64;
  line_.clear();
  line_.reserve_for(2 * tree.text.size() + kForEach * (tree.words.size() + tree.comments.size()) + kOnce +
                    kLookAheadPadding.size());
  comments_written_ = 0;
  order_.resize(tree.words.size());
  std::iota(order_.begin(), order_.end(), std::uint16_t{0});
}

/// Chooses the order of the words. Lines with comments between words keep their order, because such comments refer to
/// their neighbors. A comment inside the last word moves to the end; one after a G that is dropped from the start of
/// the line moves to the start.
void Formatter::choose_order(const LineTree& tree, const LineChange& change) {
  if (tree.words.empty()) return;
  const Instruction* const motion = tree.motion();
  const bool drops_first = change.motion == LineChange::MotionEdit::Drop && motion != nullptr && motion->command == 0;
  const Word& first = tree.words[drops_first ? 1 : 0];
  for (const Span comment : tree.comments)
    if (comment.begin > first.begin && comment.begin < tree.words.back().begin) return;
  for (const Instruction& instruction : tree.instructions)
    if (instruction.kind == InstructionKind::G || instruction.kind == InstructionKind::Continuation)
      sort_arguments(tree, instruction);
  move_feed(tree);
  const auto number = std::find(order_.begin(), order_.end(), line_number_word(tree));
  if (number != order_.end()) std::rotate(order_.begin(), number, number + 1);
}

void Formatter::sort_arguments(const LineTree& tree, const Instruction& instruction) {
  slots_.clear();
  for (std::uint16_t i = instruction.begin; i < instruction.end; ++i)
    if (is_argument(tree, instruction, i)) slots_.push_back(i);
  // Insertion sort: the arguments are few, and usually in order.
  for (std::size_t i = 1; i < slots_.size(); ++i)
    for (std::size_t j = i; j > 0; --j) {
      const auto rank = [&](std::size_t at) {
        return dialect::kArgumentOrder.find(tree.words[order_[slots_[at]]].letter);
      };
      if (rank(j - 1) <= rank(j)) break;
      std::swap(order_[slots_[j - 1]], order_[slots_[j]]);
    }
}

/// Moves the F after the motion's arguments. F is the speed of the line's motion wherever it stands (D14); a line has
/// at most one motion.
void Formatter::move_feed(const LineTree& tree) {
  const Instruction* const motion = tree.motion();
  if (tree.feed < 0 || motion == nullptr) return;
  const auto feed = static_cast<std::uint16_t>(tree.feed);
  order_.erase(std::find(order_.begin(), order_.end(), feed));
  auto after = order_.end();
  while (after != order_.begin() && tree.words[*(after - 1)].owner != motion->number) --after;
  order_.insert(after, feed);
}

void Formatter::write_words(const LineTree& tree, const LineChange& change) {
  const Instruction* const motion = change.motion == LineChange::MotionEdit::Keep ? nullptr : tree.motion();
  bool is_pending = motion != nullptr;
  const std::size_t number_at = change.line_number ? line_number_word(tree) : tree.words.size();
  bool needs_number = change.line_number && number_at == tree.words.size();
  char letter_before = '\0';
  for (const std::uint16_t index : order_) {
    const Word& word = tree.words[index];
    const bool joins = word.letter == kAssign && letter_before == 'P';  // P1=2.5
    if (!joins) write_comments_before(tree, word.begin);
    if (needs_number) write_new_number(*change.line_number);
    needs_number = false;
    if (is_pending && change.motion == LineChange::MotionEdit::Write && word.owner == motion->number) {
      write_motion(change.motion_in_force);
      is_pending = false;
    }
    const bool is_dropped = is_pending && change.motion == LineChange::MotionEdit::Drop && index == motion->command;
    if (is_dropped) {
      // Comments inside the G stay.
    } else if (index == number_at) {
      write_new_number(*change.line_number);
    } else if (change.target && word.span() == tree.jump->target_span) {
      write_new_number(*change.target);
    } else {
      if (!joins) separate();
      write_word(tree, index);
    }
    letter_before = word.letter;
    const bool is_last = index + 1u == tree.words.size();
    const bool next_joins = !is_last && word.letter == 'P' && tree.words[index + 1u].letter == kAssign;
    if (!is_last && !next_joins) write_comments_before(tree, word.end);
  }
  write_comments_before(tree, static_cast<std::uint32_t>(tree.text.size()) + 1);
}

void Formatter::write_word(const LineTree& tree, std::uint16_t index) {
  static constexpr dialect::LetterSet kIntegers = dialect::letters("GMNTV");
  const Word& word = tree.words[index];
  const std::string_view text = tree.text_of(word.span());
  std::size_t number = line_.size();
  if (word.letter == kAssign) {
    const bool is_register = index > 0 && tree.words[index - 1u].letter == 'V';  // V25 = 78.99
    put(is_register && !word.has(Word::kMissing) ? "= " : "=");
    number = line_.size();
    write_characters(text.substr(1));
  } else if (is_compact(word)) {
    line_.push_back(word.letter);
    put(text.substr(1));
    ++number;
  } else {
    write_characters(text);
    if (word.letter != kNumber) ++number;
  }
  const bool is_number = word.letter == kAssign || word.letter == kNumber ||
                         (word.letter >= 'A' && word.letter <= 'Z' && !dialect::contains(kIntegers, word.letter));
  if (is_number && style_.max_decimals) {
    if (word.has(Word::kPoint)) settle_decimals(number);
    drop_leading_zeros(number);
  }
  if (word.letter == 'G') settle_g_digits(number);
}

/// Writes all characters except blanks and comments, in upper case.
void Formatter::write_characters(std::string_view text) {
  char* at = line_.reserve_for(text.size());
  const char* const begin = at;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') {
      i = text.find(')', i);
    } else if (!text::is_blank(text[i])) {
      *at++ = text::upper(text[i]);
    }
  }
  line_.add(static_cast<std::size_t>(at - begin));
}

void Formatter::write_new_number(std::uint64_t number) {
  char digits[20];
  const char* const end = std::to_chars(std::begin(digits), std::end(digits), number).ptr;
  separate();
  put("N");
  put({digits, static_cast<std::size_t>(end - digits)});
}

void Formatter::write_motion(std::uint8_t number) {
  separate();
  put(style_.g_digits == GDigits::One ? "G" : "G0");
  line_.push_back(static_cast<char>('0' + number));
}

void Formatter::write_comments_before(const LineTree& tree, std::uint32_t column) {
  while (comments_written_ < tree.comments.size() && tree.comments[comments_written_].begin < column)
    write_comment(tree, tree.comments[comments_written_++]);
}

/// Writes a comment. At the end of its line, or alone on it, it stays in its column if possible, because such comments
/// are often aligned; other comments follow their word.
void Formatter::write_comment(const LineTree& tree, Span comment) {
  const bool follows_words = tree.words.empty() || comment.begin >= tree.words.back().end;
  if (follows_words) {
    write_gap(tree.text, comment.begin);
  } else {
    separate();
  }
  put(tree.text_of(comment));
}

/// Writes the blanks before the comment that was at `column`.
void Formatter::write_gap(std::string_view text, std::uint32_t column) {
  std::uint32_t begin = column;
  while (begin > 0 && text::is_blank(text[begin - 1])) --begin;
  const std::string_view gap = text.substr(begin, column - begin);
  const bool has_tab = gap.find('\t') != std::string_view::npos;
  if ((begin == 0 && line_.size() == 0) || has_tab) return put(gap);
  separate();
  if (gap.size() < 2) return;
  while (line_.size() < column) line_.push_back(' ');
}

void Formatter::separate() {
  if (line_.size() > 0) line_.push_back(' ');
}

void Formatter::put(std::string_view text) { line_.append(text.data(), text.size()); }

/// Drops redundant zeros and puts one before the point, unless there are more decimals than the style allows: a number
/// is never rounded.
void Formatter::settle_decimals(std::size_t number) {
  const std::string_view text(line_.data() + number, line_.size() - number);
  const std::size_t point = text.find('.');
  const std::size_t last = text.find_last_not_of('0');
  if (point == std::string_view::npos || last - point > static_cast<std::size_t>(*style_.max_decimals)) return;
  const std::size_t length = last == point ? point : last + 1;
  while (line_.size() > number + length) line_.pop_back();
  if (point != 0 && text::is_digit(line_[number + point - 1])) return;
  line_.push_back('0');
  std::rotate(line_.data() + number + point, line_.data() + line_.size() - 1, line_.data() + line_.size());
}

/// Writes 007.5 as 7.5; 0.5 keeps its zero.
void Formatter::drop_leading_zeros(std::size_t number) {
  std::size_t begin = number;
  if (begin < line_.size() && (line_[begin] == '+' || line_[begin] == '-')) ++begin;
  std::size_t first = begin;
  while (first + 1 < line_.size() && line_[first] == '0' && text::is_digit(line_[first + 1])) ++first;
  std::copy(line_.data() + first, line_.data() + line_.size(), line_.data() + begin);
  for (; first > begin; --first) line_.pop_back();
}

/// Writes the number of a G, which has at most three significant digits, in the style's number of digits.
void Formatter::settle_g_digits(std::size_t number) {
  if (style_.g_digits == GDigits::Keep) return;
  unsigned value = 0;
  for (std::size_t i = number; i < line_.size(); ++i) value = 10 * value + static_cast<unsigned>(line_[i] - '0');
  while (line_.size() > number) line_.pop_back();
  if (style_.g_digits == GDigits::Two && value < 10) line_.push_back('0');
  char digits[20];
  const char* const end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
  put({digits, static_cast<std::size_t>(end - digits)});
}

std::string formatted(std::string_view line, const LineStyle& style) {
  const ParsedLine parsed(line);
  return std::string(Formatter(style).format(parsed.tree()));
}

}  // namespace isocnc::syntax
