#include <cmath>
#include <string_view>

#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// A length error larger than rounding and smaller than this is a wrong digit; from here on the length was chosen.
static constexpr double kChosen = 0.1;

/// Skips vectors with a component of 1 or more, and exact ones: those give a direction, not a unit vector.
static void check_vector(const ExecutedBlock& block, std::string_view letters, execution::Sink& sink) {
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
static void check_axes_nearly_unit(const ExecutedBlock& block, execution::Sink& sink) {
  const GRole role = block.g(GRole::FaceByAxes) ? GRole::FaceByAxes : GRole::FaceAtTip;
  if (!block.g(role)) return;
  for (std::size_t axis = 0; axis < 3; ++axis)
    check_vector(block, dialect::g_code(role).axes.substr(3 * axis, 3), sink);
}

extern const Rule axes_nearly_unit = {kModal, check_axes_nearly_unit};

}  // namespace isocnc::rules
