#include "debugger/breakpoints/exception_filter.h"

#include <array>

namespace isocnc::breakpoints {

static constexpr std::array<ExceptionFilterDef, kExceptionFilterCount> kExceptionFilters{{
    {.name = "errors",
     .label = {"Program errors", "Errori di programma"},
     .description = {"Where the control would stop with an error", "Dove il controllo si fermerebbe con un errore"},
     .is_default = true},
    {.name = "warnings",
     .label = {"Warnings", "Avvisi"},
     .description = {"Before blocks of which isolint warns", "Prima dei blocchi per cui isolint avvisa"},
     .takes_condition = true},
    {.name = "limits",
     .label = {"Axis limits", "Limiti degli assi"},
     .description = {"Before motions that take an axis beyond its travel",
                     "Prima dei movimenti che portano un asse oltre la corsa"}},
    {.name = "contacts",
     .label = {"Contacts", "Contatti"},
     .description = {"Where the machine touches a fixture, the finished part, itself or, in rapid, with its holder or "
                     "with the spindle stopped, the material, inside the block",
                     "Dove la macchina tocca un'attrezzatura, il pezzo finito, se stessa o, in rapido, con il "
                     "portautensile o a mandrino fermo, il materiale, dentro il blocco"},
     .takes_condition = true},
    {.name = "run",
     .label = {"Findings of the machine", "Segnalazioni della macchina"},
     .description = {"Before blocks in which a run shows an error or a warning, such as a joint outside its travel",
                     "Prima dei blocchi in cui un'esecuzione mostra un errore o un avviso, come un asse fuori corsa"},
     .takes_condition = true},
    {.name = "toolChange",
     .label = {"Tool changes", "Cambi utensile"},
     .description = {"Before each M06", "Prima di ogni M06"},
     .takes_condition = true},
    {.name = "firstCut",
     .label = {"First cut", "Primo taglio"},
     .description = {"Before the first feed move of each tool", "Prima del primo movimento in lavoro di ogni utensile"},
     .takes_condition = true},
}};

const ExceptionFilterDef& definition(ExceptionFilter filter) {
  return kExceptionFilters[static_cast<std::size_t>(filter)];
}

std::optional<ExceptionFilter> find_exception_filter(std::string_view name) {
  for (std::size_t i = 0; i < kExceptionFilters.size(); ++i)
    if (kExceptionFilters[i].name == name) return static_cast<ExceptionFilter>(i);
  return std::nullopt;
}

}  // namespace isocnc::breakpoints
