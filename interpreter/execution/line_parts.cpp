#include "interpreter/execution/line_parts.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace isocnc::execution {

using namespace dialect::literals;
using syntax::LineTree;
using syntax::Word;

namespace {

/// A finding about missing words.
struct Lacking {
  dialect::DiagnosticId finding;
  dialect::LetterSet letters;
};

/// The findings about missing words of motions, with the letters of these words and of those that may follow them.
constexpr Lacking kMotions[] = {{"missing-coordinate"_diag, dialect::kMotionLetters},
                                {"arc-end-outside-plane"_diag, dialect::kMotionLetters},
                                {"circle-not-given"_diag, dialect::kMotionLetters},
                                {"center-undetermined-g17-i"_diag, dialect::kMotionLetters},
                                {"center-undetermined-g17-j"_diag, dialect::kMotionLetters},
                                {"center-undetermined-g18-i"_diag, dialect::kMotionLetters},
                                {"center-undetermined-g18-k"_diag, dialect::kMotionLetters},
                                {"center-undetermined-g19-j"_diag, dialect::kMotionLetters},
                                {"center-undetermined-g19-k"_diag, dialect::kMotionLetters},
                                {"feed-missing"_diag, dialect::kCircleLetters | dialect::letters("F")},
                                {"inverse-time-feed-missing"_diag, dialect::letters("F")}};

/// The same for other instructions.
constexpr Lacking kOthers[] = {
    {"tool-change-without-tool"_diag, dialect::letters("T")}, {"dwell-time-missing"_diag, dialect::letters("P")},
    {"missing-arguments"_diag, dialect::kDimensionLetters},   {"missing-i-vector"_diag, dialect::kDimensionLetters},
    {"missing-j-vector"_diag, dialect::kDimensionLetters},    {"missing-k-vector"_diag, dialect::kDimensionLetters},
    {"missing-origin"_diag, dialect::kLinearLetters},
};

template <std::size_t count>
dialect::LetterSet letters_of(const Lacking (&rows)[count], dialect::DiagnosticId finding) {
  const auto row =
      std::find_if(std::begin(rows), std::end(rows), [&](const Lacking& it) { return it.finding == finding; });
  return row == std::end(rows) ? 0 : row->letters;
}

}  // namespace

void Lack::take(dialect::Cause finding) {
  const dialect::LetterSet of_motion = letters_of(kMotions, finding.id);
  letters |= of_motion | letters_of(kOthers, finding.id);
  is_of_motion |= of_motion != 0;
  value |= finding.id == "register-not-assigned"_diag || finding == "m-param-invalid/no-value"_cause;
  jump |= finding.id == "if-malformed"_diag;
}

void Lack::remove_words_of(const syntax::LineTree& line) {
  for (const syntax::Word& word : line.words) {
    jump &= word.letter != syntax::kGoto;
    if (word.letter >= 'A' && word.letter <= 'Z' && !word.has(syntax::Word::kMissing))
      letters &= ~dialect::letter_bit(word.letter);
  }
}

/// The number of words up to the label of a GOTO without its IF; 0 if the line does not hold one.
static std::size_t rest_of_jump(std::span<const Word> words) {
  const auto is_jump = [](const Word& word) { return word.letter == syntax::kGoto || word.letter == syntax::kIf; };
  const auto jump = std::find_if(words.begin(), words.end(), is_jump);
  if (jump == words.end() || jump->letter == syntax::kIf) return 0;
  const auto label = jump + 1;
  const bool has_label = label != words.end() && (label->letter == 'N' || label->letter == syntax::kNumber);
  return static_cast<std::size_t>(jump - words.begin()) + (has_label ? 2 : 1);
}

/// The number of words at the start of a line that are among those that the block before lacks.
static std::size_t count_carried(std::span<const Word> words, const Lack& lack) {
  if (words.empty() || lack.empty()) return 0;
  if (lack.jump)
    if (const std::size_t count = rest_of_jump(words)) return count;
  if (lack.value && (words[0].letter == syntax::kAssign || words[0].letter == syntax::kNumber)) {
    std::size_t count = 1;  // = 2.5 P2=-3: the parameters after it, too.
    while (count + 1 < words.size() && words[count].letter == 'P' && words[count + 1].letter == syntax::kAssign)
      count += 2;
    return count;
  }
  std::size_t count = 0;
  dialect::LetterSet seen = 0;
  while (count < words.size() && dialect::contains(lack.letters & ~seen, words[count].letter) &&
         !words[count].has(Word::kMissing))
    seen |= dialect::letter_bit(words[count++].letter);
  return count;
}

/// Whether an instruction goes on after the first `count` words, each letter once: then all of it is one block.
static bool cuts_instruction(const LineTree& line, std::size_t count) {
  if (count == line.words.size()) return false;
  const std::uint16_t owner = line.words[count - 1].owner;
  if (owner == Word::kNoOwner || line.words[count].owner != owner) return false;
  for (const syntax::Instruction& it : line.instructions)
    if (it.number == owner && it.kind == syntax::InstructionKind::G && it.command >= count) return false;
  dialect::LetterSet seen = 0;
  for (const Word& word : line.words) {
    if (word.owner != owner || word.letter < 'A') continue;
    if (dialect::contains(seen, word.letter)) return false;
    seen |= dialect::letter_bit(word.letter);
  }
  return true;
}

/// Whether an F among the carried words may be the line's own: it is alone there, or before a feed move without
/// another.
static bool has_own_feed(const LineTree& carried, const LineTree& rest) {
  return carried.feed >= 0 && rest.feed < 0 && (rest.is_empty() || rest.motion() != nullptr);
}

/// Whether the coordinates that are carried have the line's own F behind them, so that they are a block of their own.
static bool leaves_feed(const LineTree& carried, const LineTree& rest) {
  return carried.motion() != nullptr && rest.feed >= 0 && rest.motion() == nullptr;
}

std::optional<SplitLine> SplitLine::split(const LineTree& line, const Lack& lack) {
  const std::size_t count = count_carried(line.words, lack);
  if (count == 0 || cuts_instruction(line, count)) return std::nullopt;
  std::string carried(line.text);
  std::string rest(line.text);
  const std::size_t end = line.words[count - 1].end;
  std::fill(carried.begin() + static_cast<std::ptrdiff_t>(end), carried.end(), ' ');
  std::fill(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(end), ' ');
  SplitLine parts(carried, rest);
  const bool is_lone_feed = parts.carried().instructions.empty();
  if (is_lone_feed && has_own_feed(parts.carried(), parts.rest())) return std::nullopt;
  if (leaves_feed(parts.carried(), parts.rest())) return std::nullopt;
  return parts;
}

}  // namespace isocnc::execution
