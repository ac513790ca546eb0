#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "interpreter/dialect/codes.h"
#include "interpreter/syntax/finding.h"

namespace isocnc::syntax {

/// Signs in Word::letter for tokens that are not letter-number words.
inline constexpr char kAssign = '=';    ///< `=` and the number after it, following a V or an M's P.
inline constexpr char kIf = '?';        ///< The keyword IF.
inline constexpr char kVgpl = '$';      ///< The keyword VGPL.
inline constexpr char kOperator = '<';  ///< A comparison inside IF; Word::digits holds the Comparison.
inline constexpr char kGoto = '@';      ///< The keyword GOTO.
inline constexpr char kNumber = '#';    ///< A number without a letter.
inline constexpr char kError = '!';     ///< Characters that do not start a word (ISO003).

enum class Comparison : std::uint8_t { Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual, Invalid };

/// A letter with its number, or one of the tokens above.
struct Word {
  static constexpr std::uint8_t kSigned = 1;     ///< Written with + or -.
  static constexpr std::uint8_t kPoint = 2;      ///< Written with a decimal point.
  static constexpr std::uint8_t kMalformed = 4;  ///< The text in place of the number is not a number.
  static constexpr std::uint8_t kMissing = 8;    ///< No number at all.
  static constexpr std::uint8_t kBreak = 16;     ///< An argument that is separated from its command's series (D17).
  static constexpr std::uint8_t kReported = 32;  ///< An error of this word has been reported (X=5); checks skip it.

  // Without initializers, for speed: long programs have millions of words, and each is filled in at once.
  double value;  ///< NaN when malformed, missing or written twice.
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t digits;  ///< Number of digits as written.
  std::uint16_t owner;   ///< Index of the instruction that it belongs to, or kNoOwner.
  char letter;           ///< Upper case.
  std::uint8_t flags;

  static constexpr std::uint16_t kNoOwner = 0xFFFF;

  constexpr Span span() const { return {begin, end}; }
  bool known() const { return !std::isnan(value); }
  /// The value if it is a whole number that fits, as in 8, -8 and 8.0; none if it is not known.
  std::optional<int> whole() const {
    constexpr double kMax = std::numeric_limits<int>::max();
    if (!(std::abs(value) <= kMax) || std::trunc(value) != value) return std::nullopt;
    return static_cast<int>(value);
  }
  constexpr bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
  /// Digits only, as G, M, N, T and V require.
  constexpr bool is_plain_integer() const { return (flags & (kSigned | kPoint | kMalformed | kMissing)) == 0; }
  /// The register that a V names, 1 to 30; 0 if it names none.
  constexpr int register_number() const {
    return is_plain_integer() && dialect::is_register(value) ? static_cast<int>(value) : 0;
  }
  /// The parameter of a user M that a P names, 1 to 20; 0 if it names none.
  constexpr int parameter_number() const {
    return is_plain_integer() && value >= 1 && value <= dialect::kMaxFunctionParameters ? static_cast<int>(value) : 0;
  }
  /// Whether a T has its six digits, and these; none if it is not written so.
  constexpr bool is_tool() const { return is_plain_integer() && digits == 6; }
  std::optional<int> tool_number() const { return is_tool() ? whole() : std::nullopt; }
};

enum class InstructionKind : std::uint8_t {
  G,             ///< A G code (`row`) with its arguments.
  Continuation,  ///< Coordinates without a G, which continue the motion in force.
  Function,      ///< Any M except M06, with its parameters.
  ToolChange,    ///< M06; its T, if any, is its argument.
  StrayTool,     ///< T without M06.
  Assignment,    ///< V = value; the value is the word after the command.
  Jump,          ///< IF ... GOTO; details in LineTree::jump.
};

/// A command with its arguments. Its words are those in [begin, end) whose `owner` is this instruction. Other words in
/// that range, such as an F (which belongs to the line) or a word that breaks the series, are not part of it.
struct Instruction {
  static constexpr std::uint8_t kFollowsMotion = 1;      ///< It directly follows a motion's arguments (G09).
  static constexpr std::uint8_t kFirst = 2;              ///< The first instruction on its line.
  static constexpr std::uint8_t kReportedElsewhere = 4;  ///< Its error has been reported at another instruction.

  InstructionKind kind = InstructionKind::G;
  std::uint8_t row = dialect::kUnknownGCode;  ///< Row of dialect::kGCodes, for G.
  std::uint8_t flags = 0;
  std::uint16_t number = 0;   ///< Position in the order of writing, as in Word::owner.
  std::uint16_t command = 0;  ///< Index of the command's word; of the first word for a continuation.
  std::uint16_t begin = 0;
  std::uint16_t end = 0;

  constexpr bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
  const dialect::GCode* g() const { return row == dialect::kUnknownGCode ? nullptr : &dialect::kGCodes[row]; }
  /// Whether it is a G that the dialect does not know, or whose number is illegible.
  bool is_unknown_g() const { return kind == InstructionKind::G && g() == nullptr; }
  /// Whether it is a G of this role.
  bool is(dialect::GRole role) const { return g() != nullptr && g()->role == role; }
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
  Span target_span;    ///< The label after GOTO.

  /// Moves the jump to the right.
  void shift(std::uint32_t columns) {
    for (Span* const span : {&if_span, &variable_span, &target_span})
      *span = {span->begin + columns, span->end + columns};
  }
  bool condition_is_known() const {
    return variable != kUnknownVariable && comparison != Comparison::Invalid && !std::isnan(value);
  }
};

/// The data for the execution of a plain line (LineTree::plain_arguments).
struct PlainLine {
  std::span<const Word> words;
  dialect::LetterSet arguments = 0;  ///< Letters of the arguments; without a coordinate there is no plain motion.
  std::int32_t feed = -1;            ///< Index of the line's F, or -1.
  std::uint8_t row = dialect::kUnknownGCode;  ///< Row of dialect::kGCodes; kUnknownGCode continues the motion in force.
  bool has_label = false;
  std::uint64_t label = 0;

  bool has_coordinates() const { return (arguments & dialect::kCoordinateLetters) != 0; }
};

/// The tree of one line. It holds columns but no line number, and no meaning: `X10` is a word here, never a position.
/// Hence a line inserted above changes nothing, and equal text gives equal trees. Parsing cannot fail; `findings` lists
/// the errors of the line by itself, in the order of its columns, and the rest of the line is still there.
///
/// A view: a TreeStore owns the words, and the caller owns the text.
struct LineTree {
  static constexpr std::uint8_t kAloneViolated = 1;  ///< An instruction that must be alone is not; once per line (D22).
  static constexpr std::uint8_t kHasLabel = 2;
  static constexpr std::uint8_t kCut = 4;         ///< The line has more words than are parsed (W192).
  static constexpr std::uint8_t kUnclosed = 8;    ///< A comment is not closed; words that seem missing may be in it.
  static constexpr std::uint8_t kTwoBlocks = 16;  ///< Two blocks whose line break is lost; see blocks() (D68).
  static constexpr std::uint8_t kMayMove = 32;    ///< A statement of another control, which may move the tool there.

  std::string_view text;  ///< Text of the line without its terminator.
  std::span<const Word> words;
  std::span<const Instruction> instructions;  ///< In the order in which they take effect.
  std::span<const Span> comments;
  std::span<const Finding> findings;
  const Jump* jump = nullptr;
  std::uint64_t label = 0;    ///< The line number, if the line has one (kHasLabel).
  std::int32_t feed = -1;     ///< Index of the line's F, or -1.
  std::int32_t spindle = -1;  ///< Index of the line's S, or -1.
  std::uint8_t flags = 0;
  /// The letters of the arguments of a plain line; 0 for other lines. A plain line holds one motion, by a G of 0 to 3
  /// or by coordinates alone, and beside it at most N, F and comments; every value is finite, and every argument
  /// belongs to the motion. Not all such lines are marked plain: the mark only speeds up execution.
  dialect::LetterSet plain_arguments = 0;

  constexpr bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
  constexpr bool has_label() const { return has(kHasLabel); }
  /// The number without a letter that starts the line (ISO005), or the one whose G was hit as H; else null. Digits
  /// after an N belong to the N.
  const Word* number_without_letter() const {
    if (words.empty()) return nullptr;
    if (words.front().letter == kNumber) return &words.front();
    const std::size_t first = words.size() > 1 && words.front().letter == 'N' ? 1 : 0;
    const Word& word = words[first];
    const bool is_h = word.letter == kError && word.digits > 0 && (text[word.begin] | 0x20) == 'h';
    return is_h ? &word : nullptr;
  }
  /// Whether the line has only blanks, comments and N: a block without effect (D13).
  bool is_empty() const {
    return instructions.empty() && feed < 0 && spindle < 0 && !number_without_letter() && !has(kMayMove);
  }
  const Word& command(const Instruction& instruction) const { return words[instruction.command]; }
  /// The first motion, or null.
  const Instruction* motion() const {
    for (const Instruction& instruction : instructions)
      if (instruction.is_motion()) return &instruction;
    return nullptr;
  }
  /// Whether an instruction of the line is M02.
  bool ends_program(const Instruction& instruction) const {
    return instruction.kind == InstructionKind::Function && command(instruction).value == dialect::kProgramEnd;
  }
  /// The two blocks of a line with kTwoBlocks. Its only finding is at the number of the second.
  std::array<std::string_view, 2> blocks() const {
    const std::uint32_t second = findings.front().span.begin;
    return {text.substr(0, second), text.substr(second)};
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
  /// The word of the line's own number, not of the label after a GOTO; null if the line has no number.
  const Word* label_word() const {
    if (!has_label()) return nullptr;
    for (const Word& word : words)
      if (word.letter == 'N' && word.is_plain_integer() && !(jump && word.span() == jump->target_span)) return &word;
    return nullptr;
  }
  std::string_view text_of(Span span) const { return text.substr(span.begin, span.end - span.begin); }
};

/// Whether the text of a kError is a letter of other controls with its number (H2, D3): a word, not plain text.
bool is_foreign_word(std::string_view text);

/// Maximum number of words parsed per line; W192 reports longer lines.
inline constexpr std::size_t kMaxWords = 16384;

/// The number of trailing words that are probably plain text (OP 10): a malformed word (without letter or number, or
/// unknown characters), and one correct word after it.
inline std::size_t prose_at_end(std::span<const Word> words) {
  const auto is_prose = [](const Word& word) {
    return word.letter == kError || word.letter == kNumber || word.has(Word::kMissing);
  };
  if (words.empty()) return 0;
  if (is_prose(words.back())) return 1;
  return words.size() > 1 && is_prose(words[words.size() - 2]) ? 2 : 0;
}

}  // namespace isocnc::syntax
