#pragma once

#include <array>

#include "analyzer/fixes/makers.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::fixes {

/// Why a code has no fix, unless a row says something else.
inline constexpr dialect::Text kMeaningUnknown = {"What is meant cannot be seen from the program.",
                                                  "Dal programma non si capisce che cosa si voleva fare."};

/// The fix of findings of one code, or the reason why there is none.
struct FixDef {
  dialect::DiagnosticId diagnostic = dialect::kNoDiagnostic;
  Safety safety = Safety::None;
  /// The title of the fix, in the imperative; may contain `{text}` (the program text under the finding's mark) and
  /// `{new}` (the text that the maker writes or moves). Without a fix: the reason, as a sentence.
  dialect::Text title;
  Maker make = nullptr;
  bool mends_repetitions = false;  ///< Whether the fix of the first of some repeated findings mends them all (D66).
};

namespace detail {
using dialect::Text;
using namespace dialect::literals;

inline constexpr Text kOwnLine = {"put {text} on a line of its own", "mettere {text} su una linea a sé"};
inline constexpr Text kModeFirst = {"move {new} to the start of the line", "spostare {new} all'inizio della linea"};
inline constexpr Text kRepetition = {"remove {text}, which is there already", "togliere {text}, che c'è già"};
inline constexpr Text kIgnored = {"remove {text}, which is ignored", "togliere {text}, che viene ignorata"};
inline constexpr Text kTogether = {"move {new} to the other arguments", "spostare {new} accanto agli altri argomenti"};
inline constexpr Text kNotNeeded = {"remove {text}, which is not needed here", "togliere {text}, che qui non serve"};
inline constexpr Text kWrite = {"write {new}", "scrivere {new}"};
inline constexpr Text kWriteDecimal = {"write {new}, with a decimal point", "scrivere {new}, con il punto decimale"};
inline constexpr Text kWholeNumber = {"write {new}, without sign and point", "scrivere {new}, senza segno né punto"};
inline constexpr Text kZero = {"write the digit 0 for the letter O", "scrivere la cifra 0 al posto della lettera O"};
inline constexpr Text kComment = {"put the text in a comment", "mettere il testo in un commento"};
inline constexpr Text kAbove = {"insert {new} above", "inserire prima una linea con {new}"};
inline constexpr Text kMeantCenter = {
    "write {new}, and all centers of the program so: they were given with the other origin (G90, G91)",
    "scrivere {new}, e così tutti i centri del programma: erano riferiti all'altra origine (G90, G91)"};
inline constexpr Text kNearestCenter = {"move the center to {new}, equally far from both ends",
                                        "spostare il centro in {new}, alla stessa distanza dai due estremi"};
inline constexpr Text kOtherCenter = {"add {new}, the start's coordinate",
                                      "aggiungere {new}, la quota del punto iniziale"};
inline constexpr Text kStrayCenter = {"remove {text}: the circle is given without it",
                                      "togliere {text}: il cerchio è definito anche senza"};

inline constexpr Text kValueUnknown = {"Only the author knows the number.",
                                       "Il numero lo sa solo chi scrive il programma."};
inline constexpr Text kVectorUnknown = {"Only the author knows where the face's axes point.",
                                        "La direzione degli assi della faccia la sa solo chi scrive il programma."};
inline constexpr Text kToolUnknown = {"Only the author knows which tool is meant.",
                                      "Quale utensile serve lo sa solo chi scrive il programma."};
inline constexpr Text kLabelUnknown = {"Only the author knows where the jump should lead.",
                                       "La destinazione del salto la sa solo chi scrive il programma."};
inline constexpr Text kAboutCheck = {"It is about the check, not about the program.",
                                     "Riguarda la verifica, non il programma."};
}  // namespace detail

/// The fixes of each code in the order in which they are tried: the first that gives edits is the finding's fix. A code
/// without a row has no fix, for kMeaningUnknown.
inline constexpr auto kFixes = [] {
  using namespace detail;
  using enum Safety;
  return std::to_array<FixDef>({
      {"unclosed-comment"_diag, Unsafe, {"close the comment with )", "chiudere il commento con )"}, closed_comment},
      {"unopened-comment"_diag, Unsafe, {"open the comment with (", "aprire il commento con ("}, opened_comment},
      {"unopened-comment"_diag, Unsafe, {"remove the )", "togliere la )"}, removed_mark},
      {"unknown-word"_diag, Unsafe, kZero, zero_for_letter_o},
      {"unknown-word"_diag,
       Unsafe,
       {"write the minus sign of the keyboard", "scrivere il segno meno della tastiera"},
       plain_minus},
      {"unknown-word"_diag,
       Unsafe,
       {"remove {text}, which belongs to other controls", "togliere {text}, che è di altri controlli"},
       removed_foreign_frame},
      {"unknown-word"_diag, Safe, kNotNeeded, removed_certainly_superfluous},
      {"unknown-word"_diag, Unsafe, kNotNeeded, removed_foreign_word},
      {"unknown-word"_diag, Unsafe, kComment, text_as_comment},
      {"word-without-number"_diag, Unsafe, kZero, zero_for_letter_o},
      {"word-without-number"_diag, Safe, kWrite, radius_of_arc},
      {"word-without-number"_diag, Unsafe, kWrite, message_as_comment},
      {"word-without-number"_diag, Unsafe, kNotNeeded, removed_foreign_word},
      {"word-without-number"_diag, Unsafe, kComment, text_as_comment},
      {"malformed-number"_diag, Unsafe, kWrite, point_for_comma},
      {"invalid-g-number"_diag, Unsafe, kWholeNumber, whole_number},
      {"invalid-g-number"_diag, Unsafe, kNotNeeded, removed_foreign_word},
      {"invalid-m-number"_diag, Unsafe, kWholeNumber, whole_number},
      {"invalid-tool-number"_diag, Unsafe, kWholeNumber, whole_number},
      {"units-after-dimensions"_diag, Unsafe, kModeFirst, mode_first},
      {"stray-argument"_diag, Safe, kTogether, arguments_together},
      {"stray-argument"_diag,
       Unsafe,
       {"move {new} before its coordinates", "spostare {new} prima delle sue quote"},
       command_first},
      {"head-not-selected"_diag, None, kToolUnknown},
      {"holder-not-selected"_diag, None, kToolUnknown},
      {"tool-change-without-tool"_diag,
       Safe,
       {"move {new} directly after M06", "spostare {new} subito dopo la M06"},
       move_tool_after_change},
      {"tool-change-without-tool"_diag,
       Unsafe,
       {"move {new} here from its own line", "portare qui la {new} dalla sua linea"},
       tool_of_other_line},
      {"repeated-argument"_diag, Safe, kRepetition, removed_repetition},
      {"missing-arguments"_diag, None, kValueUnknown},
      {"frame-not-alone"_diag, Safe, kOwnLine, on_its_own_line},
      {"missing-i-vector"_diag, None, kVectorUnknown},
      {"missing-j-vector"_diag, None, kVectorUnknown},
      {"missing-k-vector"_diag, None, kVectorUnknown},
      {"zero-axis-vector"_diag, None, kVectorUnknown},
      {"coplanar-axis-vectors"_diag, None, kVectorUnknown},
      {"face-already-mounted"_diag, Unsafe, kAbove, g27_above},
      {"missing-origin"_diag, None, kValueUnknown},
      {"missing-coordinate"_diag, Safe, kTogether, arguments_together},
      {"missing-coordinate"_diag,
       Unsafe,
       {"move {text} to its coordinates on the next line", "spostare {text} davanti alle sue quote, sulla linea dopo"},
       command_to_next_line},
      {"circle-not-given"_diag,
       Unsafe,
       {"write G01 before {text}", "scrivere G01 prima di {text}"},
       g01_before_coordinates},
      {"arc-radius-mismatch"_diag, Unsafe, kMeantCenter, center_from_other_origin},
      {"arc-radius-mismatch"_diag,
       Unsafe,
       {"remove {text}: the center gives the circle", "togliere {text}: il cerchio è dato dal centro"},
       removed_contradicting_radius},
      {"arc-radius-too-small"_diag,
       Unsafe,
       {"write {new}, a half circle", "scrivere {new}, una semicirconferenza"},
       radius_large_enough},
      {"arc-radius-too-small"_diag,
       Unsafe,
       {"write {new}, the center of the larger arc", "scrivere {new}, il centro dell'arco maggiore"},
       center_of_larger_arc},
      {"arc-center-mismatch"_diag, Unsafe, kMeantCenter, center_from_other_origin},
      {"arc-center-mismatch"_diag, Unsafe, kNearestCenter, center_between_ends},
      {"five-axis-not-enabled"_diag, Unsafe, kAbove, g49_above, true},
      {"g48-g49-not-alone"_diag,
       Unsafe,
       {"remove {text}: there is no tool length compensation to end",
        "togliere {text}: qui non c'è correzione della lunghezza utensile da annullare"},
       removed_length_cancel},
      {"g48-g49-not-alone"_diag, Safe, kOwnLine, on_its_own_line},
      {"misplaced-g41-g42"_diag,
       Unsafe,
       {"move {new} before the motion", "spostare {new} prima del movimento"},
       compensation_before_motion},
      {"misplaced-g41-g42"_diag, Safe, kOwnLine, on_its_own_line},
      {"misplaced-g40"_diag,
       Unsafe,
       {"move {new} after the motion", "spostare {new} dopo il movimento"},
       move_after_motion},
      {"misplaced-g40"_diag, Safe, kOwnLine, on_its_own_line},
      {"negative-dwell"_diag, Unsafe, {"write {new}, without the sign", "scrivere {new}, senza segno"}, without_sign},
      {"g04-not-alone"_diag, Safe, kOwnLine, on_its_own_line},
      {"stray-center-k"_diag, Unsafe, kStrayCenter, removed_stray_center},
      {"stray-center-j"_diag, Unsafe, kStrayCenter, removed_stray_center},
      {"stray-center-i"_diag, Unsafe, kStrayCenter, removed_stray_center},
      {"inverse-time-feed-missing"_diag, None, kValueUnknown},
      {"feed-not-positive"_diag, None, kValueUnknown},
      {"m02-not-alone"_diag, Safe, kOwnLine, on_its_own_line},
      {"initial-tool-missing"_diag, None, kToolUnknown},
      {"m02-missing"_diag, Unsafe, {"write {new} for M30", "scrivere {new} al posto di M30"}, m02_for_m30},
      {"m02-missing"_diag, Unsafe, {"end the program with M02", "chiudere il programma con M02"}, end_of_program},
      {"repeated-spindle-speed"_diag, Safe, kRepetition, removed_repetition},
      {"linear-coordinate-missing"_diag, Unsafe, kAbove, g49_above, true},
      {"center-undetermined-g17-i"_diag, Unsafe, kMeantCenter, center_from_other_origin},
      {"center-undetermined-g17-i"_diag, Unsafe, kOtherCenter, center_completed},
      {"center-undetermined-g17-j"_diag, Unsafe, kMeantCenter, center_from_other_origin},
      {"center-undetermined-g17-j"_diag, Unsafe, kOtherCenter, center_completed},
      {"center-undetermined-g18-i"_diag, Unsafe, kMeantCenter, center_from_other_origin},
      {"center-undetermined-g18-i"_diag, Unsafe, kOtherCenter, center_completed},
      {"center-undetermined-g18-k"_diag, Unsafe, kMeantCenter, center_from_other_origin},
      {"center-undetermined-g18-k"_diag, Unsafe, kOtherCenter, center_completed},
      {"center-undetermined-g19-j"_diag, Unsafe, kMeantCenter, center_from_other_origin},
      {"center-undetermined-g19-j"_diag, Unsafe, kOtherCenter, center_completed},
      {"center-undetermined-g19-k"_diag, Unsafe, kMeantCenter, center_from_other_origin},
      {"center-undetermined-g19-k"_diag, Unsafe, kOtherCenter, center_completed},
      {"tool-without-m06"_diag, Safe, {"move {new} before the T", "spostare {new} prima della T"}, change_before_tool},
      {"tool-without-m06"_diag,
       Unsafe,
       {"move {text} directly after the M06 below", "spostare {text} subito dopo la M06 che segue"},
       tool_to_later_change},
      {"tool-without-m06"_diag, Unsafe, {"write M06 before {text}", "scrivere M06 prima di {text}"}, m06_before_tool},
      {"workpiece-frame-under-face"_diag,
       Unsafe,
       {"move the {new} from below to a line above this one",
        "spostare prima di questa, su una linea a sé, la {new} che segue"},
       later_g27_above},
      {"workpiece-frame-under-face"_diag, Unsafe, kAbove, g27_above},
      {"invalid-line-number"_diag,
       Unsafe,
       {"break the line before {text}", "andare a capo prima di {text}"},
       line_break_between_blocks},
      {"invalid-line-number"_diag, Safe, kRepetition, removed_repetition},
      {"invalid-line-number"_diag, Unsafe, kWholeNumber, whole_number},
      {"invalid-register-number"_diag, Unsafe, kWholeNumber, whole_number},
      {"assignment-without-register"_diag, Unsafe, {"remove the =", "togliere il segno ="}, without_equals},
      {"face-angle-out-of-range"_diag,
       Safe,
       {"write {new}, the same direction", "scrivere {new}, la stessa direzione"},
       angle_in_range},
      {"distance-mode-after-dimensions"_diag, Unsafe, kModeFirst, mode_first},
      {"second-motion"_diag,
       Unsafe,
       {"remove {new}, which moves nothing", "togliere {new}, che non muove nulla"},
       removed_first_motion},
      {"second-motion"_diag,
       Unsafe,
       {"move {text} to the next line", "spostare {text} sulla linea dopo"},
       motions_on_two_lines},
      {"register-not-assigned"_diag, None, kValueUnknown},
      {"dwell-time-missing"_diag, Unsafe, {"write P for {new}", "scrivere P al posto di {new}"}, time_by_p},
      {"repeated-feed"_diag, Safe, kRepetition, removed_repetition},
      {"feed-missing"_diag, None, kValueUnknown},
      {"tool-not-configured"_diag, None, kToolUnknown},
      {"arc-plane-not-orthogonal"_diag, None, kVectorUnknown},
      {"unsupported-g"_diag,
       Unsafe,
       {"write {new}, which is the same here", "scrivere {new}, che qui è lo stesso"},
       code_of_this_control},
      {"unsupported-g"_diag,
       Unsafe,
       {"remove {text}: there are no canned cycles to end", "togliere {text}: qui non ci sono cicli fissi da chiudere"},
       removed_canned_cycle_end},
      {"unsupported-g"_diag,
       Unsafe,
       {"write the moves of each hole, also on the lines below",
        "scrivere i movimenti di ogni foro, anche sulle linee seguenti"},
       moves_of_cycle},
      {"unsupported-g"_diag, Safe, kNotNeeded, removed_certainly_superfluous},
      {"unsupported-g"_diag, Unsafe, kNotNeeded, removed_foreign_word},
      {"if-not-alone"_diag,
       Safe,
       {"put the jump on a line of its own", "mettere il salto su una linea a sé"},
       on_its_own_line},
      {"if-malformed"_diag, Unsafe, kWrite, comparison},

      {"if-malformed"_diag, Unsafe, kWriteDecimal, point_for_comma},
      {"if-malformed"_diag,
       Unsafe,
       {"write {new}: labels start with N", "scrivere {new}: le etichette iniziano con N"},
       label_with_letter},
      {"if-malformed"_diag, Unsafe, kZero, label_with_zeros},
      {"if-malformed"_diag, Unsafe, kWholeNumber, whole_number},
      {"label-not-found"_diag, None, kLabelUnknown},
      {"backward-jump"_diag, None, kLabelUnknown},
      {"duplicate-label"_diag,
       Unsafe,
       {"number the line {new}, which is free", "dare alla linea il numero {new}, che è libero"},
       free_label},
      {"m-params-not-alone"_diag, Safe, kOwnLine, on_its_own_line},
      {"g09-misplaced"_diag,
       Unsafe,
       {"move {new} after the motion", "spostare {new} dopo il movimento"},
       move_after_feed_motion},
      {"redundant-modal"_diag,
       Safe,
       {"remove {text}, already in force", "togliere {text}, già in presa"},
       removed_on_every_path},
      {"g27-without-face"_diag,
       Safe,
       {"remove {text}, which dismounts nothing", "togliere {text}, che non smonta nulla"},
       removed_on_every_path},
      {"feed-ignored"_diag, Safe, kIgnored, removed_on_every_path},
      {"modal-group-twice"_diag,
       Safe,
       {"remove {new}, which {text} replaces", "togliere {new}, sostituita da {text}"},
       removed_earlier_mode},
      {"spindle-without-speed"_diag, None, kValueUnknown},
      {"spindle-reversed"_diag, Unsafe, kAbove, m05_above},
      {"tool-change-with-spindle-on"_diag, Unsafe, kAbove, m05_above},
      {"end-with-spindle-on"_diag, Unsafe, kAbove, m05_above},
      {"end-with-face-mounted"_diag, Unsafe, kAbove, g27_above},
      {"end-with-compensation"_diag, Unsafe, kAbove, g40_above},
      {"feed-on-rapid"_diag, Safe, kIgnored, removed_on_every_path},
      {"feed-of-inverse-time"_diag, None, kValueUnknown},
      {"arc-barely-fits"_diag, Unsafe, kNearestCenter, center_between_ends},
      {"center-legal-both-ways"_diag, Unsafe, kMeantCenter, center_from_other_origin},
      {"axes-nearly-orthogonal"_diag, None, kVectorUnknown},
      {"dwell-of-odd-length"_diag,
       Unsafe,
       {"write {new}, if milliseconds were meant", "scrivere {new}, se si intendevano millisecondi"},
       seconds_of_milliseconds},
      {"end-in-incremental"_diag, Safe, kAbove, g90_above},
      {"end-in-inches"_diag, Safe, kAbove, g71_above},
      {"label-never-used"_diag, Safe, {"remove the number", "togliere il numero"}, removed_mark},
      {"line-number-not-growing"_diag,
       None,
       {"isofmt --renumber numbers all lines anew.", "isofmt --renumber rinumera tutte le linee."}},
      {"lower-case"_diag, Safe, {"write capitals", "scrivere in maiuscolo"}, capitals},
      {"tab"_diag, Safe, {"write a blank", "scrivere uno spazio"}, blank_for_tab},
      {"mixed-line-ends"_diag,
       None,
       {"All line ends of a program are changed at once, by an editor or by version control.",
        "I terminatori di linea si cambiano tutti insieme, con un editor o con il controllo di versione."}},
      {"axes-nearly-unit"_diag, None, kVectorUnknown},
      {"travel-exceeded"_diag, None, kValueUnknown},
      {"feed-above-machine"_diag, None, kValueUnknown},
      {"rotary-speed-above-machine"_diag, None, kValueUnknown},
      {"spindle-speed-above-machine"_diag, None, kValueUnknown},
      {"inside-arc-too-small"_diag, None, kValueUnknown},
      {"useless-suppression"_diag, Safe, {"remove {text}", "togliere {text}"}, removed_suppression},
      {"too-many-paths"_diag, None, kAboutCheck},
      {"line-too-long"_diag, None, kAboutCheck},
  });
}();

}  // namespace isocnc::fixes
