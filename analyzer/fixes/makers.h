#pragma once

#include <string>
#include <vector>

#include "analyzer/fixes/fix.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::fixes {

/// The input of a maker.
struct FixRequest {
  std::size_t number = 0;  ///< The line number, from 0.
  const syntax::Finding& finding;
  bool on_every_path = true;
  syntax::LineTree line;
  FixProgram& program;

  std::string_view marked() const { return line.text_of(finding.span); }
};

/// The result of a maker; without edits, this finding has no such fix.
struct Draft {
  std::vector<Edit> edits;
  std::string what = {};      ///< The value of `{new}` in the title.
  Habit habit = Habit::None;  ///< The habit whose other rewrites belong to the edits.
};

/// The rewriting of the finding's line for a habit; empty unless the habit can be rewritten everywhere.
Draft habit_draft(const FixRequest& request, Habit habit);

using Maker = Draft (*)(const FixRequest&);

// spelling.cpp: corrects a word, or text that should be a word.
Draft zero_for_letter_o(const FixRequest& request);
Draft point_for_comma(const FixRequest& request);
Draft whole_number(const FixRequest& request);
Draft plain_minus(const FixRequest& request);
Draft without_sign(const FixRequest& request);
Draft without_equals(const FixRequest& request);
Draft angle_in_range(const FixRequest& request);
Draft comparison(const FixRequest& request);
Draft label_with_letter(const FixRequest& request);
Draft label_with_zeros(const FixRequest& request);
Draft code_of_this_control(const FixRequest& request);
Draft time_by_p(const FixRequest& request);
Draft seconds_of_milliseconds(const FixRequest& request);
Draft free_label(const FixRequest& request);
Draft closed_comment(const FixRequest& request);
Draft opened_comment(const FixRequest& request);
Draft text_as_comment(const FixRequest& request);
Draft capitals(const FixRequest& request);
Draft blank_for_tab(const FixRequest& request);

// removal.cpp: removes superfluous text.
Draft removed_on_every_path(const FixRequest& request);
Draft removed_mark(const FixRequest& request);
Draft removed_repetition(const FixRequest& request);
Draft removed_earlier_mode(const FixRequest& request);
Draft removed_foreign_frame(const FixRequest& request);
Draft removed_canned_cycle_end(const FixRequest& request);
Draft removed_stray_center(const FixRequest& request);
Draft removed_first_motion(const FixRequest& request);
Draft removed_suppression(const FixRequest& request);

// order.cpp: moves parts of a line to their right place.
Draft on_its_own_line(const FixRequest& request);
Draft mode_first(const FixRequest& request);
Draft arguments_together(const FixRequest& request);
Draft command_first(const FixRequest& request);
Draft compensation_before_motion(const FixRequest& request);
Draft move_after_motion(const FixRequest& request);
Draft move_after_feed_motion(const FixRequest& request);
Draft change_before_tool(const FixRequest& request);
Draft move_tool_after_change(const FixRequest& request);
Draft motions_on_two_lines(const FixRequest& request);
Draft line_break_between_blocks(const FixRequest& request);

// lines.cpp: adds a missing word or line, or moves one from a neighboring line.
Draft g27_above(const FixRequest& request);
Draft later_g27_above(const FixRequest& request);
Draft g49_above(const FixRequest& request);
Draft g40_above(const FixRequest& request);
Draft m05_above(const FixRequest& request);
Draft g90_above(const FixRequest& request);
Draft g71_above(const FixRequest& request);
Draft end_of_program(const FixRequest& request);
Draft m02_for_m30(const FixRequest& request);
Draft m06_before_tool(const FixRequest& request);
Draft tool_of_other_line(const FixRequest& request);
Draft tool_to_later_change(const FixRequest& request);
Draft g01_before_coordinates(const FixRequest& request);
Draft command_to_next_line(const FixRequest& request);

// foreign.cpp: words and statements of other controls.
Draft removed_foreign_word(const FixRequest& request);
Draft removed_certainly_superfluous(const FixRequest& request);
Draft removed_length_cancel(const FixRequest& request);
Draft message_as_comment(const FixRequest& request);
Draft radius_of_arc(const FixRequest& request);

// drilling_cycle.cpp
Draft moves_of_cycle(const FixRequest& request);

// arcs.cpp: corrects circles that do not fit.
Draft center_from_other_origin(const FixRequest& request);
Draft removed_contradicting_radius(const FixRequest& request);
Draft center_between_ends(const FixRequest& request);
Draft center_completed(const FixRequest& request);
Draft radius_large_enough(const FixRequest& request);
Draft center_of_larger_arc(const FixRequest& request);

}  // namespace isocnc::fixes
