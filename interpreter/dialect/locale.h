#pragma once

#include <optional>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

/// How users say in which language they want to be spoken to.
namespace isocnc::dialect {

/// What commands, files and messages call the languages, in their order.
inline constexpr std::string_view kLanguageNames[] = {"en", "it"};
std::optional<Language> language_named(std::string_view name);
std::string_view name_of(Language language);

/// Of `it_IT.UTF-8`, `it-IT` or `it`; English unless it is Italian.
Language language_of_locale(std::string_view locale);

/// The user's language by LC_ALL, LC_MESSAGES or LANG, in this order; English unless one says Italian.
Language language_of_environment();

}  // namespace isocnc::dialect
