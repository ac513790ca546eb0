#include "interpreter/comparison/comparison_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/summary/summary.h"

namespace isocnc::comparison {

using dialect::Language;
using dialect::Text;
using OrderedJson = nlohmann::ordered_json;

namespace {

constexpr std::string_view kKindNames[] = {"moved", "shape",    "added", "removed", "reordered", "feed", "speed",
                                           "tool",  "function", "frame", "dwell",   "path",      "end"};

constexpr Text kMoved{"moved", "spostato"};
constexpr Text kMovedBy{"moved by {}", "spostato di {}"};
constexpr Text kMovedUpTo{"moved by up to {} mm", "spostato fino a {} mm"};
constexpr Text kTurned{"B or C turned by up to {} degrees", "B o C girati fino a {} gradi"};
constexpr Text kTurnedByOne{"B or C turned by up to 1 degree", "B o C girati fino a 1 grado"};
constexpr Text kShape{"another path, up to {} mm away", "un altro percorso, fino a {} mm di distanza"};
constexpr Text kOtherTurn{"the same path with B or C turned otherwise",
                          "lo stesso percorso con B o C girati diversamente"};
constexpr Text kOtherCount{"another path, {} instead of {}, up to {} mm away",
                           "un altro percorso, {} invece di {}, fino a {} mm di distanza"};
constexpr Text kOtherWhole{"another path, {} instead of {}", "un altro percorso, {} invece di {}"};
constexpr Text kWayBack{"the same path the other way around", "lo stesso percorso nel verso opposto"};
constexpr Text kOtherFunctions{"other functions, too many to compare", "altre funzioni, troppe per confrontarle"};
constexpr Text kEarlier{"{} comes {} mm earlier", "{} viene {} mm prima"};
constexpr Text kLater{"{} comes {} mm later", "{} viene {} mm dopo"};
constexpr Text kDwellOf{"dwell of {}", "l'attesa di {}"};
constexpr Text kMotion{"1 motion", "1 movimento"};
constexpr Text kMotions{"{} motions", "{} movimenti"};
constexpr Text kAdded{"added: {}", "aggiunto: {}"};
constexpr Text kRemoved{"removed: {}", "tolto: {}"};
constexpr Text kMotionsAdded{"added: {} motions", "aggiunti: {} movimenti"};
constexpr Text kMotionsRemoved{"removed: {} motions", "tolti: {} movimenti"};
constexpr Text kAndOtherPath{"{}; the next one takes another path, up to {} mm away",
                             "{}; il successivo fa un altro percorso, fino a {} mm di distanza"};
constexpr Text kPlaces{"{}, in {} places", "{}, in {} punti"};
constexpr Text kReordered{"order changed", "ordine cambiato"};
constexpr Text kReorderedOperation{"order changed: now {}, was {}", "ordine cambiato: ora {}, era {}"};
constexpr Text kIsFirst{"the first one", "la prima"};
constexpr Text kIsAfter{"after {}", "dopo {}"};
constexpr Text kOperationAdded{"added: operation of {}, {}", "aggiunta: lavorazione di {}, {}"};
constexpr Text kOperationRemoved{"removed: operation of {}, {}", "tolta: lavorazione di {}, {}"};
constexpr Text kInstead{"{} instead of {}", "{} invece di {}"};
constexpr Text kFrame{"moved by {}: the frame is elsewhere", "spostato di {}: il sistema di riferimento è altrove"};
constexpr Text kFrameOf{"moved by {}: the frame of line {} is elsewhere",
                        "spostato di {}: il sistema di riferimento della riga {} è altrove"};
constexpr Text kFrameTurned{"moved by up to {} mm: the frame of line {} is turned",
                            "spostato fino a {} mm: il sistema di riferimento della riga {} è girato"};
constexpr Text kFrameTurnedFar{"moved: the frame of line {} is turned",
                               "spostato: il sistema di riferimento della riga {} è girato"};
constexpr Text kFrameGone{"moved by {}: the frame of old line {} is missing",
                          "spostato di {}: manca il sistema di riferimento della riga {} di prima"};
constexpr Text kFrameGoneTurned{"moved by up to {} mm: the frame of old line {}, which is turned, is missing",
                                "spostato fino a {} mm: manca il sistema di riferimento girato della riga {} di prima"};
constexpr Text kFrameGoneTurnedFar{"moved: the frame of old line {}, which is turned, is missing",
                                   "spostato: manca il sistema di riferimento girato della riga {} di prima"};
constexpr Text kSpindleStands{"the spindle stands still, was {}", "il mandrino è fermo, era {}"};
constexpr Text kSpindleTurns{"the spindle turns, {}, stood still before", "il mandrino gira, {}, prima era fermo"};
constexpr Text kDwell{"dwell of {} instead of {}", "attesa di {} invece di {}"};
constexpr Text kDwellAdded{"dwell of {} added", "aggiunta un'attesa di {}"};
constexpr Text kDwellRemoved{"dwell of {} removed", "tolta un'attesa di {}"};
constexpr Text kPath{"another path: the IF of line {} jumps in the {} program only ({} instead of {})",
                     "un'altra via: l'IF della riga {} salta solo nel programma {} ({} invece di {})"};
constexpr Text kNew{"new", "nuovo"};
constexpr Text kOld{"old", "vecchio"};
constexpr Text kEnds{"ends with {} instead of {}", "finisce con {} invece di {}"};

constexpr Text kEndsElsewhere{"ends with {} instead of {}: from here on {} instead of {}",
                              "finisce con {} invece di {}: da qui in poi {} invece di {}"};

constexpr Text kNoDifference{"no difference", "nessuna differenza"};
constexpr Text kBothStop{"both stop at an error: {} on {}, {} on {}\n",
                         "tutti e due si fermano a un errore: {} alla {}, {} alla {}\n"};
constexpr Text kNoTool{"without a tool", "senza utensile"};
constexpr Text kOperation{"{}, operation {}", "{}, lavorazione {}"};
constexpr Text kLine{"line {}", "riga {}"};
constexpr Text kLines{"lines {}-{}", "righe {}-{}"};
constexpr Text kOldSide{"old {}", "prima {}"};
constexpr Text kNewSide{"new {}", "ora {}"};
constexpr Text kCycleTime{"cycle time: {}, was {} ({:+.1f} s)\n", "tempo ciclo: {}, era {} ({:+.1f} s)\n"};
constexpr Text kFeedLength{"feed moves: {} mm, were {} mm\n", "lavoro: {} mm, era {} mm\n"};
constexpr Text kRapidLength{"rapids: {} mm, were {} mm\n", "rapidi: {} mm, erano {} mm\n"};
constexpr Text kExtent{"extent in {}: {} to {}, was {} to {} (machine)\n",
                       "ingombro in {}: da {} a {}, era da {} a {} (macchina)\n"};
constexpr Text kOneDifference{"1 difference", "1 differenza"};
constexpr Text kDifferences{"{} differences", "{} differenze"};

std::string in_thousandths(double number) { return dialect::written_number(number, 3); }

/// The vector as programs write it: `X10 Z-0.5`; what rounds to 0 is left out.
std::string shown_shift(const geometry::Vec3& shift) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string number = in_thousandths(shift[axis]);
    if (number == "0") continue;
    text += fmt::format("{}{}{}", text.empty() ? "" : " ", "XYZ"[axis], number);
  }
  return text.empty() ? fmt::format("{:.2g} mm", shift.norm()) : text;
}

std::string shown_count(std::size_t count, Language language) {
  return count == 1 ? std::string(kMotion.in(language)) : dialect::format(kMotions, language, count);
}

/// A distance below the last decimal shown has more.
std::string shown_distance(double mm) { return mm < 0.01 ? fmt::format("{:.2g}", mm) : in_thousandths(mm); }

std::string shown_lines(const ChangedLines& lines, Language language) {
  return lines.first == lines.last ? dialect::format(kLine, language, lines.first + 1)
                                   : dialect::format(kLines, language, lines.first + 1, lines.last + 1);
}

std::string shown_place(const BehaviorChange& change, Language language) {
  const bool is_of_one = change.kind == ChangeKind::Added || change.kind == ChangeKind::Removed;
  if (!is_of_one && change.old_lines == change.new_lines && change.old_lines)
    return shown_lines(*change.old_lines, language);
  std::string place;
  if (change.old_lines) place = dialect::format(kOldSide, language, shown_lines(*change.old_lines, language));
  if (!change.new_lines) return place;
  return (place.empty() ? "" : place + ", ") +
         dialect::format(kNewSide, language, shown_lines(*change.new_lines, language));
}

std::string and_turned(const std::string& text, const BehaviorChange& change, Language language) {
  if (change.turned == 0) return text;
  const std::string degrees = in_thousandths(change.turned);
  return text + (text.empty() ? "" : ", ") +
         (degrees == "1" ? std::string(kTurnedByOne.in(language)) : dialect::format(kTurned, language, degrees));
}

/// Lets the lines of a change reach to those of another one with the same words: each program has a part in both, or in
/// neither.
void include_lines(const BehaviorChange& next, BehaviorChange& change) {
  const auto include = [](const std::optional<ChangedLines>& more, std::optional<ChangedLines>& lines) {
    if (more && lines) *lines = {std::min(lines->first, more->first), std::max(lines->last, more->last)};
  };
  include(next.old_lines, change.old_lines);
  include(next.new_lines, change.new_lines);
}

std::string moved_in_words(const BehaviorChange& change, Language language) {
  std::string text;
  if (change.shift) {
    text = dialect::format(kMovedBy, language, shown_shift(*change.shift));
  } else if (change.distance) {
    text = dialect::format(kMovedUpTo, language, shown_distance(std::max(*change.distance, change.end_distance)));
  }
  if (text.empty() && change.turned == 0) return std::string(kMoved.in(language));
  return and_turned(text, change, language);
}

std::string path_shape_in_words(const BehaviorChange& change, Language language) {
  const std::size_t old_count = change.old_motions;
  const std::string new_count = shown_count(change.new_motions, language);
  const bool is_one = change.old_motions == 1 && change.new_motions == 1;
  if (!change.distance)
    return is_one ? std::string(kOtherTurn.in(language)) : dialect::format(kOtherWhole, language, new_count, old_count);
  if (*change.distance == 0) return std::string(kWayBack.in(language));
  const std::string distance = shown_distance(*change.distance);
  return change.old_motions == change.new_motions
             ? dialect::format(kShape, language, distance)
             : dialect::format(kOtherCount, language, new_count, old_count, distance);
}

std::string shape_in_words(const BehaviorChange& change, Language language) {
  const bool is_same_tip = !change.distance && change.turned != 0 && change.old_motions == change.new_motions;
  return and_turned(is_same_tip ? "" : path_shape_in_words(change, language), change, language);
}

std::string end_in_words(const BehaviorChange& change, Language language) {
  if (change.old_motions == change.new_motions)
    return dialect::format(kEnds, language, change.new_value, change.old_value);
  return dialect::format(kEndsElsewhere, language, change.new_value, change.old_value,
                         shown_count(change.new_motions, language), change.old_motions);
}

std::string later_in_words(std::string_view what, double later, Language language) {
  return dialect::format(later < 0 ? kEarlier : kLater, language, what, shown_distance(std::abs(later)));
}

/// Motions that only one program has.
std::string count_in_words(const BehaviorChange& change, Language language) {
  const bool is_added = change.kind == ChangeKind::Added;
  const std::size_t count = is_added ? change.new_motions : change.old_motions;
  const std::string text = count == 1
                               ? dialect::format(is_added ? kAdded : kRemoved, language, shown_count(count, language))
                               : dialect::format(is_added ? kMotionsAdded : kMotionsRemoved, language, count);
  return change.distance ? dialect::format(kAndOtherPath, language, text, shown_distance(*change.distance)) : text;
}

std::string exchange_in_words(const BehaviorChange& change, Language language) {
  if (change.old_value.empty() && change.new_value.empty()) return std::string(kOtherFunctions.in(language));
  if (change.later != 0) return later_in_words(change.new_value, change.later, language);
  if (change.old_value.empty()) return dialect::format(kAdded, language, change.new_value);
  if (change.new_value.empty()) return dialect::format(kRemoved, language, change.old_value);
  if (change.kind == ChangeKind::End) return end_in_words(change, language);
  if (change.kind == ChangeKind::Speed && change.old_motions > 0) {
    if (change.new_value == "M05") return dialect::format(kSpindleStands, language, change.old_value);
    if (change.old_value == "M05") return dialect::format(kSpindleTurns, language, change.new_value);
  }
  return dialect::format(kInstead, language, change.new_value, change.old_value);
}

std::string dwell_in_words(const BehaviorChange& change, Language language) {
  if (change.later != 0)
    return later_in_words(dialect::format(kDwellOf, language, change.new_value), change.later, language);
  if (change.old_value.empty()) return dialect::format(kDwellAdded, language, change.new_value);
  if (change.new_value.empty()) return dialect::format(kDwellRemoved, language, change.old_value);
  return dialect::format(kDwell, language, change.new_value, change.old_value);
}

std::string path_in_words(const BehaviorChange& change, Language language) {
  const std::size_t line = change.new_cause.value_or(change.old_cause.value_or(0)) + 1;
  return dialect::format(kPath, language, line, (change.new_cause ? kNew : kOld).in(language),
                         shown_count(change.new_motions, language), change.old_motions);
}

std::string frame_in_words(const BehaviorChange& change, Language language) {
  if (!change.shift) {
    const std::size_t line = change.new_cause.value_or(change.old_cause.value_or(0)) + 1;
    const std::string farthest = change.distance ? shown_distance(std::max(*change.distance, change.end_distance)) : "";
    if (!change.new_cause)
      return change.distance ? dialect::format(kFrameGoneTurned, language, farthest, line)
                             : dialect::format(kFrameGoneTurnedFar, language, line);
    return change.distance ? dialect::format(kFrameTurned, language, farthest, line)
                           : dialect::format(kFrameTurnedFar, language, line);
  }
  const std::string shift = shown_shift(*change.shift);
  if (change.old_cause && !change.new_cause) return dialect::format(kFrameGone, language, shift, *change.old_cause + 1);
  return change.new_cause ? dialect::format(kFrameOf, language, shift, *change.new_cause + 1)
                          : dialect::format(kFrame, language, shift);
}

std::string operation_in_words(const BehaviorChange& change, Language language) {
  const auto place = [&](const std::string& tool) {
    return tool.empty() ? std::string(kIsFirst.in(language)) : dialect::format(kIsAfter, language, tool);
  };
  if (change.kind == ChangeKind::Reordered)
    return dialect::format(kReorderedOperation, language, place(change.new_value), place(change.old_value));
  const bool is_added = change.kind == ChangeKind::Added;
  return dialect::format(is_added ? kOperationAdded : kOperationRemoved, language,
                         running::tool_name(change.tool().value()),
                         shown_count(is_added ? change.new_motions : change.old_motions, language));
}

/// Red for what is removed, green for what is added, yellow for what is otherwise.
std::string_view color_of(ChangeKind kind) {
  if (kind == ChangeKind::Removed) return "\x1b[31m";
  return kind == ChangeKind::Added ? "\x1b[32m" : "\x1b[33m";
}

/// What a run does between two tool changes, numbered from 1. A tool that has one operation needs no number.
class Operations {
 public:
  explicit Operations(const RecordedRun& run) {
    for (const MachineAction& action : run.actions) {
      if (action.kind != ActionKind::Tool) continue;
      first_lines_.push_back(action.line);
      ++uses_[run.tools[action.tool].code];
    }
  }

  /// The heading of a change.
  std::string heading(const execution::ToolCode& tool, const ChangedLines& lines, Language language) const {
    const auto uses = uses_.find(tool);
    if (uses == uses_.end() || uses->second < 2) return running::tool_name(tool);
    const auto next = std::upper_bound(first_lines_.begin(), first_lines_.end(), lines.first);
    return dialect::format(kOperation, language, running::tool_name(tool), next - first_lines_.begin());
  }

 private:
  std::vector<std::size_t> first_lines_;
  std::map<execution::ToolCode, int> uses_;
};

OrderedJson lines_json(const std::optional<ChangedLines>& lines) {
  return lines ? OrderedJson{lines->first + 1, lines->last + 1} : OrderedJson(nullptr);
}

}  // namespace

std::string_view name_of(ChangeKind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

std::string in_words(const BehaviorChange& change, Language language) {
  if (change.is_operation) return operation_in_words(change, language);
  switch (change.kind) {
    case ChangeKind::Moved:
      return moved_in_words(change, language);
    case ChangeKind::Shape:
      return shape_in_words(change, language);
    case ChangeKind::Added:
    case ChangeKind::Removed:
      return count_in_words(change, language);
    case ChangeKind::Reordered:
      return std::string(kReordered.in(language));
    case ChangeKind::Frame:
      return frame_in_words(change, language);
    case ChangeKind::Dwell:
      return dwell_in_words(change, language);
    case ChangeKind::Path:
      return path_in_words(change, language);
    case ChangeKind::Feed:
    case ChangeKind::Speed:
    case ChangeKind::Tool:
    case ChangeKind::Function:
    case ChangeKind::End:
      return exchange_in_words(change, language);
  }
  return "";
}

bool shows_seconds(double difference) { return std::abs(difference) >= 0.05; }
bool shows_mm(double difference) { return std::abs(difference) >= 0.0005; }

std::string changes_text(const ComparedRuns& runs, const TextStyle& style) {
  constexpr std::size_t kFew = 3;  // So many like changes in a row are told one by one: passes, sides.
  const Language language = style.language;
  const Operations old_operations(runs.old_run);
  const Operations new_operations(runs.new_run);
  const auto heading_of = [&](const BehaviorChange& change) {
    return change.new_tool && change.new_lines   ? new_operations.heading(*change.new_tool, *change.new_lines, language)
           : change.old_tool && change.old_lines ? old_operations.heading(*change.old_tool, *change.old_lines, language)
                                                 : std::string(kNoTool.in(language));
  };
  std::string text;
  std::optional<std::string> group;
  for (std::size_t first = 0, last = 0; first < runs.changes.size(); first = last) {
    BehaviorChange change = runs.changes[first];
    const std::string heading = heading_of(change);
    const std::string words = in_words(change, language);
    const auto is_like = [&](const BehaviorChange& next) {
      return next.kind == change.kind && in_words(next, language) == words && heading_of(next) == heading;
    };
    std::size_t like = first + 1;
    while (like < runs.changes.size() && is_like(runs.changes[like])) ++like;
    last = like - first > kFew ? like : first + 1;
    if (group != heading) text += fmt::format("{}{}{}\n", style.paint(kBold), heading, style.paint(kReset));
    group = heading;
    for (std::size_t i = first + 1; i < last; ++i) include_lines(runs.changes[i], change);
    const std::string place = shown_place(change, language);
    text += fmt::format("  {}: {}{}{}\n",
                        last - first == 1 ? place : dialect::format(kPlaces, language, place, last - first),
                        style.paint(color_of(change.kind)), words, style.paint(kReset));
  }
  return text;
}

std::string totals_text(const ComparedRuns& runs, Language language) {
  const RecordedRun& old_run = runs.old_run;
  const RecordedRun& new_run = runs.new_run;
  std::string text;
  if (shows_seconds(new_run.seconds - old_run.seconds))
    text += dialect::format(kCycleTime, language, summary::shown_time(new_run.seconds),
                            summary::shown_time(old_run.seconds), new_run.seconds - old_run.seconds);
  if (shows_mm(new_run.feed_mm - old_run.feed_mm))
    text += dialect::format(kFeedLength, language, in_thousandths(new_run.feed_mm), in_thousandths(old_run.feed_mm));
  if (shows_mm(new_run.rapid_mm - old_run.rapid_mm))
    text += dialect::format(kRapidLength, language, in_thousandths(new_run.rapid_mm), in_thousandths(old_run.rapid_mm));
  if (!old_run.has_motion || !new_run.has_motion) return text;
  for (std::size_t axis = 0; axis < old_run.extents.size(); ++axis) {
    const geometry::Range& before = old_run.extents[axis];
    const geometry::Range& now = new_run.extents[axis];
    if (!shows_mm(before.minimum - now.minimum) && !shows_mm(before.maximum - now.maximum)) continue;
    text += dialect::format(kExtent, language, "XYZ"[axis], in_thousandths(now.minimum), in_thousandths(now.maximum),
                            in_thousandths(before.minimum), in_thousandths(before.maximum));
  }
  return text;
}

std::string stop_text(const ComparedRuns& runs, Language language) {
  const std::string_view old_error = error_of(runs.old_run);
  const std::string_view new_error = error_of(runs.new_run);
  if (old_error.empty() || new_error.empty()) return "";
  const auto line = [&](const RecordedRun& run) {
    const std::size_t last = run.actions.back().line;
    return shown_lines({last, last}, language);
  };
  return dialect::format(kBothStop, language, old_error, line(runs.old_run), new_error, line(runs.new_run));
}

std::string count_text(const ComparedRuns& runs, const TextStyle& style) {
  const std::size_t count = runs.changes.size();
  const std::string text = count == 0   ? std::string(kNoDifference.in(style.language))
                           : count == 1 ? std::string(kOneDifference.in(style.language))
                                        : dialect::format(kDifferences, style.language, count);
  return fmt::format("{}{}{}\n", style.paint(kBold), text, style.paint(kReset));
}

OrderedJson changes_json(const ComparedRuns& runs, Language language) {
  OrderedJson changes = OrderedJson::array();
  for (const BehaviorChange& change : runs.changes) {
    OrderedJson each;
    each["kind"] = name_of(change.kind);
    each["old"] = lines_json(change.old_lines);
    each["new"] = lines_json(change.new_lines);
    const std::optional<execution::ToolCode> tool = change.tool();
    each["tool"] = tool ? OrderedJson(running::tool_name(*tool)) : OrderedJson(nullptr);
    each["distance"] = change.distance ? OrderedJson(*change.distance) : OrderedJson(nullptr);
    each["seconds"] = std::round(change.seconds * 1000) / 1000 + 0.0;  // No -0.
    each["text"] = in_words(change, language);
    changes.push_back(std::move(each));
  }
  return changes;
}

OrderedJson run_json(const RecordedRun& run) {
  OrderedJson json = {{"time", run.seconds}, {"feedMm", run.feed_mm}, {"rapidMm", run.rapid_mm}, {"extents", nullptr}};
  if (run.has_motion)
    for (std::size_t axis = 0; axis < run.extents.size(); ++axis)
      json["extents"][std::string(1, "XYZ"[axis])] = {run.extents[axis].minimum, run.extents[axis].maximum};
  json["tools"] = OrderedJson::array();
  for (const ActionTool& tool : run.tools)
    json["tools"].push_back({{"tool", running::tool_name(tool.code)}, {"time", tool.seconds}});
  return json;
}

std::string json_of(const ComparedRuns& runs, Language language) {
  const OrderedJson json = {{"same", runs.changes.empty()},
                            {"old", run_json(runs.old_run)},
                            {"new", run_json(runs.new_run)},
                            {"changes", changes_json(runs, language)}};
  return json.dump() + '\n';
}

}  // namespace isocnc::comparison
