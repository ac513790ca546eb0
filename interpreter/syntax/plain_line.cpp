#include "interpreter/syntax/number.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::syntax {

/// What a plain line may hold besides N, G and F.
static constexpr dialect::LetterSet kPlainLetters = dialect::letters("XYZBCIJKR");

namespace {

/// What the words of a line amount to as long as it may be a plain one.
struct PlainLine {
  static constexpr std::size_t kMostWords = 12;  // N, G, F and each letter once.

  std::uint16_t count = 0;
  dialect::LetterSet taken = 0;
  int command = -1;          // The G, or the first coordinate.
  std::uint16_t behind = 0;  // Behind the last argument.
  std::uint8_t row = dialect::kUnknownGCode;
  int feed = -1;
  bool has_label = false;
  std::uint64_t label = 0;

  /// Takes the word into its place; false when the line is not plain because of it.
  bool take(Word& word) {
    if (dialect::contains(kPlainLetters, word.letter)) {
      const dialect::LetterSet bit = dialect::letter_bit(word.letter);
      if ((taken & bit) != 0) return false;
      taken |= bit;
      word.owner = 0;
      if (command < 0) command = count;
      behind = static_cast<std::uint16_t>(count + 1);
      return true;
    }
    switch (word.letter) {
      case 'F':
        if (feed >= 0 || !(word.value > 0)) return false;
        feed = count;
        return true;
      case 'G':
        if (command >= 0 || !word.is_plain_integer() || word.value > 3) return false;
        row = dialect::kGCodeRows[static_cast<std::size_t>(word.value)];
        command = count;
        behind = static_cast<std::uint16_t>(count + 1);
        word.owner = 0;
        return true;
      case 'N':
        if (count > 0 || !word.is_plain_integer() || word.digits > 15) return false;
        has_label = true;
        label = static_cast<std::uint64_t>(word.value);
        return true;
      default: return false;
    }
  }

  /// A motion G needs a coordinate; that it has none is for the general way to tell.
  bool is_complete() const {
    return row == dialect::kUnknownGCode || (taken & dialect::kCoordinateLetters) != 0;
  }
};

}  // namespace

/// Most lines of most programs hold at most an N, a motion G, coordinates and F, each once and well written. They are
/// parsed in one go, into the very tree that the general way gives them. Null, with nothing changed, for any other line.
const char* TreeStore::append_plain_line(const char* begin, const char* end) {
  PlainLine line;
  const char* p = begin;
  const std::size_t first_word = words_.size();
  const std::size_t first_comment = comments_.size();
  const auto column = [begin](const char* at) { return static_cast<std::uint32_t>(at - begin); };
  // Words are written where they stay.
  Word* const words = words_.room_for(PlainLine::kMostWords);
  const auto give_up = [&]() -> const char* {
    comments_.resize(first_comment);
    return nullptr;
  };
  for (;;) {
    while (p != end && is_blank(*p)) ++p;
    if (p == end || is_line_end(*p)) break;
    const char letter = upper(*p);
    if (letter < 'A' || letter > 'Z') {
      if (letter == ';') {
        const char* const comment_end = find_line_end(p, end);
        comments_.push_back({column(p), column(comment_end)});
        p = comment_end;
        break;
      }
      if (letter != '(') return give_up();
      const char* close = p;
      while (close != end && !is_line_end(*close) && *close != ')') ++close;
      if (close == end || *close != ')') return give_up();
      comments_.push_back({column(p), column(close) + 1});
      p = close + 1;
      continue;
    }
    if (line.count == PlainLine::kMostWords) return give_up();
    const char* const start = p++;
    while (p != end && is_blank(*p)) ++p;
    Number number;
    if (!scan_short_number(p, end, number)) {
      if (p == end || !is_number_char(*p)) return give_up();
      number = scan_number(p, end);
      const bool has_more_inside =
          number.end - p != number.digits + (number.is_signed ? 1 : 0) + (number.has_point ? 1 : 0);
      if (number.malformed || has_more_inside) return give_up();
    }
    Word& word = words[line.count];
    word.letter = letter;
    word.begin = column(start);
    word.end = column(number.end);
    word.value = number.value;
    word.digits = number.digits;
    word.flags = static_cast<std::uint8_t>((number.is_signed ? Word::kSigned : 0) | (number.has_point ? Word::kPoint : 0));
    word.owner = Word::kNobody;
    if (!line.take(word)) return give_up();
    ++line.count;
    p = number.end;
  }
  if (!line.is_complete()) return give_up();

  words_.add(line.count);
  Line& added = lines_.push_back(Line{});
  added.length = column(p);
  added.first_word = static_cast<std::uint32_t>(first_word);
  added.first_instruction = static_cast<std::uint32_t>(instructions_.size());
  added.first_comment = static_cast<std::uint32_t>(first_comment);
  added.first_finding = static_cast<std::uint32_t>(findings_.size());
  added.words = line.count;
  added.feed = line.feed;
  added.comments = static_cast<std::uint32_t>(comments_.size() - first_comment);
  if (line.has_label) {
    added.flags = LineTree::kHasLabel;
    added.label = line.label;
  }
  if (line.command >= 0) {
    added.instructions = 1;
    const auto command = static_cast<std::uint16_t>(line.command);
    const bool is_first = command == (line.has_label ? 1 : 0);
    instructions_.push_back(
        {.kind = line.row == dialect::kUnknownGCode ? InstructionKind::Continuation : InstructionKind::G,
         .row = line.row,
         .flags = is_first ? Instruction::kFirst : std::uint8_t{0},
         .number = 0,
         .command = command,
         .begin = command,
         .end = line.behind});
  }
  return p;
}

}  // namespace isocnc::syntax
