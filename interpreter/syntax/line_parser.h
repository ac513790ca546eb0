#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "interpreter/syntax/number.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::syntax {

/// Parses one line into a TreeStore: first its characters into words, then its words into instructions. Reports all
/// errors that do not depend on earlier lines: spelling, order, and codes that must be alone on their line.
///
/// One pass over the words finds the instructions. Its state is the argument series (D16, D17): `taker_`, the
/// instruction that takes the next argument, and `contiguous_`, whether its series is unbroken.
///
///                       X Y Z ...: starts a continuation          X Y Z ...: an argument
///                 +--------------------------------------+         F, reported text: no change
///                 |                                      v
///     start --> none -- G with arguments, unknown G --> open <-----------------+
///                                                        |                     |
///                               S N M T V IF, other G    |                     |  G with arguments,
///                                                        v                     |  unknown G
///                                                      broken -----------------+
///                                                         X Y Z ...: an argument that is marked as stray;
///                                                         after an unknown G, starts a continuation
///
/// Beside it, `function_open_` says that a P would be a parameter of the M before it, and `after_motion_` that a G09
/// would belong to the motion before it (D23). A letter without a number, which has been reported, changes none of
/// this.
class LineParser {
 public:
  LineParser(TreeStore& store, const char* begin, const char* end);

  /// Returns where the line's text ends.
  const char* parse();

 private:
  // Characters into words (lexer.cpp).
  const char* lex();
  const char* lex_word(const char* start);
  const char* lex_with_number(const char* start, const char* p);
  const char* lex_without_number(const char* start, const char* p);
  const char* digits_of_foreign_minus(const char* p) const;
  const char* lex_with_foreign_minus(char letter, const char* start, const char* minus);
  void report_number(const char* begin, const char* end);
  void report_letter_alone(const char* start, const char* after);
  const char* lex_keyword(const char* p, char letter);
  const char* end_of_formula(const char* p) const;
  const char* lex_formula(const char* start, const char* p);
  const char* lex_corner(const char* start, const char* p, const char* number_end);
  const char* lex_comment(const char* p);
  void drop_comment_text();
  const char* lex_number_alone(const char* p);
  const char* lex_equals(const char* p);
  const char* lex_comparison(const char* p);
  const char* lex_unknown(const char* p);
  enum class BesideNumber : std::uint8_t { No, InItsPlace, Continues };
  BesideNumber garble_number(char first);
  bool continues_increments(const char* start, const char* end);
  const char* skip_space(const char* p) const;
  bool ends_in_text() const;
  const char* match_keyword(const char* p, const char* keyword) const;
  bool goto_follows(const char* p);
  void note_comments_inside(const char* p, const char* end);
  Word& add_word(char letter, const char* begin, const char* end);
  Word& add_word(char letter, const char* begin, const Number& number);
  void end_target();

  // Words into instructions (line_parser.cpp).
  void structure();
  std::uint16_t add(std::uint16_t index);
  std::uint16_t add_between_series(std::uint16_t index);
  bool follows_letter(std::uint16_t index, char letter) const;
  bool follows_letter_of(std::uint16_t index, char letter) const;
  bool precedes_if(std::uint16_t index) const;
  bool lacks_equals_before(std::uint16_t equals) const;
  void take_parameter_before_function(std::uint16_t equals);
  bool follows_lone_equals(std::uint16_t index) const;
  bool is_assigned(std::uint16_t index) const;
  bool stands_for_number(std::uint16_t index) const;
  bool is_taken_by_unknown_g(std::uint16_t index) const;
  bool is_taken_by_call(std::uint16_t index) const;
  Instruction& add_instruction(InstructionKind kind, std::uint16_t command);
  void own(Instruction& owner, std::uint16_t index);

  void find_two_blocks();

  // Statements of other controls, and text that was meant as a comment (line_prose.cpp).
  Span statement_span(std::uint16_t first) const;
  bool starts_with_unknown_g() const;
  bool take_statement();
  void drop_block_end();
  bool is_unit(const Word& first, const Word& second) const;
  bool is_prose(std::size_t index) const;
  bool is_number_of_prose(std::uint16_t index) const;
  std::uint16_t end_of_prose(std::uint16_t index, bool& is_odd) const;
  std::uint16_t end_of_text(std::uint16_t index) const;
  bool ends_with_foreign_word(std::uint16_t first, std::uint16_t end) const;
  void report_prose(std::uint16_t first, std::uint16_t end);
  void join_prose();

  // Letters with numbers (line_instructions.cpp).
  void add_dimension(std::uint16_t index);
  bool is_parameter(std::uint16_t index) const;
  bool is_foreign_parameter(std::uint16_t index) const;
  void start_continuation(std::uint16_t index);
  void take_argument(std::uint16_t index);
  void make_repeated_unknown(const Instruction& owner, std::uint16_t index);
  bool starts_second_block(std::uint16_t index);
  bool is_motion_g(const Word& g) const;
  void add_g(std::uint16_t index);
  bool belongs_to_cycle(std::uint16_t index) const;
  std::uint8_t row_of_g(std::uint16_t index);
  void note_g(const dialect::GCode& code, std::uint16_t index);
  void take_earlier_words(Instruction& g);
  void add_m(std::uint16_t index);
  void add_tool_change(std::uint16_t index);
  bool has_tool(std::size_t change) const;
  bool is_in_series(std::uint16_t index) const;
  void add_tool(std::uint16_t index);
  std::uint64_t label_of(const Word& number) const;
  bool add_line_number(std::uint16_t index);
  void add_feed(std::uint16_t index);
  void add_spindle_speed(std::uint16_t index);

  // V and = (line_assignments.cpp).
  std::uint16_t add_assignment(std::uint16_t index);
  void own_in_place_of_value(Instruction& owner, std::uint16_t index);
  bool lacks_value(std::uint16_t assign) const;
  bool is_equals_reported_before(std::uint16_t index) const;
  std::uint16_t end_of_value(std::uint16_t index) const;
  bool repeats_equals(std::uint16_t index, std::uint16_t last);
  bool is_between_coordinates(std::uint16_t assign) const;
  bool own_equals(std::uint16_t index, std::uint16_t last);
  void make_word_before_unknown(std::uint16_t index);
  void report_equals(std::uint16_t index);
  std::uint16_t add_equals(std::uint16_t index);

  // IF and GOTO (line_jumps.cpp).
  std::uint16_t add_jump(std::uint16_t index);
  bool take_foreign_jump();
  std::uint16_t end_jump(std::uint16_t last);
  std::uint16_t read_condition(Jump& jump, std::uint16_t index);
  bool read_comparison(Jump& jump, std::uint16_t at, std::uint16_t goto_at);
  void report_part(std::uint16_t where, std::uint16_t goto_at, char next_letter);
  std::uint16_t end_of_condition(std::uint16_t index) const;
  bool read_variable(Jump& jump, const Word& written, bool has_operator);
  std::optional<Span> comparison_in_comment(std::uint32_t begin, std::uint32_t end) const;
  void report_half_jump(std::uint16_t where, std::uint16_t end);
  std::uint16_t end_of_target(std::uint16_t index) const;
  std::uint16_t report_target(std::uint16_t index);
  std::uint16_t read_target(Jump& jump, std::uint16_t index);
  void take_back_half_if(std::uint16_t index);
  std::uint16_t add_lone_goto(std::uint16_t index);

  // Checks of the line's instructions (line_checks.cpp).
  void check();
  void check_alone();
  bool must_be_alone(const Instruction& checked, dialect::DiagnosticId& diagnostic) const;
  const Word* other_word_on_line(const Instruction& alone) const;
  bool neighbor_has_arguments_of(const Instruction& alone) const;
  void check_misplaced_modes();
  void check_motion(const Instruction& motion);
  void report_broken_series(const Instruction& motion, std::uint16_t broken, bool has_arguments);
  bool is_garbled_argument(std::size_t index) const;
  void check_coordinates(const Instruction& motion);
  bool is_zero_return(const Instruction& frame) const;
  void check_vectors(const Instruction& frame);
  void check_face_angles(const Instruction& frame);
  void check_g(const Instruction& checked);
  void check_dwell(const Instruction& dwell);
  const Word& first_parameter(const Instruction& function, double number) const;
  void check_parameters(const Instruction& function);
  void check_compensation(const Instruction& checked);
  bool breaker_is_reported(const Instruction& motion, std::uint16_t broken) const;
  Span breaker_of(const Instruction& owner, std::uint16_t broken) const;
  bool is_interpolation_mode(const Word& checked) const;
  bool stands_alone(const Instruction& alone) const;
  bool is_reported_not_alone() const;
  bool owns_any(const Instruction& owner, dialect::LetterSet set, bool unbroken = false) const;
  void check_arguments(const Instruction& checked, dialect::DiagnosticId when_missing);
  void check_unbroken(const Instruction& checked);
  void check_tool_number(const Word& tool);

  void report(dialect::Cause cause, Span span, std::initializer_list<double> values = {}, Span related = {});
  void take_back(dialect::DiagnosticId id, Span span);
  void take_back_within(Span span);
  /// The first finding of the line.
  auto own_findings() const { return store_.findings_.begin() + static_cast<std::ptrdiff_t>(line_.first_finding); }
  void report_missing(dialect::Cause cause, const Instruction& lacking, Span related = {});
  std::uint32_t column(const char* p) const { return static_cast<std::uint32_t>(p - begin_); }
  std::string_view text_of(Span span) const { return {begin_ + span.begin, span.end - span.begin}; }
  Word& word(std::size_t index) { return store_.words_[line_.first_word + index]; }
  const Word& word(std::size_t index) const { return store_.words_[line_.first_word + index]; }
  std::uint16_t word_count() const { return static_cast<std::uint16_t>(store_.words_.size() - line_.first_word); }
  Instruction& instruction(std::size_t index) { return store_.instructions_[line_.first_instruction + index]; }
  const Instruction& instruction(std::size_t index) const {
    return store_.instructions_[line_.first_instruction + index];
  }
  Instruction& taker() { return instruction(static_cast<std::size_t>(taker_)); }
  const Instruction& taker() const { return instruction(static_cast<std::size_t>(taker_)); }
  std::size_t instruction_count() const { return store_.instructions_.size() - line_.first_instruction; }

  TreeStore& store_;
  const char* const begin_;
  const char* const end_;
  TreeStore::Line line_;

  /// The position is between IF and the label after GOTO, where a comparison and a bare number are valid.
  bool in_condition_ = false;
  bool after_goto_ = false;   ///< The next word is the label.
  bool has_formula_ = false;  ///< A letter whose number other controls would compute has been reported.
  bool has_prose_ = false;    ///< Some letter has no number, or some text is not a word.
  /// The line's last GOTO, or the line's start without a GOTO; null before the search.
  const char* last_goto_ = nullptr;

  static constexpr int kNone = -1;
  int other_numbers_ = 0;         ///< The count of line numbers that differ from the first.
  int second_number_ = kNone;     ///< The last of them.
  int second_block_ = kNone;      ///< The first word that the line has already.
  int taker_ = kNone;             ///< The instruction that takes the next argument.
  bool contiguous_ = false;       ///< The argument series of `taker_` is unbroken so far (D17).
  dialect::LetterSet taken_ = 0;  ///< Letters of the arguments of `taker_`.
  int function_ = kNone;          ///< The last M that may have parameters.
  bool function_open_ = false;    ///< The position is directly after that M or its parameters.
  int motions_ = 0;
  Span first_motion_;
  bool dimensions_seen_ = false;     ///< A G with dimensions, or a continuation, precedes (D15).
  std::uint16_t misplaced_[4] = {};  ///< G70/G71/G90/G91 after dimensions.
  std::size_t misplaced_count_ = 0;
  bool needs_check_ = false;
  bool half_jump_ = false;              ///< A part of the IF is missing.
  bool stray_parameter_ = false;        ///< A parameter without its M has been reported.
  int stray_value_ = kNone;             ///< The last word of the value of a reported `=`.
  bool after_unknown_ = false;          ///< The continuation follows a word unknown to this control.
  bool after_motion_ = false;           ///< The previous word belongs to a motion (G09).
  bool compensation_reported_ = false;  ///< A misplaced G40 to G42 has been reported (once per line).
};

}  // namespace isocnc::syntax
