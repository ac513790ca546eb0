#include <array>
#include <cmath>
#include <string_view>

#include "interpreter/syntax/characters.h"
#include "interpreter/syntax/number.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::syntax {

namespace {

/// What a letter may do on a plain line.
enum class Role : std::uint8_t { None, Blank, Argument, Feed, Command, LineNumber };

struct LetterRole {
  dialect::LetterSet bit = 0;
  char letter = 0;  ///< Upper case.
  Role role = Role::None;
};

constexpr auto kRoles = [] {
  std::array<LetterRole, 256> roles{};
  const auto give = [&](std::string_view letters, Role role) {
    for (const char letter : letters)
      for (const char written : {letter, static_cast<char>(letter + ('a' - 'A'))})
        roles[static_cast<unsigned char>(written)] = {dialect::letter_bit(letter), letter, role};
  };
  for (const char blank : {' ', '\t'}) roles[static_cast<unsigned char>(blank)].role = Role::Blank;
  give("XYZBCIJKR", Role::Argument);
  give("F", Role::Feed);
  give("G", Role::Command);
  give("N", Role::LineNumber);
  return roles;
}();

/// N, G, F and each argument once; more never fit.
constexpr std::uint16_t kMostPlainWords = 12;

/// With so many bytes left, a letter, a blank and a short number can be read without looking for the end.
constexpr std::ptrdiff_t kMargin = 2 + kShortNumberBytes;

/// Behind the comment at `p`, or null when it does not end on this line.
const char* behind_comment(const char* p, const char* end) {
  if (*p == ';') return find_line_end(p, end);
  while (p != end && !is_line_end(*p) && *p != ')') ++p;
  return p != end && *p == ')' ? p + 1 : nullptr;
}

/// A number that scan_short_number() leaves alone: a longer one, but with nothing inside and not malformed.
bool scan_long_number(const char* p, const char* end, Number& number) {
  if (!is_number_char(*p)) return false;
  number = scan_number(p, end);
  const bool has_more_inside =
      number.end - p != number.digits + (number.is_signed ? 1 : 0) + (number.has_point ? 1 : 0);
  return std::isfinite(number.value) && !has_more_inside;
}

}  // namespace

/// The same for a line of nothing but `V7 = 12.215`: programs that use registers at all use them a lot.
const char* TreeStore::append_plain_assignment(const char* begin, const char* end) {
  const auto skip_blanks = [end](const char* p) {
    while (p != end && is_blank(*p)) ++p;
    return p;
  };
  const char* const digits = begin + 1;
  Number name;
  Number value;
  if (end - digits < kShortNumberBytes || !scan_short_number(digits, name) || name.is_signed || name.has_point ||
      !(name.value >= 1 && name.value <= dialect::kRegisterCount))
    return nullptr;
  const char* const equals = skip_blanks(name.end);
  if (equals == end || *equals != '=') return nullptr;
  const char* const number = skip_blanks(equals + 1);
  if (end - number < kShortNumberBytes || !scan_short_number(number, value)) return nullptr;
  const char* const line_end = skip_blanks(value.end);
  if (line_end == end || !is_line_end(*line_end)) return nullptr;

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
                    .flags = static_cast<std::uint8_t>((value.is_signed ? Word::kSigned : 0) |
                                                       (value.has_point ? Word::kPoint : 0))});
  instructions_.push_back({.kind = InstructionKind::Assignment, .flags = Instruction::kFirst, .end = 2});
  return line_end;
}

/// Most lines of most programs hold at most an N, a motion G, coordinates and F, each once and well written. They are
/// parsed in one go, into the very tree that the general way gives them. Null, with nothing changed, for any other
/// line.
const char* TreeStore::append_plain_line(const char* begin, const char* end) {
  const std::size_t first_comment = comments_.size();
  Word* const words = words_.room_for(kMostPlainWords);  // Written where they stay.
  std::uint16_t count = 0;
  std::uint16_t behind = 0;  // Behind the last argument.
  int command = -1;          // The G, or the first argument.
  int feed = -1;
  bool has_label = false;
  std::uint8_t row = dialect::kUnknownGCode;
  dialect::LetterSet taken = 0;
  const char* p = begin;
  if (end - begin < kMargin) return nullptr;
  for (const char* const last = end - kMargin; p <= last;) {
    const LetterRole& role = kRoles[static_cast<unsigned char>(*p)];
    if (role.role <= Role::Blank) {
      if (role.role == Role::Blank) {
        ++p;
        continue;
      }
      if (is_line_end(*p)) goto complete;
      const char* const behind_it = *p == ';' || *p == '(' ? behind_comment(p, end) : nullptr;
      if (!behind_it) break;
      comments_.push_back({static_cast<std::uint32_t>(p - begin), static_cast<std::uint32_t>(behind_it - begin)});
      p = behind_it;
      continue;
    }
    const char* digits = p + 1;
    if (*digits <= ' ' && is_blank(*digits)) ++digits;
    Number number;
    if (!scan_short_number(digits, number) && !scan_long_number(digits, end, number)) break;
    Word& word = words[count];
    word.value = number.value;
    word.begin = static_cast<std::uint32_t>(p - begin);
    word.end = static_cast<std::uint32_t>(number.end - begin);
    word.digits = number.digits;
    word.letter = role.letter;
    word.flags =
        static_cast<std::uint8_t>((number.is_signed ? Word::kSigned : 0) | (number.has_point ? Word::kPoint : 0));
    if (role.role == Role::Argument) {
      if ((taken & role.bit) != 0) break;
      taken |= role.bit;
      word.owner = 0;
      command = command < 0 ? count : command;
      behind = static_cast<std::uint16_t>(count + 1);
    } else if (role.role == Role::Feed) {
      if (feed >= 0 || !(word.value > 0)) break;
      word.owner = Word::kNobody;
      feed = count;
    } else if (role.role == Role::Command) {
      if (command >= 0 || !word.is_plain_integer() || !(word.value <= 3)) break;
      row = dialect::kGCodeRows[static_cast<std::size_t>(word.value)];
      word.owner = 0;
      command = count;
      behind = static_cast<std::uint16_t>(count + 1);
    } else {
      if (count > 0 || !word.is_plain_integer() || word.digits > 15) break;
      word.owner = Word::kNobody;
      has_label = true;
    }
    ++count;
    p = number.end;
    if (p != end && *p == ' ') ++p;  // Nearly always.
  }
  comments_.resize(first_comment);
  return nullptr;

complete:
  // A motion G needs a coordinate; that it has none is for the general way to tell.
  if (row != dialect::kUnknownGCode && (taken & dialect::kCoordinateLetters) == 0) {
    comments_.resize(first_comment);
    return nullptr;
  }
  Line& added = lines_.push_back(Line{});
  added.length = static_cast<std::uint32_t>(p - begin);
  added.first_word = static_cast<std::uint32_t>(words_.size());
  added.first_instruction = static_cast<std::uint32_t>(instructions_.size());
  added.first_comment = static_cast<std::uint32_t>(first_comment);
  added.first_finding = static_cast<std::uint32_t>(findings_.size());
  added.words = count;
  added.feed = feed;
  added.comments = static_cast<std::uint32_t>(comments_.size() - first_comment);
  added.plain_arguments = taken;
  if (has_label) {
    added.flags = LineTree::kHasLabel;
    added.label = static_cast<std::uint64_t>(words[0].value);
  }
  words_.add(count);
  if (command >= 0) {
    added.instructions = 1;
    Instruction& instruction = *instructions_.room_for(1);
    instruction = {.kind = row == dialect::kUnknownGCode ? InstructionKind::Continuation : InstructionKind::G,
                   .row = row,
                   .flags = command == (has_label ? 1 : 0) ? Instruction::kFirst : std::uint8_t{0},
                   .number = 0,
                   .command = static_cast<std::uint16_t>(command),
                   .begin = static_cast<std::uint16_t>(command),
                   .end = behind};
    instructions_.add(1);
  }
  return p;
}

}  // namespace isocnc::syntax
