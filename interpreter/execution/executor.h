#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>

#include "interpreter/dialect/near_codes.h"
#include "interpreter/execution/arguments.h"
#include "interpreter/execution/execute.h"
#include "interpreter/execution/feed.h"
#include "interpreter/execution/plane.h"
#include "interpreter/geometry/arc.h"

namespace isocnc::execution {

/// Executes the instructions of one line on a state, in the order in which they take effect. Lives for one call of
/// execute(), and is private to this folder: other modules call execute() and get the effects by their Sink.
///
///   run()  S first (I.4.2) -> each instruction by its kind -> F without a feed move, G09 and M06 of the next line
///            Continuation, motion G  -> motion()             motions.cpp   move, arc, feed, rotary axes
///            frame G                 -> mount_face() ...     frames.cpp    workpiece and face frames
///            other G                 -> execute_g()          executor.cpp  modes, G04, G09, signals
///            M, T, V                 -> function() ...       executor.cpp
///   Whatever a finding leaves open -> doubt(), allow_for_... doubts.cpp   unknown axes, motions and modes
///
/// Each step updates `state_`, then reports its effect and its findings to `sink_`.
class Executor {
 public:
  Executor(const syntax::LineTree& line, State& state, const Setup& setup, Sink& sink)
      : line_(line), state_(state), setup_(setup), sink_(sink) {}

  void run();
  /// Handles a line that holds no word that can be read: D1000, for an F1000.
  void allow_for_unreadable_line();

 private:
  bool moves_in_plane() const;
  void execute_g(const syntax::Instruction& instruction);
  void execute_unknown_g(const syntax::Instruction& instruction);
  static bool may_be_motion(const Arguments& arguments);
  bool is_reported(const syntax::Word& word) const;
  void set_mode(const dialect::GCode& code, const syntax::Word& word);
  bool repetition_is_reported(const dialect::GCode& code) const;
  void exact_stop(const syntax::Instruction& instruction);
  void dwell(const syntax::Instruction& instruction);
  void function(const syntax::Instruction& instruction);
  void turn_spindle(int m);
  void tool_change(const syntax::Instruction& instruction);
  bool follows_wrong_m06(const syntax::Instruction& tool) const;
  void stray_tool(const syntax::Instruction& instruction);
  void select_tool(const syntax::Word& word);
  bool is_configured(ToolCode tool) const;
  void assign(const syntax::Instruction& instruction);
  void apply_feed_without_motion();

  // motions.cpp
  void motion(const syntax::Instruction& instruction);
  bool follows_foreign_word(const Arguments& arguments) const;
  void move_of_foreign_word(const Arguments& arguments);
  dialect::LetterSet end_in_rotary_word(const Arguments& arguments, const dialect::GCode& code) const;
  bool follows_wrong_motion(const Arguments& arguments) const;
  bool motion_is_legible() const { return state_.motion() != nullptr; }
  bool motion_is_in_force(const Arguments& arguments);
  void move_illegibly(const Arguments& arguments);
  void report_strays(const Arguments& arguments, const dialect::GCode& code);
  void check_first_motion(syntax::Span place);
  void check_feed(syntax::Span place);
  bool check_rotary_axes(const Arguments& arguments, const dialect::GCode& code, syntax::Span place);
  void take_feed();
  ProgrammedFeed feed_in_force() const;
  void move_to(const Arguments& arguments);
  void move_with_effects(const Arguments& arguments, const dialect::GCode& code, syntax::Span place);
  void arc(const Arguments& arguments, const dialect::GCode& code, syntax::Span place, ProgrammedMove* move);
  std::optional<geometry::ArcGiven> read_arc(const Arguments& arguments, const Plane& plane) const;
  void report_centered_arc(const Arguments& arguments, const Plane& plane, const geometry::ArcGiven& given,
                           const geometry::Circle& circle);
  bool fits_from_start(const geometry::ArcGiven& given, const Plane& plane) const;
  void report_center(syntax::Span centers, const geometry::ArcGiven& given, const geometry::Circle& circle,
                     const Plane& plane);
  void report_circle(const Arguments& arguments, const geometry::ArcGiven& given, const geometry::Circle& circle,
                     const Plane& plane);
  bool has_illegible_equals() const;
  bool has_stray_equals() const;
  void report_missing_circle(const Plane& plane, syntax::Span place);
  bool arc_is_described(const Arguments& arguments, const Plane& plane, syntax::Span place);

  // frames.cpp
  void workpiece_frame(const syntax::Instruction& instruction);
  dialect::LetterSet letters_after(const syntax::Instruction& dismount) const;
  void dismount_face(const syntax::Instruction& instruction);
  void mount_face(const syntax::Instruction& instruction, const dialect::GCode& code);
  void go_home(const Arguments& arguments, const dialect::GCode& code);
  bool read_face_axes(const Arguments& arguments, const dialect::GCode& code, syntax::Span place, geometry::Mat3& axes);
  void enter_face(const geometry::Frame& face, bool is_defined, bool is_at_tip);
  void leave_face();
  bool read_axes(const Arguments& arguments, const dialect::GCode& code, geometry::Mat3& axes);
  bool read_point(const Arguments& arguments, geometry::Vec3& point) const;
  AxisSet read_origin(const Arguments& arguments, geometry::Vec3& origin) const;

  // doubts.cpp
  void doubt(const dialect::GCode& code);
  bool would_change(const dialect::GCode& code) const;
  void doubt(dialect::ModalGroup group);
  void doubt(dialect::GCodeSet codes, dialect::LetterSet arguments);
  void end_doubt(dialect::ModalGroup group);
  void make_motion_illegible();
  void blur_linear_axes() { state_.unknown |= kLinearAxes; }
  void blur_axes_not_named();
  void blur_axes_of_late_mode();
  bool doubt_unknown_g(const syntax::Word& g, const Arguments& arguments);
  bool takes_number(const syntax::Word& g) const;
  bool fits_near_code(const syntax::Instruction& g, const Arguments& arguments) const;
  void doubt_near_g(const syntax::Instruction& g, const Arguments& arguments);
  void doubt_lone_g(const syntax::Instruction& g);
  const syntax::Instruction* g_before(const Arguments& arguments) const;
  bool follows_reported_g(const Arguments& arguments) const;
  void doubt_code_before(const Arguments& arguments);
  void allow_for_lost_letter();
  void allow_for_lost_g(const dialect::GCode& code);
  void allow_for_call();
  void allow_for_wrong_line_number();
  void allow_for_lost_register();
  void allow_for_findings();
  bool may_be_garbled(const syntax::Word& word) const;
  dialect::LetterSet letters_meant_by(const syntax::Word& word) const;
  dialect::LetterSet garbled_letters() const;
  bool may_have(dialect::LetterSet letters) const { return (garbled_ & letters) != 0; }
  void blur_garbled_axes();

  void report(dialect::Cause cause, syntax::Span span, std::initializer_list<double> values = {},
              syntax::Span related = {}) {
    lack_.take(cause);
    last_reported_ = span;
    sink_.report(syntax::finding_of(cause, span, values, related));
  }

  const syntax::LineTree& line_;
  State& state_;
  const Setup& setup_;
  Sink& sink_;
  /// Whether the coordinates of the line may belong to a frame G that has lost its letter.
  bool frame_is_lost_ = false;
  bool feed_move_ = false;  ///< Whether the line has had an interpolated motion.
  bool rapid_move_ = false;
  dialect::LetterSet garbled_ = 0;  ///< Letters in whose place a word of the line may have been hit wrong.
  syntax::Span last_reported_;      ///< The span of the last finding that depends on the state.
  Lack lack_;                       ///< What the line lacks, as far as it has been reported.
};

}  // namespace isocnc::execution
