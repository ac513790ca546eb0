#pragma once

#include <string>
#include <vector>

#include "analyzer/fixes/fix.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::fixes {

/// The input of a maker.
struct Request {
  std::uint64_t number = 0;  ///< The line number, from 0.
  const syntax::Finding& finding;
  bool on_every_path = true;
  syntax::LineTree line;
  Program& program;

  std::string_view marked() const { return line.text_of(finding.span); }
};

/// The result of a maker; without edits, this finding has no such fix.
struct Draft {
  std::vector<Edit> edits;
  std::string what = {};      ///< The value of `{new}` in the title.
  Habit habit = Habit::None;  ///< The habit whose other rewrites belong to the edits.
};

/// The rewriting of the finding's line for a habit; empty unless the habit can be rewritten everywhere.
Draft habit_draft(const Request& request, Habit habit);

using Maker = Draft (*)(const Request&);

// spelling.cpp: corrects a word, or text that should be a word.
Draft zero_for_letter_o(const Request& request);
Draft point_for_comma(const Request& request);
Draft whole_number(const Request& request);
Draft without_sign(const Request& request);
Draft without_equals(const Request& request);
Draft angle_in_range(const Request& request);
Draft comparison(const Request& request);
Draft label_with_letter(const Request& request);
Draft code_of_this_control(const Request& request);
Draft time_by_p(const Request& request);
Draft seconds_of_milliseconds(const Request& request);
Draft free_label(const Request& request);
Draft closed_comment(const Request& request);
Draft opened_comment(const Request& request);
Draft text_as_comment(const Request& request);
Draft capitals(const Request& request);
Draft blank_for_tab(const Request& request);

// removal.cpp: removes superfluous text.
Draft removed_on_every_path(const Request& request);
Draft removed_mark(const Request& request);
Draft removed_repetition(const Request& request);
Draft removed_earlier_mode(const Request& request);
Draft removed_foreign_frame(const Request& request);
Draft removed_canned_cycle_end(const Request& request);
Draft removed_stray_center(const Request& request);
Draft removed_first_motion(const Request& request);
Draft removed_suppression(const Request& request);

// order.cpp: moves parts of a line to their right place.
Draft on_its_own_line(const Request& request);
Draft mode_first(const Request& request);
Draft arguments_together(const Request& request);
Draft command_first(const Request& request);
Draft compensation_before_motion(const Request& request);
Draft move_after_motion(const Request& request);
Draft move_after_feed_motion(const Request& request);
Draft change_before_tool(const Request& request);
Draft move_tool_after_change(const Request& request);
Draft motions_on_two_lines(const Request& request);

// lines.cpp: adds a missing word or line, or moves one from a neighboring line.
Draft g27_above(const Request& request);
Draft later_g27_above(const Request& request);
Draft g49_above(const Request& request);
Draft g40_above(const Request& request);
Draft m05_above(const Request& request);
Draft g90_above(const Request& request);
Draft g71_above(const Request& request);
Draft end_of_program(const Request& request);
Draft m06_before_tool(const Request& request);
Draft tool_of_other_line(const Request& request);
Draft tool_to_later_change(const Request& request);
Draft command_to_next_line(const Request& request);

// arcs.cpp: corrects circles that do not fit.
Draft center_from_other_origin(const Request& request);
Draft removed_contradicting_radius(const Request& request);
Draft center_between_ends(const Request& request);
Draft center_completed(const Request& request);
Draft radius_large_enough(const Request& request);

}  // namespace isocnc::fixes
