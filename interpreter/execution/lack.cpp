#include "interpreter/execution/lack.h"

#include <algorithm>
#include <iterator>

namespace isocnc::execution {

using namespace dialect::literals;

namespace {

constexpr dialect::LetterSet kCircle = dialect::kCenterLetters | dialect::letters("R");
constexpr dialect::LetterSet kArc = dialect::kCoordinateLetters | kCircle | dialect::letters("F");
constexpr dialect::LetterSet kFace = dialect::letters("XYZABCIJKPQR");

struct Row {
  dialect::DiagnosticId finding;
  dialect::LetterSet letters;
};

/// The findings about missing words of motions, with the letters of these words and of those that may follow them.
constexpr Row kMotions[] = {{"missing-coordinate"_diag, kArc},
                            {"arc-end-outside-plane"_diag, kArc},
                            {"circle-not-given"_diag, kArc},
                            {"center-undetermined-g17-i"_diag, kArc},
                            {"center-undetermined-g17-j"_diag, kArc},
                            {"center-undetermined-g18-i"_diag, kArc},
                            {"center-undetermined-g18-k"_diag, kArc},
                            {"center-undetermined-g19-j"_diag, kArc},
                            {"center-undetermined-g19-k"_diag, kArc},
                            {"feed-missing"_diag, dialect::letters("F")},
                            {"inverse-time-feed-missing"_diag, dialect::letters("F")}};

/// The same for other instructions.
constexpr Row kOthers[] = {
    {"tool-change-without-tool"_diag, dialect::letters("T")},
    {"dwell-time-missing"_diag, dialect::letters("P")},
    {"missing-arguments"_diag, kFace},
    {"missing-i-vector"_diag, kFace},
    {"missing-j-vector"_diag, kFace},
    {"missing-k-vector"_diag, kFace},
    {"missing-origin"_diag, dialect::kLinearLetters},
};

template <std::size_t count>
dialect::LetterSet letters_of(const Row (&rows)[count], dialect::DiagnosticId finding) {
  const auto row = std::find_if(std::begin(rows), std::end(rows), [&](const Row& it) { return it.finding == finding; });
  return row == std::end(rows) ? 0 : row->letters;
}

}  // namespace

void Lack::take(dialect::DiagnosticId finding) {
  const dialect::LetterSet of_motion = letters_of(kMotions, finding);
  letters |= of_motion | letters_of(kOthers, finding);
  is_of_motion |= of_motion != 0;
  value |= finding == "register-not-assigned"_diag || finding == "m-param-invalid"_diag;
  jump |= finding == "if-malformed"_diag;
}

void Lack::remove_words_of(const syntax::LineTree& line) {
  for (const syntax::Word& word : line.words) {
    jump &= word.letter != syntax::kGoto;
    if (word.letter >= 'A' && word.letter <= 'Z' && !word.has(syntax::Word::kMissing))
      letters &= ~dialect::letter_bit(word.letter);
  }
}

}  // namespace isocnc::execution
