#include "analyzer/translation/translation_finding.h"

#include <iterator>

#include <fmt/args.h>

#include "interpreter/dialect/format.h"

namespace isocnc::translation {

using dialect::Text;
using Untranslatable = UntranslatableReason;

namespace {

struct ReasonText {
  Untranslatable reason;
  Text text;
};

constexpr ReasonText kReasonTexts[] = {
    {Untranslatable::Unreadable, {"{0} cannot be read", "{0} non si può leggere"}},
    {Untranslatable::Formula,
     {"{0} takes its number from a variable or a formula: write the number",
      "{0} prende il numero da una variabile o da una formula: scrivere il numero"}},
    {Untranslatable::Assignment, {"variables cannot be translated: {0}", "le variabili non si possono tradurre: {0}"}},
    {Untranslatable::Statement,
     {"jumps, loops and calls with parameters cannot be translated: {0}",
      "salti, cicli e chiamate con parametri non si possono tradurre: {0}"}},
    {Untranslatable::SkippedBlock,
     {"the operator may skip this block: decide whether it belongs to the program",
      "l'operatore può saltare questo blocco: decidere se fa parte del programma"}},
    {Untranslatable::WordTwice, {"{0} stands twice in the block", "{0} compare due volte nel blocco"}},
    {Untranslatable::NumberTooLarge, {"the number of {0} is too large", "il numero di {0} è troppo grande"}},
    {Untranslatable::UnknownG, {"{0} has no translation", "{0} non ha traduzione"}},
    {Untranslatable::UnknownWord, {"{0} has no meaning in this block", "{0} non ha significato in questo blocco"}},
    {Untranslatable::UnnamedFunction,
     {"which M of the shop does what {0} does? Name it in the map, under functions",
      "quale M dell'officina fa ciò che fa {0}? Indicarla nella mappa, in functions"}},
    {Untranslatable::SavedModes,
     {"{0}: saved modes cannot be restored here; write the Gs, the F and the S that hold after an M72",
      "{0}: qui i modi salvati non si possono ripristinare; scrivere le G, la F e la S che valgono dopo una M72"}},
    {Untranslatable::RotaryAxis,
     {"{0} turns an axis: what that does to the tool depends on the machine's axes, and is not translated",
      "{0} ruota un asse: l'effetto sull'utensile dipende dagli assi della macchina, e non viene tradotto"}},
    {Untranslatable::ZeroPointMissing,
     {"where is the zero point of {0}, in machine coordinates? Give it with --zero {0}=X,Y,Z or in the map",
      "dov'è l'origine di {0}, in coordinate di macchina? Indicarla con --zero {0}=X,Y,Z o nella mappa"}},
    {Untranslatable::ToolUnmapped,
     {"{0} is not in the map of tools: --map says at which head and holder it is",
      "{0} non è nella mappa degli utensili: --map dice in quale testa e portautensile si trova"}},
    {Untranslatable::ToolNumberMissing, {"M06 without a T before it", "M06 senza una T prima"}},
    {Untranslatable::NoTool,
     {"no tool is mounted before this motion: name the first one in the map, under start",
      "nessun utensile è montato prima di questo movimento: indicare il primo nella mappa, in start"}},
    {Untranslatable::ToolOffsetOfOther,
     {"{0} takes the data of another tool than the one mounted, {1}; where they are its own, the map says so under "
      "offsets",
      "{0} prende i dati di un utensile diverso da quello montato, {1}; se sono i suoi, la mappa lo dice in offsets"}},
    {Untranslatable::LengthOff,
     {"after G49 Z counts without the tool's length, which here always counts",
      "dopo la G49 Z conta senza la lunghezza dell'utensile, che qui conta sempre"}},
    {Untranslatable::LengthGiven,
     {"{0} gives the tool a length of its own: here it comes with the tool of M06",
      "{0} dà all'utensile una sua lunghezza: qui arriva con l'utensile della M06"}},
    {Untranslatable::CompensationGiven,
     {"{0} gives the tool a radius of its own: here it comes with the tool of M06",
      "{0} dà all'utensile un suo raggio: qui arriva con l'utensile della M06"}},
    {Untranslatable::PolarCoordinates,
     {"{0} turns polar coordinates on: points are written in X, Y and Z",
      "{0} attiva le coordinate polari: qui i punti si scrivono in X, Y e Z"}},
    {Untranslatable::ScaledOrMirrored,
     {"{0} scales or mirrors the path: the program itself must hold it as it is to be cut",
      "{0} scala o specchia il percorso: il programma deve contenerlo come va lavorato"}},
    {Untranslatable::TiltedPlane,
     {"{0} tilts the working plane: write the frame as G24, G28 or G29",
      "{0} inclina il piano di lavoro: scrivere il riferimento con G24, G28 o G29"}},
    {Untranslatable::Rotation,
     {"{0} is translated where it has an R, its center is known, G90 holds and no other G68 does",
      "{0} si traduce dove ha la R, il suo centro è noto, vale la G90 e non vale già un'altra G68"}},
    {Untranslatable::FeedPerTurn,
     {"{0} counts F per turn of the spindle: here it counts per minute",
      "{0} conta la F al giro del mandrino: qui si conta al minuto"}},
    {Untranslatable::SurfaceSpeed,
     {"{0} keeps the cutting speed constant: here S is revolutions per minute",
      "{0} tiene costante la velocità di taglio: qui S è in giri al minuto"}},
    {Untranslatable::DiameterMode,
     {"{0} makes X a diameter, as on a lathe", "con {0} la X è un diametro, come su un tornio"}},
    {Untranslatable::NoMotionInForce,
     {"coordinates, but no motion G is in force", "coordinate, ma nessuna G di movimento è in presa"}},
    {Untranslatable::FeedMissing, {"no F is given for this feed move", "per questo movimento di lavoro manca la F"}},
    {Untranslatable::FeedNotPositive, {"{0} is not positive", "{0} non è positiva"}},
    {Untranslatable::SpeedNotPositive,
     {"{0} is no speed here: M05 stops the spindle", "{0} qui non è una velocità: il mandrino si ferma con M05"}},
    {Untranslatable::CenterMissing,
     {"the arc has neither a center nor a radius that determine it",
      "l'arco non ha né un centro né un raggio che lo determinino"}},
    {Untranslatable::ArcStartUnknown,
     {"the arc's start is not known, since {0} has not been given before; so neither is its center",
      "non si sa dove inizia l'arco, perché {0} non è ancora stata data; e quindi neppure il centro"}},
    {Untranslatable::ArcMismatch,
     {"the ends of the arc are not equally far from its center, or its radius does not reach: {0} and {1} mm",
      "gli estremi dell'arco non distano ugualmente dal centro, o il raggio non basta: {0} e {1} mm"}},
    {Untranslatable::ArcTurns, {"{0} is no number of turns", "{0} non è un numero di giri"}},
    {Untranslatable::LostPlace,
     {"a block above is not translated, so the tool would not start where it should; translation goes on once a "
      "G00 in G90 has given the axes anew",
      "un blocco sopra non è tradotto, e l'utensile non partirebbe da dove deve; la traduzione riprende quando una "
      "G00 in G90 ha ridato gli assi"}},
    {Untranslatable::ModeUnknown,
     {"{0} must be given anew: a block above that may have changed it is not translated",
      "{0} va dato di nuovo: un blocco sopra che può averlo cambiato non è tradotto"}},
    {Untranslatable::PlaceUnknown,
     {"{0} needs to know where the tool is, and {1} has not been given before",
      "per {0} occorre sapere dov'è l'utensile, e {1} non è ancora stata data"}},
    {Untranslatable::AxesAfterRotation,
     {"the first motion after {0} must give both axes of the plane in G90",
      "il primo movimento dopo {0} deve dare i due assi del piano in G90"}},
    {Untranslatable::MachineCoordinates,
     {"G53 takes coordinates in G90, and G00 or G01", "G53 vuole coordinate in G90, e G00 o G01"}},
    {Untranslatable::ReferenceMissing,
     {"where is the reference point of {0}, in machine coordinates? Give it in the map, under references",
      "dov'è il punto di riferimento di {0}, in coordinate di macchina? Indicarlo nella mappa, in references"}},
    {Untranslatable::CycleUnknown,
     {"{0} needs a spindle that is synchronized or oriented: no motion here is tied to its turns",
      "{0} vuole un mandrino sincronizzato o orientato: qui nessun movimento è legato ai suoi giri"}},
    {Untranslatable::CycleIncomplete,
     {"the cycle needs {0}, and it has not been given", "al ciclo serve {0}, che non è stata data"}},
    {Untranslatable::CycleDepth, {"the bottom of the hole is above R", "il fondo del foro è sopra R"}},
    {Untranslatable::RetractUnstated,
     {"the cycle above goes back to where it started or to R, as the machine is set: write a G98 or G99 before it",
      "il ciclo sopra torna da dove è partito o a R, secondo la macchina: scrivere prima una G98 o G99"}},
    {Untranslatable::CycleTooManyMoves,
     {"{0} makes more moves than any part needs", "{0} dà più movimenti di quanti ne servano a un pezzo"}},
    {Untranslatable::DwellMissing, {"the dwell needs a time, in {0}", "all'attesa serve un tempo, in {0}"}},
    {Untranslatable::SubprogramMissing,
     {"the subprogram of {0} is not in this file: write its lines where it is called",
      "il sottoprogramma di {0} non è in questo file: scriverne le linee dove viene chiamato"}},
    {Untranslatable::SubprogramsTooDeep,
     {"{0}: subprograms call one another more than {1} deep", "{0}: sottoprogrammi uno dentro l'altro oltre {1}"}},
    {Untranslatable::SubprogramsTooLong,
     {"{0}: the lines that subprograms repeat are more than {1} MB",
      "{0}: le linee ripetute dai sottoprogrammi superano {1} MB"}},
    {Untranslatable::NoSubprogram,
     {"{0} needs the number of a subprogram, P", "{0} vuole il numero di un sottoprogramma, P"}},
    {Untranslatable::EndlessProgram,
     {"M99 starts the program again without end; the translation ends here",
      "M99 ripete il programma senza fine; la traduzione finisce qui"}},
    {Untranslatable::OtherProgram,
     {"another program starts here, which nothing calls", "qui inizia un altro programma, che nessuno chiama"}},
    {Untranslatable::WholeNumber,
     {"{0} has no decimal point: on a Fanuc it is {0} units or thousandths of them; say which in the map, as "
      "wholeNumbers",
      "{0} non ha il punto decimale: su un Fanuc sono unità o millesimi; dirlo nella mappa, con wholeNumbers"}},
};

constexpr Text kRepeated{"{0} (and {1} times more, the last time in line {2})",
                         "{0} (e altre {1} volte, l'ultima alla riga {2})"};
constexpr Text kRepeatedOnce{"{0} (and once more in line {1})", "{0} (e un'altra volta alla riga {1})"};

}  // namespace

const Text& text_of(Untranslatable reason) {
  for (const ReasonText& row : kReasonTexts)
    if (row.reason == reason) return row.text;
  return kReasonTexts[0].text;
}

std::string TranslationFinding::message(dialect::Language language) const {
  fmt::dynamic_format_arg_store<fmt::format_context> arguments;
  for (const std::string& value : values) arguments.push_back(value);
  std::string text = fmt::vformat(text_of(reason).in(language), arguments);
  if (repeats == 0) return text;
  if (repeats == 1) return dialect::format(kRepeatedOnce, language, text, last_line);
  return dialect::format(kRepeated, language, text, repeats, last_line);
}

void FindingList::add(TranslationFinding finding) {
  const auto [at, is_new] = first_.try_emplace({finding.reason, finding.values}, findings_.size());
  if (is_new) {
    findings_.push_back(std::move(finding));
    return;
  }
  TranslationFinding& first = findings_[at->second];
  ++first.repeats;
  first.last_line = finding.line;
}

}  // namespace isocnc::translation
