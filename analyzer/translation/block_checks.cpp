#include <algorithm>
#include <cmath>

#include "analyzer/translation/translation_run.h"
#include "interpreter/text/unicode.h"

namespace isocnc::translation {

using Untranslatable = UntranslatableReason;
using enum ForeignRole;

static constexpr double kLargestNumber = 1e9;
static constexpr std::size_t kLongestQuote = 40;

static std::string quoted(const ForeignBlock& block, std::size_t at, std::size_t end) {
  return text::printable(block.text.substr(at, std::min(end - at, kLongestQuote)));
}

static BlockRefusal refusal_at(const ForeignBlock& block, Untranslatable reason, const ForeignWord& word) {
  return {reason, word.at, {quoted(block, word.at, word.end)}};
}

/// Why the block as a whole cannot be translated. Reads its words into Gs and Ms first, so that what it sets is known.
std::optional<BlockRefusal> TranslationRun::find_refusal(CurrentBlock& current) {
  const ForeignBlock& block = current.block;
  std::optional<BlockRefusal> refusal = classify_words(current);
  if (block.skip_at) return BlockRefusal{Untranslatable::SkippedBlock, *block.skip_at, {}};
  if (block.oddity != BlockOddity::None) {
    const Untranslatable reason = block.oddity == BlockOddity::Assignment  ? Untranslatable::Assignment
                                  : block.oddity == BlockOddity::Statement ? Untranslatable::Statement
                                                                           : Untranslatable::Unreadable;
    // One finding for all variables and statements: what differs is in the comment.
    return BlockRefusal{reason, block.oddity_at, {quoted(block, block.oddity_at, block.oddity_end)}};
  }
  if (refusal) return refusal;
  if ((refusal = check_letters(current))) return refusal;
  if ((refusal = check_known_lengths(current))) return refusal;
  return count_thousandths(current);
}

std::optional<BlockRefusal> TranslationRun::classify_words(CurrentBlock& current) const {
  std::optional<BlockRefusal> first;
  const auto fail = [&](Untranslatable reason, const ForeignWord& word) {
    if (!first) first = refusal_at(current.block, reason, word);
  };
  std::set<char> seen;
  bool has_motion = false;
  for (const ForeignWord& word : current.words) {
    const bool is_code = word.letter == 'G' || word.letter == 'M';
    if (word.is_formula)
      fail(Untranslatable::Formula, word);
    else if (!is_code && std::abs(word.value) > kLargestNumber)
      fail(Untranslatable::NumberTooLarge, word);
    else if (!is_code && !seen.insert(word.letter).second)
      fail(Untranslatable::WordTwice, word);
    if (word.letter == 'T' && !(word.value >= 0 && word.value == std::floor(word.value)))
      fail(Untranslatable::UnknownWord, word);
    if (word.letter == 'G') {
      const int tenths = word.tenths();
      const ForeignRole role = tenths < 0 ? Unknown : foreign_role(tenths, setup_.control);
      current.gs.emplace_back(tenths, role);
      const bool moves = role == Motion || role == Cycle;
      if (moves && std::exchange(has_motion, true)) fail(Untranslatable::UnknownWord, word);
      if (role == Unknown || role == PresetShift) fail(Untranslatable::UnknownG, word);
      if (role == CycleUnknown) fail(Untranslatable::CycleUnknown, word);
    } else if (word.letter == 'M') {
      const int tenths = word.tenths();
      if (tenths % 10 != 0 || tenths < 0 || tenths >= 10'000)
        fail(Untranslatable::UnknownWord, word);
      else
        current.ms.push_back(tenths / 10);
    }
  }
  return first;
}

/// The letters that the block may have: what no G or M of it takes means something else than the translation knows.
std::string TranslationRun::letters_of(const CurrentBlock& current) const {
  std::string letters = "GMNFSTO";
  const bool is_fanuc = setup_.control == SourceControl::Fanuc;
  if (is_fanuc) letters += "HD";
  for (const auto& [tenths, role] : current.gs) {
    if (role == Dwell) letters += is_fanuc ? "PXU" : "P";
    if (role == Data) letters += "LPRXYZ";
    if (role == Reference) letters += tenths == 300 ? "XYZP" : "XYZ";
    if (role == SetPosition || role == LocalShift) letters += "XYZ";
    if (role == Rotation) letters += "XYZR";
    if (role == FurtherZero || (role == ZeroPoint && is_fanuc)) letters += 'P';
    if (role == CurvedPlane || role == CurvedPlaneOff) letters += "XYZABC";
    if (role == Tilt || role == Scale || role == Mirror || role == MirrorOff) letters += "XYZIJKRPQ";
    if (role == Compensation) letters += 'D';
    if (role == CompensationGiven) letters += "DL";
    if (role == Length || role == LengthOff) letters += 'H';
    if (role == LengthGiven) letters += "HXYZ";
    if (role == Ignored || role == Continuous || role == PolarOff) letters += "PQRIJKXYZ";
    if (role == SurfaceSpeed) letters += 'D';
  }
  for (const int m : current.ms)
    if (m == 98) letters += "PL";
  if (takes_place_as_motion(current)) {
    letters += "XYZ";
    const bool has_cycle = current.has(Cycle) || (holds_cycle() && !current.has(Motion) && !current.has(CycleEnd));
    int motion = motion_;
    for (const auto& [tenths, role] : current.gs)
      if (role == Motion) motion = tenths / 10;
    if (has_cycle) letters += is_fanuc ? "RQPKL" : "RQPL";
    if (!has_cycle && (motion == 2 || motion == 3))
      letters += setup_.control == SourceControl::LinuxCnc ? "IJKRP" : "IJKR";
  }
  return letters;
}

/// Whether coordinates in the block are those of a motion.
bool TranslationRun::takes_place_as_motion(const CurrentBlock& current) const {
  static constexpr ForeignRole kOthers[] = {Dwell,    Data, Reference, SetPosition, LocalShift,
                                            Rotation, Tilt, Scale,     Mirror,      MirrorOff};
  const bool gives_length = current.has(LengthGiven) && setup_.control != SourceControl::Fanuc;
  return !gives_length &&
         std::none_of(std::begin(kOthers), std::end(kOthers), [&](ForeignRole role) { return current.has(role); });
}

std::optional<BlockRefusal> TranslationRun::check_letters(CurrentBlock& current) {
  const std::string letters = letters_of(current);
  const auto is_idle_rotary = [](const ForeignWord& word) {  // An axis that a post writes and never turns.
    return word.letter >= 'A' && word.letter <= 'C' && word.value == 0;
  };
  std::erase_if(current.words, is_idle_rotary);
  for (const ForeignWord& word : current.words) {
    if (letters.find(word.letter) != std::string::npos) continue;
    const bool is_rotary = word.letter >= 'A' && word.letter <= 'C';
    if (is_rotary) return BlockRefusal{Untranslatable::RotaryAxis, word.at, {std::string(1, word.letter)}};
    return refusal_at(current.block, Untranslatable::UnknownWord, word);
  }
  return std::nullopt;
}

/// A frame needs the units, and G90 or G91.
std::optional<BlockRefusal> TranslationRun::check_known_lengths(const CurrentBlock& current) const {
  const bool gives_frame =
      current.has(SetPosition) || current.has(LocalShift) || current.has(Data) || current.has(Rotation);
  if (!gives_frame || !current.has_any("XYZ")) return std::nullopt;
  std::set<UnknownMode> needed;
  if (!current.has(Inches) && !current.has(Millimeters)) needed.insert(UnknownMode::Units);
  if (!current.has(Absolute) && !current.has(Incremental)) needed.insert(UnknownMode::Distance);
  if (!lacks(needed)) return std::nullopt;
  return missing_modes(needed, current.words.front().at);
}

/// Lengths of a Fanuc without a decimal point.
std::optional<BlockRefusal> TranslationRun::count_thousandths(CurrentBlock& current) {
  if (setup_.control != SourceControl::Fanuc) return std::nullopt;
  bool inches = now_.inches;
  bool is_cycle = holds_cycle();
  for (const auto& [tenths, role] : current.gs) {
    if (role == Inches || role == Millimeters) inches = role == Inches;
    if (role == Ignored || role == Data) return std::nullopt;
    is_cycle |= role == Cycle;
  }
  for (ForeignWord& word : current.words) {
    const bool is_length = std::string_view("XYZUIJKRQ").find(word.letter) != std::string_view::npos;
    if (!is_length || word.has_point || word.value == 0 || (word.letter == 'K' && is_cycle)) continue;
    if (!setup_.map.counts_thousandths) {
      refusal_ = TranslationFinding{.reason = Untranslatable::WholeNumber,
                                    .line = current.line + 1,
                                    .column = text::column_of(current.block.text, word.at),
                                    .values = {quoted(current.block, word.at, word.end)}};
      return std::nullopt;
    }
    if (!*setup_.map.counts_thousandths) continue;
    const bool is_inch_length = inches && !current.has(Dwell) && !(current.has(Rotation) && word.letter == 'R');
    word.value /= is_inch_length ? 10'000 : 1'000;
    word.digits = written_number(word.value);
  }
  return std::nullopt;
}

}  // namespace isocnc::translation
