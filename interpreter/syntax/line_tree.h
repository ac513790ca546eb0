#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "interpreter/dialect/codes.h"
#include "interpreter/syntax/finding.h"

namespace isocnc::syntax {

/// Tokens that are no letter-number words have a sign of their own in Word::letter.
inline constexpr char kAssign = '=';    ///< `=` and the number behind it, after a V or an M's P.
inline constexpr char kIf = '?';        ///< The keyword IF.
inline constexpr char kVgpl = '$';      ///< The keyword VGPL.
inline constexpr char kOperator = '<';  ///< A comparison inside IF; Word::digits holds the Comparison.
inline constexpr char kGoto = '@';      ///< The keyword GOTO.
inline constexpr char kNumber = '#';    ///< A number without a letter.
inline constexpr char kError = '!';     ///< Characters that start no word (ISO003).

enum class Comparison : std::uint8_t { Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual, Invalid };

/// A letter with its number, or one of the tokens above.
struct Word {
  static constexpr std::uint8_t kSigned = 1;     ///< Written with + or -.
  static constexpr std::uint8_t kPoint = 2;      ///< Written with a decimal point.
  static constexpr std::uint8_t kMalformed = 4;  ///< Something stands where the number should be, but it is none.
  static constexpr std::uint8_t kMissing = 8;    ///< No number at all.
  static constexpr std::uint8_t kBreak = 16;     ///< An argument that stands apart from its command's series (D17).
  static constexpr std::uint8_t kReported = 32;  ///< What is wrong with it has been said (X=5): nothing more is.

  // No initializers: a million lines make millions of words, and each is filled in at once.
  double value;  ///< NaN when malformed, missing or written twice.
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t digits;  ///< How many digits were written.
  std::uint16_t owner;   ///< Index of the instruction that it belongs to, kNobody for none.
  char letter;           ///< Upper case.
  std::uint8_t flags;

  static constexpr std::uint16_t kNoOwner = 0xFFFF;

  constexpr Span span() const { return {begin, end}; }
  bool known() const { return !std::isnan(value); }
  constexpr bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
  /// Digits only: what G, M, N, T and V want.
  constexpr bool is_plain_integer() const { return (flags & (kSigned | kPoint | kMalformed | kMissing)) == 0; }
  /// The register that a V names, 1 to 30; 0 where it names none.
  constexpr int register_number() const {
    return is_plain_integer() && dialect::is_register(value) ? static_cast<int>(value) : 0;
  }
};

enum class InstructionKind : std::uint8_t {
  G,             ///< A G code with its arguments; `row` tells which.
  Continuation,  ///< Coordinates without a G: the motion in force goes on.
  Function,      ///< M but for M06, with its parameters.
  ToolChange,    ///< M06; its T, if there is one, is its argument.
  StrayTool,     ///< T without M06.
  Assignment,    ///< V = value; the value is the word behind the command.
  Jump,          ///< IF ... GOTO; details in LineTree::jump.
};

/// A command with its arguments. Its words are those in [begin, end) whose `owner` is this instruction; what else
/// stands there (an F, which belongs to the line, or what breaks the series) belongs to others.
struct Instruction {
  static constexpr std::uint8_t kFollowsMotion = 1;      ///< Directly behind a motion's arguments (G09).
  static constexpr std::uint8_t kFirst = 2;              ///< The first instruction on its line.
  static constexpr std::uint8_t kReportedElsewhere = 4;  ///< What is wrong with it has been reported with another one.

  InstructionKind kind = InstructionKind::G;
  std::uint8_t row = dialect::kUnknownGCode;  ///< Of dialect::kGCodes, for G.
  std::uint8_t flags = 0;
  std::uint16_t number = 0;   ///< Position in the order of writing: what Word::owner refers to.
  std::uint16_t command = 0;  ///< Word of the command; for a continuation its first word.
  std::uint16_t begin = 0;
  std::uint16_t end = 0;

  constexpr bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
  const dialect::GCode* g() const { return row == dialect::kUnknownGCode ? nullptr : &dialect::kGCodes[row]; }
  /// A motion, by its G or continued.
  bool is_motion() const { return kind == InstructionKind::Continuation || (g() != nullptr && g()->is_motion()); }
};

/// IF left comparison value GOTO label (I.5).
struct Jump {
  static constexpr std::int8_t kVgplVariable = 0;
  static constexpr std::int8_t kUnknownVariable = -1;

  std::int8_t variable = kUnknownVariable;  ///< 1 to 30: a register; kVgplVariable; kUnknownVariable when malformed.
  Comparison comparison = Comparison::Invalid;
  double value = 0;  ///< NaN when malformed.
  bool has_target = false;
  std::uint64_t target = 0;
  Span if_span;
  Span variable_span;  ///< The register or VGPL.
  Span target_span;    ///< The label behind GOTO.

  bool condition_is_known() const {
    return variable != kUnknownVariable && comparison != Comparison::Invalid && !std::isnan(value);
  }
};

/// What executing a plain line takes (LineTree::plain_arguments).
struct PlainLine {
  std::span<const Word> words;
  dialect::LetterSet arguments = 0;           ///< Without any coordinate the line is none, or moves nothing.
  std::int32_t feed = -1;                     ///< Index of the line's F, or -1.
  std::uint8_t row = dialect::kUnknownGCode;  ///< Of dialect::kGCodes; kUnknownGCode where the motion in force goes on.
  bool has_label = false;
  std::uint64_t label = 0;

  bool has_coordinates() const { return (arguments & dialect::kCoordinateLetters) != 0; }
};

/// The tree of one line. It holds columns but no line number, and no meaning: `X10` is a word here, never a position.
/// Hence a line inserted above changes nothing, and equal text gives equal trees. Parsing cannot fail; what is wrong
/// with the line by itself is in `findings`, in the order of its columns, and the rest of the line is still there.
///
/// A view: the words and the text belong to a TreeStore and to whoever holds the text.
struct LineTree {
  static constexpr std::uint8_t kAloneViolated = 1;  ///< An instruction that must be alone is not; once per line (D22).
  static constexpr std::uint8_t kHasLabel = 2;
  static constexpr std::uint8_t kCut = 4;       ///< More words than are read (W192).
  static constexpr std::uint8_t kUnclosed = 8;  ///< A comment is not closed: what seems missing may stand in it.

  std::string_view text;  ///< Without its terminator.
  std::span<const Word> words;
  std::span<const Instruction> instructions;  ///< In the order in which they take effect.
  std::span<const Span> comments;
  std::span<const Finding> findings;
  const Jump* jump = nullptr;
  std::uint64_t label = 0;    ///< The line number, when there is one.
  std::int32_t feed = -1;     ///< Index of the line's F, or -1.
  std::int32_t spindle = -1;  ///< Index of the line's S, or -1.
  std::uint8_t flags = 0;
  /// Where the line is plain: the letters of its arguments. Plain is one motion, by a G of 0 to 3 or by coordinates
  /// alone, and beside it N, F and comments at most; every value is finite, every argument the motion's. Most such
  /// lines are known to be so, not all: it only helps to execute them quickly.
  dialect::LetterSet plain_arguments = 0;

  constexpr bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
  constexpr bool has_label() const { return has(kHasLabel); }
  /// The number that the line starts with, where its letter is lost (ISO005); else null. After an N there is none: the
  /// digits are the N's.
  const Word* number_without_letter() const {
    return !words.empty() && words.front().letter == kNumber ? &words.front() : nullptr;
  }
  /// Nothing but blanks, comments and N: a block that does nothing (D13).
  bool is_empty() const { return instructions.empty() && feed < 0 && spindle < 0 && !number_without_letter(); }
  const Word& command(const Instruction& instruction) const { return words[instruction.command]; }
  /// The first motion, or null.
  const Instruction* motion() const {
    for (const Instruction& instruction : instructions)
      if (instruction.is_motion()) return &instruction;
    return nullptr;
  }
  /// Whether an instruction of the line is the M02.
  bool ends_program(const Instruction& instruction) const {
    return instruction.kind == InstructionKind::Function && command(instruction).value == dialect::kProgramEnd;
  }
  PlainLine plain() const {
    return {.words = words,
            .arguments = plain_arguments,
            .feed = feed,
            .row = plain_arguments == 0 ? dialect::kUnknownGCode : instructions.front().row,
            .has_label = has_label(),
            .label = label};
  }
  /// The word that holds this column, or null.
  const Word* word_at(std::uint32_t column) const {
    for (const Word& word : words)
      if (word.span().holds(column)) return &word;
    return nullptr;
  }
  /// The word of the line's own number, not of the one behind a GOTO; null where it has none.
  const Word* label_word() const {
    if (!has_label()) return nullptr;
    for (const Word& word : words)
      if (word.letter == 'N' && word.is_plain_integer() && !(jump && word.span() == jump->target_span)) return &word;
    return nullptr;
  }
  std::string_view text_of(Span span) const { return text.substr(span.begin, span.end - span.begin); }
};

/// Words of a line that are read; W192 tells of a line that has more.
inline constexpr std::size_t kMaxWords = 16384;

}  // namespace isocnc::syntax
