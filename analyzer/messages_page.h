#pragma once

#include <string>

namespace isocnc::analyzer {

/// The page of all messages and titles of fixes in both languages, with the values of examples: docs/messages.md.
std::string messages_page();

}  // namespace isocnc::analyzer
