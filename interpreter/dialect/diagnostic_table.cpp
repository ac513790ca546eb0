#include <algorithm>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::dialect {

/// Every kind of finding. A row is the only source of all texts about a code: messages in both languages, `--explain`,
/// the documentation and the reports to other tools. `wrong` and `right` are its first test.
///
/// `ISO` codes are the specification's (I.7); `E` and `W0` are rules that its text states without a code (D2, D3);
/// `W19x` report on the check itself. Lengths in messages are in mm and angles in degrees, whatever the program uses.
constexpr DiagnosticDef kDiagnostics[kDiagnosticCount] = {
    {.code = "ISO001",
     .name = "unclosed-comment",
     .severity = Severity::Error,
     .section = "I.2.3",
     .arguments = {},
     .title = {.en = "Unclosed comment", .it = "Commento non chiuso"},
     .message = {.en = "no ) closes this comment before the end of the line",
                 .it = "il commento non è chiuso da una ) entro la fine della linea"},
     .explanation = {.en = "A comment in parentheses must end on the line where it starts. Add the ), or put ; in "
                           "place of the ( to comment out the rest of the line. A second ( inside a comment is plain "
                           "text and needs no ) of its own.",
                     .it = "Un commento fra parentesi deve chiudersi sulla stessa linea in cui si apre. Aggiungere "
                           "la ), oppure mettere ; al posto della ( per commentare tutto il resto della linea. Una "
                           "seconda ( dentro il commento è semplice testo e non richiede una sua )."},
     .wrong = "M06 T101001\nG00 Z5 [!(OP 10!]\nM02\n",
     .right = "M06 T101001\nG00 Z5 (OP 10)\nM02\n"},
    {.code = "ISO002",
     .name = "unopened-comment",
     .severity = Severity::Error,
     .section = "I.2.3",
     .arguments = {},
     .title = {.en = "Unopened comment", .it = "Commento non aperto"},
     .message = {.en = "this ) closes no comment: its ( is missing on the line",
                 .it = "questa ) non chiude alcun commento: sulla linea manca la ( corrispondente"},
     .explanation = {.en = "A ) is allowed only where it closes a comment that was opened on the same line. The first "
                           ") ends the comment, however many ( stand before it. Delete the extra ) or add the missing "
                           "(.",
                     .it = "Una ) è ammessa solo per chiudere un commento aperto sulla stessa linea. La prima ) chiude "
                           "il commento, per quante ( la precedano. Cancellare la ) di troppo o aggiungere "
                           "la ( mancante."},
     .wrong = "M06 T101001\nG00 Z5 (OP 10)[!)!]\nM02\n",
     .right = "M06 T101001\nG00 Z5 (OP 10)\nM02\n"},
    {.code = "ISO003",
     .name = "unknown-word",
     .severity = Severity::Error,
     .section = "I.2.2",
     .arguments = {},
     .title = {.en = "Unknown word", .it = "Parola non riconosciuta"},
     .message = {.en = "{text} is not a word of this control: words start with A B C F G I J K M N P Q R S T V X Y Z",
                 .it = "parola {text} non riconosciuta: le parole iniziano con A B C F G I J K M N P Q R S T V X Y Z"},
     .causes =
         {{.cause = "prose",
           .message = {.en = "\"{text}\" is text outside a comment: put it in parentheses, or after a ;",
                       .it = "«{text}» è testo fuori da un commento: metterlo fra parentesi, o dopo un ;"},
           .wrong = "M06 T101001\n[!END OF PART!]\nM02\n"},
          {.cause = "outside-if",
           .message = {.en = "{text} belongs in the condition of an IF, as in IF VGPL = 1 GOTO N30",
                       .it = "{text} va solo nella condizione di un IF, come in IF VGPL = 1 GOTO N30"},
           .wrong = "M06 T101001\nG00 X10 [!VGPL!]\nM02\n"},
          {.cause = "letter-for-digit",
           .message =
               {.en = "{text} puts a letter into the number before it: write a digit, 0 for O, 1 for l",
                .it = "con {text} il numero che precede contiene una lettera: scrivere una cifra, 0 per O, 1 per l"},
           .wrong = "M06 T101001\nG00 X1[!O!]\nM02\n"},
          {.cause = "no-digits",
           .message = {.en = "{text} without digits is no number: write its digits, or delete it",
                       .it = "{text} senza cifre non è un numero: scrivere le cifre, o togliere il segno"},
           .wrong = "M06 T101001\n[!,!] G00 X10\nM02\n"},
          {.cause = "foreign-minus",
           .message = {.en = "{text} has a dash that is not the minus sign: type it anew, with the - of the keyboard",
                       .it = "{text} ha un trattino che non è il segno meno: riscriverlo con il - della tastiera"},
           .wrong = "M06 T101001\nG00 X[!\u221220!]\nM02\n"}},
     .explanation = {.en = "The control knows no word with D, E, H, L, O, U or W, nor characters such as %, # or *. "
                           "Use the letter that serves the purpose here, or put the text in a comment. Programs "
                           "written for other controls often start with % or with an O number: delete both.",
                     .it = "Il controllo non conosce parole con D, E, H, L, O, U o W, né caratteri come %, # o *. "
                           "Usare la lettera prevista da questo controllo, oppure mettere il testo in un commento. I "
                           "programmi scritti per altri controlli iniziano spesso con % o con un numero O: vanno "
                           "tolti."},
     .wrong = "M06 T101001\nG00 X10 [!U5!]\nM02\n",
     .right = "M06 T101001\nG00 X10 Y5\nM02\n"},
    {.code = "ISO004",
     .name = "word-without-number",
     .severity = Severity::Error,
     .section = "I.2.2",
     .arguments = {},
     .title = {.en = "Word without a number", .it = "Parola senza numero"},
     .message = {.en = "no number follows {text}: every letter needs one, and a zero is written, too",
                 .it = "dopo {text} manca il numero: ogni lettera ne vuole uno, e anche lo zero va scritto"},
     .causes = {{.cause = "prose",
                 .message = {.en = "\"{text}\" is text outside a comment: put it in parentheses, or after a ;",
                             .it = "«{text}» è testo fuori da un commento: metterlo fra parentesi, o dopo un ;"},
                 .wrong = "M06 T101001\n[!FINE LATO!]\nM02\n"},
                {.cause = "letter-for-digit",
                 .message = {.en = "the letter {other} follows {text}: write a digit, 0 for O, 1 for l",
                             .it = "dopo {text} c'è la lettera {other}: scrivere una cifra, 0 per O, 1 per l"},
                 .wrong = "M06 T101001\n[!G!]O X10\nM02\n"}},
     .explanation = {.en =
                         "A word is a letter with its number: the letter alone means nothing to the control. Write the "
                         "number after it, or delete the letter. Zero must be written too: X0, not X.",
                     .it = "Una parola è formata da una lettera e dal suo numero: la lettera da sola non dice nulla "
                           "al controllo. Scrivere il numero o cancellare la lettera. Anche lo zero va scritto: X0, "
                           "non X."},
     .wrong = "M06 T101001\nG00 X10 [!Y!]\nM02\n",
     .right = "M06 T101001\nG00 X10 Y20\nM02\n"},
    {.code = "ISO005",
     .name = "number-without-letter",
     .severity = Severity::Error,
     .section = "I.2.2",
     .arguments = {},
     .title = {.en = "Number without a letter", .it = "Numero senza lettera"},
     .message = {.en = "no letter stands before the number {text}: write the one that it belongs to",
                 .it = "davanti al numero {text} manca la lettera: scrivere quella a cui appartiene"},
     .explanation = {.en = "Without its letter the control cannot tell what the number is for. Write the letter "
                           "before it (X, F, N and so on), or delete the number. Spaces do not separate numbers: X10 "
                           "20 is read as X1020.",
                     .it = "Senza la lettera il controllo non sa a che cosa serva il numero. Scrivere la lettera "
                           "davanti (X, F, N e così via) o cancellare il numero. Gli spazi non separano i numeri: "
                           "X10 20 viene letto come X1020."},
     .wrong = "M06 T101001\nG00 X10 Y20\n[!30!] Y40\nM02\n",
     .right = "M06 T101001\nG00 X10 Y20\nX30 Y40\nM02\n"},
    {.code = "ISO006",
     .name = "malformed-number",
     .severity = Severity::Error,
     .section = "I.2.1",
     .arguments = {},
     .title = {.en = "Malformed number", .it = "Formato numerico errato"},
     .message = {.en = "{text} has a comma: decimals follow a point, as in 10.5",
                 .it = "{text} ha una virgola: i decimali si scrivono dopo un punto, come in 10.5"},
     .causes =
         {{.cause = "shape",
           .message =
               {.en = "{text} is not a number: the control reads one sign, digits and one decimal point, as in -12.5",
                .it =
                    "{text} non è un numero: il controllo legge un segno, le cifre e un punto decimale, come in -12.5"},
           .wrong = "M06 T101001\nG00 X[!1.2.3!]\nM02\n"}},
     .explanation = {.en = "A number may start with + or -, and its decimals follow a point, never a comma. Write "
                           "10.5, .35 or -3. A second sign, a second point and separators for thousands are not "
                           "allowed.",
                     .it = "Un numero può iniziare con + o -, e i decimali si separano con il punto, mai con la "
                           "virgola. Scrivere 10.5, .35 o -3. Non sono ammessi un secondo segno, un secondo punto o "
                           "separatori delle migliaia."},
     .wrong = "M06 T101001\nG00 X[!10,5!]\nM02\n",
     .right = "M06 T101001\nG00 X10.5\nM02\n"},
    {.code = "ISO007",
     .name = "invalid-g-number",
     .severity = Severity::Error,
     .section = "I.2.2",
     .arguments = {},
     .title = {.en = "Invalid G number", .it = "Numero non valido per la G"},
     .message = {.en = "{text}: G takes a whole number from 0 to 999, without sign or decimal point",
                 .it = "{text}: alla G segue un numero intero da 0 a 999, senza segno né punto decimale"},
     .explanation = {.en = "The control knows G codes only as whole numbers of at most three digits. Codes with a "
                           "point, such as G54.1 or G90.1, belong to other controls: use the G that does the same "
                           "here. Leading zeros do not matter: G01 is G1.",
                     .it = "Il controllo conosce solo G con un numero intero di tre cifre al massimo. I codici con "
                           "il punto, come G54.1 o G90.1, sono di altri controlli: usare la G che qui fa lo stesso "
                           "lavoro. Gli zeri iniziali non contano: G01 è G1."},
     .wrong = "M06 T101001\n[!G1000!]\nG00 X10\nM02\n",
     .right = "M06 T101001\nG90\nG00 X10\nM02\n"},
    {.code = "ISO008",
     .name = "invalid-m-number",
     .severity = Severity::Error,
     .section = "I.2.2",
     .arguments = {},
     .title = {.en = "Invalid M number", .it = "Numero non valido per la M"},
     .message = {.en = "{text}: M takes a whole number from 1 to 999, without sign or decimal point",
                 .it = "{text}: alla M segue un numero intero da 1 a 999, senza segno né punto decimale"},
     .causes = {{.cause = "tool",
                 .message = {.en = "{text}: the T is missing before the tool: write M06 T101001",
                             .it = "{text}: davanti all'utensile manca la T: scrivere M06 T101001"},
                 .wrong = "[!M06 101002!]\nM02\n"}},
     .explanation = {.en = "M functions are numbered from 1 to 999, and no other exists. M02 to M06 have a fixed "
                           "meaning; the others are defined for each machine. There is no M0 on this control.",
                     .it = "Le funzioni M sono numerate da 1 a 999 e altre non esistono. Da M02 a M06 il significato "
                           "è fisso; le altre sono definite macchina per macchina. La M0 su questo controllo non c'è."},
     .wrong = "[!M1000!]\nM02\n",
     .right = "M100\nM02\n"},
    {.code = "ISO009",
     .name = "invalid-tool-number",
     .severity = Severity::Error,
     .section = "I.2.2",
     .arguments = {},
     .title = {.en = "Invalid tool number", .it = "Numero non valido per la T"},
     .message = {.en = "{text}: T takes exactly six digits, one for the head, two for the holder, three for the tool",
                 .it = "{text}: alla T seguono esattamente sei cifre, una per la testa, due per il portautensile, "
                       "tre per l'utensile"},
     .explanation = {.en = "Head, holder and tool have fixed places in the number, so none of the six digits may be "
                           "left out. Fill up with zeros: head 1, holder 1 and tool 1 are T101001. Spaces between the "
                           "groups are allowed: T 1 01 001.",
                     .it = "Testa, portautensile e utensile hanno un posto fisso nel numero: delle sei cifre non se "
                           "ne può omettere nessuna. Completare con gli zeri: testa 1, portautensile 1 e utensile 1 "
                           "si scrivono T101001. Fra i gruppi di cifre si possono lasciare spazi: T 1 01 001."},
     .wrong = "M06 [!T10101!]\nM02\n",
     .right = "M06 T101001\nM02\n"},
    {.code = "ISO010",
     .name = "units-after-dimensions",
     .severity = Severity::Error,
     .section = "I.3.1",
     .arguments = {},
     .title = {.en = "Units after the coordinates", .it = "G70/G71 dopo le quote"},
     .message = {.en = "{text} must stand before the line's motion and coordinates",
                 .it = "{text} va scritta prima del movimento della linea e delle sue quote"},
     .explanation = {.en = "The control must know the unit before it reads the coordinates of the line. Move G70 or "
                           "G71 to the start of the line, or put it on a line of its own before this one.",
                     .it = "Il controllo deve conoscere l'unità di misura prima di leggere le quote della linea. "
                           "Spostare la G70 o la G71 all'inizio della linea, oppure scriverla da sola sulla linea "
                           "precedente."},
     .wrong = "M06 T101001\nG00 X2 Y3 [!G70!]\nM02\n",
     .right = "M06 T101001\nG70 G00 X2 Y3\nM02\n"},
    {.code = "ISO011",
     .name = "stray-argument",
     .severity = Severity::Error,
     .section = "I.3.4",
     .arguments = {"g"},
     .title = {.en = "Stray argument", .it = "Quota o componente fuori posto"},
     .message = {.en = "{other} cuts {text} off from its command: write {text} right after the other arguments",
                 .it = "{other} stacca {text} dal suo comando: scrivere {text} subito dopo gli altri argomenti"},
     .causes = {{.cause = "no-motion",
                 .message = {.en = "no motion G is in force for {text}: write G00, G01, G02 or G03 before it",
                             .it =
                                 "per {text} non è in presa alcuna G di movimento: scrivere prima G00, G01, G02 o G03"},
                 .wrong = "M06 T101001\n[!X10!]\nG00 X20\nM02\n"},
                {.cause = "no-such-axis",
                 .message = {.en = "no motion takes {text}: a motion has X Y Z B C, an arc I J K R as well",
                             .it = "nessun movimento ammette {text}: un movimento ha X Y Z B C, un arco anche I J K R"},
                 .wrong = "M06 T101001\nG00 X10 [!A5!]\nM02\n"},
                {.cause = "no-arc",
                 .message = {.en = "{g} has no center or radius: write {text} with an arc, G02 or G03",
                             .it = "la {g} non ha centro né raggio: scrivere {text} con un arco, G02 o G03"},
                 .wrong = "M06 T101001\nG01 X10 [!I5 J0!] F1000\nM02\n"},
                {.cause = "before-its-g",
                 .message = {.en = "{text} stands before its G: write {other} first",
                             .it = "{text} sta prima della sua G: scrivere prima {other}"},
                 .wrong = "M06 T101001\n[!X10!] G00\nM02\n"}},
     .explanation = {.en = "A coordinate or component counts only directly after the command that takes it, or alone "
                           "on its line while a motion G is in force. S, N or another command in between breaks the "
                           "series of arguments: write S before the G or after its last coordinate. G00 and G01 take "
                           "X Y Z B C; G02 and G03 take I J K R as well; no motion takes A, P or Q.",
                     .it = "Una quota o una componente vale solo subito dopo il comando che la richiede, oppure da "
                           "sola sulla linea se è già in presa una G di movimento. Una S, una N o un altro comando in "
                           "mezzo spezza la serie degli argomenti: scrivere la S prima della G o dopo l'ultima "
                           "quota. G00 e G01 ammettono X Y Z B C; G02 e G03 anche I J K R; nessun movimento ammette "
                           "A, P o Q."},
     .wrong = "M06 T101001\nG00 X10 S5000 [!Z5!]\nM02\n",
     .right = "M06 T101001\nG00 X10 Z5 S5000\nM02\n"},
    {.code = "ISO012",
     .name = "head-not-selected",
     .severity = Severity::Error,
     .section = "I.4.3",
     .arguments = {"holder"},
     .title = {.en = "Head not selected", .it = "Testa non selezionata"},
     .message = {.en = "holder {holder} has no head: the first digit of T is 0",
                 .it = "il portautensile {holder} non ha testa: la prima cifra di T è 0"},
     .explanation = {.en = "A holder is always mounted on a head, so a holder without a head cannot be called. Write "
                           "the head, from 1 to 9, as the first digit of T. T000000 says that nothing is mounted.",
                     .it = "Il portautensile sta sempre su una testa: senza testa non si può richiamare. Scrivere la "
                           "testa, da 1 a 9, come prima cifra della T. Con T000000 si indica che non è montato nulla."},
     .wrong = "M06 [!T030207!]\nM02\n",
     .right = "M06 T130207\nM02\n"},
    {.code = "ISO013",
     .name = "holder-not-selected",
     .severity = Severity::Error,
     .section = "I.4.3",
     .arguments = {"tool"},
     .title = {.en = "Holder not selected", .it = "Portautensile non selezionato"},
     .message = {.en = "tool {tool} has no holder: the second and third digits of T are 0",
                 .it = "l'utensile {tool} non ha portautensile: la seconda e la terza cifra di T sono 0"},
     .explanation = {.en = "A tool is always mounted in a holder, so a tool without a holder cannot be called. Write "
                           "the holder, from 01 to 99, as the second and third digits of T. If no tool is mounted, "
                           "the last three digits are 000.",
                     .it = "L'utensile sta sempre in un portautensile: senza portautensile non si può richiamare. "
                           "Scrivere il portautensile, da 01 a 99, come seconda e terza cifra della T. Se l'utensile "
                           "non è montato, le ultime tre cifre sono 000."},
     .wrong = "M06 [!T100207!]\nM02\n",
     .right = "M06 T130207\nM02\n"},
    {.code = "ISO014",
     .name = "tool-change-without-tool",
     .severity = Severity::Error,
     .section = "I.4.3",
     .arguments = {},
     .title = {.en = "Tool change without a tool", .it = "Cambio utensile senza T"},
     .message =
         {.en = "no T follows {text}: write it directly after, with the tool to mount, as in M06 T101001",
          .it = "alla {text} non segue la T: scriverla subito dopo, con l'utensile da montare, come in M06 T101001"},
     .causes = {{.cause = "tool-elsewhere",
                 .message = {.en = "{other} does not follow {text} at once: write both together, as in M06 T101001",
                             .it = "{other} non segue subito la {text}: scriverle insieme, come in M06 T101001"},
                 .wrong = "[!M06!] S5000 T101001\nM02\n"}},
     .explanation = {.en = "M06 must be followed at once by the T of the tool to load. Write both together and in "
                           "this order: M06 T101001. A T before M06, on another line or after another word does not "
                           "count.",
                     .it = "Alla M06 deve seguire subito la T dell'utensile da montare. Scriverle insieme e in "
                           "quest'ordine: M06 T101001. Una T prima della M06, su un'altra linea o dopo un'altra "
                           "parola non vale."},
     .wrong = "[!M06!]\nM02\n",
     .right = "M06 T101001\nM02\n"},
    {.code = "ISO015",
     .name = "spindle-speed-not-positive",
     .severity = Severity::Error,
     .section = "I.4.2",
     .arguments = {"speed"},
     .title = {.en = "Spindle speed not positive", .it = "Velocità del mandrino negativa o nulla"},
     .message = {.en = "spindle speed {speed} rev/min: S must be greater than 0",
                 .it = "velocità del mandrino {speed} giri/min: la S deve essere maggiore di 0"},
     .explanation = {.en = "S gives the spindle speed only, neither the stop nor the direction, so it is always "
                           "positive. To stop the spindle write M05. To turn it counterclockwise write M04 and a "
                           "positive S.",
                     .it = "La S dà solo la velocità del mandrino, non l'arresto né il senso di rotazione, perciò è "
                           "sempre positiva. Per arrestare il mandrino scrivere M05. Per la rotazione antioraria "
                           "scrivere M04 con una S positiva."},
     .wrong = "[!S-5000!] M03\nM02\n",
     .right = "S5000 M03\nM02\n"},
    {.code = "ISO016",
     .name = "repeated-argument",
     .severity = Severity::Error,
     .section = "I.7",
     .arguments = {},
     .title = {.en = "Repeated argument", .it = "Argomento ripetuto"},
     .message = {.en = "{text} comes after {other}: a command takes each letter once",
                 .it = "{text} viene dopo {other}: un comando ammette ogni lettera una sola volta"},
     .explanation = {.en = "Each letter may be given once per command: the control does not choose between two "
                           "values. Delete the wrong one or correct its letter.",
                     .it = "Ogni lettera si può dare una sola volta per comando: fra due valori il controllo non "
                           "sceglie. Cancellare quello sbagliato o correggerne la lettera."},
     .wrong = "M06 T101001\nG00 X10 [!X20!]\nM02\n",
     .right = "M06 T101001\nG00 X10 Y20\nM02\n"},
    {.code = "ISO017",
     .name = "missing-arguments",
     .severity = Severity::Error,
     .section = "I.7",
     .arguments = {},
     .title = {.en = "Missing arguments", .it = "Mancanza di argomenti"},
     .message = {.en = "{text} has no argument: it needs at least one of X, Y, Z, B and C",
                 .it = "{text} senza argomenti: ne serve almeno uno fra X, Y, Z, B e C"},
     .explanation = {.en = "Without arguments the control does not know what the command should do. After G29 write "
                           "at least one of X, Y, Z (origin), C and B (angles). Those left out are 0.",
                     .it = "Senza argomenti il controllo non sa che cosa fare del comando. Dopo la G29 scrivere "
                           "almeno una fra X, Y, Z (origine), C e B (angoli). Quelle omesse valgono 0."},
     .wrong = "[!G29!]\nM02\n",
     .right = "G29 X100 C90\nM02\n"},
    {.code = "ISO018",
     .name = "frame-not-alone",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Reference frame not alone on its line", .it = "Sistema di riferimento non da solo sulla linea"},
     .message = {.en = "{text} must stand alone on its line with its own arguments, without {other}",
                 .it = "{text} deve stare da sola sulla linea con i suoi argomenti, senza {other}"},
     .explanation = {.en = "On a line that changes the reference frame anything else could be taken in the old frame "
                           "or in the new one. Put the other words on a line before or after it; only a line number N "
                           "may stay. Check the letters too: G92 takes X Y Z, G29 takes X Y Z B C, G27 takes none.",
                     .it = "Su una linea che cambia sistema di riferimento ogni altra parola potrebbe valere per il "
                           "vecchio sistema o per il nuovo. Spostare le altre parole su una linea prima o dopo; può "
                           "restare solo il numero di riga N. Controllare anche le lettere: la G92 ammette X Y Z, la "
                           "G29 X Y Z B C, la G27 nessuna."},
     .wrong = "G90 [!G92!] X100 Y50\nM02\n",
     .right = "G90\nG92 X100 Y50\nM02\n"},
    {.code = "ISO019",
     .name = "missing-i-vector",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Missing axis vector i", .it = "Mancanza del versore i"},
     .message = {.en = "{text} has no axis vector i, the direction of the face's X axis",
                 .it = "{text} senza il versore i, che dà la direzione dell'asse X della faccia"},
     .explanation = {.en = "A face frame needs the directions of all three axes, each with at least one component. "
                           "The components of i are X Y Z with G28, A B C with G24; those left out are 0. On this "
                           "control G28 mounts a face frame: it is no return to the reference point.",
                     .it = "Una faccia vuole la direzione di tutti e tre gli assi, ciascuna "
                           "con almeno una componente. Le componenti di i sono X Y Z con la G28, A B C con la G24; "
                           "quelle omesse valgono 0. Su questo controllo la G28 mette in presa una faccia, non è un "
                           "ritorno allo zero macchina."},
     .wrong = "[!G28!] I-1 R1\nM02\n",
     .right = "G28 Y1 I-1 R1\nM02\n"},
    {.code = "ISO020",
     .name = "missing-j-vector",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Missing axis vector j", .it = "Mancanza del versore j"},
     .message = {.en = "{text} has no axis vector j, the direction of the face's Y axis",
                 .it = "{text} senza il versore j, che dà la direzione dell'asse Y della faccia"},
     .explanation = {.en = "A face frame needs the directions of all three axes, each with at least one component. "
                           "The components of j are I J K; those left out are 0. On this control G28 mounts a face "
                           "frame: it is no return to the reference point.",
                     .it = "Una faccia vuole la direzione di tutti e tre gli assi, ciascuna "
                           "con almeno una componente. Le componenti di j sono I J K; quelle omesse valgono 0. Su "
                           "questo controllo la G28 mette in presa una faccia, non è un ritorno allo zero "
                           "macchina."},
     .wrong = "[!G28!] Y1 R1\nM02\n",
     .right = "G28 Y1 I-1 R1\nM02\n"},
    {.code = "ISO021",
     .name = "missing-k-vector",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Missing axis vector k", .it = "Mancanza del versore k"},
     .message = {.en = "{text} has no axis vector k, the direction of the face's Z axis",
                 .it = "{text} senza il versore k, che dà la direzione dell'asse Z della faccia"},
     .explanation = {.en = "A face frame needs the directions of all three axes, each with at least one component. "
                           "The components of k are P Q R; those left out are 0. On this control G28 mounts a face "
                           "frame: it is no return to the reference point.",
                     .it = "Una faccia vuole la direzione di tutti e tre gli assi, ciascuna "
                           "con almeno una componente. Le componenti di k sono P Q R; quelle omesse valgono 0. Su "
                           "questo controllo la G28 mette in presa una faccia, non è un ritorno allo zero "
                           "macchina."},
     .wrong = "[!G28!] Y1 I-1\nM02\n",
     .right = "G28 Y1 I-1 R1\nM02\n"},
    {.code = "ISO022",
     .name = "zero-axis-vector",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Axis vector of length zero", .it = "Versore a modulo nullo"},
     .message = {.en = "{text}: an axis vector of length 0 has no direction; G24 and G28 mount a face frame here",
                 .it = "{text}: un versore a modulo nullo non ha direzione; qui G24 e G28 mettono in presa una faccia"},
     .explanation = {.en = "An axis of the face must point somewhere, so at least one of its components must differ "
                           "from 0. Correct the components. Their size does not matter, only the direction that they "
                           "give. G28 X0 Y0, with which other controls return to their reference point, moves nothing "
                           "here: write a G00 to where the tool should go.",
                     .it = "Un asse della faccia deve avere una direzione: almeno una componente deve essere diversa "
                           "da 0. Correggere le componenti. La loro grandezza non conta, conta solo la direzione che "
                           "danno. G28 X0 Y0, con cui altri controlli tornano al punto di riferimento, qui non muove "
                           "nulla: scrivere una G00 verso la posizione voluta."},
     .wrong = "G28 [!X0 Y0 Z0!] I-1 R1\nM02\n",
     .right = "G28 X0 Y1 Z0 I-1 R1\nM02\n"},
    {.code = "ISO023",
     .name = "coplanar-axis-vectors",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Coplanar axis vectors", .it = "Terna di versori complanari"},
     .message = {.en = "the three axis vectors of {text} lie in one plane: one must lead out of it",
                 .it = "i tre versori della {text} sono complanari: uno deve uscire dal piano degli altri due"},
     .explanation = {.en = "Three axes in one plane make no frame in space. They need not be at right angles, but "
                           "none may lie in the plane of the other two. Often two vectors are the same or a component "
                           "has the wrong letter, such as P for R: check them one by one.",
                     .it = "Tre assi su uno stesso piano non formano un sistema di riferimento nello spazio. Non "
                           "occorre che siano ortogonali, ma nessuno può giacere nel piano degli altri due. Spesso "
                           "due versori coincidono o una componente ha la lettera sbagliata, per esempio P al posto "
                           "di R: controllarle una per una."},
     .wrong = "[!G28!] X1 J1 P1\nM02\n",
     .right = "G28 X1 J1 R1\nM02\n"},
    {.code = "ISO024",
     .name = "face-already-mounted",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Face frame already in force", .it = "Faccia già in presa"},
     .message = {.en = "a face frame is in force already: dismount it with G27 before {text}",
                 .it = "c'è già una faccia in presa: smontarla con la G27 prima della {text}"},
     .explanation = {.en = "The control does not pass straight from one face frame to another. Write G27 on a line of "
                           "its own before this one. The rule is the same for G24, G28 and G29.",
                     .it = "Il controllo non passa direttamente da una faccia a un'altra. "
                           "Scrivere prima una G27 su una linea a sé. La regola è la stessa per G24, G28 e G29."},
     .wrong = "G29 X100 C90\n[!G29!] Y100 C-90\nM02\n",
     .right = "G29 X100 C90\nG27\nG29 Y100 C-90\nM02\n"},
    {.code = "ISO025",
     .name = "missing-origin",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Missing origin", .it = "Mancanza delle coordinate dell'origine"},
     .message = {.en = "{text} has no origin: at least one of X, Y and Z is needed",
                 .it = "{text} senza origine: serve almeno una fra X, Y e Z"},
     .explanation = {.en = "G92 sets the workpiece zero and needs at least one of its coordinates, even if it is 0. "
                           "Those left out are 0. G92 X0 Y0 Z0 goes back to the machine frame.",
                     .it = "La G92 fissa lo zero pezzo e vuole almeno una delle sue coordinate, anche nulla. Quelle "
                           "omesse valgono 0. Con G92 X0 Y0 Z0 si torna al sistema di riferimento di macchina."},
     .wrong = "[!G92!]\nM02\n",
     .right = "G92 X100 Y50\nM02\n"},
    {.code = "ISO026",
     .name = "missing-coordinate",
     .severity = Severity::Error,
     .section = "I.3.4",
     .arguments = {"g"},
     .title = {.en = "Missing coordinate", .it = "Nessuna quota specificata"},
     .message = {.en = "{text} has no coordinate: write at least one directly after it",
                 .it = "{text} senza alcuna quota: scriverne almeno una subito dopo"},
     .causes = {{.cause = "series-broken",
                 .message = {.en = "{other} cuts {text} off from its coordinates: write them directly after {text}",
                             .it = "{other} stacca la {text} dalle sue quote: scriverle subito dopo la {text}"},
                 .wrong = "M06 T101001\n[!G00!] S5000 X10\nM02\n"},
                {.cause = "continuation",
                 .message = {.en = "{g} is still in force, but {text} gives it no end: a coordinate is missing",
                             .it = "è ancora in presa la {g}, ma {text} non ne dà il punto finale: manca una quota"},
                 .wrong = "M06 T101001\nG02 X10 Y10 R10 F1000\n[!I10!] J0\nM02\n"}},
     .explanation = {.en = "A motion G needs at least one coordinate directly after it, even if it is meant for the "
                           "lines that follow. Write the coordinate right after the G. S or N in between cuts the "
                           "coordinate off from its G.",
                     .it = "Una G di movimento vuole almeno una quota subito dopo, anche quando dovrebbe servire "
                           "solo per le linee successive. Scrivere la quota subito dopo la G. Una S o una N in mezzo "
                           "stacca la quota dalla sua G."},
     .wrong = "M06 T101001\n[!G00!]\nX10 Y20\nM02\n",
     .right = "M06 T101001\nG00 X10 Y20\nM02\n"},
    {.code = "ISO027",
     .name = "arc-end-outside-plane",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {"g", "axis", "otheraxis"},
     .title = {.en = "Arc end outside the plane", .it = "Punto finale dell'arco fuori dal piano"},
     .message = {.en = "with {g} in force an arc needs an end in {axis} or {otheraxis}: {text} is not enough",
                 .it = "con la {g} in presa un arco vuole una quota finale {axis} o {otheraxis}: {text} non basta"},
     .explanation = {.en = "The end of an arc needs at least one of the two coordinates of its plane. Add it, or "
                           "select the right plane with G17, G18 or G19. The third coordinate may be added to make a "
                           "helix. For a full turn repeat a coordinate of the start.",
                     .it = "Il punto finale di un arco vuole almeno una delle due quote del suo piano. "
                           "Aggiungerla, oppure selezionare il piano giusto con G17, G18 o G19. La terza quota si può "
                           "aggiungere per un'elica. Per un giro completo ripetere una quota del punto iniziale."},
     .wrong = "M06 T101001\nG00 Z5\nG02 [!Z-3!] R10 F1000\nM02\n",
     .right = "M06 T101001\nG00 Z5\nG02 X10 Y10 Z-3 R10 F1000\nM02\n"},
    {.code = "ISO028",
     .name = "circle-not-given",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {"g", "center", "othercenter"},
     .title = {.en = "Circle not given", .it = "Mancanza dei dati del cerchio"},
     .message = {.en = "{text} has neither radius nor center: write R, or {center} and {othercenter}",
                 .it = "{text} senza raggio né centro: scrivere R, oppure {center} e {othercenter}"},
     .causes = {{.cause = "continuation",
                 .message = {.en = "{g} is still in force, and {text} has no radius or center: is G01 missing?",
                             .it = "è ancora in presa la {g}, e {text} non ha raggio né centro: manca una G01?"},
                 .wrong = "M06 T101001\nG02 X10 Y10 R10 F1000\n[!X20!] Y10\nM02\n"}},
     .explanation = {.en = "Many circles pass through the same start and end, so the control needs the radius or the "
                           "center. Add R for an arc of up to 180°, or the center: I J with G17, I K with G18, J K "
                           "with G19. With G90 the center is given as a position, with G91 as a distance from the "
                           "start.",
                     .it = "Per gli stessi punti iniziale e finale passano molti cerchi: al controllo serve il "
                           "raggio o il centro. Aggiungere R per un arco fino a 180°, oppure il centro: I J con G17, "
                           "I K con G18, J K con G19. Con la G90 il centro si dà come posizione, con la G91 come "
                           "distanza dal punto iniziale."},
     .wrong = "M06 T101001\n[!G02!] X10 Y10 F1000\nM02\n",
     .right = "M06 T101001\nG02 X10 Y10 R10 F1000\nM02\n"},
    {.code = "ISO029",
     .name = "arc-radius-mismatch",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {"radius", "distance"},
     .title = {.en = "Radius and center do not agree", .it = "Raggio e centro incongruenti"},
     .message = {.en = "the radius is {radius} mm, but the center is {distance} mm from the start",
                 .it = "il raggio è di {radius} mm, ma il centro dista {distance} mm dal punto iniziale"},
     .explanation = {.en = "Radius and center given together must describe the same circle. Correct the wrong one, or "
                           "delete it: either is enough. With G90 I, J and K are the position of the center, with G91 "
                           "its distance from the start.",
                     .it = "Raggio e centro dati insieme devono descrivere lo stesso cerchio. Correggere quello "
                           "sbagliato o toglierlo: ne basta uno. Con la G90 I, J e K danno la posizione del centro, "
                           "con la G91 la sua distanza dal punto iniziale."},
     .wrong = "M06 T101001\nG02 X10 Y10 I10 J0 [!R12!] F1000\nM02\n",
     .right = "M06 T101001\nG02 X10 Y10 I10 J0 R10 F1000\nM02\n"},
    {.code = "ISO030",
     .name = "arc-radius-too-small",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {"radius", "needed"},
     .title = {.en = "Arc radius too small", .it = "Raggio del cerchio insufficiente"},
     .message =
         {.en = "with R {radius} mm the arc does not reach its end: R must be at least {needed} mm, half the distance",
          .it = "con R {radius} mm l'arco non arriva al punto finale: R deve essere di almeno {needed} mm, metà della "
                "distanza"},
     .causes = {{.cause = "not-positive",
                 .message = {.en = "{text}: R must be greater than 0; for more than 180° give the center",
                             .it = "{text}: R deve essere maggiore di 0; oltre i 180° dare il centro"},
                 .wrong = "M06 T101001\nG02 X10 Y10 [!R-10!] F1000\nM02\n"}},
     .explanation =
         {.en = "No circle of this radius reaches from the start of the arc to its end. Enlarge R, or "
                "check the two points: R cannot be less than half the distance between them. R is always "
                "positive: for an arc of more than 180° give the center, not a negative R.",
          .it = "Con questo raggio nessun cerchio arriva dal punto iniziale dell'arco a quello finale. "
                "Aumentare R o controllare i due punti: R non può essere minore di metà della loro "
                "distanza. La R è sempre positiva: per un arco oltre i 180° dare il centro, non una R negativa."},
     .wrong = "M06 T101001\nG02 X30 [!R10!] F1000\nM02\n",
     .right = "M06 T101001\nG02 X30 R20 F1000\nM02\n"},
    {.code = "ISO031",
     .name = "arc-center-mismatch",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {"start", "end"},
     .title = {.en = "Arc center does not fit", .it = "Centro dell'arco incongruente"},
     .message = {.en = "the center must be equally far from both ends of the arc: it is {start} mm from the start and "
                       "{end} mm from the end",
                 .it = "il centro deve avere la stessa distanza dai due estremi dell'arco: dista {start} mm dal punto "
                       "iniziale e {end} mm da quello finale"},
     .causes =
         {{.cause = "from-start",
           .message = {.en = "in G90 the center {text} is a position, not a distance from the start: it is {start} mm "
                             "from the start and {end} mm from the end of the arc, which must be equal",
                       .it = "in G90 il centro {text} è una posizione, non una distanza dal punto iniziale: dista "
                             "{start} mm dal punto iniziale e {end} mm da quello finale, e le due distanze devono "
                             "essere uguali"},
           .wrong = "M06 T101001\nG00 X100\nG02 X120 Y0 [!I10 J0!] F1000\nM02\n"},
          {.cause = "on-start",
           .message = {.en = "with {text} the center is the start of the arc, which leaves no radius",
                       .it = "con {text} il centro è il punto iniziale dell'arco: il raggio è nullo"},
           .wrong = "M06 T101001\nG02 X10 Y10 [!I0 J0!] F1000\nM02\n"}},
     .explanation = {.en = "Start and end of an arc must lie on one circle, equally far from its center and not on "
                           "it. Check the center and the end point. With G90 I, J and K are the position of the "
                           "center, with G91 its distance from the start.",
                     .it = "I punti iniziale e finale devono stare sullo stesso cerchio, alla stessa distanza dal "
                           "centro e non sul centro stesso. Controllare il centro e il punto finale. Con la G90 I, J "
                           "e K danno la posizione del centro, con la G91 la sua distanza dal punto iniziale."},
     .wrong = "M06 T101001\nG02 X10 Y10 [!I10 J5!] F1000\nM02\n",
     .right = "M06 T101001\nG02 X10 Y10 I10 J0 F1000\nM02\n"},
    {.code = "ISO032",
     .name = "five-axis-not-enabled",
     .severity = Severity::Error,
     .folds = FoldKind::FiveAxes,
     .section = "I.3.5",
     .arguments = {},
     .title = {.en = "Five-axis interpolation not enabled", .it = "Interpolazione a 5 assi non abilitata"},
     .message = {.en =
                     "with G48 in force no rotary axis may turn in a feed move: for {text} write G49 on a line before",
                 .it = "con la G48 in presa i rotanti non si muovono in lavoro: per {text} scrivere prima una G49 su "
                       "una linea a sé"},
     .explanation = {.en = "With G48 in force B and C may move in rapid only, not in a feed move. Write G49 on a line "
                           "of its own before this move, or position the rotary axes with G00 first.",
                     .it = "Con la G48 in presa B e C si muovono solo in rapido, non in lavoro. Scrivere prima una G49 "
                           "su una linea a sé, oppure posizionare i rotanti con una G00."},
     .wrong = "M06 T101001\nG01 X10 [!C45!] F1000\nM02\n",
     .right = "M06 T101001\nG49\nG01 X10 C45 F1000\nM02\n"},
    {.code = "ISO033",
     .name = "g48-g49-not-alone",
     .severity = Severity::Error,
     .section = "I.3.5",
     .arguments = {},
     .title = {.en = "G48 or G49 not alone on its line", .it = "G48/G49 non da sola sulla linea"},
     .message = {.en = "{text} must stand alone on its line, without {other}",
                 .it = "{text} deve stare da sola sulla linea, senza {other}"},
     .explanation = {.en = "The control changes between three-axis and five-axis interpolation only on a line that "
                           "holds nothing else. Move the other words to the next line, where the new setting holds. A "
                           "line number N may stay.",
                     .it = "Il controllo cambia fra interpolazione a 3 e a 5 assi solo su una linea che non contiene "
                           "altro. Spostare le altre parole sulla linea successiva, dove vale la nuova impostazione. "
                           "Il numero di riga N può restare."},
     .wrong = "M06 T101001\n[!G49!] G01 X10 C45 F1000\nM02\n",
     .right = "M06 T101001\nG49\nG01 X10 C45 F1000\nM02\n"},
    {.code = "ISO034",
     .name = "misplaced-g41-g42",
     .severity = Severity::Error,
     .section = "I.7",
     .arguments = {},
     .title = {.en = "Misplaced G41 or G42", .it = "Posizione errata della G41/G42"},
     .message = {.en = "{text} must stand alone or before the motion on its line",
                 .it = "{text} deve stare da sola o prima del movimento della linea"},
     .explanation = {.en = "Cutter compensation must be known before the motion to which it applies. Write G41 or G42 "
                           "before the motion G, or on a line of its own.",
                     .it = "La correzione raggio fresa deve essere nota prima del movimento a cui si applica. "
                           "Scrivere la G41 o la G42 prima della G di movimento, oppure su una linea a sé."},
     .wrong = "M06 T101001\nG01 X10 F1000 [!G41!]\nG01 Y20 G40\nM02\n",
     .right = "M06 T101001\nG41 G01 X10 F1000\nG01 Y20 G40\nM02\n"},
    {.code = "ISO035",
     .name = "misplaced-g40",
     .severity = Severity::Error,
     .section = "I.7",
     .arguments = {},
     .title = {.en = "Misplaced G40", .it = "Posizione errata della G40"},
     .message = {.en = "{text} must stand alone or after the line's motion and coordinates",
                 .it = "{text} deve stare da sola o dopo il movimento della linea e le sue quote"},
     .explanation = {.en = "Cutter compensation is switched off once the last compensated motion is complete, not "
                           "before it. Write G40 after the coordinates of that motion, or on a line of its own. In a "
                           "start line with several G codes it needs its own line too.",
                     .it = "La correzione raggio fresa si toglie quando l'ultimo movimento compensato è completo, non "
                           "prima. Scrivere la G40 dopo le quote di quel movimento, oppure su una linea a sé. Anche "
                           "fra le impostazioni di inizio programma la G40 va su una linea sua."},
     .wrong = "M06 T101001\nG41 G01 X10 F1000\n[!G40!] G01 Y20\nM02\n",
     .right = "M06 T101001\nG41 G01 X10 F1000\nG01 Y20 G40\nM02\n"},
    {.code = "ISO036",
     .name = "negative-dwell",
     .severity = Severity::Error,
     .section = "I.3.10",
     .arguments = {"seconds"},
     .title = {.en = "Negative dwell time", .it = "Tempo di attesa negativo"},
     .message = {.en = "dwell time {seconds} s: P must not be negative",
                 .it = "tempo di attesa {seconds} s: la P non può essere negativa"},
     .explanation = {.en = "P is the time to wait in seconds, and waiting less than 0 seconds makes no sense. Write a "
                           "positive value. 0 is allowed and does not wait.",
                     .it = "La P è il tempo di attesa in secondi, e un'attesa negativa non ha senso. Scrivere un "
                           "valore positivo. Lo zero è ammesso e non fa attendere."},
     .wrong = "G04 [!P-2!]\nM02\n",
     .right = "G04 P2\nM02\n"},
    {.code = "ISO037",
     .name = "g04-not-alone",
     .severity = Severity::Error,
     .section = "I.3.10",
     .arguments = {},
     .title = {.en = "G04 not alone on its line", .it = "G04 non da sola sulla linea"},
     .message = {.en = "{text} must stand alone on its line with its P, without {other}",
                 .it = "{text} deve stare da sola sulla linea con la sua P, senza {other}"},
     .explanation =
         {.en = "A dwell needs a line of its own: it could otherwise come before or after the other words "
                "of the line. Move them to the line before or after, as they should be executed. A line "
                "number N may stay.",
          .it = "L'attesa vuole una linea a sé: altrimenti non sarebbe chiaro se viene prima o dopo le "
                "altre parole. Spostarle sulla linea precedente o su quella successiva, nell'ordine voluto. Il "
                "numero di riga N può restare."},
     .wrong = "S5000 M03 [!G04!] P2\nM02\n",
     .right = "S5000 M03\nG04 P2\nM02\n"},
    {.code = "ISO038",
     .name = "stray-center-k",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Center with K in G17", .it = "Centro con K in G17"},
     .message = {.en = "{text}: in the XY plane (G17) the center takes I and J only",
                 .it = "{text}: nel piano XY (G17) il centro si dà solo con I e J"},
     .explanation = {.en = "K is the Z of a center, which means nothing in the XY plane. Delete K or replace it with "
                           "the right letter. If another plane was meant, select it before the arc: G18 takes I and "
                           "K, G19 takes J and K.",
                     .it = "La K è la Z del centro, che nel piano XY non ha senso. Togliere la K o sostituirla con "
                           "la lettera giusta. Se si intendeva un altro piano, selezionarlo prima dell'arco: con G18 "
                           "I e K, con G19 J e K."},
     .wrong = "M06 T101001\nG02 X10 Y10 I10 [!K0!] F1000\nM02\n",
     .right = "M06 T101001\nG02 X10 Y10 I10 J0 F1000\nM02\n"},
    {.code = "ISO039",
     .name = "stray-center-j",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Center with J in G18", .it = "Centro con J in G18"},
     .message = {.en = "{text}: in the ZX plane (G18) the center takes I and K only",
                 .it = "{text}: nel piano ZX (G18) il centro si dà solo con I e K"},
     .explanation = {.en = "J is the Y of a center, which means nothing in the ZX plane. Delete J or replace it with "
                           "the right letter. If another plane was meant, select it before the arc: G17 takes I and "
                           "J, G19 takes J and K.",
                     .it = "La J è la Y del centro, che nel piano ZX non ha senso. Togliere la J o sostituirla con "
                           "la lettera giusta. Se si intendeva un altro piano, selezionarlo prima dell'arco: con G17 "
                           "I e J, con G19 J e K."},
     .wrong = "M06 T101001\nG18 G02 X10 Z10 I10 [!J0!] F1000\nM02\n",
     .right = "M06 T101001\nG18 G02 X10 Z10 I10 K0 F1000\nM02\n"},
    {.code = "ISO040",
     .name = "stray-center-i",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Center with I in G19", .it = "Centro con I in G19"},
     .message = {.en = "{text}: in the YZ plane (G19) the center takes J and K only",
                 .it = "{text}: nel piano YZ (G19) il centro si dà solo con J e K"},
     .explanation = {.en = "I is the X of a center, which means nothing in the YZ plane. Delete I or replace it with "
                           "the right letter. If another plane was meant, select it before the arc: G17 takes I and "
                           "J, G18 takes I and K.",
                     .it = "La I è la X del centro, che nel piano YZ non ha senso. Togliere la I o sostituirla con "
                           "la lettera giusta. Se si intendeva un altro piano, selezionarlo prima dell'arco: con G17 "
                           "I e J, con G18 I e K."},
     .wrong = "M06 T101001\nG19 G02 Y10 Z10 [!I10!] K0 F1000\nM02\n",
     .right = "M06 T101001\nG19 G02 Y10 Z10 J10 K0 F1000\nM02\n"},
    {.code = "ISO041",
     .name = "inverse-time-feed-missing",
     .severity = Severity::Error,
     .folds = FoldKind::InverseTimeFeed,
     .section = "I.3.7",
     .arguments = {},
     .title = {.en = "F missing in inverse time", .it = "F mancante con la G93"},
     .message = {.en = "{text} has no F: with G93 in force every feed move needs its own",
                 .it = "{text} senza F: con la G93 in presa ogni movimento in lavoro vuole la sua"},
     .explanation =
         {.en = "In inverse time (G93) F belongs to one move only: it is 1 divided by the minutes that the "
                "move should take. Write F on this line, or return to feed rate per minute with G94.",
          .it = "Con l'inverso del tempo (G93) la F vale per un solo movimento: è 1 diviso la durata voluta in minuti. "
                "Scrivere la F su questa linea, oppure tornare con la G94 all'avanzamento al minuto."},
     .wrong = "M06 T101001\nG93 G01 X10 F4\n[!G01!] Y20\nM02\n",
     .right = "M06 T101001\nG93 G01 X10 F4\nG01 Y20 F4\nM02\n"},
    {.code = "ISO042",
     .name = "feed-not-positive",
     .severity = Severity::Error,
     .section = "I.3.7",
     .arguments = {"feed"},
     .title = {.en = "Feed rate not positive", .it = "Avanzamento negativo o nullo"},
     .message = {.en = "feed rate {feed}: F must be greater than 0",
                 .it = "avanzamento {feed}: la F deve essere maggiore di 0"},
     .explanation =
         {.en = "With a feed rate of 0 or less the tool would never arrive. Write a positive F: the "
                "direction comes from the coordinates. This holds for an F next to G00 too, although it is "
                "ignored there.",
          .it = "Con un avanzamento negativo o nullo l'utensile non arriverebbe mai. Scrivere una F positiva: il verso "
                "del movimento lo danno le quote. Vale anche per una F accanto a una G00, dove pure viene ignorata."},
     .wrong = "M06 T101001\nG01 X10 F1000\nG01 Y20 [!F0!]\nM02\n",
     .right = "M06 T101001\nG01 X10 F1000\nG01 Y20 F500\nM02\n"},
    {.code = "ISO043",
     .name = "m02-not-alone",
     .severity = Severity::Error,
     .section = "I.4.1",
     .arguments = {},
     .title = {.en = "M02 not alone on its line", .it = "M02 non da sola sulla linea"},
     .message = {.en = "{text} must stand alone on its line, without {other}",
                 .it = "{text} deve stare da sola sulla linea, senza {other}"},
     .explanation = {.en = "The program end needs a line of its own, with a line number N at most. Move the other "
                           "words to the line before: what comes after M02 is ignored.",
                     .it = "La fine del programma vuole una linea a sé, al più con il numero di riga N. Spostare le "
                           "altre parole sulla linea precedente: ciò che segue la M02 viene ignorato."},
     .wrong = "M06 T101001\nG00 Z50 [!M02!]\n",
     .right = "M06 T101001\nG00 Z50\nM02\n"},
    {.code = "ISO044",
     .name = "initial-tool-missing",
     .severity = Severity::Error,
     .section = "I.4.3",
     .arguments = {},
     .title = {.en = "Initial tool missing", .it = "Attrezzaggio iniziale mancante"},
     .message = {.en = "no tool change before the first motion: write M06 and its T first",
                 .it = "nessun cambio utensile prima del primo movimento: scrivere prima M06 e la sua T"},
     .explanation = {.en = "Before the first motion the control must know which head, holder and tool are mounted. "
                           "Write M06 and its T on a line before it, for example M06 T101001. To move without a tool "
                           "write M06 T000000.",
                     .it = "Prima del primo movimento il controllo deve sapere quali testa, portautensile e utensile "
                           "sono montati. Scrivere prima una M06 con la sua T, per esempio M06 T101001. Per muoversi "
                           "senza utensile scrivere M06 T000000."},
     .wrong = "[!G00!] X10\nM02\n",
     .right = "M06 T101001\nG00 X10\nM02\n"},
    {.code = "ISO045",
     .name = "m02-missing",
     .severity = Severity::Error,
     .section = "I.4.1",
     .arguments = {},
     .title = {.en = "M02 missing", .it = "Mancanza della M02"},
     .message = {.en = "the program ends here without M02", .it = "il programma finisce qui senza M02"},
     .explanation = {.en = "Every program must end with M02 on a line of its own. Add it after the last line. If an "
                           "IF jumps past an M02, the lines that it jumps to need one as well.",
                     .it = "Ogni programma deve finire con una M02 su una linea a sé. Aggiungerla dopo l'ultima "
                           "linea. Se un IF salta oltre una M02, ne serve una anche per le linee a cui si salta."},
     .wrong = "M06 T101001\n[!G00 X10!]\n",
     .right = "M06 T101001\nG00 X10\nM02\n"},
    {.code = "ISO046",
     .name = "repeated-spindle-speed",
     .severity = Severity::Error,
     .section = "I.4.2",
     .arguments = {},
     .title = {.en = "Repeated spindle speed", .it = "S ripetuta"},
     .message = {.en = "{text} comes after {other}: a line takes one S",
                 .it = "{text} viene dopo {other}: su una linea è ammessa una sola S"},
     .explanation = {.en = "The control sets one spindle speed per line and does not choose between two. Delete the "
                           "wrong S, or put it on another line.",
                     .it = "Il controllo imposta una sola velocità del mandrino per linea: fra due valori non "
                           "sceglie. Cancellare la S sbagliata o spostarla su un'altra linea."},
     .wrong = "S5000 [!S6000!] M03\nM02\n",
     .right = "S5000 M03\nM02\n"},
    {.code = "ISO047",
     .name = "linear-coordinate-missing",
     .severity = Severity::Error,
     .folds = FoldKind::FiveAxes,
     .section = "I.3.4.2",
     .arguments = {},
     .title = {.en = "Linear coordinate missing", .it = "Quota lineare mancante"},
     .message = {.en = "{text} without X, Y or Z: with G48 in force a G01 needs at least one",
                 .it = "{text} senza X, Y o Z: con la G48 in presa la G01 ne vuole almeno una"},
     .explanation = {.en = "In three-axis interpolation (G48) G01 moves the linear axes, so one of them must be "
                           "given. Add the coordinate. To turn B or C alone use G00, or write G49 on a line of its "
                           "own before this one.",
                     .it = "Nell'interpolazione a 3 assi (G48) la G01 muove gli assi lineari: almeno una delle loro "
                           "quote va data. Aggiungerla. Per muovere solo B o C usare la G00, oppure scrivere prima "
                           "una G49 su una linea a sé."},
     .wrong = "M06 T101001\n[!G01!] C45 F1000\nM02\n",
     .right = "M06 T101001\nG49\nG01 C45 F1000\nM02\n"},
    {.code = "ISO048",
     .name = "center-undetermined-g17-i",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Center undetermined: I alone in G17", .it = "Centro non individuabile: solo I in G17"},
     .message = {.en = "{text} alone does not fix the center: start and end have the same Y",
                 .it = "{text} da sola non individua il centro: i punti iniziale e finale hanno la stessa Y"},
     .explanation = {.en = "From I alone the control works out the Y of the center only if start and end differ in Y. "
                           "Add J, or give the radius with R instead. A full circle always needs both I and J.",
                     .it = "Con la sola I il controllo ricava la Y del centro solo se i punti iniziale e finale "
                           "hanno Y diverse. Aggiungere la J, oppure dare il raggio con R. Per un cerchio completo "
                           "servono sempre I e J."},
     .wrong = "M06 T101001\nG02 X20 [!I10!] F1000\nM02\n",
     .right = "M06 T101001\nG02 X20 I10 J0 F1000\nM02\n"},
    {.code = "ISO049",
     .name = "center-undetermined-g17-j",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Center undetermined: J alone in G17", .it = "Centro non individuabile: solo J in G17"},
     .message = {.en = "{text} alone does not fix the center: start and end have the same X",
                 .it = "{text} da sola non individua il centro: i punti iniziale e finale hanno la stessa X"},
     .explanation = {.en = "From J alone the control works out the X of the center only if start and end differ in X. "
                           "Add I, or give the radius with R instead. A full circle always needs both I and J.",
                     .it = "Con la sola J il controllo ricava la X del centro solo se i punti iniziale e finale "
                           "hanno X diverse. Aggiungere la I, oppure dare il raggio con R. Per un cerchio completo "
                           "servono sempre I e J."},
     .wrong = "M06 T101001\nG02 Y20 [!J10!] F1000\nM02\n",
     .right = "M06 T101001\nG02 Y20 I0 J10 F1000\nM02\n"},
    {.code = "ISO050",
     .name = "center-undetermined-g18-i",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Center undetermined: I alone in G18", .it = "Centro non individuabile: solo I in G18"},
     .message = {.en = "{text} alone does not fix the center: start and end have the same Z",
                 .it = "{text} da sola non individua il centro: i punti iniziale e finale hanno la stessa Z"},
     .explanation = {.en = "From I alone the control works out the Z of the center only if start and end differ in Z. "
                           "Add K, or give the radius with R instead. A full circle always needs both I and K.",
                     .it = "Con la sola I il controllo ricava la Z del centro solo se i punti iniziale e finale "
                           "hanno Z diverse. Aggiungere la K, oppure dare il raggio con R. Per un cerchio completo "
                           "servono sempre I e K."},
     .wrong = "M06 T101001\nG18 G02 X20 [!I10!] F1000\nM02\n",
     .right = "M06 T101001\nG18 G02 X20 I10 K0 F1000\nM02\n"},
    {.code = "ISO051",
     .name = "center-undetermined-g18-k",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Center undetermined: K alone in G18", .it = "Centro non individuabile: solo K in G18"},
     .message = {.en = "{text} alone does not fix the center: start and end have the same X",
                 .it = "{text} da sola non individua il centro: i punti iniziale e finale hanno la stessa X"},
     .explanation = {.en = "From K alone the control works out the X of the center only if start and end differ in X. "
                           "Add I, or give the radius with R instead. A full circle always needs both I and K.",
                     .it = "Con la sola K il controllo ricava la X del centro solo se i punti iniziale e finale "
                           "hanno X diverse. Aggiungere la I, oppure dare il raggio con R. Per un cerchio completo "
                           "servono sempre I e K."},
     .wrong = "M06 T101001\nG18 G02 Z20 [!K10!] F1000\nM02\n",
     .right = "M06 T101001\nG18 G02 Z20 I0 K10 F1000\nM02\n"},
    {.code = "ISO052",
     .name = "center-undetermined-g19-j",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Center undetermined: J alone in G19", .it = "Centro non individuabile: solo J in G19"},
     .message = {.en = "{text} alone does not fix the center: start and end have the same Z",
                 .it = "{text} da sola non individua il centro: i punti iniziale e finale hanno la stessa Z"},
     .explanation = {.en = "From J alone the control works out the Z of the center only if start and end differ in Z. "
                           "Add K, or give the radius with R instead. A full circle always needs both J and K.",
                     .it = "Con la sola J il controllo ricava la Z del centro solo se i punti iniziale e finale "
                           "hanno Z diverse. Aggiungere la K, oppure dare il raggio con R. Per un cerchio completo "
                           "servono sempre J e K."},
     .wrong = "M06 T101001\nG19 G02 Y20 [!J10!] F1000\nM02\n",
     .right = "M06 T101001\nG19 G02 Y20 J10 K0 F1000\nM02\n"},
    {.code = "ISO053",
     .name = "center-undetermined-g19-k",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Center undetermined: K alone in G19", .it = "Centro non individuabile: solo K in G19"},
     .message = {.en = "{text} alone does not fix the center: start and end have the same Y",
                 .it = "{text} da sola non individua il centro: i punti iniziale e finale hanno la stessa Y"},
     .explanation = {.en = "From K alone the control works out the Y of the center only if start and end differ in Y. "
                           "Add J, or give the radius with R instead. A full circle always needs both J and K.",
                     .it = "Con la sola K il controllo ricava la Y del centro solo se i punti iniziale e finale "
                           "hanno Y diverse. Aggiungere la J, oppure dare il raggio con R. Per un cerchio completo "
                           "servono sempre J e K."},
     .wrong = "M06 T101001\nG19 G02 Z20 [!K10!] F1000\nM02\n",
     .right = "M06 T101001\nG19 G02 Z20 J0 K10 F1000\nM02\n"},
    {.code = "ISO054",
     .name = "tool-without-m06",
     .severity = Severity::Error,
     .section = "I.4.3",
     .arguments = {},
     .title = {.en = "T without M06", .it = "T senza M06"},
     .message = {.en = "{text} has no M06 before it: write M06 {text}",
                 .it = "{text} senza la sua M06: scrivere M06 {text}"},
     .explanation = {.en = "T has a meaning only as the argument of a tool change, directly after M06. Write M06 "
                           "T101001, in this order. T alone does not preselect a tool on this control.",
                     .it = "La T ha senso solo come argomento del cambio utensile, subito dopo la M06. Scrivere M06 "
                           "T101001, in quest'ordine. Su questo controllo la T da sola non preseleziona l'utensile."},
     .wrong = "[!T101001!]\nM02\n",
     .right = "M06 T101001\nM02\n"},
    {.code = "ISO055",
     .name = "workpiece-frame-under-face",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Workpiece frame changed under a face frame",
               .it = "Cambio del riferimento di pezzo con faccia in presa"},
     .message = {.en = "a face frame is in force: dismount it with G27 before {text}",
                 .it = "c'è una faccia in presa: smontarla con la G27 prima della {text}"},
     .explanation = {.en = "A face frame is measured from the workpiece frame, which therefore cannot change beneath "
                           "it. Write G27 on a line of its own before G92. If the face is still needed, mount it "
                           "again afterwards.",
                     .it = "La faccia parte dal riferimento di pezzo, che quindi non può cambiare mentre la faccia è "
                           "in presa. Scrivere prima della G92 una G27 su una linea a sé. Se la faccia "
                           "serve ancora, rimetterla in presa dopo."},
     .wrong = "G28 Y1 I-1 R1\n[!G92!] X200 Y50\nM02\n",
     .right = "G28 Y1 I-1 R1\nG27\nG92 X200 Y50\nM02\n"},
    {.code = "ISO056",
     .name = "invalid-line-number",
     .severity = Severity::Error,
     .section = "I.2.0",
     .arguments = {},
     .title = {.en = "Invalid line number", .it = "Numero di riga non valido"},
     .message = {.en = "{text} is not a line number: N takes a whole number, without sign, point or comma",
                 .it = "{text} non è un numero di riga: alla N segue un numero intero, senza segno, punto o virgola"},
     .causes = {{.cause = "second",
                 .message = {.en = "{text} is the second line number on this line: a line has one at most",
                             .it = "{text} è il secondo numero di riga su questa linea: ce ne può essere uno solo"},
                 .wrong = "M06 T101001\nN10 G00 X5 [!N20!]\nM02\n"}},
     .explanation = {.en = "After N the control expects a plain whole number, such as N20 or N20000. Correct it, or "
                           "delete the whole word: line numbers are optional.",
                     .it = "Dopo la N il controllo si aspetta un semplice numero intero, come N20 o N20000. "
                           "Correggerlo, oppure togliere tutta la parola: i numeri di riga non sono obbligatori."},
     .wrong = "M06 T101001\n[!N-5!] G00 X10\nM02\n",
     .right = "M06 T101001\nN5 G00 X10\nM02\n"},
    {.code = "ISO057",
     .name = "invalid-register-number",
     .severity = Severity::Error,
     .section = "I.6",
     .arguments = {},
     .title = {.en = "Invalid register number", .it = "Numero di registro non valido"},
     .message = {.en = "{text}: the number of a register is a whole number from 1 to 30, without sign or decimal point",
                 .it = "{text}: il numero di un registro è un intero da 1 a 30, senza segno né punto decimale"},
     .explanation = {.en = "The control has 30 registers, V1 to V30, and none in between. Correct the number after V. "
                           "Decimals are allowed in the value, after the = sign: V2 = 5.5.",
                     .it = "Il controllo ha 30 registri, da V1 a V30, senza decimali nel numero. Correggere il "
                           "numero dopo la V. I decimali sono ammessi nel valore, dopo il segno =: V2 = 5.5."},
     .wrong = "[!V2.5!] = 10\nM02\n",
     .right = "V2 = 10\nM02\n"},
    {.code = "ISO058",
     .name = "assignment-without-register",
     .severity = Severity::Error,
     .section = "I.6",
     .arguments = {},
     .title = {.en = "Assignment without a register", .it = "Assegnazione senza registro"},
     .message = {.en = "no register stands before this =: an assignment is written as in V5 = 10",
                 .it = "davanti a questo segno = manca il registro: l'assegnazione si scrive come in V5 = 10"},
     .causes = {{.cause = "letter",
                 .message = {.en = "{other} takes no =: its number follows at once, as in {other}1",
                             .it = "{other} non vuole il segno =: il numero segue subito, come in {other}1"},
                 .wrong = "M06 T101001\nG00 X[!=!]20\nM02\n"},
                {.cause = "word",
                 .message = {.en = "{other} takes no =: only a register does, as in V5 = 10",
                             .it = "{other} non vuole il segno =: lo vuole solo un registro, come in V5 = 10"},
                 .wrong = "M06 T101001\nG00 X1[!=!]10\nM02\n"},
                {.cause = "parameter",
                 .message = {.en = "{other} has no M before it: parameters follow their M, as in M100 P1=5",
                             .it = "{other} senza una M davanti: i parametri seguono la loro M, come in M100 P1=5"},
                 .wrong = "P1[!=!]5\nM02\n"}},
     .explanation = {.en = "The control does not know where to put the value: a = needs a register before it, as in "
                           "V5 = 10. Coordinates take no =: write X10, not X=10. Otherwise = appears only in the "
                           "parameters of an M (M100 P1=5) and in an IF.",
                     .it = "Il controllo non sa a chi assegnare il valore: prima del segno = ci vuole un registro, "
                           "come in V5 = 10. Le quote non vogliono il segno =: scrivere X10, non X=10. Per il resto "
                           "il segno = si usa solo nei parametri di una M (M100 P1=5) e in un IF."},
     .wrong = "[!=!] 10\nM02\n",
     .right = "V5 = 10\nM02\n"},
    {.code = "ISO059",
     .name = "register-out-of-range",
     .severity = Severity::Error,
     .section = "I.6",
     .arguments = {"number"},
     .title = {.en = "Register out of range", .it = "Numero di registro fuori intervallo"},
     .message = {.en = "there is no register {number}: registers go from V1 to V30",
                 .it = "il registro {number} non esiste: i registri vanno da V1 a V30"},
     .explanation = {.en = "The control has 30 registers and cannot store a value in any other. Choose a number from "
                           "1 to 30 that the program does not use for anything else.",
                     .it = "Il controllo ha 30 registri e non può memorizzare valori altrove. Scegliere un numero da "
                           "1 a 30 che il programma non usi già per altro."},
     .wrong = "[!V31!] = 10\nM02\n",
     .right = "V30 = 10\nM02\n"},
    {.code = "ISO060",
     .name = "face-angle-out-of-range",
     .severity = Severity::Error,
     .section = "I.3.2",
     .arguments = {"angle", "limit"},
     .title = {.en = "Face angle out of range", .it = "Angolo della G29 fuori intervallo"},
     .message = {.en = "the angle {angle}° is not between -{limit}° and +{limit}°",
                 .it = "l'angolo {angle}° non è compreso fra -{limit}° e +{limit}°"},
     .explanation = {.en = "G29 takes C from -180° to +180° and B from -90° to +90°. Write the same direction within "
                           "these limits, for example C-90 in place of C270. A face that B cannot reach is mounted "
                           "with G24 or G28.",
                     .it = "La G29 ammette C da -180° a +180° e B da -90° a +90°. Scrivere la stessa direzione entro "
                           "questi limiti, per esempio C-90 al posto di C270. Una faccia che con B non si raggiunge "
                           "si mette in presa con G24 o G28."},
     .wrong = "G29 X100 [!C270!]\nM02\n",
     .right = "G29 X100 C-90\nM02\n"},
    {.code = "ISO061",
     .name = "distance-mode-after-dimensions",
     .severity = Severity::Error,
     .section = "I.3.3",
     .arguments = {},
     .title = {.en = "G90 or G91 after the coordinates", .it = "G90/G91 dopo le quote"},
     .message = {.en = "{text} must stand before the line's motion and coordinates",
                 .it = "{text} va scritta prima del movimento della linea e delle sue quote"},
     .explanation = {.en = "The control must know whether coordinates are absolute or incremental before it reads "
                           "them. Move G90 or G91 to the start of the line, or put it on a line of its own before "
                           "this one.",
                     .it = "Il controllo deve sapere se le quote sono assolute o incrementali prima di leggerle. "
                           "Spostare la G90 o la G91 all'inizio della linea, oppure scriverla da sola sulla linea "
                           "precedente."},
     .wrong = "M06 T101001\nG00 X10 [!G91!]\nM02\n",
     .right = "M06 T101001\nG91 G00 X10\nM02\n"},
    {.code = "ISO062",
     .name = "second-motion",
     .severity = Severity::Error,
     .section = "I.7",
     .arguments = {},
     .title = {.en = "Second motion on a line", .it = "Più di una G di movimento"},
     .message = {.en = "{text} comes after {other}: a line takes one motion G",
                 .it = "{text} viene dopo {other}: su una linea è ammessa una sola G di movimento"},
     .explanation = {.en = "A line carries out one motion at most. Put the second one, with its coordinates, on the "
                           "next line.",
                     .it = "Una linea esegue al più un movimento. Scrivere il secondo, con le sue quote, sulla linea "
                           "successiva."},
     .wrong = "M06 T101001\nG00 X10 [!G01!] Z-3 F1000\nM02\n",
     .right = "M06 T101001\nG00 X10\nG01 Z-3 F1000\nM02\n"},
    {.code = "ISO063",
     .name = "register-not-assigned",
     .severity = Severity::Error,
     .section = "I.6",
     .arguments = {},
     .title = {.en = "Register without a value", .it = "Registro senza valore"},
     .message = {.en = "{text} gets no value: write = and a number after it",
                 .it = "{text} senza valore: aggiungere = e un numero"},
     .causes = {{.cause = "no-number",
                 .message = {.en = "{text} takes a number, and {other} is none",
                             .it = "{text} vuole un numero, e {other} non lo è"},
                 .wrong = "[!V1!] = V2\nM02\n"}},
     .explanation = {.en = "Naming a register means giving it a value: on its own it does nothing. Write V5 = 10, or "
                           "delete it. A coordinate cannot be taken from a register: besides assignments, V appears "
                           "only in the condition of an IF.",
                     .it = "Scrivere un registro vuol dire assegnargli un valore: da solo non fa nulla. Scrivere V5 "
                           "= 10, oppure toglierlo. Una quota non si può prendere da un registro: oltre che nelle "
                           "assegnazioni, V si usa solo nella condizione di un IF."},
     .wrong = "[!V5!]\nM02\n",
     .right = "V5 = 10\nM02\n"},
    {.code = "ISO064",
     .name = "dwell-time-missing",
     .severity = Severity::Error,
     .section = "I.3.10",
     .arguments = {},
     .title = {.en = "Dwell time missing", .it = "Tempo di attesa mancante"},
     .message = {.en = "{text} has no P: the dwell time in seconds is missing",
                 .it = "{text} senza P: manca il tempo di attesa in secondi"},
     .explanation = {.en = "Without P the control does not know how long to wait. Write the time after P, for example "
                           "G04 P2 or G04 P0.5. P is in seconds, not in milliseconds as on some other controls.",
                     .it = "Senza la P il controllo non sa quanto attendere. Scrivere il tempo dopo la P, per "
                           "esempio G04 P2 o G04 P0.5. La P è in secondi, non in millisecondi come su altri "
                           "controlli."},
     .wrong = "[!G04!]\nM02\n",
     .right = "G04 P2\nM02\n"},
    {.code = "ISO065",
     .name = "repeated-feed",
     .severity = Severity::Error,
     .section = "I.3.7",
     .arguments = {},
     .title = {.en = "Repeated feed rate", .it = "F ripetuta"},
     .message = {.en = "{text} comes after {other}: a line takes one F",
                 .it = "{text} viene dopo {other}: su una linea è ammessa una sola F"},
     .explanation = {.en = "The control takes one feed rate per line and does not choose between two. Delete the "
                           "wrong F, or put it on another line.",
                     .it = "Il controllo accetta un solo avanzamento per linea: fra due valori non sceglie. Cancellare "
                           "la F sbagliata o spostarla su un'altra linea."},
     .wrong = "M06 T101001\nG01 X10 F1000 [!F500!]\nM02\n",
     .right = "M06 T101001\nG01 X10 F1000\nM02\n"},
    {.code = "ISO066",
     .name = "feed-missing",
     .severity = Severity::Error,
     .section = "I.3.7",
     .arguments = {},
     .title = {.en = "Feed rate missing", .it = "Avanzamento mancante"},
     .message = {.en = "{text} has no feed rate: no F has been given so far",
                 .it = "{text} senza avanzamento: finora non è stata data alcuna F"},
     .causes = {{.cause = "on-rapid",
                 .message = {.en = "{text} has no feed rate: F so far stands on rapids only, which ignore it",
                             .it = "{text} senza avanzamento: finora la F è scritta solo su rapidi, che la ignorano"},
                 .wrong = "M06 T101001\nG00 X10 F1000\n[!G01!] X20\nM02\n"}},
     .explanation =
         {.en = "The control cannot start the first feed move without a speed. Write F on this line or on "
                "one before it. An F on the line of a G00 is ignored and does not count.",
          .it = "Il controllo non può iniziare il primo movimento in lavoro senza un avanzamento. Scrivere la F su "
                "questa linea o su una precedente. Una F sulla linea di una G00 viene ignorata e non conta."},
     .wrong = "M06 T101001\n[!G01!] X10\nM02\n",
     .right = "M06 T101001\nG01 X10 F1000\nM02\n"},
    {.code = "ISO067",
     .name = "tool-not-configured",
     .severity = Severity::Error,
     .section = "I.4.3",
     .arguments = {},
     .title = {.en = "Tool not configured", .it = "Attrezzaggio non configurato"},
     .message = {.en = "{text} names a head, holder or tool that the machine file does not list",
                 .it = "{text} indica una testa, un portautensile o un utensile che il file macchina non elenca"},
     .explanation = {.en = "The control changes only to a head, holder and tool that are configured on the machine. "
                           "Correct T. If the tool is really there, add it to the machine file.",
                     .it = "Il controllo monta solo testa, portautensile e utensile configurati sulla macchina. "
                           "Correggere la T. Se l'utensile c'è davvero, aggiungerlo al file macchina."},
     .wrong = "M06 [!T202002!]\nM02\n",
     .right = "M06 T101001\nM02\n"},
    {.code = "ISO068",
     .name = "arc-plane-not-orthogonal",
     .severity = Severity::Error,
     .section = "I.3.4.3.a",
     .arguments = {"angle"},
     .title = {.en = "Arc plane not orthogonal", .it = "Piano di interpolazione non ortogonale"},
     .message = {.en = "the axes of the arc plane are at {angle}° to each other, not at 90°",
                 .it = "gli assi del piano di interpolazione formano un angolo di {angle}°, non di 90°"},
     .explanation = {.en = "On axes that are not at right angles a circle would become an ellipse, so the control "
                           "refuses the arc. Correct the axis vectors of G24 or G28, or dismount the face with G27 "
                           "before the arc. Only the two axes of the plane count: with G18 or G19 another pair is "
                           "used.",
                     .it = "Su assi non ortogonali il cerchio diventerebbe un'ellisse, perciò il controllo rifiuta "
                           "l'arco. Correggere i versori della G24 o della G28, oppure smontare la faccia con la G27 "
                           "prima dell'arco. Contano solo i due assi del piano: con G18 o G19 sono altri due."},
     .wrong = "M06 T101001\nG28 X1 I1 J1 R1\n[!G02!] X10 Y10 R10 F1000\nM02\n",
     .right = "M06 T101001\nG28 X1 J1 R1\nG02 X10 Y10 R10 F1000\nM02\n"},
    {.code = "E001",
     .name = "unsupported-g",
     .severity = Severity::Error,
     .section = "I.3",
     .arguments = {},
     .title = {.en = "Unsupported G", .it = "G non prevista"},
     .message = {.en = "{text} is not among the G codes of this control",
                 .it = "{text} non è fra le G di questo controllo"},
     .explanation = {.en = "The control gives this G no meaning and would not know what to do. Delete it, or write "
                           "what it was meant for with the G codes of this control. Zero points such as G54 and "
                           "canned cycles such as G81 do not exist here: use G92 and single moves.",
                     .it = "Il controllo non conosce questa G e non saprebbe che cosa fare. Toglierla, oppure "
                           "ottenere lo stesso risultato con le G di questo controllo. Le origini come la G54 e i "
                           "cicli fissi come la G81 qui non esistono: usare la G92 e i singoli movimenti."},
     .wrong = "[!G54!]\nM02\n",
     .right = "G92 X100 Y50\nM02\n"},
    {.code = "E002",
     .name = "if-not-alone",
     .severity = Severity::Error,
     .section = "I.5",
     .arguments = {},
     .title = {.en = "IF not alone on its line", .it = "IF non da solo sulla linea"},
     .message = {.en = "IF ... GOTO must stand alone on its line, without {other}",
                 .it = "IF ... GOTO deve stare da solo sulla linea, senza {other}"},
     .explanation = {.en = "At an IF the control stops reading ahead, checks the condition and jumps, so the line may "
                           "hold nothing else. Move the other instructions to the line before, or after if they "
                           "belong to the case without the jump. A line number N may stay.",
                     .it = "Davanti a un IF il controllo sospende la lettura del programma, valuta la condizione e "
                           "salta: sulla linea non può esserci altro. Spostare le altre istruzioni sulla linea "
                           "precedente, o su quella seguente se valgono solo quando non si salta. Il numero di riga "
                           "N può restare."},
     .wrong = "M06 T101001\nG00 X10 [!IF!] VGPL = 1 GOTO N30\nG00 Y20\nN30 M02\n",
     .right = "M06 T101001\nG00 X10\nIF VGPL = 1 GOTO N30\nG00 Y20\nN30 M02\n"},
    {.code = "E003",
     .name = "if-malformed",
     .severity = Severity::Error,
     .section = "I.5",
     .arguments = {},
     .title = {.en = "Malformed IF", .it = "IF scritto male"},
     .message = {.en = "write the jump as IF VGPL = 1 GOTO N30: \"{text}\" is no part of it",
                 .it = "il salto si scrive IF VGPL = 1 GOTO N30: «{text}» non ne fa parte"},
     .causes =
         {{.cause = "incomplete",
           .message = {.en = "write the jump as IF VGPL = 1 GOTO N30: a part is missing after \"{text}\"",
                       .it = "il salto si scrive IF VGPL = 1 GOTO N30: dopo «{text}» manca qualcosa"},
           .wrong = "M06 T101001\nIF VGPL = [!1!]\nG00 X10\nM02\n"},
          {.cause = "condition-in-comment",
           .message = {.en = "write the jump as IF VGPL = 1 GOTO N30: \"{text}\" is a comment, not a condition",
                       .it = "il salto si scrive IF VGPL = 1 GOTO N30: «{text}» è un commento, non una condizione"},
           .wrong = "M06 T101001\nIF [!(VGPL = 1)!] GOTO N30\nG00 X10\nN30 M02\n"},
          {.cause = "label",
           .message =
               {.en = "write the jump as IF VGPL = 1 GOTO N30: the label \"{text}\" must be N and a whole number",
                .it = "il salto si scrive IF VGPL = 1 GOTO N30: l'etichetta «{text}» deve essere una N con un numero "
                      "intero"},
           .wrong = "M06 T101001\nIF VGPL = 1 GOTO [!30!]\nG00 X10\nN30 M02\n"},
          {.cause = "after-label",
           .message = {.en = "write the jump as IF VGPL = 1 GOTO N30: \"{text}\" may not follow its label",
                       .it = "il salto si scrive IF VGPL = 1 GOTO N30: dopo l'etichetta non ci può essere «{text}»"},
           .wrong = "M06 T101001\nIF VGPL = 1 GOTO N30 [!ELSE N20!]\nN20 G00 X10\nN30 M02\n"},
          {.cause = "goto-alone",
           .message = {.en = "write the jump as IF VGPL = 1 GOTO N30: this GOTO has no IF",
                       .it = "il salto si scrive IF VGPL = 1 GOTO N30: questo GOTO è senza IF"},
           .wrong = "M06 T101001\n[!GOTO!] N30\nG00 X10\nN30 M02\n"}},
     .explanation = {.en = "The control reads a jump in one form only, such as IF VGPL = 34.5 GOTO N30 or IF V5 >= 2 "
                           "GOTO N100. Write all its parts in this order. A condition compares with one number: two "
                           "registers cannot be compared, nor two conditions combined. What stands in parentheses is a "
                           "comment, a condition too.",
                     .it = "Il controllo legge il salto in una sola forma, per esempio IF VGPL = 34.5 GOTO N30 o IF "
                           "V5 >= 2 GOTO N100. Scrivere tutte le parti in quest'ordine. Il confronto si fa con un "
                           "solo numero: non si possono confrontare due registri né unire due condizioni. Ciò che "
                           "sta fra parentesi è un commento, anche una condizione."},
     .wrong = "M06 T101001\nIF VGPL [!==!] 1 GOTO N30\nG00 X10\nN30 M02\n",
     .right = "M06 T101001\nIF VGPL = 1 GOTO N30\nG00 X10\nN30 M02\n"},
    {.code = "E004",
     .name = "label-not-found",
     .severity = Severity::Error,
     .section = "I.5",
     .arguments = {},
     .title = {.en = "Label not found", .it = "Etichetta inesistente"},
     .message = {.en = "no line of the program has the label {text}",
                 .it = "nessuna linea del programma ha l'etichetta {text}"},
     .explanation = {.en = "The control would not know where to go on after the jump. Correct the number after GOTO, "
                           "or write this N on the line to jump to. Leading zeros do not matter: N007 and N7 are the "
                           "same label.",
                     .it = "Il controllo non saprebbe da dove riprendere dopo il salto. Correggere il numero dopo "
                           "GOTO, oppure scrivere questa N sulla linea a cui saltare. Gli zeri iniziali non contano: "
                           "N007 e N7 sono la stessa etichetta."},
     .wrong = "M06 T101001\nIF VGPL = 1 GOTO [!N99!]\nG00 X10\nN30 M02\n",
     .right = "M06 T101001\nIF VGPL = 1 GOTO N30\nG00 X10\nN30 M02\n"},
    {.code = "E005",
     .name = "backward-jump",
     .severity = Severity::Error,
     .section = "I.5",
     .arguments = {},
     .title = {.en = "Backward jump", .it = "Salto all'indietro"},
     .message = {.en = "{text} is not below the jump: IF ... GOTO goes forward only",
                 .it = "{text} non si trova dopo il salto: IF ... GOTO va solo in avanti"},
     .explanation = {.en = "The control runs a program from top to bottom and does not return to a line already "
                           "passed, so loops are not possible. Put the label below the IF. What must be repeated has "
                           "to be written again.",
                     .it = "Il controllo esegue il programma dall'alto in basso e non torna su una linea già "
                           "passata: i cicli non sono possibili. Mettere l'etichetta dopo l'IF. Ciò che va ripetuto "
                           "si deve riscrivere."},
     .wrong = "M06 T101001\nN10 G00 X10\nIF VGPL = 1 GOTO [!N10!]\nG00 Y20\nN20 M02\n",
     .right = "M06 T101001\nN10 G00 X10\nIF VGPL = 1 GOTO N20\nG00 Y20\nN20 M02\n"},
    {.code = "E006",
     .name = "duplicate-label",
     .severity = Severity::Error,
     .section = "I.5",
     .arguments = {},
     .title = {.en = "Duplicate label", .it = "Etichetta doppia"},
     .message = {.en = "label {text} already stands on a line above",
                 .it = "l'etichetta {text} esiste già su una linea precedente"},
     .explanation = {.en = "A jump needs a single target, so a label named after GOTO may stand on one line only. "
                           "Give this line another number. Equal line numbers do no harm as long as no GOTO names "
                           "them.",
                     .it = "Il salto deve avere un solo punto di arrivo: l'etichetta indicata dopo GOTO può stare su "
                           "una sola linea. Dare a questa linea un altro numero. I numeri di riga uguali non danno "
                           "problemi finché nessun GOTO li indica."},
     .wrong = "M06 T101001\nIF VGPL = 1 GOTO N30\nG00 X10\nN30 G00 Y20\n[!N30!] M02\n",
     .right = "M06 T101001\nIF VGPL = 1 GOTO N30\nG00 X10\nN30 G00 Y20\nN40 M02\n"},
    {.code = "E007",
     .name = "m-params-not-alone",
     .severity = Severity::Error,
     .section = "I.4.4",
     .arguments = {},
     .title = {.en = "M with parameters not alone on its line", .it = "M con parametri non da sola sulla linea"},
     .message = {.en = "{text} has parameters and must stand alone on its line, without {other}",
                 .it = "{text} ha dei parametri e deve stare da sola sulla linea, senza {other}"},
     .explanation =
         {.en = "The control runs an M with parameters only if it is the single instruction on its line. "
                "Move the other instructions to the line before or after it. A line number N may stay.",
          .it = "Il controllo esegue una M con parametri solo se è l'unica istruzione della linea. "
                "Spostare le altre istruzioni sulla linea precedente o su quella successiva. Il numero di riga N può "
                "restare."},
     .wrong = "M06 T101001\nG00 X10 [!M100!] P1=5\nM02\n",
     .right = "M06 T101001\nG00 X10\nM100 P1=5\nM02\n"},
    {.code = "E008",
     .name = "m-param-invalid",
     .severity = Severity::Error,
     .section = "I.4.4",
     .arguments = {},
     .title = {.en = "Invalid M parameter", .it = "Parametro non valido per la M"},
     .message = {.en = "{text} is no parameter: an M function has P1 to P20",
                 .it = "{text} non è un parametro: una funzione M ha da P1 a P20"},
     .causes =
         {{.cause = "no-value",
           .message = {.en = "{text} has no value: write = and a number, as in P1=5",
                       .it = "{text} senza valore: scrivere = e un numero, come in P1=5"},
           .wrong = "M100 [!P1!]\nM02\n"},
          {.cause = "repeated",
           .message = {.en = "{text} comes after {other}: an M function takes each parameter once",
                       .it = "{text} viene dopo {other}: una funzione M ammette ogni parametro una sola volta"},
           .wrong = "M100 P1=5 [!P1=6!]\nM02\n"},
          {.cause = "fixed-function",
           .message = {.en = "{other} takes no parameters: {text} goes with a function of the user, such as M100",
                       .it = "{other} non ammette parametri: {text} va con una funzione dell'utente, per esempio M100"},
           .wrong = "M05 [!P1=1!]\nM02\n"}},
     .explanation = {.en = "A user M function has 20 places for values, P1 to P20, and each value needs its place. "
                           "Write the parameters as in M100 P1=2.5 P2=-3. M03, M04 and M05 take none.",
                     .it = "Una M definita dall'utente ha 20 posti per i valori, da P1 a P20, e ogni valore vuole il "
                           "suo. Scrivere i parametri come in M100 P1=2.5 P2=-3. M03, M04 e M05 non ne ammettono."},
     .wrong = "M100 [!P21=5!]\nM02\n",
     .right = "M100 P20=5\nM02\n"},
    {.code = "E009",
     .name = "g09-misplaced",
     .severity = Severity::Error,
     .section = "I.3.8",
     .arguments = {},
     .title = {.en = "Misplaced G09", .it = "Posizione errata della G09"},
     .message =
         {.en = "{text} must directly follow a feed move, on its line or first on the next",
          .it = "{text} deve seguire subito un movimento in lavoro, sulla sua linea o all'inizio della successiva"},
     .causes = {{.cause = "after-rapid",
                 .message = {.en = "{text} must follow a feed move: a rapid stops at its end anyway",
                             .it = "{text} deve seguire un movimento in lavoro: un rapido si ferma comunque alla fine"},
                 .wrong = "M06 T101001\nG00 X10 [!G09!]\nM02\n"}},
     .explanation = {.en = "G09 stops the axes at the end of the feed move just before it, and here there is none. "
                           "Write it after the coordinates of the move or first on the next line. After a rapid (G00) "
                           "it is not allowed.",
                     .it = "La G09 arresta gli assi alla fine del movimento in lavoro che la precede, e qui non ce n'è "
                           "uno. Scriverla dopo le quote del movimento o all'inizio della linea successiva. Dopo un "
                           "rapido (G00) non è ammessa."},
     .wrong = "M06 T101001\n[!G09!] G01 X10 F1000\nM02\n",
     .right = "M06 T101001\nG01 X10 F1000 G09\nM02\n"},
    {.code = "E150",
     .name = "rapid-in-material",
     .severity = Severity::Error,
     .evidence = Evidence::Stock,
     .section = "I.3.4.1",
     .arguments = {"depth", "x", "y", "z", "time", "enough"},
     .title = {.en = "Rapid through material", .it = "Rapido nel materiale"},
     .message =
         {.en = "{who} goes through material in rapid: {depth} {unit} deep at X{x} Y{y} Z{z}, {time} s after the "
                "start; Z{enough} (absolute) would have been enough",
          .it = "{who} attraversa il materiale in rapido: {depth} {unit} di profondità in X{x} Y{y} Z{z}, {time} s "
                "dopo l'avvio; bastava Z{enough} (quota assoluta)"},
     .causes =
         {{.cause = "at-any-height",
           .message = {.en = "{who} goes through material in rapid: {depth} {unit} deep at X{x} Y{y} Z{z}, {time} s "
                             "after the start",
                       .it = "{who} attraversa il materiale in rapido: {depth} {unit} di profondità in X{x} Y{y} "
                             "Z{z}, {time} s dopo l'avvio"},
           .wrong = "M06 T101001\nS12000 M03\nG00 X350 Y150 Z50\nG01 Z30 F1000\n[!G00 X380!]\nZ50\nM05\nM02\n"}},
     .explanation =
         {.en = "In rapid the machine goes as fast as it can, and the cutter meets what is left of the blank. Rapids "
                "are not straight where the axes need different times: what counts is the path that the machine really "
                "takes. Go higher, or go in feed. The Z in the message is the lowest, up to 0.1 mm, at which this "
                "motion meets nothing; where a tool is mounted, and on the way out of a cut, no Z helps. If the way is "
                "free at the machine, the stock in isocnc.json is larger than the blank or stands elsewhere, or "
                "something was cut before that this program does not cut.",
          .it = "In rapido la macchina va alla massima velocità, e la fresa incontra ciò che resta del grezzo. I "
                "rapidi non sono rettilinei quando gli assi impiegano tempi diversi: conta il percorso che la macchina "
                "compie davvero. Passare più in alto, o in lavoro. La Z del messaggio è la più bassa, a 0.1 mm, con "
                "cui questo movimento non incontra nulla; dove si monta un utensile e uscendo da una passata nessuna Z "
                "aiuta. Se alla macchina la strada è libera, il grezzo (stock) in "
                "isocnc.json è più grande di quello vero o sta altrove, oppure qualcosa è già stato tagliato fuori da "
                "questo programma."},
     .wrong = "M06 T101001\nS12000 M03\nG00 X250 Y150 Z50\nZ5\n[!X500!]\nZ50\nM05\nM02\n",
     .right = "M06 T101001\nS12000 M03\nG00 X250 Y150 Z50\nZ41\nX500\nZ50\nM05\nM02\n"},
    {.code = "E151",
     .name = "holder-in-material",
     .severity = Severity::Error,
     .evidence = Evidence::Stock,
     .section = "I.4.3",
     .arguments = {"depth", "x", "y", "z", "time", "enough"},
     .title = {.en = "Holder or shank in material", .it = "Portautensile o gambo nel materiale"},
     .message = {.en = "{who} is in the material: {depth} {unit} deep at X{x} Y{y} Z{z}, {time} s after the start; "
                       "Z{enough} (absolute) would have been enough",
                 .it = "{who} è nel materiale: {depth} {unit} di profondità in X{x} Y{y} Z{z}, {time} s dopo l'avvio; "
                       "bastava Z{enough} (quota assoluta)"},
     .causes =
         {{.cause = "at-any-height",
           .message = {.en = "{who} is in the material: {depth} {unit} deep at X{x} Y{y} Z{z}, {time} s after the "
                             "start",
                       .it = "{who} è nel materiale: {depth} {unit} di profondità in X{x} Y{y} Z{z}, {time} s dopo "
                             "l'avvio"},
           .wrong = "M06 T101004\nS12000 M03\nG00 X288 Y150 Z50\nZ-25\nM05\n[!M06 T101001!]\nG00 Z50\nM02\n"}},
     .explanation =
         {.en = "What does not cut meets what is left of the blank: the shank, the holder or the spindle nose. The "
                "message names the deepest place, and the Z at which this motion would have met nothing. Go less deep, "
                "take a longer tool, or make room for the holder before.",
          .it =
              "Ciò che non taglia incontra ciò che resta del grezzo: il gambo, il portautensile o il naso del "
              "mandrino. Il messaggio dà il punto più profondo e la Z con cui questo movimento non avrebbe incontrato "
              "nulla. Andare meno a fondo, montare un utensile più lungo, o fare prima spazio al portautensile."},
     .wrong = "M06 T101001\nS12000 M03\nG00 X350 Y150 Z50\n[!G01 Z-25!] F1000\nG00 Z50\nM05\nM02\n",
     .right = "M06 T101001\nS12000 M03\nG00 X350 Y150 Z50\nG01 Z-15 F1000\nG00 Z50\nM05\nM02\n"},
    {.code = "E152",
     .name = "hits-fixture",
     .severity = Severity::Error,
     .evidence = Evidence::Scene,
     .section = "I.3.4",
     .arguments = {"depth", "x", "y", "z", "time"},
     .title = {.en = "Fixture that is hit", .it = "Urto contro un'attrezzatura"},
     .message = {.en = "{who} hits {whom}: {depth} {unit} deep at X{x} Y{y} Z{z}, {time} s after the start",
                 .it = "{who} urta {whom}: entra di {depth} {unit} in X{x} Y{y} Z{z}, {time} s dopo l'avvio"},
     .explanation =
         {.en = "On the path that the machine really takes, the tool, its holder, the spindle nose or the head meets a "
                "cup, a clamp or a stop of the setup. The finding stands where it first touches and gives the deepest "
                "place, in the frame in force; motions that go on through the same obstacle belong to it. Lift the "
                "tool, go around, or move the fixture. If nothing of the kind happens at the machine, the setup in "
                "isocnc.json describes other fixtures, or at another place, or the tool is longer or shorter there.",
          .it = "Sul percorso che la macchina compie davvero, l'utensile, il suo portautensile, il naso del mandrino o "
                "la testa incontra una ventosa, un morsetto o un riscontro dell'attrezzaggio. La segnalazione è dove "
                "lo tocca per la prima volta e dà il punto più profondo, nel sistema di riferimento in presa; i "
                "movimenti che proseguono nello stesso ostacolo ne fanno parte. Alzare l'utensile, passare di lato o "
                "spostare l'attrezzatura. Se alla macchina non succede nulla di simile, in isocnc.json ci sono altre "
                "attrezzature, o in un altro posto, oppure lì l'utensile è più lungo o più corto."},
     .wrong = "M06 T101001\nG00 X100 Y20 Z50\nG01 Z20 F1000\n[!X300!]\nZ50\nM02\n",
     .right = "M06 T101001\nG00 X100 Y20 Z50\nG01 X300 F1000\nZ20\nZ50\nM02\n"},
    {.code = "E153",
     .name = "hits-machine",
     .severity = Severity::Error,
     .evidence = Evidence::Scene,
     .section = "I.3.4",
     .arguments = {"depth", "x", "y", "z", "time"},
     .title = {.en = "Machine that is hit", .it = "Urto contro la macchina"},
     .message = {.en = "{who} hits {whom}: {depth} {unit} deep at X{x} Y{y} Z{z}, {time} s after the start",
                 .it = "{who} urta {whom}: entra di {depth} {unit} in X{x} Y{y} Z{z}, {time} s dopo l'avvio"},
     .explanation =
         {.en =
              "On the path that the machine really takes, a moving body meets the table, another body of the machine, "
              "or the spoilboard deeper than the setup allows. The finding stands where it first touches and gives "
              "the deepest place, in the frame in force; motions that go on in the same body belong to it. Check Z, "
              "the workpiece origin and the length of the tool. Where cutting into the spoilboard is meant, "
              "spoilboard.allow of the setup says how deep.",
          .it = "Sul percorso che la macchina compie davvero, un corpo in movimento incontra la tavola, un'altra parte "
                "della macchina, o il piano martire più a fondo di quanto l'attrezzaggio permetta. La segnalazione è "
                "dove lo tocca per la prima volta e dà il punto più profondo, nel sistema di riferimento in presa; i "
                "movimenti che proseguono nello stesso corpo ne fanno parte. Controllare Z, lo zero pezzo e la "
                "lunghezza dell'utensile. Dove si vuole tagliare anche il piano martire, spoilboard.allow "
                "dell'attrezzaggio dice di quanto."},
     .wrong = "M06 T101001\nG00 X300 Y100 Z5\n[!G01 Z-30!] F1000\nZ5\nM02\n",
     .right = "M06 T101001\nG00 X300 Y100 Z5\nG01 Z-18.5 F1000\nZ5\nM02\n"},
    {.code = "E155",
     .name = "gouges-part",
     .severity = Severity::Error,
     .evidence = Evidence::Scene,
     .section = "I.3.4",
     .arguments = {"depth", "x", "y", "z", "time"},
     .title = {.en = "Finished part that is cut into", .it = "Pezzo finito intaccato"},
     .message = {.en = "{who} goes into {whom}: {depth} {unit} deep at X{x} Y{y} Z{z}, {time} s after the start",
                 .it = "{who} intacca {whom} di {depth} {unit} in X{x} Y{y} Z{z}, {time} s dopo l'avvio"},
     .explanation =
         {.en = "The motion takes away what the finished part of the setup (target) still has. For the cutter, depths "
                "up to the tolerance of the target are accepted and not counted; shank and holder may not touch it. "
                "Check the offset of the path, the radius of the tool and the workpiece origin, or whether the target "
                "belongs to this program and stands where its frame says.",
          .it = "Il movimento toglie ciò che il pezzo finito dell'attrezzaggio (target) deve ancora avere. Per la "
                "fresa le profondità fino alla tolleranza del pezzo sono accettate e non contano; il gambo e il "
                "portautensile non possono toccarlo. Controllare la distanza del percorso dal profilo, il raggio "
                "dell'utensile e lo zero pezzo, oppure se il pezzo finito è di questo programma e sta dove dice il "
                "suo sistema di riferimento."},
     .wrong = "M06 T101001\nG00 X60 Y60 Z5\nG01 Z-5 F1000\n[!X80!]\nZ5\nM02\n",
     .right = "M06 T101001\nG00 X60 Y60 Z5\nG01 Z-5 F1000\nX50\nZ5\nM02\n"},
    {.code = "E158",
     .name = "cuts-with-spindle-stopped",
     .severity = Severity::Error,
     .evidence = Evidence::Stock,
     .section = "I.4.2",
     .arguments = {"depth", "x", "y", "z", "time"},
     .title = {.en = "Cut with the spindle stopped", .it = "Taglio a mandrino fermo"},
     .message = {.en = "{who} cuts while the spindle stands: {depth} {unit} deep at X{x} Y{y} Z{z}, {time} s after the "
                       "start",
                 .it = "{who} taglia a mandrino fermo: {depth} {unit} di profondità in X{x} Y{y} Z{z}, {time} s dopo "
                       "l'avvio"},
     .explanation =
         {.en = "The motion removes material, and the spindle does not turn: no M03 or M04 came before, or an M05 or a "
                "tool change has stopped it since. Start it before the first cut. W102, which asks for the spindle "
                "before any feed, is not reported beside this.",
          .it = "Il movimento asporta materiale e il mandrino non gira: prima non c'è una M03 o M04, oppure una M05 o "
                "un cambio utensile lo ha fermato. Avviarlo prima del primo taglio. W102, che chiede il mandrino prima "
                "di ogni lavoro, non viene segnalata insieme a questa."},
     .wrong = "M06 T101001\nG00 X350 Y150 Z50\n[!G01 Z35!] F1000\nG00 Z50\nM02\n",
     .right = "M06 T101001\nS12000 M03\nG00 X350 Y150 Z50\nG01 Z35 F1000\nG00 Z50\nM05\nM02\n"},
    {.code = "E160",
     .name = "joint-travel",
     .severity = Severity::Error,
     .evidence = Evidence::Run,
     .section = "I.3.4",
     .arguments = {"axis", "reached", "limit"},
     .title = {.en = "Joint outside its travel", .it = "Asse macchina fuori corsa"},
     .message =
         {.en = "the machine's {axis} leaves its travel: it goes to {reached}, and the travel ends at {limit}{inches}",
          .it = "l'asse {axis} della macchina esce dalla corsa: arriva a {reached}, e la corsa finisce a "
                "{limit}{inches}"},
     .explanation =
         {.en = "During this motion a joint of the machine passes the end of its travel. The joints X, Y and Z "
                "are those of the spindle nose: the length of the tool, and what B and C of the head swing, lie "
                "between it and the tip. Motions that go on outside belong to the same finding, which gives the "
                "farthest place. Check the workpiece origin, the tool and the angles, or the limits in isocnc.json. No "
                "false alarms are known, as long as these limits and the lengths of the tools are right.",
          .it = "Durante questo movimento un asse macchina passa la fine della sua corsa. Gli assi macchina X, Y e Z "
                "sono quelli del naso del mandrino: fra esso e la punta ci sono la lunghezza dell'utensile e ciò che B "
                "e C della testa fanno oscillare. I movimenti che proseguono fuori corsa fanno parte della stessa "
                "segnalazione, che dà il punto più lontano. Controllare lo zero pezzo, l'utensile e gli angoli, oppure "
                "i limiti in isocnc.json. Se questi limiti e le lunghezze degli utensili sono giusti non si conoscono "
                "falsi allarmi."},
     .wrong = "M06 T101001\n[!G00 X1200 Y10!]\nM02\n",
     .right = "M06 T101001\nG00 X900 Y10\nM02\n"},
    {.code = "W001",
     .name = "redundant-modal",
     .severity = Severity::Warning,
     .section = "I.3",
     .arguments = {},
     .title = {.en = "Repeated modal G", .it = "G modale ripetuta"},
     .message = {.en = "{text} is already in force", .it = "{text} è già in presa"},
     .explanation = {.en = "The G stays in force until another one of its group replaces it, so writing it again "
                           "changes nothing. Delete it, or check whether another G was meant. Writing a default once "
                           "at the start of the program is fine.",
                     .it = "La G resta in presa finché non la sostituisce un'altra dello stesso gruppo: riscriverla "
                           "non cambia nulla. Toglierla, o verificare se si intendeva un'altra G. Scrivere una volta "
                           "la G di default a inizio programma va bene."},
     .wrong = "M06 T101001\nG70 G00 X1\n[!G70!] G00 Y2\nM02\n",
     .right = "M06 T101001\nG70 G00 X1\nG00 Y2\nM02\n"},
    {.code = "W002",
     .name = "g27-without-face",
     .severity = Severity::Warning,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "G27 without a face frame", .it = "G27 senza faccia in presa"},
     .message = {.en = "{text} has nothing to dismount: no face frame is in force",
                 .it = "{text} non ha nulla da smontare: nessuna faccia è in presa"},
     .explanation = {.en = "The control ignores a G27 when the workpiece frame is already the one in use. Delete it, "
                           "or check whether a G24, G28 or G29 is missing before it.",
                     .it = "Il controllo ignora la G27 se si sta già lavorando nel sistema di riferimento di pezzo. "
                           "Toglierla, o verificare se prima manca una G24, una G28 o una G29."},
     .wrong = "M06 T101001\n[!G27!]\nG00 X10\nM02\n",
     .right = "M06 T101001\nG00 X10\nM02\n"},
    {.code = "W003",
     .name = "feed-ignored",
     .severity = Severity::Warning,
     .folds = FoldKind::IgnoredFeed,
     .section = "I.3.7",
     .arguments = {},
     .title = {.en = "F ignored", .it = "F ignorata"},
     .message = {.en = "{text} is ignored: with G93 in force F counts only on the line of a feed move",
                 .it =
                     "{text} viene ignorata: con la G93 in presa la F vale solo sulla linea di un movimento in lavoro"},
     .explanation =
         {.en = "In inverse time (G93) F stands for the time of the move on its own line, and this line "
                "has no feed move. Delete F, or write it on the line of the move that it is meant for.",
          .it = "Con l'inverso del tempo (G93) la F dà il tempo del movimento sulla stessa linea, e qui non ci sono "
                "movimenti in lavoro. Togliere la F, oppure scriverla sulla linea del movimento a cui serve."},
     .wrong = "M06 T101001\nG93 G01 X10 F4\nG00 Z5 [!F4!]\nM02\n",
     .right = "M06 T101001\nG93 G01 X10 F4\nG00 Z5\nM02\n"},
    {.code = "W101",
     .name = "modal-group-twice",
     .severity = Severity::Warning,
     .section = "I.3",
     .arguments = {},
     .title = {.en = "Two Gs of one modal group", .it = "Due G dello stesso gruppo modale"},
     .message = {.en = "{text} replaces a G of the same modal group on this line",
                 .it = "{text} sostituisce un'altra G dello stesso gruppo modale sulla stessa linea"},
     .explanation = {.en = "Of two Gs of one modal group only the one written last stays in force, so the other one "
                           "does nothing. Delete the one that is not wanted. No false alarms are known.",
                     .it = "Di due G dello stesso gruppo modale resta in presa solo l'ultima scritta, quindi l'altra "
                           "non serve. Togliere quella di troppo. Non si conoscono falsi allarmi."},
     .wrong = "M06 T101001\nG90 [!G91!]\nG00 X10\nM02\n",
     .right = "M06 T101001\nG91\nG00 X10\nM02\n"},
    {.code = "W102",
     .name = "spindle-stopped-feed",
     .severity = Severity::Warning,
     .section = "I.4.2",
     .arguments = {},
     .title = {.en = "Feed move with the spindle stopped", .it = "Movimento in lavoro a mandrino fermo"},
     .message = {.en = "feed move without an M03 or M04 in force: the spindle does not turn",
                 .it = "movimento in lavoro senza una M03 o una M04 in presa: il mandrino è fermo"},
     .explanation =
         {.en =
              "The spindle was stopped with M05, or given a speed with S and never started, and now a feed move comes: "
              "in the material the tool breaks. Write M03 or M04 with its S before it. A false alarm where a probe or "
              "a "
              "drag knife is moved with the spindle stopped, or where the shop's tool change starts the spindle.",
          .it = "Il mandrino è stato fermato con la M05, oppure ha una velocità S ma nessuno l'ha avviato, e ora "
                "arriva un movimento in lavoro: nel materiale l'utensile si rompe. Scrivere prima una M03 o una M04 "
                "con la sua S. Falso allarme se si lavora apposta a mandrino fermo, per esempio con un tastatore o un "
                "coltello, o se il mandrino parte già con il cambio utensile."},
     .wrong = "M06 T101001\nS12000 M03\nG01 X10 F1000\nM05\n[!X20!]\nM02\n",
     .right = "M06 T101001\nS12000 M03\nG01 X10 F1000\nM05\nG00 X20\nM02\n"},
    {.code = "W103",
     .name = "spindle-without-speed",
     .severity = Severity::Warning,
     .section = "I.4.2",
     .arguments = {},
     .title = {.en = "Spindle started without a speed", .it = "Mandrino avviato senza velocità"},
     .message = {.en = "{text} starts the spindle, but no S has been given yet",
                 .it = "{text} avvia il mandrino, ma finora non è stata data alcuna S"},
     .explanation = {.en = "The spindle is started before any S says how fast. Write S on this line or before it. A "
                           "false alarm where the machine keeps a speed of its own.",
                     .it = "Il mandrino viene avviato prima che una S ne dica la velocità. Scrivere la S su questa "
                           "linea o prima. Falso allarme se la macchina ha una sua velocità di partenza."},
     .wrong = "M06 T101001\n[!M03!]\nM05\nM02\n",
     .right = "M06 T101001\nS12000 M03\nM05\nM02\n"},
    {.code = "W104",
     .name = "spindle-reversed",
     .severity = Severity::Warning,
     .section = "I.4.2",
     .arguments = {},
     .title = {.en = "Spindle reversed while it turns", .it = "Inversione a mandrino in moto"},
     .message = {.en = "{text} reverses the spindle while it turns the other way",
                 .it = "{text} inverte il mandrino mentre gira nell'altro verso"},
     .explanation = {.en = "The spindle has to stop before it can turn the other way, and not every drive does so by "
                           "itself. Write M05 first. A false alarm where the drive reverses without harm.",
                     .it =
                         "Il mandrino deve fermarsi prima di girare nell'altro verso, e non tutti gli azionamenti lo "
                         "fanno da soli. Scrivere prima una M05. Falso allarme se l'azionamento inverte senza danni."},
     .wrong = "M06 T101001\nS12000 M03\n[!M04!]\nM05\nM02\n",
     .right = "M06 T101001\nS12000 M03\nM05\nM04\nM05\nM02\n"},
    {.code = "W105",
     .name = "tool-change-with-spindle-on",
     .severity = Severity::Warning,
     .section = "I.4.3",
     .arguments = {},
     .title = {.en = "Tool change with the spindle running", .it = "Cambio utensile a mandrino in moto"},
     .message = {.en = "tool change while the spindle is running", .it = "cambio utensile con il mandrino in moto"},
     .explanation =
         {.en = "Neither M03 nor M04 has been ended with M05 before this tool change. Write M05 before it. A false "
                "alarm where the machine's own tool change stops the spindle.",
          .it = "Prima di questo cambio utensile la M03 o la M04 non è stata chiusa da una M05. Scrivere prima la M05. "
                "Falso allarme se il ciclo di cambio utensile della macchina ferma da sé il mandrino."},
     .wrong = "M06 T101001\nS12000 M03\nG01 X10 F1000\n[!M06!] T101002\nM05\nM02\n",
     .right = "M06 T101001\nS12000 M03\nG01 X10 F1000\nM05\nM06 T101002\nM02\n"},
    {.code = "W106",
     .name = "end-with-spindle-on",
     .severity = Severity::Warning,
     .section = "I.4.1",
     .arguments = {},
     .title = {.en = "Program end with the spindle running", .it = "Fine programma a mandrino in moto"},
     .message = {.en = "the program ends with the spindle running",
                 .it = "il programma finisce con il mandrino in moto"},
     .explanation = {.en = "Nothing stops the spindle before the end of the program. Write M05 before M02. A false "
                           "alarm where the machine stops the spindle at M02 by itself.",
                     .it = "Nulla ferma il mandrino prima della fine del programma. Scrivere la M05 prima della M02. "
                           "Falso allarme se alla M02 la macchina ferma da sé il mandrino."},
     .wrong = "M06 T101001\nS12000 M03\n[!M02!]\n",
     .right = "M06 T101001\nS12000 M03\nM05\nM02\n"},
    {.code = "W107",
     .name = "end-with-face-mounted",
     .severity = Severity::Warning,
     .section = "I.3.2",
     .arguments = {},
     .title = {.en = "Program end with a face frame mounted", .it = "Fine programma con la faccia in presa"},
     .message = {.en = "the program ends with a face frame mounted",
                 .it = "il programma finisce con una faccia in presa"},
     .explanation =
         {.en = "The face frame has not been dismounted with G27 before the end of the program. Write G27 on a line of "
                "its own before M02. No false alarms are known.",
          .it = "La faccia non è stata smontata con la G27 prima della fine del programma. "
                "Scrivere una G27 su una linea a sé prima della M02. Non si conoscono falsi allarmi."},
     .wrong = "M06 T101001\nG29 B90\n[!M02!]\n",
     .right = "M06 T101001\nG29 B90\nG27\nM02\n"},
    {.code = "W108",
     .name = "end-with-compensation",
     .severity = Severity::Warning,
     .section = "I.3.12",
     .arguments = {"mode"},
     .title = {.en = "Program end with cutter compensation on",
               .it = "Fine programma con la correzione raggio fresa in presa"},
     .message = {.en = "the program ends with G{mode} in force", .it = "il programma finisce con la G{mode} in presa"},
     .explanation = {.en = "Cutter compensation has not been ended with G40 before the end of the program. Write G40 "
                           "after the last compensated move. No false alarms are known.",
                     .it = "La correzione raggio fresa non è stata tolta con la G40 prima della fine del programma. "
                           "Scrivere la G40 dopo l'ultimo movimento compensato. Non si conoscono falsi allarmi."},
     .wrong = "M06 T101001\nG41 G01 X10 F1000\n[!M02!]\n",
     .right = "M06 T101001\nG41 G01 X10 F1000\nG40\nM02\n"},
    {.code = "W109",
     .name = "feed-on-rapid",
     .severity = Severity::Warning,
     .section = "I.3.7",
     .arguments = {},
     .title = {.en = "F on a rapid", .it = "F su un rapido"},
     .message = {.en = "{text} is ignored on the line of a rapid",
                 .it = "{text} viene ignorata sulla linea di un rapido"},
     .explanation =
         {.en = "A rapid runs at the machine's own speed and its F sets nothing, not even for the lines below. Delete "
                "the F, or write it on the first feed move. No false alarms are known.",
          .it = "Il rapido va alla velocità propria della macchina e la sua F non imposta nulla, nemmeno per le linee "
                "seguenti. Togliere la F o scriverla sul primo movimento in lavoro. Non si conoscono falsi allarmi."},
     .wrong = "M06 T101001\nG00 X10 [!F1000!]\nM02\n",
     .right = "M06 T101001\nG00 X10\nM02\n"},
    {.code = "W110",
     .name = "feed-of-inverse-time",
     .severity = Severity::Warning,
     .section = "I.3.7",
     .arguments = {"feed"},
     .title = {.en = "No F since G93", .it = "Nessuna F dopo la G93"},
     .message = {.en = "no F since G93: the feed rate is {feed} mm/min from here on",
                 .it = "nessuna F dopo la G93: da qui l'avanzamento è di {feed} mm/min"},
     .explanation =
         {.en = "Back in G94 without a new F the last F of G94 holds again; where there was none, the F of G93, which "
                "stood for a time, is read as a speed. Write an F on the first feed move after G94. A false alarm "
                "where the F from before G93 is meant.",
          .it = "Tornati in G94 senza una nuova F vale di nuovo l'ultima F data in G94; se non ce n'era, la F della "
                "G93, che indicava un tempo, viene letta come velocità. Scrivere una F sul primo movimento in lavoro "
                "dopo la G94. Falso allarme se si intende proprio la F precedente alla G93."},
     .wrong = "M06 T101001\nG93\nG01 X10 F4\nG94\n[!G01!] X20\nM02\n",
     .right = "M06 T101001\nG93\nG01 X10 F4\nG94\nG01 X20 F1000\nM02\n"},
    {.code = "W111",
     .name = "arc-goes-nowhere",
     .severity = Severity::Warning,
     .section = "I.3.4.3.a",
     .arguments = {},
     .title = {.en = "Arc that goes nowhere", .it = "Arco senza sviluppo"},
     .message = {.en =
                     "an arc with a radius alone that ends where it starts does not move: a full turn needs its center",
                 .it = "un arco che finisce dove comincia e ha solo il raggio non si muove: per un giro completo serve "
                       "il centro"},
     .explanation =
         {.en = "With R alone the sweep is at most 180 degrees, and from a point to itself there is none. Give the "
                "center with I, J or K for a full turn, or check the end point. No false alarms are known.",
          .it = "Con la sola R lo sviluppo è al massimo di 180 gradi, e da un punto a sé stesso non ce n'è. Per un "
                "giro completo dare il centro con I, J o K, altrimenti controllare il punto finale. Non si conoscono "
                "falsi allarmi."},
     .wrong = "M06 T101001\nG02 X0 Y0 [!R10!] F1000\nM02\n",
     .right = "M06 T101001\nG02 X0 Y0 I10 J0 F1000\nM02\n"},
    {.code = "W112",
     .name = "arc-barely-fits",
     .severity = Severity::Warning,
     .section = "I.3.4.3.a",
     .arguments = {"found", "wanted"},
     .title = {.en = "Arc that fits only by the tolerance", .it = "Arco accettato solo grazie alla tolleranza"},
     .message = {.en = "the center is {found} mm from the start and {wanted} mm from the end: the arc fits only within "
                       "the tolerance",
                 .it = "il centro dista {found} mm dal punto iniziale e {wanted} mm da quello finale: l'arco passa "
                       "solo grazie alla tolleranza"},
     .explanation = {.en = "The two distances differ by more than half of what the control still accepts, so the arc "
                           "is drawn with a visible step or not at all on a stricter control. Give center and end with "
                           "more decimals. A false alarm where the program has only two decimals on purpose.",
                     .it =
                         "Le due distanze differiscono per più della metà di quanto il controllo accetta ancora: "
                         "l'arco viene eseguito con un gradino, o rifiutato da un controllo più severo. Dare centro e "
                         "punto finale con più decimali. Falso allarme se il programma ha apposta due soli decimali."},
     .wrong = "M06 T101001\nG02 X20.008 Y0 [!I10 J0!] F1000\nM02\n",
     .right = "M06 T101001\nG02 X20 Y0 I10 J0 F1000\nM02\n"},
    {.code = "W113",
     .name = "compensation-across-change",
     .severity = Severity::Warning,
     .section = "I.3.12",
     .arguments = {"mode"},
     .title = {.en = "Change under cutter compensation", .it = "Cambio con la correzione raggio fresa in presa"},
     .message = {.en = "{text} while cutter compensation (G{mode}) is in force: write G40 before it",
                 .it = "{text} con la correzione raggio fresa (G{mode}) in presa: scrivere prima la G40"},
     .explanation =
         {.en = "Plane, frame or tool change while the path is offset for the old one. End the compensation "
                "with G40 before it. A false alarm only where the shop's control is known to allow it.",
          .it = "Cambia il piano, il riferimento o l'utensile mentre il percorso è compensato per quello di prima. "
                "Togliere prima la correzione con la G40. Falso allarme solo se è certo che il controllo lo consente."},
     .wrong = "M06 T101001\nG41 G01 X10 F1000\n[!G18!]\nX20\nG40\nM02\n",
     .right = "M06 T101001\nG41 G01 X10 F1000\nG40\nG18\nX20\nM02\n"},
    {.code = "W114",
     .name = "axes-nearly-orthogonal",
     .severity = Severity::Info,
     .section = "I.3.2",
     .arguments = {"angle"},
     .title = {.en = "Face axes not quite orthogonal", .it = "Assi della faccia non proprio ortogonali"},
     .message = {.en = "the face axes are {angle}° off the right angle",
                 .it = "gli assi della faccia si scostano di {angle}° dall'angolo retto"},
     .explanation = {.en = "The control takes the axes as orthogonal, but their components have so few decimals that "
                           "the coordinates along them are slightly oblique. Write them with six decimals or more, or "
                           "use G29 with angles. A false alarm where axes are meant to be oblique by so little.",
                     .it = "Il controllo considera gli assi ortogonali, ma le componenti hanno così pochi decimali che "
                           "le quote lungo di essi sono leggermente oblique. Scriverle con almeno sei decimali o usare "
                           "la G29 con gli angoli. Falso allarme se gli assi sono davvero obliqui di così poco."},
     .wrong = "M06 T101001\n[!G28!] X1 J1 P0.0005 R1\nG27\nM02\n",
     .right = "M06 T101001\nG28 X1 J1 R1\nG27\nM02\n"},
    {.code = "W115",
     .name = "dwell-of-odd-length",
     .severity = Severity::Warning,
     .section = "I.3.10",
     .arguments = {"time"},
     .title = {.en = "Dwell of odd length", .it = "Attesa di durata insolita"},
     .message = {.en = "a dwell of {time} s: P counts seconds", .it = "attesa di {time} s: la P è in secondi"},
     .explanation =
         {.en = "The dwell lasts nothing, or so long that milliseconds may have been meant. Check P, which counts "
                "seconds. A false alarm where a long wait is wanted: for clamping or cooling an M function is clearer.",
          .it = "L'attesa non dura nulla, oppure così a lungo da far pensare a millisecondi. Controllare la P, che è "
                "in secondi. Falso allarme se serve davvero una lunga attesa: per bloccaggi o raffreddamento è più "
                "chiara una funzione M."},
     .wrong = "M06 T101001\nG04 [!P500!]\nM02\n",
     .right = "M06 T101001\nG04 P0.5\nM02\n"},
    {.code = "W116",
     .name = "never-runs",
     .severity = Severity::Warning,
     .section = "I.5",
     .arguments = {},
     .title = {.en = "Code that never runs", .it = "Codice mai eseguito"},
     .message = {.en = "no path of the program leads here: it never runs",
                 .it = "nessun percorso del programma arriva qui: non viene mai eseguito"},
     .explanation =
         {.en = "All paths end before this line, so the control never reads it and nothing below is checked until a "
                "label that is reached. Delete it, or mend the M02 before it. What a jump skips whose condition is "
                "always true is reported at its IF (W117). A false alarm where code is kept after M02 on purpose: as a "
                "comment it cannot be mistaken.",
          .it = "Tutti i percorsi finiscono prima di questa linea: il controllo non la legge e, fino a un'etichetta "
                "raggiungibile, nemmeno questa verifica. Cancellarla, oppure correggere la M02 che la precede. Ciò che "
                "un salto dalla condizione sempre vera scavalca è segnalato al suo IF (W117). Falso allarme se il "
                "codice dopo la M02 è tenuto apposta: come commento non può trarre in inganno."},
     .wrong = "M06 T101001\nG00 X10\nM02\n[!G00 X20!]\n",
     .right = "M06 T101001\nG00 X10\nG00 X20\nM02\n"},
    {.code = "W117",
     .name = "condition-decided",
     .severity = Severity::Info,
     .section = "I.5",
     .arguments = {},
     .title = {.en = "Condition that is always decided", .it = "Condizione con un solo esito"},
     .message = {.en = "with the values set above, this condition always has the same outcome",
                 .it = "con i valori impostati sopra, questa condizione ha sempre lo stesso esito"},
     .explanation = {.en = "The register's value is known here on every path, so the jump is always or never taken. "
                           "Fine for a switch set at the top of the program, otherwise check the register and the "
                           "value. A false alarm where the register is such a switch.",
                     .it = "Qui il valore del registro è noto su ogni percorso, quindi il salto avviene sempre o mai. "
                           "Va bene per un selettore impostato in testa al programma, altrimenti controllare il "
                           "registro e il valore. Falso allarme se il registro è un selettore di questo tipo."},
     .wrong = "M06 T101001\nV1 = 0\n[!IF!] V1 = 1 GOTO N10\nG00 X10\nN10 G00 X20\nM02\n",
     .right = "M06 T101001\nIF VGPL = 1 GOTO N10\nG00 X10\nN10 G00 X20\nM02\n"},
    {.code = "W118",
     .name = "end-in-incremental",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.3.3",
     .arguments = {},
     .title = {.en = "Program end in incremental mode", .it = "Fine programma in incrementale"},
     .message = {.en = "the program ends with G91 in force", .it = "il programma finisce con la G91 in presa"},
     .explanation =
         {.en = "Every program starts in G90, so nothing breaks on this control. Where programs are joined, or run on "
                "a control that keeps its modes, what follows would move by offsets: write G90 before M02. Off by "
                "default; no false alarms are known beyond that.",
          .it = "Ogni programma parte in G90, quindi su questo controllo non succede nulla. Se però i programmi "
                "vengono uniti, o girano su un controllo che conserva i modi, ciò che segue si muoverebbe in "
                "incrementale: "
                "scrivere G90 prima della M02. Disattivata di norma; non si conoscono altri falsi allarmi."},
     .wrong = "M06 T101001\nG91\nG00 X10\n[!M02!]\n",
     .right = "M06 T101001\nG91\nG00 X10\nG90\nM02\n"},
    {.code = "W119",
     .name = "end-in-inches",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.3.1",
     .arguments = {},
     .title = {.en = "Program end in inches", .it = "Fine programma in pollici"},
     .message = {.en = "the program ends with G70 in force", .it = "il programma finisce con la G70 in presa"},
     .explanation =
         {.en = "Every program starts in G71, so nothing breaks on this control. Where programs are joined, or run on "
                "a control that keeps its modes, millimeters that follow would be read as inches: write G71 before "
                "M02. Off by default; no false alarms are known beyond that.",
          .it =
              "Ogni programma parte in G71, quindi su questo controllo non succede nulla. Se però i programmi vengono "
              "uniti, o girano su un controllo che conserva i modi, i millimetri che seguono verrebbero letti come "
              "pollici: scrivere G71 prima della M02. Disattivata di norma; non si conoscono altri falsi allarmi."},
     .wrong = "M06 T101001\nG70\nG00 X1\n[!M02!]\n",
     .right = "M06 T101001\nG70\nG00 X1\nG71\nM02\n"},
    {.code = "W120",
     .name = "motion-goes-nowhere",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.3.4",
     .arguments = {},
     .title = {.en = "Motion that goes nowhere", .it = "Movimento senza spostamento"},
     .message = {.en = "the tool is there already: nothing moves", .it = "l'utensile è già lì: non si muove nulla"},
     .explanation = {.en = "The motion ends where it starts. Often a post-processor only repeats the point, but a "
                           "wrong coordinate can hide there, or a G91 that was forgotten. Off by default, since "
                           "repeated points are common and harmless.",
                     .it = "Il movimento finisce dove comincia. Spesso è solo il post-processor che ripete il punto, "
                           "ma può nascondersi una quota sbagliata o una G91 dimenticata. Disattivata di norma, "
                           "perché i punti ripetuti sono frequenti e innocui."},
     .wrong = "M06 T101001\nG00 X10\n[!G00!] X10\nM02\n",
     .right = "M06 T101001\nG00 X10\nG00 X20\nM02\n"},
    {.code = "W121",
     .name = "register-never-assigned",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.6",
     .arguments = {},
     .title = {.en = "Register compared but never set", .it = "Registro confrontato ma mai impostato"},
     .message = {.en = "nothing in this program gives {text} a value",
                 .it = "nessuna linea di questo programma dà un valore a {text}"},
     .explanation = {.en = "The IF compares a register that the program gives no value anywhere. Check its number, or "
                           "set it at the top of the program. Off by default; a false alarm where the register is set "
                           "from outside, by the GPL or by a program that ran before.",
                     .it = "Un IF confronta un registro al quale il programma non dà mai un valore. Controllare il "
                           "numero, o impostarlo in testa al programma. Disattivata di norma; falso allarme se il "
                           "registro viene impostato da fuori, dal GPL o da un programma eseguito prima."},
     .wrong = "M06 T101001\nIF [!V3!] = 1 GOTO N10\nG00 X10\nN10 G00 X20\nM02\n",
     .right = "M06 T101001\nIF VGPL = 1 GOTO N10\nG00 X10\nN10 G00 X20\nM02\n"},
    {.code = "W122",
     .name = "register-never-read",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.6",
     .arguments = {},
     .title = {.en = "Register set but never compared", .it = "Registro impostato ma mai confrontato"},
     .message = {.en = "no IF of this program compares {text}", .it = "nessun IF di questo programma confronta {text}"},
     .explanation =
         {.en = "The register is given a value that no IF looks at. It may be left over, or the IF names another "
                "number. Off by default; a false alarm where the GPL reads the register.",
          .it = "Al registro viene dato un valore che nessun IF confronta. Può essere un resto, oppure l'IF indica "
                "un altro numero. Disattivata di norma; falso allarme se il registro viene letto dal GPL."},
     .wrong = "M06 T101001\n[!V2!] = 5\nG00 X10\nM02\n",
     .right = "M06 T101001\nG00 X10\nM02\n"},
    {.code = "W123",
     .name = "label-never-used",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.5",
     .arguments = {},
     .title = {.en = "Label that no jump names", .it = "Etichetta che nessun salto indica"},
     .message = {.en = "no GOTO leads to {text}", .it = "nessun GOTO porta a {text}"},
     .explanation = {.en = "Only few lines of this program have a number, so a number is there to be jumped to, and to "
                           "this one no GOTO leads. Delete it, or check the numbers after GOTO. Off by default; a "
                           "false alarm where a number only marks a place for the operator.",
                     .it = "In questo programma poche linee hanno un numero, quindi il numero serve per i salti, e a "
                           "questo non porta nessun GOTO. Toglierlo, o controllare i numeri dopo GOTO. Disattivata di "
                           "norma; falso allarme se il numero segna solo un punto per l'operatore."},
     .wrong = "M06 T101001\nIF VGPL = 1 GOTO N10\n[!N5!] G00 X10\nN10 G00 X20\nG00 X30\nG00 X40\nM02\n",
     .right = "M06 T101001\nIF VGPL = 1 GOTO N10\nG00 X10\nN10 G00 X20\nG00 X30\nG00 X40\nM02\n"},
    {.code = "W124",
     .name = "line-number-not-growing",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.2.1",
     .arguments = {"last"},
     .title = {.en = "Line number that does not grow", .it = "Numero di riga che non cresce"},
     .message = {.en = "{text} comes after N{last}: line numbers should grow",
                 .it = "{text} viene dopo N{last}: i numeri di riga dovrebbero crescere"},
     .explanation = {.en = "The number is the same as the one before, or smaller. The control does not mind, but a "
                           "search for the line to restart from finds the wrong one; isofmt --renumber puts them in "
                           "order. Off by default; a false alarm where parts are numbered each from its own start.",
                     .it = "Il numero è uguale a quello precedente, o minore. Al controllo non importa, ma chi cerca "
                           "la linea da cui ripartire trova quella sbagliata; isofmt --renumber li rimette in ordine. "
                           "Disattivata di norma; falso allarme se ogni parte ha una numerazione propria."},
     .wrong = "M06 T101001\nN20 G00 X10\n[!N10!] G00 X20\nM02\n",
     .right = "M06 T101001\nN10 G00 X10\nN20 G00 X20\nM02\n"},
    {.code = "W125",
     .name = "lower-case",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.1",
     .arguments = {},
     .title = {.en = "Small letters outside comments", .it = "Lettere minuscole fuori dai commenti"},
     .message = {.en = "small letters outside a comment", .it = "lettere minuscole fuori da un commento"},
     .explanation =
         {.en = "The control reads small letters as capitals and stores capitals, so a saved program differs from its "
                "file in every such line. isofmt writes capitals. Off by default; no false alarms are known.",
          .it = "Il controllo legge le minuscole come maiuscole e salva le maiuscole: il programma salvato è diverso "
                "dal file in ognuna di queste linee. isofmt scrive le maiuscole. Disattivata di norma; non si "
                "conoscono falsi allarmi."},
     .wrong = "M06 T101001\n[!g00 x!]10\nM02\n",
     .right = "M06 T101001\nG00 X10\nM02\n"},
    {.code = "W126",
     .name = "tab",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.1",
     .arguments = {},
     .title = {.en = "Tab outside comments", .it = "Tabulazione fuori dai commenti"},
     .message = {.en = "a tab outside a comment", .it = "una tabulazione fuori da un commento"},
     .explanation =
         {.en = "A tab means nothing to the control and is shown with a different width on every screen. isofmt writes "
                "a blank. Off by default; a false alarm where the shop sets its columns with tabs.",
          .it = "Per il controllo la tabulazione non significa nulla, e ogni schermo la mostra con una larghezza "
                "diversa. isofmt scrive uno spazio. Disattivata di norma; falso allarme se in officina si incolonna "
                "con le tabulazioni."},
     .wrong = "M06 T101001\nG00[!\t!]X10\nM02\n",
     .right = "M06 T101001\nG00 X10\nM02\n"},
    {.code = "W127",
     .name = "mixed-line-ends",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.1",
     .arguments = {},
     .title = {.en = "Mixed line ends", .it = "Terminatori di linea diversi"},
     .message = {.en = "from here on the line ends differ from those above",
                 .it = "da qui i terminatori di linea sono diversi da quelli precedenti"},
     .explanation =
         {.en = "The program has lines that end in CR, in LF or in both, as happens when pieces of several files are "
                "joined. The control reads them all; editors and version control may show lines doubled, or all as "
                "changed. Off by default; no false alarms are known.",
          .it =
              "Il programma ha linee che finiscono con CR, con LF o con entrambi, come capita quando si uniscono pezzi "
              "di più file. Il controllo le legge tutte; gli editor e il controllo di versione possono mostrare linee "
              "doppie, o tutte come modificate. Disattivata di norma; non si conoscono falsi allarmi."},
     .wrong = "M06 T101001\nG00 X10\n[!G00 X20!]\r\nM02\n",
     .right = "M06 T101001\nG00 X10\nG00 X20\nM02\n"},
    {.code = "W128",
     .name = "axes-nearly-unit",
     .severity = Severity::Info,
     .section = "I.3.2",
     .arguments = {"length"},
     .title = {.en = "Axis vector not quite of length 1", .it = "Versore di modulo non proprio 1"},
     .message = {.en = "this axis vector is {length} long: is a digit missing?",
                 .it = "il modulo di questo versore è {length}: manca una cifra?"},
     .explanation = {.en = "The control makes the vector a unit one and goes on, so only its direction counts. Its "
                           "length is further from 1 than three decimals explain and nearer than a length chosen on "
                           "purpose: a component may have a wrong digit, and then the direction is wrong. A false "
                           "alarm where the components are rounded to two decimals.",
                     .it = "Il controllo normalizza il versore e prosegue: conta solo la direzione. Il modulo è più "
                           "lontano da 1 di quanto spieghino tre decimali, ma troppo vicino per essere voluto: una "
                           "componente può avere una cifra sbagliata, e allora è sbagliata la direzione. Falso allarme "
                           "se le componenti sono arrotondate a due decimali."},
     .wrong = "M06 T101001\nG28 [!X0.98 Y0 Z0!] I0 J1 K0 P0 Q0 R1\nG27\nM02\n",
     .right = "M06 T101001\nG28 X1 Y0 Z0 I0 J1 K0 P0 Q0 R1\nG27\nM02\n"},
    {.code = "W129",
     .name = "unnamed-function",
     .severity = Severity::Warning,
     .section = "I.4.4",
     .arguments = {},
     .title = {.en = "M function that the machine file does not name",
               .it = "Funzione M non indicata nel file macchina"},
     .message = {.en = "{text} is not among the M functions of the machine file",
                 .it = "{text} non è fra le funzioni M del file macchina"},
     .explanation = {.en =
                         "The machine file lists the M functions of the shop, and this is none of them. Check the "
                         "number, or add the function to isocnc.json. Only reported where the file has such a list; a "
                         "false alarm where the list is not complete.",
                     .it = "Il file macchina elenca le funzioni M dell'officina, e questa non c'è. Controllare il "
                           "numero, o aggiungere la funzione a isocnc.json. Segnalata solo se il file contiene un "
                           "elenco; falso allarme se l'elenco non è completo."},
     .wrong = "M06 T101001\n[!M77!]\nM02\n",
     .right = "M06 T101001\nM100\nM02\n"},
    {.code = "W130",
     .name = "travel-exceeded",
     .severity = Severity::Warning,
     .section = "I.3.4",
     .arguments = {"axis", "reached", "limit"},
     .title = {.en = "Axis travel exceeded", .it = "Asse fuori corsa"},
     .message = {.en = "{axis} goes to {reached} in machine coordinates, and its travel ends at {limit}{inches}",
                 .it = "l'asse {axis} va fuori corsa: arriva a {reached} in coordinate macchina, e la corsa finisce a "
                       "{limit}{inches}"},
     .explanation =
         {.en =
              "During this motion, the bulge of an arc included, the tool tip leaves the travel that the "
              "machine "
              "file gives, in machine coordinates. Check the coordinate and the workpiece origin, or the file. A false "
              "alarm where the file gives the travel of the joints of a tilting head, which is not that of the tip.",
          .it = "Durante questo movimento, compresa la freccia di un arco, la punta dell'utensile esce dalla corsa "
                "indicata nel file macchina, in coordinate macchina. Controllare la quota e lo zero pezzo, "
                "oppure il file. Falso allarme se il file indica la corsa degli assi di una macchina a testa "
                "orientabile, che non è quella della punta."},
     .wrong = "M06 T101001\nG00 [!X1200!] Y10\nM02\n",
     .right = "M06 T101001\nG00 X900 Y10\nM02\n"},
    {.code = "W131",
     .name = "feed-above-machine",
     .severity = Severity::Warning,
     .section = "I.3.7",
     .arguments = {"feed", "limit"},
     .title = {.en = "Feed rate above the machine's", .it = "Avanzamento oltre quello della macchina"},
     .message = {.en = "{text} means {feed} mm/min, more than the machine's {limit}",
                 .it = "{text} vale {feed} mm/min, oltre i {limit} della macchina"},
     .explanation =
         {.en = "The feed is above what the machine file allows; in G93 it follows from the length of the motion. The "
                "machine will be slower than the program asks, so the cut differs from what was planned. A false alarm "
                "where the program counts on the machine to slow down.",
          .it = "L'avanzamento supera quello ammesso dal file macchina; in G93 dipende dalla lunghezza del movimento. "
                "La macchina andrà più piano di quanto chiede il programma, e la lavorazione sarà diversa da quella "
                "prevista. Falso allarme se il programma conta sul rallentamento della macchina."},
     .wrong = "M06 T101001\nG01 X100 [!F15000!]\nM02\n",
     .right = "M06 T101001\nG01 X100 F1500\nM02\n"},
    {.code = "W132",
     .name = "rotary-speed-above-machine",
     .severity = Severity::Warning,
     .section = "I.3.7",
     .arguments = {"speed", "limit"},
     .title = {.en = "Rotary axis faster than the machine", .it = "Asse rotante oltre la velocità della macchina"},
     .message = {.en = "{text} would turn at {speed} degrees/min, more than the machine's {limit}",
                 .it = "{text} girerebbe a {speed} gradi/min, oltre i {limit} della macchina"},
     .explanation = {.en = "At this feed the rotary axis would have to turn faster than the machine file allows, as "
                           "happens near a singular position or on short moves. Lower the feed, or spread the turn "
                           "over a longer way. A false alarm where the program counts on the machine to slow down.",
                     .it = "Con questo avanzamento l'asse rotante dovrebbe girare più in fretta di quanto ammette il "
                           "file macchina, come capita vicino a una posizione singolare o su tratti corti. Ridurre "
                           "l'avanzamento, o distribuire la rotazione su un tratto più lungo. Falso allarme se il "
                           "programma conta sul rallentamento della macchina."},
     .wrong = "M06 T101001\nG49\nG01 X10 [!C90!] F5000\nM02\n",
     .right = "M06 T101001\nG49\nG01 X10 C90 F100\nM02\n"},
    {.code = "W133",
     .name = "spindle-speed-above-machine",
     .severity = Severity::Warning,
     .section = "I.4.2",
     .arguments = {"limit"},
     .title = {.en = "Spindle speed above the machine's", .it = "Giri mandrino oltre quelli della macchina"},
     .message = {.en = "{text} is more than the machine's {limit} rev/min",
                 .it = "{text} supera i {limit} giri/min della macchina"},
     .explanation = {.en = "The spindle speed is above what the machine file allows. Check the number, or the file. No "
                           "false alarms are known, as long as the file is right.",
                     .it = "I giri del mandrino superano quelli ammessi dal file macchina. Controllare il numero, "
                           "oppure il file. Se il file è giusto non si conoscono falsi allarmi."},
     .wrong = "M06 T101001\n[!S24000!]\nM02\n",
     .right = "M06 T101001\nS12000\nM02\n"},
    {.code = "W134",
     .name = "rapid-below-clearance",
     .severity = Severity::Warning,
     .section = "I.3.4.1",
     .arguments = {"z", "clearance"},
     .title = {.en = "Rapid below the clearance", .it = "Rapido sotto la quota di sicurezza"},
     .message = {.en = "a rapid to Z = {z} mm of the face, below the clearance of {clearance} mm",
                 .it = "rapido a Z = {z} mm rispetto alla faccia, sotto la quota di sicurezza di {clearance} mm"},
     .explanation =
         {.en = "The machine file gives a clearance height above the face, and this rapid goes down below it or moves "
                "across the face beneath it. Approach with a feed move, or raise the tool first. A false alarm where "
                "the way is known to be free, as between two slots, or right after another face has been mounted.",
          .it = "Il file macchina indica una quota di sicurezza sopra la faccia, e questo rapido scende sotto di essa "
                "o si sposta sopra la faccia a quota inferiore. Avvicinarsi con un movimento in lavoro, o sollevare "
                "prima l'utensile. Falso allarme se si sa che la strada è libera, come fra due cave, o subito dopo "
                "aver montato un'altra faccia."},
     .wrong = "M06 T101001\nG00 X10 Y10 Z20\nG00 [!Z1!]\nM02\n",
     .right = "M06 T101001\nG00 X10 Y10 Z20\nG00 Z5\nG01 Z1 F500\nM02\n"},
    {.code = "W135",
     .name = "tool-never-cuts",
     .severity = Severity::Warning,
     .section = "I.4.3",
     .arguments = {},
     .title = {.en = "Tool changed before it cut", .it = "Utensile cambiato prima di lavorare"},
     .message = {.en = "the tool before this change has made no feed move",
                 .it = "l'utensile montato prima di questo cambio non ha fatto alcun movimento in lavoro"},
     .explanation =
         {.en = "A tool was mounted and is changed for another without a single feed move or M function of the shop. "
                "Its operation may be missing, or the tool call left over, which costs a tool change. A false alarm "
                "where the tool was mounted to be measured or looked at.",
          .it = "Un utensile è stato montato e viene cambiato senza un solo movimento in lavoro né una funzione M "
                "dell'officina. Può mancare la sua lavorazione, o essere rimasta la chiamata, che costa un cambio "
                "utensile. Falso allarme se l'utensile è stato montato per misurarlo o controllarlo."},
     .wrong = "M06 T101001\nG00 Z50\n[!M06!] T102001\nG01 Z5 F500\nM02\n",
     .right = "M06 T101001\nG01 Z50 F500\nM06 T102001\nG01 Z5\nM02\n"},
    {.code = "W136",
     .name = "tool-already-mounted",
     .severity = Severity::Info,
     .is_off = true,
     .section = "I.4.3",
     .arguments = {},
     .title = {.en = "Tool that is mounted already", .it = "Utensile già montato"},
     .message = {.en = "{text} is mounted already", .it = "{text} è già montato"},
     .explanation =
         {.en = "The change is to the tool that the spindle holds. Most machines skip it, some change it for itself; "
                "or another tool was meant. Off by default; a false alarm where each operation calls its tool on "
                "purpose, so that it can be run alone.",
          .it = "Il cambio chiama l'utensile che è già nel mandrino. Molte macchine lo saltano, alcune lo depositano e "
                "lo riprendono; oppure si voleva un altro utensile. Disattivata di norma; falso allarme se ogni "
                "lavorazione richiama apposta il suo utensile, per poter essere eseguita da sola."},
     .wrong = "M06 T101001\nG01 Z5 F500\nM06 [!T101001!]\nG01 Z1\nM02\n",
     .right = "M06 T101001\nG01 Z5 F500\nG01 Z1\nM02\n"},
    {.code = "W137",
     .name = "compensation-begins-on-arc",
     .severity = Severity::Warning,
     .section = "I.3.12",
     .arguments = {},
     .title = {.en = "Cutter compensation that starts on an arc",
               .it = "Correzione raggio fresa che inizia su un arco"},
     .message = {.en = "the first motion under cutter compensation is an arc",
                 .it = "il primo movimento con la correzione raggio fresa è un arco"},
     .explanation = {.en = "The tool has to move sideways by its radius while compensation starts, which an arc cannot "
                           "do without leaving a mark; many controls refuse it. Start with a straight move that leads "
                           "onto the contour. No false alarms are known.",
                     .it = "Quando inizia la correzione l'utensile deve spostarsi di lato del suo raggio, e su un "
                           "arco non può farlo senza lasciare il segno; molti controlli lo rifiutano. Iniziare con un "
                           "tratto rettilineo di ingresso sul profilo. Non si conoscono falsi allarmi."},
     .wrong = "M06 T101001\nG01 X0 Y0 F500\nG41\n[!G02!] X20 Y0 I10 J0\nG40\nM02\n",
     .right = "M06 T101001\nG01 X0 Y0 F500\nG41 G01 X10 Y0\nG02 X30 Y0 I20 J0\nG40\nM02\n"},
    {.code = "W138",
     .name = "compensation-gouge",
     .severity = Severity::Warning,
     .evidence = Evidence::Run,
     .section = "I.3",
     .arguments = {"radius"},
     .title = {.en = "Cutter that goes into the contour", .it = "Fresa che intacca il profilo"},
     .message = {.en = "here a cutter of radius {radius} {unit} goes into the contour that it should leave",
                 .it = "qui una fresa di raggio {radius} {unit} intacca il profilo che deve restare"},
     .explanation =
         {.en = "Beside the contour there is no room for the cutter: a slot is narrower than it, an inside corner has "
                "steps shorter than it, or the way on or off the contour leads across it. Mount a smaller cutter, "
                "start and end beside the contour, or let G39 leave out what the cutter cannot reach. A false alarm "
                "where the tool crosses above the work in feed.",
          .it = "A lato del profilo non c'è spazio per la fresa: una cava è più stretta della fresa, un angolo interno "
                "ha gradini più corti, oppure l'ingresso o l'uscita attraversano il profilo. Montare una fresa più "
                "piccola, entrare e uscire di lato, oppure con la G39 lasciar fuori ciò che la fresa non raggiunge. "
                "Falso allarme se l'utensile attraversa sopra il pezzo in lavoro."},
     .wrong = "M06 T101001\nG01 X30 Y20 F5000\nG41 [!G01 X0 Y0!]\nY50\nG40\nM02\n",
     .right = "M06 T101001\nG01 X-10 Y-30 F5000\nG41 G01 X0 Y0\nY50\nG40\nM02\n"},
    {.code = "W139",
     .name = "inside-arc-too-small",
     .severity = Severity::Warning,
     .evidence = Evidence::Run,
     .section = "I.3",
     .arguments = {"arc", "radius"},
     .title = {.en = "Inside arc smaller than the cutter", .it = "Arco interno più piccolo della fresa"},
     .message = {.en = "an inside arc of radius {arc} {unit} is too small for a cutter of radius {radius} {unit}",
                 .it =
                     "un arco interno di raggio {arc} {unit} è troppo piccolo per una fresa di raggio {radius} {unit}"},
     .explanation =
         {.en = "The cutter does not fit into the arc: many controls stop here, others cut into the contour on both "
                "sides of it. Mount a smaller cutter or program a larger arc; with G39 the arc is left out, and "
                "material stays in the corner. No false alarms are known, as long as the tool's radius is right.",
          .it = "La fresa non entra nell'arco: molti controlli si fermano, altri intaccano il profilo da una parte e "
                "dall'altra. Montare una fresa più piccola o programmare un arco più grande; con la G39 l'arco viene "
                "saltato e nell'angolo resta del materiale. Se il raggio dell'utensile è giusto non si conoscono falsi "
                "allarmi."},
     .wrong = "M06 T101001\nG01 X-10 Y-30 F5000\nG41 G01 X0 Y0\nY45\n[!G03 X-5 Y50 R5!]\nG01 X-40\nG40\nM02\n",
     .right = "M06 T101001\nG01 X-10 Y-30 F5000\nG41 G01 X0 Y0\nY30\nG03 X-20 Y50 R20\nG01 X-40\nG40\nM02\n"},
    {.code = "W140",
     .name = "compensation-not-applied",
     .severity = Severity::Warning,
     .evidence = Evidence::Run,
     .section = "I.3",
     .arguments = {},
     .title = {.en = "Motion without its compensation", .it = "Movimento senza la sua correzione"},
     .message = {.en = "this motion runs without compensation: it turns B or C, or the axes in force are oblique",
                 .it = "questo movimento resta senza correzione: ruota B o C, oppure gli assi in presa sono obliqui"},
     .explanation =
         {.en = "G41 and G42 move the tool sideways in the arc plane, which takes axes at right angles and a tool that "
                "keeps its direction. The simulated machine ends the compensation before such a motion and takes it up "
                "after it; the control may do otherwise. Write G40 before it. No false alarms are known.",
          .it = "La G41 e la G42 spostano l'utensile di lato nel piano di interpolazione: servono assi ad angolo retto "
                "e un utensile che non cambi direzione. La macchina simulata toglie la correzione prima di questo "
                "movimento e la riprende dopo; il controllo può comportarsi diversamente. Scrivere prima la G40. Non "
                "si conoscono falsi allarmi."},
     .wrong = "M06 T101001\nG49\nG01 X10 Y40 F5000\nG41 G01 X10 Y10\nX50\n[!X60 Y40 B5!]\nG40\nM02\n",
     .right = "M06 T101001\nG49\nG01 X10 Y40 F5000\nG41 G01 X10 Y10\nX50\nG40\nX60 Y40 B5\nM02\n"},
    {.code = "W141",
     .name = "spindle-started-late",
     .severity = Severity::Warning,
     .section = "I.4.2",
     .arguments = {},
     .title = {.en = "Spindle started after the first feed move",
               .it = "Mandrino avviato dopo il primo movimento in lavoro"},
     .message = {.en = "{text} starts the spindle for the first time, but feed moves stand before it",
                 .it = "{text} avvia il mandrino per la prima volta, ma prima ci sono già movimenti in lavoro"},
     .explanation =
         {.en =
              "Nothing has started the spindle before the first feed move of the program: it runs with the spindle "
              "stopped. Write S and M03 or M04 before it. A false alarm where a probe goes first, or where the shop's "
              "tool change starts the spindle.",
          .it =
              "Prima del primo movimento in lavoro nulla avvia il mandrino: il movimento avviene a mandrino fermo. "
              "Scrivere prima la S e la M03 o M04. Falso allarme se prima si usa un tastatore, o se il mandrino parte "
              "già con il cambio utensile."},
     .wrong = "M06 T101001\nG01 X10 F1000\nS12000 [!M03!]\nX20\nM05\nM02\n",
     .right = "M06 T101001\nS12000 M03\nG01 X10 F1000\nX20\nM05\nM02\n"},
    {.code = "W142",
     .name = "center-legal-both-ways",
     .severity = Severity::Warning,
     .section = "I.3.4.3.a",
     .arguments = {"absolute", "relative"},
     .title = {.en = "Arc center that may have been meant from the start",
               .it = "Centro dell'arco forse riferito al punto iniziale"},
     .message = {.en =
                     "the radius is {absolute} mm as written (G90: absolute center), and {relative} mm with the center "
                     "counted from the start, as other arcs of this program have it",
                 .it =
                     "il raggio è di {absolute} mm così come è scritto (G90: centro assoluto), e di {relative} mm con "
                     "il centro riferito al punto iniziale, come in altri archi di questo programma"},
     .explanation =
         {.en = "Other arcs of the program have an ISO031 or its like, and fit once I, J and K count from the start of "
                "the arc, as on other controls. This arc is legal both ways, so the control would run it without a "
                "word, about an absolute center: write that center, if it is not the one meant. A full turn is legal "
                "about any center. A false alarm where the mistake is in the other arcs alone.",
          .it =
              "Altri archi del programma danno ISO031 o un errore simile, e tornano se I, J e K sono riferiti al punto "
              "iniziale dell'arco, come su altri controlli. Questo arco è lecito in entrambi i modi: il controllo lo "
              "eseguirebbe senza segnalare nulla, attorno a un centro assoluto. Se il centro inteso è un altro, "
              "scriverlo. Un giro completo è lecito attorno a qualsiasi centro. Falso allarme se sbagliati sono solo "
              "gli altri archi."},
     .wrong = "",
     .right = ""},
    {.code = "W143",
     .name = "house-rule",
     .severity = Severity::Warning,
     .section = "I.4",
     .arguments = {"value", "limit"},
     .title = {.en = "Rule of the shop", .it = "Regola dell'officina"},
     .message = {.en = "{said} ({who})", .it = "{said} ({who})"},
     .causes = {{.cause = "low-speed",
                 .message = {.en = "{said} ({who}): S is {value}, and at least {limit} is right here",
                             .it = "{said} ({who}): S è {value}, e qui ci vuole almeno {limit}"},
                 .wrong = "M06 T101002\nM08\n[!S2000!] M03\nG01 X10 F1000\nM05\nM02\n"},
                {.cause = "high-speed",
                 .message = {.en = "{said} ({who}): S is {value}, and at most {limit} is right here",
                             .it = "{said} ({who}): S è {value}, e qui ci vuole al massimo {limit}"},
                 .wrong = "M06 T101001\nM08\nS18000 M03\nG01 X10 F1000\nM05\nM06 T101002\nM08\nM03\n[!G01!] X20\n"
                          "M05\nM02\n"},
                {.cause = "low-feed",
                 .message = {.en = "{said} ({who}): the feed is {value} mm/min, and at least {limit} is right here",
                             .it = "{said} ({who}): l'avanzamento è di {value} mm/min, e qui ci vuole almeno {limit}"},
                 .wrong = "M06 T101002\nM08\nG01 X10 [!F80!]\nM02\n"},
                {.cause = "high-feed",
                 .message = {.en = "{said} ({who}): the feed is {value} mm/min, and at most {limit} is right here",
                             .it = "{said} ({who}): l'avanzamento è di {value} mm/min, e qui ci vuole al massimo "
                                   "{limit}"},
                 .wrong = "M06 T101002\nM08\nG01 X10 [!F9000!]\nM02\n"},
                {.cause = "too-deep",
                 .message = {.en = "{said} ({who}): this goes down to Z{value} {unit}, and Z{limit} is the lowest",
                             .it = "{said} ({who}): qui si scende a Z{value} {unit}, e il minimo è Z{limit}"},
                 .wrong = "M06 T101002\nM08\nG01 [!Z-25!] F1000\nM02\n"}},
     .explanation =
         {.en =
              "The program breaks a rule that your shop has set in its isocnc.json, under `lint.houseRules`; the name "
              "in parentheses is the id of the rule, and the sentence before it comes from there. The control knows "
              "nothing of such rules. A rule is judged on each path through the program, and its weight is the one "
              "that it states, unless a severity is given for W143. A false alarm where the rule does not fit the "
              "job: silence the line, or change the rule.",
          .it =
              "Il programma non rispetta una regola che la tua officina ha scritto nel suo isocnc.json, sotto "
              "`lint.houseRules`; il nome fra parentesi è l'id della regola, e la frase che lo precede viene da lì. "
              "Il controllo non sa nulla di queste regole. Una regola si giudica su ogni via attraverso il programma, "
              "e il suo peso è quello che essa indica, se non se ne dà uno a W143. Falso allarme se la regola non "
              "vale per questo lavoro: si tolga la segnalazione da quella linea, o si cambi la regola."},
     .wrong = "M06 T101001\nS12000 M03\n[!G01!] X10 F1000\nM08\nX20\nM05\nM02\n",
     .right = "M06 T101001\nS12000 M03\nM08\nG01 X10 F1000\nX20\nM05\nM02\n"},
    {.code = "W154",
     .name = "near-miss",
     .severity = Severity::Info,
     .evidence = Evidence::Scene,
     .section = "I.3.4",
     .arguments = {"distance", "x", "y", "z", "time"},
     .title = {.en = "Near miss", .it = "Passaggio troppo vicino"},
     .message = {.en = "{who} passes {distance} {unit} from {whom} at X{x} Y{y} Z{z}, {time} s after the start",
                 .it = "{who} passa a {distance} {unit} da {whom} in X{x} Y{y} Z{z}, {time} s dopo l'avvio"},
     .explanation =
         {.en = "Nothing is hit, but what passes is nearer than the clearance of the setup (2 mm unless it says "
                "otherwise). A fixture that stands a little off its place, or a tool that is a little longer, would be "
                "hit. Keep more distance, or set clearance to what the shop is content with.",
          .it = "Non viene urtato nulla, ma il passaggio è più vicino della distanza di sicurezza dell'attrezzaggio "
                "(clearance: 2 mm se non è scritta). Un attrezzaggio un po' fuori posto, o un utensile un po' più "
                "lungo, verrebbe urtato. Tenere più distanza, o mettere in clearance quella di cui l'officina si "
                "accontenta."},
     .wrong = "M06 T101001\nG00 X100 Y20 Z50\nG01 Z31 F1000\n[!X300!]\nZ50\nM02\n",
     .right = "M06 T101001\nG00 X100 Y20 Z50\nG01 Z33 F1000\nX300\nZ50\nM02\n"},
    {.code = "W156",
     .name = "material-left",
     .severity = Severity::Warning,
     .evidence = Evidence::Stock,
     .section = "I.3.4",
     .arguments = {"height", "x", "y", "z", "tolerance", "volume"},
     .title = {.en = "Material left on the finished part", .it = "Materiale rimasto sul pezzo finito"},
     .message = {.en =
                     "material is left on the finished part: up to {height} {unit} beyond its tolerance of {tolerance} "
                     "{unit}, at X{x} Y{y} Z{z}; {volume} cm3 beyond it in one piece",
                 .it = "sul pezzo finito resta materiale: fino a {height} {unit} oltre la tolleranza di {tolerance} "
                       "{unit}, in X{x} Y{y} Z{z}; {volume} cm3 oltre la tolleranza in un solo pezzo"},
     .explanation =
         {.en = "At the end of the program more material stands on the finished part of the setup (target) than its "
                "tolerance allows. The finding stands at the line that has cut last near it, or at the end of the "
                "program. A pass may be missing, or the tool too large for a corner. What has come free of the part "
                "does not count. A false alarm where another program finishes the part, or where tabs are left on "
                "purpose.",
          .it = "Alla fine del programma sul pezzo finito dell'attrezzaggio (target) resta più materiale di quanto la "
                "tolleranza ammetta. La segnalazione è sulla linea che ha tagliato per ultima lì vicino, o alla fine "
                "del programma. Può mancare una passata, o l'utensile essere troppo grande per uno spigolo. Ciò che si "
                "è staccato dal pezzo non conta. Falso allarme se un altro programma finisce il pezzo, o se i "
                "testimoni sono lasciati apposta."},
     .wrong = "M06 T101002\nS12000 M03\nG00 X200 Y120 Z50\nG01 Z30 F1000\n[!X500!]\nG00 Z50\nM05\nM02\n",
     .right = "M06 T101002\nS12000 M03\nG00 X200 Y150 Z50\nG01 Z30 F1000\nX500\nG00 Z50\nM05\nM02\n"},
    {.code = "W157",
     .name = "cut-too-deep",
     .severity = Severity::Warning,
     .evidence = Evidence::Stock,
     .section = "I.4.3",
     .arguments = {"depth", "x", "y", "z", "time", "limit"},
     .title = {.en = "Cut deeper than the tool allows", .it = "Passata troppo profonda per l'utensile"},
     .message =
         {.en = "{who} cuts {depth} {unit} deep at once at X{x} Y{y} Z{z}, {time} s after the start; it may go "
                "{limit} {unit} deep",
          .it = "{who} taglia {depth} {unit} in una passata in X{x} Y{y} Z{z}, {time} s dopo l'avvio; il massimo è "
                "{limit} {unit}"},
     .causes =
         {{.cause = "edge-too-short",
           .message = {.en = "{who} is {depth} {unit} deep in the material at X{x} Y{y} Z{z}, {time} s after the "
                             "start; its edge is {limit} {unit} long, and the shank rubs",
                       .it = "{who} è a {depth} {unit} di profondità nel materiale in X{x} Y{y} Z{z}, {time} s dopo "
                             "l'avvio; il tagliente è lungo {limit} {unit}, e il gambo striscia"},
           .wrong = "M06 T101004\nS12000 M03\nG00 X350 Y150 Z50\nG01 Z30 F1000\nX400\n[!Z12!]\nG00 Z50\nM05\nM02\n"}},
     .explanation =
         {.en = "machine.tools of isocnc.json says how much the tool may cut at once (maxDepth) and how long its edge "
                "is (cutLength). Where more is cut at once the tool may break; where a wall stands beside the shank, "
                "above the edge, the shank rubs and burns. Take more passes, or a tool with a longer edge or a thinner "
                "shank.",
          .it = "machine.tools di isocnc.json dice quanto l'utensile può asportare in una passata (maxDepth) e quanto "
                "è lungo il suo tagliente (cutLength). Asportando di più l'utensile si può rompere; dove una parete "
                "sta accanto al gambo, sopra il tagliente, il gambo striscia e brucia. Fare più passate, o usare un "
                "utensile col tagliente più lungo o il gambo più sottile."},
     .wrong = "M06 T101003\nS12000 M03\nG00 X350 Y150 Z50\n[!G01 Z20!] F1000\nG00 Z50\nM05\nM02\n",
     .right = "M06 T101003\nS12000 M03\nG00 X350 Y150 Z50\nG01 Z32 F1000\nG00 Z50\nM05\nM02\n"},
    {.code = "W159",
     .name = "cuts-nothing",
     .severity = Severity::Info,
     .is_off = true,
     .evidence = Evidence::Stock,
     .section = "I.3.4.2",
     .arguments = {"length"},
     .title = {.en = "Feed that cuts nothing", .it = "Lavoro che non taglia nulla"},
     .message = {.en = "the tool goes {length} {unit} in feed from here without meeting material",
                 .it = "da qui l'utensile percorre {length} {unit} in lavoro senza incontrare materiale"},
     .explanation =
         {.en = "Time is lost where the tool goes in feed through air: a pass that is there twice, a blank that is "
                "smaller than the program thinks, an approach from too far. Ways of up to 50 mm are left alone. Off by "
                "default: finishing passes at a contour that is clean already meet nothing, and are meant.",
          .it = "Si perde tempo dove l'utensile va in lavoro nell'aria: una passata ripetuta, un grezzo più piccolo di "
                "quello pensato, un avvicinamento da troppo lontano. Fino a 50 mm non si segnala. Disattivata di "
                "norma: le passate di finitura su un contorno già pulito non incontrano nulla, e sono volute."},
     .wrong = "M06 T101001\nS12000 M03\nG00 X350 Y150 Z60\n[!G01 X500!] F1000\nG00 Z70\nM05\nM02\n",
     .right = "M06 T101001\nS12000 M03\nG00 X350 Y150 Z60\nG00 X500\nZ70\nM05\nM02\n"},
    {.code = "W161",
     .name = "loose-piece",
     .severity = Severity::Warning,
     .evidence = Evidence::Stock,
     .section = "I.3.4",
     .arguments = {"height", "x", "y", "z", "time", "volume"},
     .title = {.en = "Piece that comes free", .it = "Pezzo che si stacca"},
     .message =
         {.en =
              "a piece of {volume} cm3 comes free here, and nothing holds it: around X{x} Y{y} Z{z}{inches}, {time} s "
              "after the start",
          .it =
              "qui si stacca un pezzo di {volume} cm3 che nulla trattiene: intorno a X{x} Y{y} Z{z}{inches}, {time} s "
              "dopo l'avvio"},
     .explanation =
         {.en = "The cut is closed, and what it has separated touches no cup, clamp or stop of the setup, nor lies on "
                "its spoilboard: the tool may catch it and throw it. Leave tabs, hold the piece, or cut it up. A false "
                "alarm where the machine holds it with what the setup does not describe.",
          .it =
              "Il taglio è chiuso, e ciò che ha separato non tocca nessuna ventosa, morsetto o riscontro "
              "dell'attrezzaggio, né poggia sul suo piano martire: l'utensile può prenderlo e scagliarlo. Lasciare "
              "dei testimoni, trattenere il pezzo, o ridurlo in trucioli. Falso allarme se alla macchina lo trattiene "
              "qualcosa che l'attrezzaggio non descrive."},
     .wrong =
         "M06 T101001\nS12000 M03\nG00 X315 Y120 Z50\nG01 Z-1 F1000\nX385\nY180\nX315\n[!Y120!]\nG00 Z50\nM05\nM02\n",
     .right = "M06 T101001\nS12000 M03\nG00 X315 Y120 Z50\nG01 Z-1 F1000\nX385\nY180\nX315\nY160\nG00 Z50\nM05\nM02\n"},
    {.code = "W162",
     .name = "not-verified",
     .severity = Severity::Info,
     .evidence = Evidence::Run,
     .section = "I.1",
     .arguments = {"paths", "spacing"},
     .title = {.en = "Not verified on the machine", .it = "Non verificato sulla macchina"},
     .message = {.en = "the simulated machine stops at this error, as the control would: what it would do from here "
                       "on is not verified",
                 .it = "la macchina simulata si ferma a questo errore, come farebbe il controllo: che cosa farebbe da "
                       "qui in poi non è verificato"},
     .causes =
         {{.cause = "tool-without-shape",
           .message = {.en = "what {who} would hit is not verified: its shape is not known",
                       .it = "che cosa urterebbe {who} non è verificato: la sua forma non è nota"},
           .wrong = "[!M06 T101002!]\nG00 X100 Y100 Z50\nM02\n"},
          {.cause = "tool-without-length",
           .message = {.en = "what {who} would hit is not verified: its length is not known",
                       .it = "che cosa urterebbe {who} non è verificato: la sua lunghezza non è nota"},
           .wrong = "[!M06 T101003!]\nG00 X100 Y100 Z50\nM02\n"},
          {.cause = "undecided",
           .message = {.en = "whether this motion hits anything could not be decided",
                       .it = "non è stato possibile decidere se questo movimento urta qualcosa"},
           .wrong = "M06 T101001\n[!G00 X2000000!]\nM02\n"},
          {.cause = "resolution-too-fine",
           .message = {.en = "the material is not verified: at the resolution that is asked for it takes more memory "
                             "than there is for it; {spacing} mm would fit",
                       .it = "il materiale non è verificato: con la risoluzione richiesta occupa più "
                             "memoria di quella prevista; con {spacing} mm ci sta"},
           .wrong = ""},
          {.cause = "setup-mistaken",
           .message = {.en = "what this program would hit is not verified: the description of its setup has a mistake",
                       .it = "che cosa urterebbe questo programma non è verificato: la descrizione del suo "
                             "attrezzaggio ha un errore"},
           .wrong = ""},
          {.cause = "other-paths",
           .message = {.en = "where this jump leads with other values of VGPL is not verified (paths that were "
                             "run: {paths})",
                       .it = "dove porta questo salto con altri valori di VGPL non è verificato (percorsi "
                             "eseguiti: {paths})"},
           .wrong = "IF VGPL = 1 GOTO N90\nIF VGPL = 2 GOTO N90\nIF VGPL = 3 GOTO N90\nIF VGPL = 4 GOTO N90\n"
                    "IF VGPL = 5 GOTO N90\nIF VGPL = 6 GOTO N90\nIF VGPL = 7 GOTO N90\n"
                    "[!IF VGPL = 8 GOTO N90!]\nG04 P1\nN90 M02\n"},
          {.cause = "other-registers",
           .message = {.en = "where this jump leads with other values of {who} is not verified: the program does "
                             "not set {who} before",
                       .it = "dove porta questo salto con altri valori di {who} non è verificato: il programma "
                             "non assegna prima {who}"},
           .wrong = "[!IF V3 = 1 GOTO N90!]\nG04 P1\nN90 M02\n"}},
     .explanation =
         {.en = "The machine was asked (--verify), and could not follow or compare everything: mistakes that only a "
                "run shows, such as a joint outside its travel or a clamp that is hit, may go unreported from this "
                "place on. Correct the error on this line, or describe the tool in isocnc.json (length, shape and "
                "radius), and verify again. Of a program whose jumps compare VGPL, isolint and the editor run up to 8 "
                "paths, each with one value of VGPL, and isorun that of --vgpl. Registers that the program does not "
                "set keep their value from the start, which is 0: isorun --set gives them another.",
          .it = "La macchina è stata interrogata (--verify) e non ha potuto seguire o confrontare tutto: gli errori "
                "che si vedono solo eseguendo il programma, come un asse macchina fuori corsa o un morsetto urtato, "
                "da qui in poi possono non essere segnalati. Correggere l'errore su questa linea, oppure descrivere "
                "l'utensile in isocnc.json (length, shape e radius), e verificare di nuovo. Di un programma i cui "
                "salti confrontano VGPL, isolint e l'editor eseguono fino a 8 percorsi, ciascuno con un valore di "
                "VGPL, e isorun quello di --vgpl. I registri che il programma non assegna tengono il valore iniziale, "
                "che è 0: isorun --set ne dà un altro."},
     .wrong = "M06 T101001\nG00 X100\n[!G01!] X50\nM02\n",
     .right = "M06 T101001\nG00 X100\nG01 X50 F1000\nM02\n"},
    {.code = "W190",
     .name = "useless-suppression",
     .severity = Severity::Warning,
     .section = "I.2.3",
     .arguments = {},
     .title = {.en = "isolint comment without effect", .it = "Commento per isolint senza effetto"},
     .message = {.en = "\"{text}\" changes nothing in what is reported",
                 .it = "«{text}» non cambia nulla di ciò che viene segnalato"},
     .explanation = {.en = "The comment names nothing that is found where it counts, or a code that does not exist. "
                           "With ignore it counts on its own line, with disable from its line to the line before "
                           "enable, with ignore-file in the whole program. If the program has been mended, delete the "
                           "comment, which would hide the next mistake. Otherwise correct it, or move it to the line "
                           "that it is meant for.",
                     .it = "Il commento non indica nulla che venga segnalato dove esso vale, oppure indica un codice "
                           "che non esiste. Con ignore vale sulla propria linea, con disable dalla propria linea fino "
                           "a quella prima di enable, con ignore-file in tutto il programma. Se il programma è stato "
                           "corretto, togliere il commento, che nasconderebbe il prossimo errore. Altrimenti "
                           "correggerlo, o spostarlo sulla linea a cui serve."},
     .wrong = "M06 T101001\nG00 X10 ;[!isolint: ignore ISO003!]\nM02\n",
     .right = "M06 T101001\nG00 X10\nM02\n"},
    {.code = "W191",
     .name = "too-many-paths",
     .severity = Severity::Info,
     .section = "I.5",
     .arguments = {"limit"},
     .title = {.en = "Too many paths", .it = "Troppi percorsi"},
     .message = {.en = "the jumps lead here in more than {limit} different machine states: what differs between them "
                       "is unknown from here on",
                 .it = "i salti portano qui con più di {limit} stati macchina diversi: da qui in poi ciò che li "
                       "distingue è ignoto"},
     .explanation = {.en = "The check follows only so many machine states one by one, and the jumps above give more. "
                           "From here on whatever differs between them (position, feed rate, tool and so on) counts "
                           "as unknown, so mistakes that depend on it may go unreported. The control itself runs the "
                           "program as usual.",
                     .it = "La verifica segue uno per uno solo un certo numero di stati macchina, e i salti precedenti "
                           "ne danno di più. Da qui in poi tutto ciò che li distingue (posizione, avanzamento, "
                           "utensile e così via) si considera ignoto: gli errori che ne dipendono possono non essere "
                           "segnalati. La macchina esegue comunque il programma come sempre."},
     .wrong = "",
     .right = ""},
    {.code = "W192",
     .name = "line-too-long",
     .severity = Severity::Info,
     .section = "I.2",
     .arguments = {"limit"},
     .title = {.en = "Line too long", .it = "Linea troppo lunga"},
     .message = {.en = "the line has more than {limit} words: the rest is not checked",
                 .it = "la linea ha più di {limit} parole: il resto non viene verificato"},
     .explanation = {.en = "Only the first words of a line this long are checked, so mistakes in the rest go "
                           "unreported. Divide the line into several. A line this long often means that line ends "
                           "were lost when the file was copied.",
                     .it = "Di una linea così lunga si verificano solo le prime parole: gli errori nel resto non "
                           "vengono segnalati. Dividere la linea in più linee. Una linea così lunga spesso vuol dire "
                           "che i terminatori di linea sono andati persi copiando il file."},
     .wrong = "",
     .right = ""},
};

static_assert(std::equal(std::begin(kDiagnostics), std::end(kDiagnostics), std::begin(kDiagnosticNames),
                         std::end(kDiagnosticNames),
                         [](const DiagnosticDef& row, std::string_view name) { return row.name == name; }),
              "CMakeLists.txt reads one name from each row: a line with `.name = \"...\"`");

/// Whether kCauseNames holds the names of all causes, in the order of the table.
static constexpr bool names_are_complete() {
  const std::string_view* name = std::begin(kCauseNames);
  for (const DiagnosticDef& def : kDiagnostics) {
    for (const CauseDef& cause : def.causes) {
      if (cause.cause.empty()) continue;
      if (name == std::end(kCauseNames) || name->size() != def.name.size() + 1 + cause.cause.size()) return false;
      if (!name->starts_with(def.name) || !name->ends_with(cause.cause)) return false;
      ++name;
    }
  }
  return name == std::end(kCauseNames);
}
static_assert(names_are_complete(), "CMakeLists.txt reads the name of each cause: a line with `.cause = \"...\"`");

}  // namespace isocnc::dialect
