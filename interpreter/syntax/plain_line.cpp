#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "interpreter/syntax/number.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::syntax {

namespace {

/// The fields of a Word after its digits, so that all are written as one number.
struct WordTail {
  std::uint16_t owner = Word::kNoOwner;
  char letter = 0;  ///< Upper case.
  std::uint8_t flags = 0;
};
static_assert(sizeof(WordTail) == 4 && offsetof(Word, owner) + 4 == sizeof(Word) &&
              offsetof(Word, letter) - offsetof(Word, owner) == offsetof(WordTail, letter) &&
              offsetof(Word, flags) - offsetof(Word, owner) == offsetof(WordTail, flags));
constexpr int kFlagsShift = 8 * offsetof(WordTail, flags);

/// The role of a byte on a plain line: one of its letters; `letter` is empty for any other byte.
struct LetterRole {
  std::uint32_t tail = 0;
  dialect::LetterSet letter = 0;
};

constexpr dialect::LetterSet kArguments = dialect::letters("XYZBCIJKR");
constexpr dialect::LetterSet kFeed = dialect::letters("F");
constexpr dialect::LetterSet kCommand = dialect::letters("G");
constexpr dialect::LetterSet kLineNumber = dialect::letters("N");

constexpr auto kRoles = [] {
  std::array<LetterRole, 256> roles{};
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (!dialect::contains(kArguments | kFeed | kCommand | kLineNumber, letter)) continue;
    const bool is_motion = dialect::contains(kArguments | kCommand, letter);
    const WordTail tail{.owner = is_motion ? std::uint16_t{0} : Word::kNoOwner, .letter = letter};
    for (const char written : {letter, static_cast<char>(letter + ('a' - 'A'))})
      roles[static_cast<unsigned char>(written)] = {std::bit_cast<std::uint32_t>(tail), dialect::letter_bit(letter)};
  }
  return roles;
}();

/// Maximum number of words of a plain line: N, G, F and each argument once.
constexpr std::size_t kMaxPlainWords = 12;

/// Number of lines parsed per buffer reservation.
constexpr std::size_t kLinesAtOnce = 64;

/// Minimum number of readable bytes for parsing a letter, a blank and a short number without bounds checks.
constexpr std::ptrdiff_t kMargin = 2 + kShortNumberBytes;

/// The end of the comment at `p`, or null when it does not end on this line.
const char* skip_comment(const char* p, const char* end) {
  if (*p == ';') return text::find_line_end(p, end);
  return text::skip_closed_comment(p, end);
}

/// Reads a number that scan_short_number() does not: after a blank, or a longer one. Without end if it is malformed,
/// has blanks or comments inside, or ends where the text ends.
[[gnu::noinline]] Number scan_number_apart(const char* p, const char* end) {
  Number number;
  if (text::is_blank(*p)) ++p;
  if (scan_short_number(p, number)) return number;
  if (!text::is_number_char(*p)) return {};
  number = scan_number(p, end);
  const bool is_plain = std::isfinite(number.value) && !number.has_more_inside(p) && number.end != end;
  return is_plain ? number : Number{};
}

}  // namespace

/// Fast path for a line with a single assignment (`V7 = 12.215`), because programs with registers have many of them.
/// For any other line it returns null and changes nothing.
const char* TreeStore::append_plain_assignment(const char* begin, const char* end) {
  const auto skip_blanks = [end](const char* p) {
    while (p != end && text::is_blank(*p)) ++p;
    return p;
  };
  const char* const digits = begin + 1;
  Number name;
  Number value;
  if (end - digits < kShortNumberBytes || !scan_short_number(digits, name) || name.flags != 0 ||
      !dialect::is_register(name.value))
    return nullptr;
  const char* const equals = skip_blanks(name.end);
  if (equals == end || *equals != '=') return nullptr;
  const char* const number = skip_blanks(equals + 1);
  if (end - number < kShortNumberBytes || !scan_short_number(number, value)) return nullptr;
  const char* const line_end = skip_blanks(value.end);
  if (line_end == end || !text::is_line_end(*line_end)) return nullptr;

  Line& added = lines_.push_back(Line{});
  added.length = static_cast<std::uint32_t>(line_end - begin);
  added.first_word = static_cast<std::uint32_t>(words_.size());
  added.first_instruction = static_cast<std::uint32_t>(instructions_.size());
  added.first_comment = static_cast<std::uint32_t>(comments_.size());
  added.first_finding = static_cast<std::uint32_t>(findings_.size());
  added.words = 2;
  added.instructions = 1;
  const auto column = [begin](const char* p) { return static_cast<std::uint32_t>(p - begin); };
  words_.push_back({.value = name.value,
                    .begin = 0,
                    .end = column(name.end),
                    .digits = name.digits,
                    .owner = 0,
                    .letter = 'V',
                    .flags = 0});
  words_.push_back({.value = value.value,
                    .begin = column(equals),
                    .end = column(value.end),
                    .digits = value.digits,
                    .owner = 0,
                    .letter = kAssign,
                    .flags = value.flags});
  instructions_.push_back({.kind = InstructionKind::Assignment, .flags = Instruction::kFirst, .end = 2});
  return line_end;
}

/// Fills in what follows from all words of a plain line. False if its G moves nothing, which the general parser
/// reports.
[[gnu::always_inline]] inline bool TreeStore::finish_plain_line(PlainPart& line, std::size_t words,
                                                                dialect::LetterSet taken) {
  line.words = static_cast<std::uint16_t>(words);
  line.plain_arguments = taken & kArguments;
  if ((taken & (kArguments | kCommand)) == 0) return true;
  // The motion has all words but the N and an F beside it; its G or its first argument stands first.
  std::size_t first = (taken & kLineNumber) != 0 ? 1 : 0;
  std::size_t after = words;
  line.motion.flags = Instruction::kFirst;
  if (line.feed >= 0) {
    const auto feed = static_cast<std::size_t>(line.feed);
    if (feed == words - 1) --after;
    if (feed == first) {
      ++first;
      line.motion.flags = 0;
    }
  }
  line.motion.command = line.motion.begin = static_cast<std::uint16_t>(first);
  line.motion.end = static_cast<std::uint16_t>(after);
  return (taken & kCommand) == 0 || (taken & dialect::kCoordinateLetters) != 0;
}

/// Reads the line at `begin` into `line` and from `words` on, if it is plain; `last` is the last place where a word may
/// start. Returns the end of the line and sets `words` to the place after its words, or returns null.
// NOLINTNEXTLINE(readability-function-cognitive-complexity): its parts would be calls, on every line of every program.
[[gnu::always_inline]] inline const char* TreeStore::read_plain_line(const char* const begin, const char* const last,
                                                                     const char* const end, PlainPart& line,
                                                                     Word*& words) {
  // Only what finish_plain_line() does not set.
  line.label = 0;
  line.comments = 0;
  line.feed = -1;
  line.flags = 0;
  line.is_plain = true;
  line.motion.kind = InstructionKind::Continuation;
  line.motion.row = dialect::kUnknownGCode;
  line.motion.number = 0;
  Word* word = words;
  dialect::LetterSet taken = 0;
  const char* p = begin;
  while (p <= last) {
    const LetterRole& role = kRoles[static_cast<unsigned char>(*p)];
    if (role.letter == 0) {
      if (text::is_line_end(*p)) break;
      if (text::is_blank(*p)) {
        ++p;
        continue;
      }
      const char* const comment_end = *p == ';' || *p == '(' ? skip_comment(p, end) : nullptr;
      if (!comment_end) return nullptr;
      comments_.push_back({static_cast<std::uint32_t>(p - begin), static_cast<std::uint32_t>(comment_end - begin)});
      ++line.comments;
      p = comment_end;
      continue;
    }
    Number number;
    if (!scan_short_number(p + 1, number)) {
      number = scan_number_apart(p + 1, end);
      if (!number.end) return nullptr;
    }
    // The words are written in parts, since GCC would gather them in a vector first, with more instructions.
    word->value = number.value;
    word->begin = static_cast<std::uint32_t>(p - begin);
    word->digits = number.digits;
    if ((taken & role.letter) != 0) return nullptr;
    word->end = static_cast<std::uint32_t>(number.end - begin);
    const std::uint32_t tail = role.tail + (std::uint32_t{number.flags} << kFlagsShift);
    std::memcpy(&word->owner, &tail, sizeof tail);
    if ((role.letter & kArguments) == 0) {
      if (role.letter == kFeed) {
        if (!(number.value > 0)) return nullptr;
        line.feed = static_cast<std::int32_t>(word - words);
      } else if (role.letter == kCommand) {
        if ((taken & kArguments) != 0 || number.flags != 0 || !dialect::is_motion_number(number.value)) return nullptr;
        line.motion.kind = InstructionKind::G;
        line.motion.row = dialect::kGCodeRows[static_cast<std::size_t>(number.value)];
      } else {
        if (word != words || number.flags != 0 || number.digits > 15) return nullptr;
        line.flags = LineTree::kHasLabel;
        line.label = static_cast<std::uint64_t>(number.value);
      }
    }
    taken |= role.letter;
    ++word;
    p = number.end;
    // A branch, which is foreseen: what is read next does not wait for this byte.
    if (*p == ' ') [[likely]] {
      ++p;
    } else if (*p == '\n') {
      break;
    }
  }
  if (p > last) return nullptr;
  line.length = static_cast<std::uint32_t>(p - begin);
  if (!finish_plain_line(line, static_cast<std::size_t>(word - words), taken)) return nullptr;
  words = word;
  return p;
}

/// Fast path for lines with at most an N, a motion G, coordinates and F, each once and well-formed, as most lines are.
/// The trees are the same as those of the general parser. Returns the start of the first other line.
const char* TreeStore::append_plain_lines(const char* begin, const char* stop, const char* end) {
  if (end - begin < kMargin) return begin;
  const char* const last = end - kMargin;
  while (begin < stop) {
    const std::size_t maximum = std::min(kLinesAtOnce, static_cast<std::size_t>(stop - begin));
    Line* const lines = lines_.reserve_for(maximum);
    Word* words = words_.reserve_for(maximum * kMaxPlainWords);
    auto first_word = static_cast<std::uint32_t>(words_.size());
    auto first_comment = static_cast<std::uint32_t>(comments_.size());
    std::size_t read = 0;
    const char* line_end = begin;
    while (read < maximum && begin < stop && (line_end = read_plain_line(begin, last, end, lines[read], words))) {
      Line& line = lines[read++];
      line.first_word = first_word;
      line.first_comment = first_comment;
      first_comment += line.comments;
      first_word += line.words;
      begin = text::skip_line_end(line_end, end);
    }
    lines_.add(read);
    words_.add(first_word - words_.size());
    if (line_end) continue;
    comments_.resize(first_comment);
    break;
  }
  return begin;
}

}  // namespace isocnc::syntax
