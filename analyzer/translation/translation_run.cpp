#include "analyzer/translation/translation_run.h"

#include <algorithm>

#include <fmt/format.h>

#include "interpreter/text/unicode.h"

namespace isocnc::translation {

using dialect::Text;
using Untranslatable = UntranslatableReason;
using enum ForeignRole;

namespace {

constexpr Text kNotTranslated{"NOT TRANSLATED: ", "NON TRADOTTO: "};
constexpr int kDeepestCall = 8;
constexpr std::size_t kMaxCalledMegabytes = 16;
constexpr std::size_t kBytesOfCall = 16;  // What a line costs beside its text, and a call beside its lines.

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
  }
  return lines;
}

/// The end of the first line, for all lines of the translation.
std::string_view line_end_of(std::string_view text) {
  const std::size_t end = text.find_first_of("\r\n");
  if (end == std::string_view::npos || text[end] == '\n') return "\n";
  return text.substr(end).starts_with("\r\n") ? "\r\n" : "\r";
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// The number of a program without leading zeros: O0100 and P100 are the same.
std::string program_number(std::string_view digits) {
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return std::string(digits);
}

bool is_whole(const ForeignWord& word) {
  return !word.is_formula && !word.digits.empty() && word.digits.find_first_not_of("0123456789") == std::string::npos;
}

/// `N10` as it stands here: only whole numbers are line numbers.
std::string label_of(const ForeignBlock& block) {
  const ForeignWord* const number = block.find('N');
  return number != nullptr && is_whole(*number) ? "N" + number->digits : "";
}

}  // namespace

const ForeignWord* TranslationRun::CurrentBlock::find(char letter) const {
  const auto found = std::find_if(words.begin(), words.end(), [&](const ForeignWord& w) { return w.letter == letter; });
  return found == words.end() ? nullptr : &*found;
}

bool TranslationRun::CurrentBlock::has(ForeignRole role) const {
  return std::any_of(gs.begin(), gs.end(), [&](const auto& g) { return g.second == role; });
}

const ForeignWord& TranslationRun::CurrentBlock::g_of(ForeignRole role) const {
  std::size_t place = 0;
  return *std::find_if(words.begin(), words.end(),
                       [&](const ForeignWord& word) { return word.letter == 'G' && gs[place++].second == role; });
}

bool TranslationRun::CurrentBlock::has_any(std::string_view letters) const {
  return std::any_of(words.begin(), words.end(),
                     [&](const ForeignWord& word) { return letters.find(word.letter) != std::string_view::npos; });
}

TranslationRun::TranslationRun(std::string_view text, const TranslationSetup& setup)
    : setup_(setup), lines_(lines_of(text)), writer_(line_end_of(text)), frames_(setup.map.zeros) {
  now_.inches = stated_.units = setup.map.starts_in_inches;
  if (setup.control == SourceControl::Grbl) motion_ = 0;  // Its state at the start.
  retract_is_stated_ = setup.control != SourceControl::LinuxCnc;
  if (setup.control == SourceControl::LinuxCnc) return;  // O is no program's number there.
  for (std::size_t line = 0; line < lines_.size(); ++line) {
    const std::string_view start = without_blanks(lines_[line]);
    if (start.empty() || (start.front() != 'O' && start.front() != 'o')) continue;
    const ForeignBlock block = read_foreign_block(lines_[line], setup.control);
    const ForeignWord* const number = block.words.empty() ? nullptr : &block.words.front();
    if (number != nullptr && number->letter == 'O' && is_whole(*number))
      programs_.try_emplace(program_number(number->digits), line);
  }
}

Translation TranslationRun::run() {
  run_lines(0, 0);
  if (refusal_) return {.refusal = refusal_};
  if (!is_ended_) {
    writer_.begin_block("", {});
    end_program();
    writer_.end_block();
  }
  return {.program = writer_.take(), .findings = findings_.take()};
}

/// Translates from a line to the end of its program.
TranslationRun::BlockFlow TranslationRun::run_lines(std::size_t first, int depth) {
  for (std::size_t line = first; line < lines_.size() && !refusal_; ++line) {
    if (depth > 0) called_bytes_ += lines_[line].size() + kBytesOfCall;
    if (depth > 0 && has_called_too_much()) return BlockFlow::Return;
    const BlockFlow flow = run_line(line, depth);
    if (flow == BlockFlow::Next) continue;
    if (depth == 0) keep_rest(line + 1);
    return flow;
  }
  return BlockFlow::Return;
}

TranslationRun::BlockFlow TranslationRun::run_line(std::size_t line, int depth) {
  const ForeignBlock block = read_foreign_block(lines_[line], setup_.control);
  CurrentBlock current{.block = block, .line = line};
  writer_.begin_block(label_of(block), block.comments);
  BlockFlow flow = BlockFlow::Next;
  if (block.is_tape_mark) {
    const bool is_second = std::exchange(ends_with_tape_mark_, true);
    if (setup_.control == SourceControl::LinuxCnc && is_second) flow = BlockFlow::End;
    if (flow == BlockFlow::End) end_program();
  } else if (!flow_end_.empty()) {
    if (block.flow == flow_end_ && block.flow_label == flow_label_) flow_end_.clear();
    if (!without_blanks(block.text).empty()) remark_untranslated(without_blanks(block.text));
  } else if (block.text.find_first_not_of(" \t") == std::string_view::npos) {
    return flow;  // A blank line says nothing, and would stand alone.
  } else {
    flow = translate_block(current, depth);
  }
  writer_.end_block();
  return flow;
}

TranslationRun::BlockFlow TranslationRun::translate_block(CurrentBlock& current, int depth) {
  current.words = current.block.words;
  if (!current.words.empty() && current.words.front().letter == 'O') {
    if (depth > 0) return BlockFlow::Return;  // The next program begins.
    const std::string title = "(O" + current.words.front().digits + ")";
    current.words.erase(current.words.begin());
    writer_.add_code(title);
    if (current.words.empty() && current.block.oddity == BlockOddity::None) return BlockFlow::Next;
  }
  const std::optional<BlockRefusal> refusal = find_refusal(current);
  if (refusal_) return BlockFlow::End;
  if (refusal) {
    refuse(current, refusal);
    return BlockFlow::Next;
  }
  apply_modals(current);
  add_tool(current);
  apply_offsets(current);
  add_spindle(current);
  add_functions(current);
  add_frames(current);
  if (has_motion(current)) {
    add_motion(current);
  } else {
    apply_feed(current);
  }
  if (!current.remark.empty()) remark_untranslated(current.remark);
  flush_words(current);
  const bool ends = std::any_of(current.ms.begin(), current.ms.end(), [](int m) { return m == 2 || m == 30; });
  if (!current.has_moved && !ends) write_settings();
  add_dwell(current);
  return end_of_block(current, depth);
}

/// What ends the block: stops, calls, the end of the program.
TranslationRun::BlockFlow TranslationRun::end_of_block(CurrentBlock& current, int depth) {
  for (const int m : current.ms) {
    if (m == 98) return call(current, depth);
    if (m == 99 && depth > 0) return BlockFlow::Return;
    if (m == 99) report(current, Untranslatable::EndlessProgram, *current.find('M'));
    if (m == 2 || m == 30 || m == 99) {
      end_program();
      return BlockFlow::End;
    }
  }
  return BlockFlow::Next;
}

TranslationRun::BlockFlow TranslationRun::call(CurrentBlock& current, int depth) {
  const ForeignWord* const number = current.find('P');
  const ForeignWord* const times = current.find('L');
  const ForeignWord& m98 = *current.find('M');
  const auto give_up = [&](Untranslatable reason, const ForeignWord& word, std::vector<std::string> further) {
    report(current, reason, word, std::move(further));
    keep_as_comment(current);
    lose(current, true);
    return BlockFlow::Next;
  };
  if (number == nullptr || !is_whole(*number)) return give_up(Untranslatable::NoSubprogram, m98, {});
  std::string digits = number->digits;
  std::size_t repeats = times != nullptr && times->value >= 1 ? static_cast<std::size_t>(times->value) : 1;
  if (times == nullptr && digits.size() > 4) {  // P0031000 calls O1000 three times.
    repeats = static_cast<std::size_t>(std::max(
        1.0,
        std::min(1e6, (number->value - static_cast<double>(std::stoi(digits.substr(digits.size() - 4)))) / 10'000)));
    digits.erase(0, digits.size() - 4);
  }
  const auto found = programs_.find(program_number(digits));
  if (found == programs_.end()) return give_up(Untranslatable::SubprogramMissing, *number, {});
  if (depth == kDeepestCall)
    return give_up(Untranslatable::SubprogramsTooDeep, *number, {std::to_string(kDeepestCall)});
  called_.insert(found->second);
  writer_.add_remark(without_blanks(current.block.text));
  writer_.end_block();
  BlockFlow flow = BlockFlow::Return;
  for (std::size_t i = 0; i < repeats && flow == BlockFlow::Return && !refusal_; ++i) {
    called_bytes_ += kBytesOfCall;
    if (has_called_too_much()) break;
    flow = run_lines(found->second + 1, depth + 1);
  }
  writer_.begin_block("", {});
  if (has_called_too_much() && depth == 0)
    return give_up(Untranslatable::SubprogramsTooLong, *number, {std::to_string(kMaxCalledMegabytes)});
  return flow == BlockFlow::End ? BlockFlow::End : BlockFlow::Next;
}

bool TranslationRun::has_called_too_much() const { return called_bytes_ > kMaxCalledMegabytes * 1024 * 1024; }

/// After the end: what was not called stays as comments.
void TranslationRun::keep_rest(std::size_t from) {
  bool is_called = false;
  for (std::size_t line = from; line < lines_.size(); ++line) {
    const std::string_view text = without_blanks(lines_[line]);
    if (text.empty() || text.front() == '%') continue;
    const ForeignBlock block = read_foreign_block(lines_[line], setup_.control);
    const bool starts_program = !block.words.empty() && block.words.front().letter == 'O';
    if (starts_program) is_called = called_.contains(line);
    if (is_called) continue;
    const CurrentBlock current{.block = block, .line = line, .words = block.words};
    if (starts_program) report(current, Untranslatable::OtherProgram, block.words.front());
    writer_.begin_block("", {});
    writer_.add_remark(text);
    writer_.end_block();
  }
}

/// M02, after what the other controls do at the end by themselves.
void TranslationRun::end_program() {
  if (std::exchange(is_ended_, true)) return;
  if (written_compensation_ != 40) writer_.add_code("G40");
  if (written_frame_.rotation) writer_.add_code("G27");
  if (spindle_ != 5 && tool_is_mounted_) writer_.add_code("M05");
  if (written_.incremental) writer_.add_code("G90");
  writer_.add_code("M02");
}

void TranslationRun::follow_flow(const ForeignBlock& block) {
  static constexpr std::pair<std::string_view, std::string_view> kBlocks[] = {
      {"sub", "endsub"}, {"if", "endif"}, {"while", "endwhile"}, {"do", "while"}, {"repeat", "endrepeat"}};
  for (const auto& [start, end] : kBlocks) {
    if (block.flow != start) continue;
    flow_end_ = end;
    flow_label_ = block.flow_label;
  }
}

void TranslationRun::report(const CurrentBlock& current, BlockRefusal refusal) {
  findings_.add({.reason = refusal.reason,
                 .line = current.line + 1,
                 .column = text::column_of(current.block.text, refusal.at),
                 .values = std::move(refusal.values)});
}

void TranslationRun::report(const CurrentBlock& current, Untranslatable reason, const ForeignWord& word,
                            std::vector<std::string> further) {
  static constexpr std::size_t kLongestWord = 40;
  const std::string_view written = current.block.text.substr(word.at, word.end - word.at);
  further.insert(further.begin(), text::printable(written.substr(0, kLongestWord)));
  report(current, {reason, word.at, std::move(further)});
}

/// Drops a word of a block that is translated otherwise.
void TranslationRun::leave_out(CurrentBlock& current, Untranslatable reason, const ForeignWord& word,
                               std::vector<std::string> further) {
  report(current, reason, word, std::move(further));
  if (!current.remark.empty()) current.remark += ' ';
  current.remark += current.block.text.substr(word.at, word.end - word.at);
}

void TranslationRun::remark_untranslated(std::string_view text) {
  writer_.add_remark(std::string(kNotTranslated.in(setup_.language)) + std::string(text));
}

void TranslationRun::keep_as_comment(const CurrentBlock& current) {
  remark_untranslated(without_blanks(current.block.text));
}

/// Leaves a block as a comment. What it sets holds for the blocks below all the same, unless the operator may skip it.
void TranslationRun::refuse(CurrentBlock& current, const std::optional<BlockRefusal>& refusal) {
  if (refusal) report(current, *refusal);
  keep_as_comment(current);
  const bool is_flow = current.block.oddity == BlockOddity::Statement;
  follow_flow(current.block);
  if (current.block.skip_at) {
    forget_what_it_sets(current);
  } else {
    apply_modals(current);
    apply_feed(current);
    apply_refused_frames(current);
    if (const ForeignWord* const t = current.find('T'))
      prepared_tool_ = t->is_formula ? -1 : static_cast<int>(std::clamp(t->value, -1.0, 1e9));
  }
  apply_refused_offsets(current);
  const bool changes_cycle = holds_cycle() && current.has_any("RQ");
  if (current.has(Unknown) || current.has(CycleUnknown) || changes_cycle)
    motion_ = -1;  // Not known on the lines below.
  const auto has_m = [&](int m) { return std::find(current.ms.begin(), current.ms.end(), m) != current.ms.end(); };
  const bool restores_modes = has_m(72) && setup_.control == SourceControl::LinuxCnc;
  const bool may_call = current.block.skip_at && has_m(98);  // Lines that may set any mode.
  if (restores_modes || may_call) forget_modes();
  const bool changes_tool = has_m(6);
  if (changes_tool) {
    tool_is_wrong_ = true;
    tool_ = -1;
  }
  const bool calls_macro =
      std::any_of(current.gs.begin(), current.gs.end(), [](const auto& g) { return g.first >= 650 && g.first < 680; });
  const bool defines = current.block.flow == "sub";
  const bool is_setting = current.block.oddity == BlockOddity::Assignment || defines;
  const bool goes_home = current.has(Reference) && !current.has_any("XYZ");
  lose(current, (is_flow || current.block.oddity == BlockOddity::Unreadable || calls_macro || has_m(98) || goes_home) &&
                    !is_setting);
}

}  // namespace isocnc::translation
