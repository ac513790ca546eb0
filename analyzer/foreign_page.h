#pragma once

#include <string>
#include <string_view>

#include "interpreter/dialect/foreign_form.h"

namespace isocnc::analyzer {

/// The page for readers who know another control, docs/other-controls.md and docs/it/altri-controlli.md.
std::string foreign_page(dialect::Language language);

/// A program with an example of a form; `lines` is its ForeignForm::written or ForeignForm::instead.
std::string foreign_example(const dialect::ForeignForm& form, std::string_view lines);

}  // namespace isocnc::analyzer
