#include <cmath>
#include <string_view>

#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// A length error larger than rounding and smaller than this is a wrong digit; from here on the length was chosen.
static constexpr double kChosen = 0.1;

/// Skips vectors with a component of 1 or more, and exact ones: those give a direction, not a unit vector.
static void check_vector(const Block& block, std::string_view letters, execution::Sink& sink) {
  double square = 0;
  bool is_direction = false;
  syntax::Span span;
  for (const syntax::Word& word : block.line.words) {
    if (word.owner == syntax::Word::kNoOwner || letters.find(word.letter) == std::string_view::npos) continue;
    square += word.value * word.value;
    is_direction |= std::abs(word.value) >= 1;
    span = span.empty() ? word.span() : syntax::hull(span, word.span());
  }
  const double length = std::sqrt(square);
  const double error = std::abs(length - 1);
  if (!is_direction && error > block.thresholds.vector_error && error < kChosen)
    report(sink, "axes-nearly-unit"_diag, span, length);
}

/// The axis vectors of G24 and G28, which the control normalizes whatever their length (D26).
static void check_axes_nearly_unit(const Block& block, execution::Sink& sink) {
  const bool by_plane = block.g(24) != nullptr;
  if (!by_plane && !block.g(28)) return;
  for (const std::string_view letters :
       {std::string_view(by_plane ? "ABC" : "XYZ"), std::string_view("IJK"), std::string_view("PQR")})
    check_vector(block, letters, sink);
}

extern const Rule axes_nearly_unit = {kModal, check_axes_nearly_unit};

}  // namespace isocnc::rules
