#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::configuration {

/// A position in a text, from 1; columns in code points.
struct LineColumn {
  std::size_t line = 1;
  std::size_t column = 1;
};
LineColumn place_of(std::size_t at, std::string_view text);

/// Where a configuration describes something.
struct DescriptionPlace {
  LineColumn shown;        ///< For messages.
  std::uint32_t byte = 0;  ///< Byte of the line, from 0.
};

/// The places of ascending offsets in one well-formed UTF-8 text, which all together take the time of reading it once.
class PlaceFinder {
 public:
  explicit PlaceFinder(std::string_view text) : text_(text) {}

  /// The place of a byte. An offset below that of the call before starts over.
  DescriptionPlace of(std::size_t at);

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  DescriptionPlace place_;
};

/// A name in a message, equal or different in the two languages.
struct Named {
  std::string en;
  std::string it;

  // NOLINTNEXTLINE(google-explicit-constructor): whatever can be named stands as it is in a list of names.
  Named(std::string name) : en(name), it(std::move(name)) {}
  // NOLINTNEXTLINE(google-explicit-constructor): likewise.
  Named(const dialect::Text& text) : en(text.en), it(text.it) {}
};

/// A mistake in a configuration file, as data; its text is made when it is shown.
struct Mistake {
  std::size_t at = 0;  ///< Byte offset, from 0.
  std::string key;     ///< Path of the key, such as `machine.axes.X.min`; empty for the file as a whole.
  dialect::Text text;  ///< Message with {0} and {1} for `names`.
  std::vector<Named> names;
  std::optional<std::string> meant;  ///< Suggested correction.

  /// The message with the key: `machine.axes.X.min: 400 is more than max, 300`.
  std::string message(dialect::Language language) const;
};

/// A mistake in its file, in one line: `isocnc.json:12:7: error: machine.home.x: ...`.
std::string located_message(std::string_view file, const LineColumn& place, const Mistake& mistake,
                            dialect::Language language);

/// Text of the file, shortened for a message.
std::string shortened(std::string_view text);

/// Texts of all mistakes.
namespace mistakes {
inline constexpr dialect::Text kByteOrderMark = {"a byte-order mark stands here; save the file as UTF-8 without it",
                                                 "qui c'è un byte-order mark: il file va salvato in UTF-8 senza BOM"};
inline constexpr dialect::Text kNoUtf8 = {"this is not UTF-8; save the file as UTF-8",
                                          "questo non è UTF-8: il file va salvato in UTF-8"};
inline constexpr dialect::Text kControl = {"a control character, where only text may stand",
                                           "un carattere di controllo, dove ci può essere solo testo"};
inline constexpr dialect::Text kTooLarge = {"larger than any configuration", "troppo grande per una configurazione"};
inline constexpr dialect::Text kNoFile = {"not a file", "non è un file"};
inline constexpr dialect::Text kTooDeep = {"nested too deeply", "troppi livelli, uno dentro l'altro"};
inline constexpr dialect::Text kEndsEarly = {"the file ends here, but a bracket is still open or a value missing",
                                             "il file finisce qui, ma c'è una parentesi aperta o manca un valore"};
inline constexpr dialect::Text kExtraComma = {"there is a comma before this {0}, with nothing after it",
                                              "prima di questa {0} c'è una virgola di troppo"};
inline constexpr dialect::Text kOutOfPlace = {"{0} is out of place here", "{0} qui è fuori posto"};
inline constexpr dialect::Text kTextAfterEnd = {"nothing may follow the end of the configuration",
                                                "dopo la fine della configurazione non ci può essere altro"};
inline constexpr dialect::Text kStringOpen = {"a text without its closing quote", "testo senza virgolette di chiusura"};
inline constexpr dialect::Text kStringEscape = {
    "a backslash that JSON does not know; write \\\\ for a backslash",
    "una barra rovesciata che JSON non prevede: per una barra scrivere \\\\"};
inline constexpr dialect::Text kStringTab = {"a tab within a text; write \\t", "tabulatore nel testo: scrivere \\t"};
inline constexpr dialect::Text kCommentOpen = {"a comment without its end", "commento senza fine"};
inline constexpr dialect::Text kBadComment = {"a comment starts with // or /*", "un commento inizia con // o /*"};
inline constexpr dialect::Text kBadNumber = {"not a number as JSON writes it", "non è un numero come li scrive JSON"};
inline constexpr dialect::Text kHugeNumber = {"a number that is too large", "numero troppo grande"};

inline constexpr dialect::Text kWrongKind = {"this is {0}, and {1} is needed", "questo è {0}; ci vuole {1}"};
inline constexpr dialect::Text kNeedsObject = {"an object in braces is needed here",
                                               "qui ci vuole un oggetto fra graffe"};
inline constexpr dialect::Text kNeedsList = {"a list in brackets is needed here", "qui ci vuole un elenco fra quadre"};
inline constexpr dialect::Text kNeedsText = {"a text in quotes is needed here", "qui ci vuole un testo fra virgolette"};
inline constexpr dialect::Text kTextOrTexts = {"text, or an object with it and en",
                                               "un testo, o un oggetto con en e it"};
inline constexpr dialect::Text kUnknownKey = {"unknown key", "chiave sconosciuta"};
inline constexpr dialect::Text kKeyTwice = {"this key stands on line {0} already", "chiave già presente alla riga {0}"};
inline constexpr dialect::Text kKeyMissing = {"the key {0} is missing", "manca la chiave {0}"};
inline constexpr dialect::Text kNotWhole = {"{0} is not a whole number", "{0} non è un numero intero"};
inline constexpr dialect::Text kTooSmall = {"{0} is too small: at least {1}", "{0} è troppo piccolo: almeno {1}"};
inline constexpr dialect::Text kNotAbove = {"{0} is too small: more than {1}", "{0} è troppo piccolo: più di {1}"};
inline constexpr dialect::Text kTooBig = {"{0} is too large: at most {1}", "{0} è troppo grande: al massimo {1}"};
inline constexpr dialect::Text kNoChoice = {"{0} is not one of {1}", "{0} non è fra {1}"};
inline constexpr dialect::Text kUnknownCode = {"there is no code {0} (isolint --list-rules)",
                                               "il codice {0} non esiste (isolint --list-rules)"};
inline constexpr dialect::Text kBadGlob = {"{0} is not a path pattern", "{0} non è un modello di percorso"};
inline constexpr dialect::Text kLeavesFolder = {"{0}: this file counts only for programs in its folder, or below",
                                                "{0}: questo file vale solo per i programmi nella sua cartella o "
                                                "nelle sue sottocartelle"};
inline constexpr dialect::Text kNegatedGlob = {"{0}: a ! means nothing here; write \\! for a name that starts with it",
                                               "{0}: qui il ! non ha significato; per un nome che inizia così "
                                               "scrivere \\!"};
inline constexpr dialect::Text kBadExtension = {"{0} is not an extension, such as .iso",
                                                "{0} non è un'estensione, come .iso"};
inline constexpr dialect::Text kBadFunction = {"{0} is not a user M function: those are M1 and M7 to M999",
                                               "{0} non è una M dell'utente: sono la M1 e quelle da M7 a M999"};
inline constexpr dialect::Text kEmptyList = {"the list is empty", "l'elenco è vuoto"};
inline constexpr dialect::Text kEmpty = {"the text is empty", "il testo è vuoto"};
inline constexpr dialect::Text kMinAboveMax = {"min is more than max", "min è maggiore di max"};
inline constexpr dialect::Text kToolTwice = {"this tool is listed already", "utensile già in elenco"};
inline constexpr dialect::Text kFunctionTwice = {"this M is named already", "questa M ha già un nome"};
inline constexpr dialect::Text kBadRuleName = {"{0}: the id of a rule has letters, digits, - . and _ only",
                                               "{0}: l'id di una regola ha solo lettere, cifre, - . e _"};
inline constexpr dialect::Text kRuleTwice = {"a rule before this has the same id",
                                             "una regola prima di questa ha lo stesso id"};
inline constexpr dialect::Text kBadEvent = {
    "{0} is none of what a rule can name: an M such as M08, a G such as G90, toolChange, motion, rapid, cut, end",
    "{0} non è fra ciò che una regola può nominare: una M come M08, una G come G90, toolChange, motion, rapid, cut, "
    "end"};
inline constexpr dialect::Text kMotionEvent = {"{0} is a motion: name it motion, rapid or cut",
                                               "{0} è un movimento: va chiamato motion, rapid o cut"};
inline constexpr dialect::Text kBadModeOrM = {"{0} is no M such as M05 and no G such as G90",
                                              "{0} non è una M come M05, né una G come G90"};
inline constexpr dialect::Text kBadTool = {"{0} is no tool: T with six digits, or with fewer and a *, as in T101*",
                                           "{0} non è un utensile: T con sei cifre, o con meno e un *, come in T101*"};
inline constexpr dialect::Text kOnePattern = {
    "one of require, forbid, comment, head, end, speedFrom, speedTo, feedFrom, feedTo and lowestZ is needed",
    "ci vuole uno fra require, forbid, comment, head, end, speedFrom, speedTo, feedFrom, feedTo e lowestZ"};
inline constexpr dialect::Text kSecondPattern = {"there is {0} already; a rule has one pattern",
                                                 "c'è già {0}: una regola ha un solo modello"};
inline constexpr dialect::Text kNotOfPattern = {"only a rule with {0} has this", "questo l'ha solo una regola con {0}"};
inline constexpr dialect::Text kFromAboveTo = {"{0} is more than {1}", "{0} è maggiore di {1}"};
inline constexpr dialect::Text kForbidsMotion = {"{0} can be forbidden only with the key after",
                                                 "{0} si può vietare solo con la chiave after"};
inline constexpr dialect::Text kSameEvent = {"{0} stands in {1}, too, so that the rule says nothing",
                                             "{0} sta anche in {1}, e così la regola non dice nulla"};
inline constexpr dialect::Text kManyWatches = {"more than {0} rules; each word of head and of end counts as one",
                                               "più di {0} regole; ogni parola di head e di end conta per una"};

inline constexpr dialect::Text kRowLength = {"{0} numbers are needed here: {1}", "qui ci vogliono {0} numeri: {1}"};
inline constexpr dialect::Text kRowCount = {"{0} rows are needed here", "qui ci vogliono {0} righe"};
inline constexpr dialect::Text kManyRows = {"more than {0} rows", "più di {0} righe"};
inline constexpr dialect::Text kCornerBelow = {"{0} is less than {1} of the lower corner",
                                               "{0} è meno di {1} dello spigolo inferiore"};
inline constexpr dialect::Text kBelowRowBefore = {"{0} is less than {1} in the row before",
                                                  "{0} è meno di {1} nella riga precedente"};
inline constexpr dialect::Text kNotAtTip = {"the rows start at the tip, that is at z = 0, not at {0}",
                                            "le righe iniziano dalla punta, cioè da z = 0, non da {0}"};
inline constexpr dialect::Text kNoVolume = {"these rows enclose nothing", "queste righe non racchiudono nulla"};
inline constexpr dialect::Text kNoDirection = {"a direction without a length", "una direzione senza lunghezza"};
inline constexpr dialect::Text kOneShape = {"one of box, cylinder and mesh is needed",
                                            "ci vuole uno fra box, cylinder e mesh"};
inline constexpr dialect::Text kSecondShape = {"there is {0} already; one of them is enough",
                                               "c'è già {0}: ne basta uno"};
inline constexpr dialect::Text kNeedsKey = {"this needs the key {0}", "ci vuole anche la chiave {0}"};
inline constexpr dialect::Text kNotOfShape = {"only a tool with the shape {0} has this",
                                              "questo l'ha solo un utensile con la forma {0}"};
inline constexpr dialect::Text kUnknownHolder = {"there is no {0} in machine.holders",
                                                 "{0} non c'è in machine.holders"};
inline constexpr dialect::Text kHolderTwice = {"this holder is listed already", "portautensile già in elenco"};
inline constexpr dialect::Text kHolderTooHigh = {"the holder is {0} mm high, and the tool {1} mm long",
                                                 "il portautensile è alto {0} mm, e l'utensile lungo {1} mm"};
inline constexpr dialect::Text kTooShortForShape = {
    "{0} mm of the tool are outside the holder, and its shape needs {1} mm",
    "fuori dal portautensile ci sono {0} mm di utensile, e la sua forma ne vuole {1}"};
inline constexpr dialect::Text kInsideHolder = {"{0} is too large: {1} mm of the tool are outside the holder",
                                                "{0} è troppo grande: fuori dal portautensile ci sono {1} mm"};
inline constexpr dialect::Text kNoRotaryAxes = {"a machine with three axes has no {0}",
                                                "una macchina a tre assi non ha {0}"};

inline constexpr dialect::Text kOutsideFolder = {"{0}: the file must be in the folder of this file, or below",
                                                 "{0}: il file deve stare nella cartella di questo file, o più sotto"};
inline constexpr dialect::Text kFileProblem = {"{0}: {1}", "{0}: {1}"};
inline constexpr dialect::Text kNotThisKind = {"{0} is not a file", "{0} non è un file"};
inline constexpr dialect::Text kMeshTooLarge = {"{0} is larger than any mesh: at most {1}",
                                                "{0} è troppo grande per una mesh: al massimo {1}"};
inline constexpr dialect::Text kMeshEmpty = {"{0} is no STL file with a triangle",
                                             "{0} non è un file STL con triangoli"};
inline constexpr dialect::Text kMeshTruncated = {"{0} ends within the triangle after {1} complete ones",
                                                 "{0} finisce dentro il triangolo dopo {1} completi"};
inline constexpr dialect::Text kMeshShort = {"{0} ends before the {1} triangles that it states",
                                             "{0} finisce prima dei {1} triangoli che dichiara"};
inline constexpr dialect::Text kMeshLong = {"{0} goes on after the {1} triangles that it states",
                                            "{0} continua dopo i {1} triangoli che dichiara"};
inline constexpr dialect::Text kMeshWord = {"{0}, line {1}: not the word that STL has here",
                                            "{0}, riga {1}: non è la parola che l'STL ha qui"};
inline constexpr dialect::Text kMeshNumber = {"{0}, line {1}: no number where STL has a coordinate",
                                              "{0}, riga {1}: nessun numero dove l'STL ha una coordinata"};
inline constexpr dialect::Text kMeshNotFinite = {"{0}, triangle {1}: a coordinate that is not finite",
                                                 "{0}, triangolo {1}: una coordinata non finita"};
inline constexpr dialect::Text kMeshTooFar = {"{0}, triangle {1}: a coordinate that is farther away than a kilometer",
                                              "{0}, triangolo {1}: una coordinata oltre il chilometro"};
inline constexpr dialect::Text kMeshShiftedTooFar = {"{0}: its shift takes it farther away than a kilometer",
                                                     "{0}: lo spostamento la porta oltre il chilometro"};
inline constexpr dialect::Text kMeshOpen = {
    "{0} is open, so that it encloses nothing: {1} edges without a second triangle",
    "{0} è aperta, quindi non racchiude nulla: {1} spigoli senza un secondo triangolo"};
inline constexpr dialect::Text kMeshFlat = {"{0} encloses nothing: its triangles have no volume between them",
                                            "{0} non racchiude nulla: fra i suoi triangoli non c'è volume"};
inline constexpr dialect::Text kFlatBlank = {"a blank has a volume: its two corners differ in X, Y and Z",
                                             "un grezzo ha un volume: i suoi due spigoli sono diversi in X, Y e Z"};
inline constexpr dialect::Text kMeshHuge = {"{0} has more triangles than any mesh",
                                            "{0} ha troppi triangoli per una mesh"};
inline constexpr dialect::Text kOneBlank = {"one of box, cylinder, mesh and from is needed",
                                            "ci vuole uno fra box, cylinder, mesh e from"};
inline constexpr dialect::Text kOnlyWithFrom = {"this is for what an earlier setup has left: it needs from",
                                                "questo vale per ciò che ha lasciato un attrezzaggio precedente: vuole "
                                                "from"};
inline constexpr dialect::Text kStockUnreadable = {
    "{0}: {1} (isorun --stock-out writes it, from the program of the earlier setup)",
    "{0}: {1} (lo scrive isorun --stock-out, dal programma dell'attrezzaggio precedente)"};
inline constexpr dialect::Text kNoStock = {"{0} is no file that isorun --stock-out FILE.stock has written",
                                           "{0} non è un file scritto da isorun --stock-out FILE.stock"};
inline constexpr dialect::Text kStockVersion = {
    "{0} was written by another version of isorun; write it again with --stock-out",
    "{0} è stato scritto da un'altra versione di isorun; si riscriva con --stock-out"};
inline constexpr dialect::Text kStockBroken = {"{0} is damaged, at byte {1}; write it again with isorun --stock-out",
                                               "{0} è rovinato, al byte {1}; si riscriva con isorun --stock-out"};
inline constexpr dialect::Text kStockDamaged = {
    "{0} is damaged: its check sum is wrong; write it again with isorun --stock-out",
    "{0} è rovinato: la somma di controllo non torna; si riscriva con isorun --stock-out"};
inline constexpr dialect::Text kStockTooLarge = {"{0} takes more memory than there is for a stock",
                                                 "{0} occupa più memoria di quella che c'è per un grezzo"};
}  // namespace mistakes

}  // namespace isocnc::configuration
