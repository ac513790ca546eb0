#include "interpreter/dialect/letters.h"

namespace isocnc::dialect {

static constexpr LetterDef kLetters[] = {
    {'A', {"first component of the face's i axis (G24)", "componente X del versore i della faccia (G24)"}},
    {'B',
     {"rotary axis about Y, degrees; second component of i (G24)",
      "asse rotante intorno a Y, gradi; componente Y di i (G24)"}},
    {'C',
     {"rotary axis about Z, degrees; third component of i (G24)",
      "asse rotante intorno a Z, gradi; componente Z di i (G24)"}},
    {'F', {"feed rate", "velocità di avanzamento (feed rate)"}},
    {'G', {"general function", "funzione generale"}},
    {'I',
     {"X of an arc's center; first component of the face's j axis",
      "X del centro dell'arco; componente X del versore j"}},
    {'J', {"Y of an arc's center; second component of j", "Y del centro dell'arco; componente Y del versore j"}},
    {'K', {"Z of an arc's center; third component of j", "Z del centro dell'arco; componente Z del versore j"}},
    {'M', {"miscellaneous function", "funzione miscelanea"}},
    {'N', {"line number", "numero di riga"}},
    {'P',
     {"first component of the face's k axis; dwell in seconds (G04); parameter of an M",
      "componente X del versore k; attesa in secondi (G04); parametro di una M"}},
    {'Q', {"second component of the face's k axis", "componente Y del versore k"}},
    {'R', {"radius of an arc; third component of k", "raggio dell'arco; componente Z del versore k"}},
    {'S', {"spindle speed, revolutions per minute", "velocità del mandrino, giri al minuto"}},
    {'T', {"tool: head, holder and tool in six digits", "utensile: testa, portautensile e utensile in sei cifre"}},
    {'V', {"register", "registro"}},
    {'X',
     {"linear axis X; X of a frame's origin; first component of i (G28)",
      "asse lineare X; X dell'origine; componente X di i (G28)"}},
    {'Y',
     {"linear axis Y; Y of a frame's origin; second component of i (G28)",
      "asse lineare Y; Y dell'origine; componente Y di i (G28)"}},
    {'Z',
     {"linear axis Z; Z of a frame's origin; third component of i (G28)",
      "asse lineare Z; Z dell'origine; componente Z di i (G28)"}},
};

std::span<const LetterDef> all_letters() { return kLetters; }

}  // namespace isocnc::dialect
