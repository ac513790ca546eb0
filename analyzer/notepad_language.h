#pragma once

#include <string>

namespace isocnc::analyzer {

/// The dialect as a user defined language of Notepad++, in its format 2.1: cmake/windows/notepad++/isocnc.xml.
std::string notepad_language();

}  // namespace isocnc::analyzer
