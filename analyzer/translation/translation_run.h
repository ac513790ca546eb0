#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/translation/coordinate_frames.h"
#include "analyzer/translation/foreign_block.h"
#include "analyzer/translation/foreign_codes.h"
#include "analyzer/translation/program_writer.h"
#include "analyzer/translation/translator.h"

namespace isocnc::translation {

/// The modal values of the other control, or those that the translation has written so far.
struct ModalValues {
  int plane = 17;
  bool inches = false;
  bool incremental = false;
  bool inverse_time = false;
};

/// One of them: whether the program, or the translation, has stated it at all.
struct ModalStated {
  bool plane = false;
  bool units = false;
  bool distance = false;
  bool feed_mode = false;
};

/// The frame that the translation has written: a G92 and, where coordinates are turned, a face frame.
struct WrittenFrame {
  geometry::Vec3 origin = geometry::Vec3::Zero();
  std::optional<TurnedCoordinates> rotation;
};

/// What the program may have set otherwise than the translation follows it, since a block is not translated.
enum class UnknownMode : std::uint8_t {
  Plane,
  Units,
  Distance,
  FeedMode,
  Centers,        ///< Absolute, or from the start of the arc.
  Retract,        ///< G98 or G99.
  ZeroPoint,      ///< Which one is selected, or where it lies.
  Shift,          ///< G92, for all zero points.
  LocalShift,     ///< G52.
  ExternalShift,  ///< G10 L2 P0 of Fanuc.
};

/// Why a block cannot be translated, and where that shows.
struct BlockRefusal {
  UntranslatableReason reason = UntranslatableReason::Unreadable;
  std::size_t at = 0;  ///< Byte of the line.
  std::vector<std::string> values;
};

/// A drilling cycle in force; levels along the plane's normal in mm, in the program's coordinates.
struct CycleInForce {
  int g = 0;                         ///< 81 for G81; 0: none in force.
  bool r_is_increment = false;       ///< Given under G91.
  bool bottom_is_increment = false;  ///< Likewise.
  double initial = 0;
  std::optional<double> r;
  std::optional<double> bottom;
  std::optional<double> peck;
  std::optional<double> dwell;  ///< s
};

/// One translation from the first line to the last.
class TranslationRun {
 public:
  TranslationRun(std::string_view text, const TranslationSetup& setup);

  Translation run();

 private:
  enum class BlockFlow { Next, Return, End };

  /// What the block being translated says.
  struct CurrentBlock {
    const ForeignBlock& block;
    std::size_t line;  ///< From 0.
    std::vector<ForeignWord> words;
    std::vector<std::pair<int, ForeignRole>> gs;  ///< In tenths.
    std::vector<int> ms;
    std::vector<std::string> before;  ///< Words that stand before the motion, or alone.
    std::vector<std::string> after;   ///< Words that stand after it.
    bool exact_stop = false;
    bool writes_motion = false;  ///< A motion G is written in the block.
    bool has_moved = false;      ///< A motion has taken the settings along, or the next one will.
    std::string remark;          ///< What of the block is left out.

    const ForeignWord* find(char letter) const;
    bool has(ForeignRole role) const;
    const ForeignWord& g_of(ForeignRole role) const;  ///< The first of those that the block has.
    bool has_any(std::string_view letters) const;
  };

  // Lines and blocks: translation_run.cpp.
  BlockFlow run_lines(std::size_t first, int depth);
  BlockFlow run_line(std::size_t line, int depth);
  BlockFlow translate_block(CurrentBlock& current, int depth);
  BlockFlow end_of_block(CurrentBlock& current, int depth);
  BlockFlow call(CurrentBlock& current, int depth);
  void follow_flow(const ForeignBlock& block);
  bool has_called_too_much() const;
  void keep_rest(std::size_t from);
  void end_program();
  void report(const CurrentBlock& current, BlockRefusal refusal);
  void report(const CurrentBlock& current, UntranslatableReason reason, const ForeignWord& word,
              std::vector<std::string> further = {});
  void leave_out(CurrentBlock& current, UntranslatableReason reason, const ForeignWord& word,
                 std::vector<std::string> further = {});
  void keep_as_comment(const CurrentBlock& current);
  void remark_untranslated(std::string_view text);
  void refuse(CurrentBlock& current, const std::optional<BlockRefusal>& refusal);

  // What is wrong with a block as a whole: block_checks.cpp.
  std::optional<BlockRefusal> find_refusal(CurrentBlock& current);
  std::optional<BlockRefusal> classify_words(CurrentBlock& current) const;
  std::optional<BlockRefusal> check_letters(CurrentBlock& current);
  std::optional<BlockRefusal> count_thousandths(CurrentBlock& current);
  std::optional<BlockRefusal> check_known_lengths(const CurrentBlock& current) const;
  std::string letters_of(const CurrentBlock& current) const;
  bool takes_place_as_motion(const CurrentBlock& current) const;

  // Blocks that the operator may skip: skipped_blocks.cpp.
  bool is_in_force(const CurrentBlock& current, int tenths, ForeignRole role) const;
  void forget_what_it_sets(const CurrentBlock& current);

  // Settings and functions: foreign_settings.cpp.
  void apply_modals(CurrentBlock& current);
  static std::optional<UnknownMode> mode_of(ForeignRole role);
  static bool suspends_motions(ForeignRole role);
  void forget_modes();
  void apply_feed(CurrentBlock& current);
  void apply_suspensions(CurrentBlock& current);
  bool is_of_other_tool(const ForeignWord* word, int offset) const;
  void apply_offsets(CurrentBlock& current);
  void apply_refused_offsets(const CurrentBlock& current);
  void add_tool(CurrentBlock& current);
  void mount_first_tool();
  void mount_tool(const std::string& code);
  void add_spindle(CurrentBlock& current);
  void add_functions(CurrentBlock& current);
  void add_function(CurrentBlock& current, int number, std::vector<std::string>& words);
  void add_dwell(CurrentBlock& current);
  std::string settings(bool incremental);
  void write_settings() { write_words(settings(now_.incremental)); }
  void write_words(const std::string& words);
  void flush_words(CurrentBlock& current);

  // Frames: foreign_frames.cpp.
  void add_frames(CurrentBlock& current);
  void apply_refused_frames(CurrentBlock& current);
  void forget_frame(const CurrentBlock& current, int tenths, ForeignRole role);
  void end_rotation();
  void select_zero(CurrentBlock& current, int name, ForeignRole role);
  bool is_further_zero(const CurrentBlock& current, ForeignRole role) const;
  void select_further_zero(CurrentBlock& current, int name);
  void forget_zero(const CurrentBlock& current);
  bool knows_frame() const;
  void set_position(CurrentBlock& current);
  void set_local_shift(const CurrentBlock& current);
  void set_data(CurrentBlock& current);
  void set_rotation(CurrentBlock& current);
  void mount_frame(const WrittenFrame& wanted);
  void mount_selected_frame();
  void go_to_reference(CurrentBlock& current, int name);
  template <class Change>
  void change_frame(Change&& change);
  std::string coordinates(const geometry::Vec3& mm, std::string_view letters, int decimals) const;

  // Motions: foreign_motions.cpp.
  bool has_motion(const CurrentBlock& current) const;
  void add_motion(CurrentBlock& current);
  bool may_move(CurrentBlock& current, bool feeds);
  bool lacks(const std::set<UnknownMode>& needed) const;
  BlockRefusal missing_modes(const std::set<UnknownMode>& needed, std::size_t at) const;
  bool has_tool(CurrentBlock& current);
  void refuse_motion(CurrentBlock& current, std::optional<BlockRefusal> refusal);
  void move_in_machine(CurrentBlock& current);
  void move_straight(CurrentBlock& current);
  void move_along_arc(CurrentBlock& current);
  std::optional<geometry::Vec3> arc_center(CurrentBlock& current, const geometry::Vec3& start,
                                           const geometry::Vec3& end);
  void write_turns(CurrentBlock& current, const geometry::Vec3& center, const geometry::Vec3& end, int turns,
                   std::string& feed);
  std::string center_words(const ForeignPlane& plane, const geometry::Vec3& center) const;
  bool take_feed(CurrentBlock& current, std::string& words);
  void write_motion(CurrentBlock& current, int g, const std::string& words);
  void write_motion_in(CurrentBlock& current, int g, const std::string& motion, bool incremental);
  KnownPlace target(const CurrentBlock& current) const;
  void arrive(const CurrentBlock& current, const KnownPlace& at);
  void lose(const CurrentBlock& current, bool everything);
  void find_again(std::size_t axis);
  std::string axis_words(const CurrentBlock& current) const;
  std::string coordinate(int axis, double mm) const;
  double unit() const { return now_.inches ? 25.4 : 1; }
  double length_of(const ForeignWord& word) const { return word.value * unit(); }

  // Cycles: foreign_cycles.cpp.
  void drill(CurrentBlock& current);
  bool read_cycle(CurrentBlock& current);
  bool may_expand(double moves);
  void drill_hole(CurrentBlock& current);
  void settle_height();
  void write_pecks();
  void write_cycle_move(int g, const std::string& words);
  void rapid_to(int axis, double mm);
  void feed_to(double mm);
  void dwell_for(double seconds);
  bool holds_cycle() const { return motion_ >= 4; }

  const TranslationSetup& setup_;
  std::vector<std::string_view> lines_;
  std::map<std::string, std::size_t> programs_;  // The line of each O number.
  std::set<std::size_t> called_;                 // Lines of programs that have been called.
  ProgramWriter writer_;
  FindingList findings_;
  std::optional<TranslationFinding> refusal_;

  // The other control.
  ModalValues now_;
  ModalStated stated_;
  int motion_ = -1;  // 0 to 3; the G of a cycle; -1: none.
  bool centers_absolute_ = false;
  bool retracts_to_r_ = false;
  bool retract_is_stated_ = false;  // By a G98 or G99, or by the control, which starts with G98.
  bool exact_stop_ = false;
  int compensation_ = 40;
  int prepared_tool_ = -1;
  int tool_ = -1;  // The number mounted by M06; -1: none, or one that is not in the map.
  int spindle_ = 5;
  bool length_active_ = false;
  bool length_off_ = false;
  // What G92.3 brings back, also after G92.2; none where it is not known.
  std::optional<geometry::Vec3> kept_shift_ = geometry::Vec3::Zero();
  CoordinateFrames frames_;
  KnownPlace place_;
  std::set<int> lost_references_;  // G28 and G30, in tenths, that the program has put elsewhere.
  std::array<bool, 3> lost_{};     // Axes that a block left as a comment would have moved.
  int left_by_cycle_ = -1;         // The one of them along which a cycle has gone back to one of two heights.
  std::set<ForeignRole> suspended_by_;
  bool tool_is_wrong_ = false;
  std::set<UnknownMode> unknown_;
  std::set<UntranslatableReason> said_once_;
  std::string turned_by_;  // G68 or G69, until a motion has given both axes of the plane.
  ForeignPlane turned_plane_;
  CycleInForce cycle_;
  std::optional<double> feed_;  // mm/min, of G94.
  std::string feed_digits_;     // As written.
  bool feed_in_inches_ = false;
  std::string flow_label_;  // The O label at which lines are translated again.
  std::string flow_end_;
  bool ends_with_tape_mark_ = false;
  std::size_t called_bytes_ = 0;  // Of the lines that subprograms repeat.
  double expanded_moves_ = 0;     // Moves of cycles and turns, beyond one for each block.

  // The translation.
  ModalValues written_;
  ModalStated written_stated_;
  int written_motion_ = -1;
  int written_compensation_ = 40;
  WrittenFrame written_frame_;
  bool feed_is_written_ = false;
  bool tool_is_mounted_ = false;
  bool is_ended_ = false;
};

}  // namespace isocnc::translation
