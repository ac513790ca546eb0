#include "analyzer/transforming/refusal.h"

#include "interpreter/dialect/format.h"

namespace isocnc::transforming {

using dialect::Text;

static constexpr Text kLine{"line {}: {}", "riga {}: {}"};

/// Why a program is not transformed, without its line.
static const Text& reason(TransformObstacle obstacle) {
  static constexpr Text kProgramError{"the program stops here, which must be corrected first: {}",
                                      "il programma si ferma qui, e va prima corretto: {}"};
  static constexpr Text kTooManyPaths{
      "the values that its IFs compare lead along too many paths: they have more than {1} combinations",
      "i valori che i suoi IF confrontano portano lungo troppe vie: hanno più di {1} combinazioni"};
  static constexpr Text kOnTwoPaths{
      "two paths lead here, and from each of them something else would have to be written",
      "qui portano due vie, e per ciascuna si dovrebbe scrivere altro"};
  static constexpr Text kFeedInMachine{
      "a feed move in machine coordinates (G92 X0 Y0 Z0), though the program has a workpiece frame of its own: whether "
      "it belongs to the workpiece is not known",
      "un movimento in lavoro in quote macchina (G92 X0 Y0 Z0), mentre il programma ha un suo riferimento di pezzo: "
      "non "
      "si sa se appartiene al pezzo"};
  static constexpr Text kPlaneRotated{"an arc in G18 or G19 cannot be turned out of its plane",
                                      "un arco in G18 o G19 non si può ruotare fuori dal suo piano"};
  static constexpr Text kStartUnknown{
      "the feed move starts at a place that the program has not given: write all its coordinates in a rapid before it",
      "il movimento in lavoro parte da un punto che il programma non ha dato: scriverne tutte le quote in un rapido "
      "prima"};
  static constexpr Text kFaceUnknown{
      "the face would not be where it must: the program has not given the place of the tool, or its axes",
      "la faccia non sarebbe dove deve: il programma non ha dato la posizione dell'utensile, o i suoi assi"};
  static constexpr Text kPlaceDiffers{"on the simulated machine the motion would end elsewhere",
                                      "sulla macchina simulata il movimento finirebbe altrove"};
  static constexpr Text kArcDiffers{"on the simulated machine the arc would be another one",
                                    "sulla macchina simulata l'arco sarebbe un altro"};
  static constexpr Text kSideDiffers{
      "on the simulated machine G41 or G42 would lead the tool beside the contour on another side",
      "sulla macchina simulata la G41 o la G42 porterebbe l'utensile da un altro lato del profilo"};
  static constexpr Text kFeedDiffers{"on the simulated machine the feed would be another one",
                                     "sulla macchina simulata l'avanzamento sarebbe un altro"};
  static constexpr Text kEffectDiffers{"on the simulated machine the block would do something else",
                                       "sulla macchina simulata il blocco farebbe altro"};
  static constexpr Text kCopyStartsLow{
      "in the next copy this rapid would start where the copy before it ends: let the program end at its highest Z, "
      "and "
      "with B and C as at its start",
      "nella copia seguente questo rapido partirebbe da dove finisce quella precedente: far finire il programma alla "
      "sua "
      "Z più alta, e con B e C come all'inizio"};
  static constexpr Text kJumpRepeated{"a program with an IF is not repeated: its labels would be there several times",
                                      "un programma con un IF non si ripete: le sue etichette ci sarebbero più volte"};
  static constexpr Text kNewError{"the new program would stop here: {}", "il nuovo programma si fermerebbe qui: {}"};
  switch (obstacle) {
    case TransformObstacle::ProgramError:
      return kProgramError;
    case TransformObstacle::TooManyPaths:
      return kTooManyPaths;
    case TransformObstacle::OnTwoPaths:
      return kOnTwoPaths;
    case TransformObstacle::FeedInMachine:
      return kFeedInMachine;
    case TransformObstacle::PlaneRotated:
      return kPlaneRotated;
    case TransformObstacle::StartUnknown:
      return kStartUnknown;
    case TransformObstacle::FaceUnknown:
      return kFaceUnknown;
    case TransformObstacle::PlaceDiffers:
      return kPlaceDiffers;
    case TransformObstacle::ArcDiffers:
      return kArcDiffers;
    case TransformObstacle::SideDiffers:
      return kSideDiffers;
    case TransformObstacle::FeedDiffers:
      return kFeedDiffers;
    case TransformObstacle::EffectDiffers:
      return kEffectDiffers;
    case TransformObstacle::CopyStartsLow:
      return kCopyStartsLow;
    case TransformObstacle::JumpRepeated:
      return kJumpRepeated;
    case TransformObstacle::NewError:
      return kNewError;
  }
  return kEffectDiffers;
}

std::string TransformationRefusal::message(dialect::Language language) const {
  const std::string why = dialect::format(reason(obstacle), language, detail, kMaxRuns);
  return obstacle == TransformObstacle::TooManyPaths ? why : dialect::format(kLine, language, line + 1, why);
}

}  // namespace isocnc::transforming
