#include "debugger/breakpoints/exception_filter.h"

#include <array>

namespace isocnc::breakpoints {

static constexpr std::array<ExceptionFilterDef, kExceptionFilterCount> kExceptionFilters{{
    {"errors",
     {"Program errors", "Errori di programma"},
     {"Where the control would stop with an error", "Dove il controllo si fermerebbe con un errore"},
     true},
    {"warnings",
     {"Warnings", "Avvisi"},
     {"Before blocks of which isolint warns", "Prima dei blocchi per cui isolint avvisa"}},
    {"limits",
     {"Axis limits", "Limiti degli assi"},
     {"Before motions that take an axis beyond its travel", "Prima dei movimenti che portano un asse oltre la corsa"}},
    {"toolChange", {"Tool changes", "Cambi utensile"}, {"Before each M06", "Prima di ogni M06"}},
    {"firstCut",
     {"First cut", "Primo taglio"},
     {"Before the first feed move of each tool", "Prima del primo movimento in lavoro di ogni utensile"}},
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
