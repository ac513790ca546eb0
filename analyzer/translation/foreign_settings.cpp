#include <algorithm>

#include <fmt/format.h>

#include "analyzer/translation/translation_run.h"

namespace isocnc::translation {

using Untranslatable = UntranslatableReason;
using enum ForeignRole;

static void append_word(std::string& words, std::string_view word) {
  if (!words.empty() && !word.empty()) words += ' ';
  words += word;
}

static bool has_function(const std::vector<int>& functions, int number) {
  return std::find(functions.begin(), functions.end(), number) != functions.end();
}

/// The mode that a G sets for the lines below.
std::optional<UnknownMode> TranslationRun::mode_of(ForeignRole role) {
  static constexpr std::pair<ForeignRole, UnknownMode> kModes[] = {{Plane, UnknownMode::Plane},
                                                                   {Inches, UnknownMode::Units},
                                                                   {Millimeters, UnknownMode::Units},
                                                                   {Absolute, UnknownMode::Distance},
                                                                   {Incremental, UnknownMode::Distance},
                                                                   {InverseTime, UnknownMode::FeedMode},
                                                                   {PerMinute, UnknownMode::FeedMode},
                                                                   {PerTurn, UnknownMode::FeedMode},
                                                                   {CentersAbsolute, UnknownMode::Centers},
                                                                   {CentersRelative, UnknownMode::Centers},
                                                                   {RetractInitial, UnknownMode::Retract},
                                                                   {RetractR, UnknownMode::Retract}};
  for (const auto& [setting, mode] : kModes)
    if (setting == role) return mode;
  return std::nullopt;
}

void TranslationRun::apply_modals(CurrentBlock& current) {
  if (current.has(CycleEnd)) motion_ = -1;
  for (const auto& [tenths, role] : current.gs) {
    if (role == Motion || role == Cycle) motion_ = tenths / 10;
    if (role == Motion) current.writes_motion = true;
    if (role == Plane) now_.plane = tenths / 10, stated_.plane = true;
    if (role == Inches || role == Millimeters) {
      feed_is_written_ = feed_is_written_ && now_.inches == (role == Inches);
      now_.inches = role == Inches;
      stated_.units = true;
    }
    if (role == Absolute || role == Incremental) now_.incremental = role == Incremental, stated_.distance = true;
    if (role == CentersAbsolute || role == CentersRelative) centers_absolute_ = role == CentersAbsolute;
    if (role == InverseTime || role == PerMinute) now_.inverse_time = role == InverseTime, stated_.feed_mode = true;
    if (role == RetractInitial || role == RetractR) retracts_to_r_ = role == RetractR, retract_is_stated_ = true;
    if (role == ExactStop || role == Continuous) exact_stop_ = role == ExactStop;
    if (role == ExactStopHere) current.exact_stop = true;
    if (const auto mode = mode_of(role)) unknown_.erase(*mode);
  }
  if (!holds_cycle()) cycle_ = {};
  apply_suspensions(current);
}

/// Any modes may be in force: an M72 restores what an M70 has saved, and a subprogram sets its own.
void TranslationRun::forget_modes() {
  unknown_.insert({UnknownMode::Plane, UnknownMode::Units, UnknownMode::Distance, UnknownMode::FeedMode,
                   UnknownMode::Centers, UnknownMode::Retract, UnknownMode::ZeroPoint});
  suspended_by_.insert({Compensation, LengthGiven});
  motion_ = -1;
  cycle_ = {};
  feed_.reset();
}

/// A mode that this dialect lacks: while it is in force, motions stay as comments.
struct SuspensionRow {
  ForeignRole on, off;
  Untranslatable reason;
  std::string_view parameters = {};  ///< Letters that belong to the G.
};

static constexpr SuspensionRow kSuspensions[] = {
    {Polar, PolarOff, Untranslatable::PolarCoordinates},
    {Scale, ScaleOff, Untranslatable::ScaledOrMirrored, "XYZIJKRPQ"},
    {Mirror, MirrorOff, Untranslatable::ScaledOrMirrored, "XYZIJKRPQ"},
    {Tilt, RotationOff, Untranslatable::TiltedPlane, "XYZIJKRPQ"},
    {CurvedPlane, CurvedPlaneOff, Untranslatable::UnknownG, "ABC"},
    {Diameter, Radius, Untranslatable::DiameterMode},
    {PerTurn, PerMinute, Untranslatable::FeedPerTurn},
    {SurfaceSpeed, TurnsPerMinute, Untranslatable::SurfaceSpeed, "D"},
    {LengthGiven, LengthOff, Untranslatable::LengthGiven, "HXYZ"},
    {CompensationGiven, CompensationOff, Untranslatable::CompensationGiven, "DL"},
};

bool TranslationRun::suspends_motions(ForeignRole role) {
  return std::any_of(std::begin(kSuspensions), std::end(kSuspensions),
                     [&](const SuspensionRow& row) { return row.on == role; });
}

void TranslationRun::apply_suspensions(CurrentBlock& current) {
  std::size_t place = 0;
  for (const ForeignWord& word : current.words) {
    if (word.letter != 'G') continue;
    const ForeignRole role = current.gs[place++].second;
    for (const SuspensionRow& row : kSuspensions) {
      const bool replaces = (row.on == LengthGiven && role == Length) || (row.on == PerTurn && role == InverseTime) ||
                            (row.on == CompensationGiven && role == Compensation);
      if (role == row.off || replaces) suspended_by_.erase(row.on);
      if (role != row.on) continue;
      suspended_by_.insert(row.on);
      leave_out(current, row.reason, word);
      for (const ForeignWord& parameter : current.words)
        if (row.parameters.find(parameter.letter) != std::string_view::npos)
          current.remark += fmt::format(" {}{}", parameter.letter, parameter.digits);
    }
  }
}

/// Whether an H or D names the data of another tool than the one mounted, or may do so.
bool TranslationRun::is_of_other_tool(const ForeignWord* word, int offset) const {
  return word != nullptr && tool_ >= 0 && (word->is_formula || word->value != static_cast<double>(tool_) + offset);
}

/// H, D and the Gs that take them. The tool's length and radius come with M06 here.
void TranslationRun::apply_offsets(CurrentBlock& current) {
  const ForeignWord* const h = current.find('H');
  const ForeignWord* const d = current.find('D');
  const bool ends_length = current.has(LengthOff) || (h != nullptr && h->value == 0);
  const bool takes_length = !ends_length && !current.has(LengthGiven) && (current.has(Length) || h != nullptr);
  const std::vector<std::string> mounted{fmt::format("T{}", tool_)};
  if (takes_length) {
    if (is_of_other_tool(h, setup_.map.length_offset)) {
      leave_out(current, Untranslatable::ToolOffsetOfOther, *h, mounted);
      suspended_by_.insert(LengthGiven);
    } else if (h != nullptr) {
      suspended_by_.erase(LengthGiven);
    }
    length_active_ = true;
    length_off_ = false;
  } else if (ends_length) {
    suspended_by_.erase(LengthGiven);
    length_off_ = length_off_ || length_active_;
    length_active_ = false;
  }
  if (current.has(Compensation) || current.has(CompensationOff)) suspended_by_.erase(Compensation);
  if (current.has(Compensation) && is_of_other_tool(d, setup_.map.radius_offset)) {
    leave_out(current, Untranslatable::ToolOffsetOfOther, *d, mounted);
    suspended_by_.insert(Compensation);
  }
  for (const auto& [tenths, role] : current.gs)
    if (role == Compensation || role == CompensationOff) compensation_ = tenths / 10;
  if (current.has(CompensationGiven)) compensation_ = 40;
}

/// What the H and D of a block that is left as a comment have set.
void TranslationRun::apply_refused_offsets(const CurrentBlock& current) {
  const ForeignWord* const d = current.find('D');
  if (is_of_other_tool(current.find('H'), setup_.map.length_offset)) suspended_by_.insert(LengthGiven);
  if (current.has(Compensation) && is_of_other_tool(d, setup_.map.radius_offset)) suspended_by_.insert(Compensation);
  if (current.has(LengthOff)) length_off_ = length_off_ || length_active_;
}

void TranslationRun::add_tool(CurrentBlock& current) {
  const ForeignWord* const t = current.find('T');
  if (t != nullptr) prepared_tool_ = static_cast<int>(t->value);
  if (!has_function(current.ms, 6)) return;
  const ForeignWord& m06 = *std::find_if(current.words.begin(), current.words.end(),
                                         [](const ForeignWord& word) { return word.letter == 'M' && word.value == 6; });
  if (prepared_tool_ < 0) {
    tool_is_wrong_ = true;
    return leave_out(current, Untranslatable::ToolNumberMissing, m06);
  }
  const auto found = setup_.map.tools.find(prepared_tool_);
  const bool is_mapped = found != setup_.map.tools.end();
  tool_is_wrong_ = !is_mapped && prepared_tool_ != 0;
  if (tool_is_wrong_) {
    report(current, {Untranslatable::ToolUnmapped, (t != nullptr ? *t : m06).at, {fmt::format("T{}", prepared_tool_)}});
    append_word(current.remark, fmt::format("T{} M06", prepared_tool_));
    tool_ = -1;
    return;
  }
  tool_ = prepared_tool_;
  mount_tool(is_mapped ? found->second : "000000");
}

/// The tool that the map names for the start, where the program has mounted none.
void TranslationRun::mount_first_tool() {
  if (!tool_is_mounted_ && !tool_is_wrong_ && !setup_.map.start.empty()) mount_tool(setup_.map.start);
}

/// The other controls stop the spindle for it; this one leaves it to the program.
void TranslationRun::mount_tool(const std::string& code) {
  if (std::exchange(spindle_, 5) != 5) writer_.add_code("M05");
  writer_.add_code("M06 T" + code);
  tool_is_mounted_ = true;
}

void TranslationRun::add_spindle(CurrentBlock& current) {
  const ForeignWord* const s = current.find('S');
  const bool stops = has_function(current.ms, 5);
  const bool starts = has_function(current.ms, 3) || has_function(current.ms, 4);
  const bool stops_later = setup_.control == SourceControl::Fanuc;  // M05 after the motion of its block.
  if (starts) mount_first_tool();                                   // Its M06 would stop the spindle afterwards.
  if (s != nullptr && suspended_by_.contains(SurfaceSpeed)) {
    append_word(current.remark, "S" + s->digits);
  } else if (s != nullptr && s->value > 0) {
    // The others change the speed at once; here an S waits for the next M03 or M04.
    const bool turns = spindle_ != 5 && !starts && (!stops || (stops_later && has_motion(current)));
    current.before.push_back(turns ? fmt::format("S{} M{:02}", s->digits, spindle_) : "S" + s->digits);
  } else if (s != nullptr && !stops) {
    leave_out(current, Untranslatable::SpeedNotPositive, *s);
  }
  for (const int m : current.ms) {
    if (m < 3 || m > 5) continue;
    (m == 5 && stops_later ? current.after : current.before).push_back(fmt::format("M{:02}", m));
    spindle_ = m;
  }
}

void TranslationRun::add_functions(CurrentBlock& current) {
  std::size_t place = 0;
  for (const ForeignWord& word : current.words) {
    if (word.letter != 'M') continue;
    const int m = current.ms[place++];
    const bool is_own = (m >= 2 && m <= 6) || m == 30 || m == 98 || m == 99;
    if (is_own) continue;
    if (m >= 70 && m <= 73 && setup_.control == SourceControl::LinuxCnc) {
      leave_out(current, Untranslatable::SavedModes, word);
      if (m == 72) forget_modes();
      continue;
    }
    const auto found = setup_.map.functions.find(m);
    const bool is_named = found != setup_.map.functions.end() || setup_.named_functions.contains(m);
    if (!is_named) {
      leave_out(current, Untranslatable::UnnamedFunction, word);
      continue;
    }
    const int number = found != setup_.map.functions.end() ? found->second : m;
    const bool comes_after = m == 0 || m == 1 || m == 9 || m == 60;
    if (number > 0) (comes_after ? current.after : current.before).push_back(fmt::format("M{:02}", number));
  }
}

void TranslationRun::add_dwell(CurrentBlock& current) {
  if (!current.has(Dwell)) return;
  const bool is_fanuc = setup_.control == SourceControl::Fanuc;
  const ForeignWord* seconds = nullptr;
  for (const char letter : {'P', 'X', 'U'})
    if (seconds == nullptr) seconds = current.find(letter);
  if (seconds == nullptr || seconds->value < 0) {
    report(current, {Untranslatable::DwellMissing, 0, {is_fanuc ? "P, X, U" : "P"}});
    return keep_as_comment(current);
  }
  const bool counts_milliseconds = is_fanuc && seconds->letter == 'P';
  dwell_for(counts_milliseconds ? seconds->value / 1000 : seconds->value);
}

/// The modal Gs that are not written yet as the program has them now.
std::string TranslationRun::settings(bool incremental) {
  std::string words;
  const auto write = [&](bool is_stated, bool& is_written, bool differs, std::string_view word) {
    if (!differs && (!is_stated || is_written)) return;
    append_word(words, word);
    is_written = true;
  };
  write(stated_.plane, written_stated_.plane, now_.plane != written_.plane, fmt::format("G{}", now_.plane));
  write(stated_.units, written_stated_.units, now_.inches != written_.inches, now_.inches ? "G70" : "G71");
  write(stated_.distance, written_stated_.distance, incremental != written_.incremental, incremental ? "G91" : "G90");
  write(stated_.feed_mode, written_stated_.feed_mode, now_.inverse_time != written_.inverse_time,
        now_.inverse_time ? "G93" : "G94");
  written_ = now_;
  written_.incremental = incremental;
  return words;
}

void TranslationRun::write_words(const std::string& words) {
  if (!words.empty()) writer_.add_code(words);
}

/// Functions that no motion has taken along.
void TranslationRun::flush_words(CurrentBlock& current) {
  std::string words;
  for (auto* list : {&current.before, &current.after}) {
    for (const std::string& word : *list) append_word(words, word);
    list->clear();
  }
  write_words(words);
}

}  // namespace isocnc::translation
