#pragma once

#include <span>
#include <string>
#include <string_view>

#include "analyzer/fixes/makers.h"

namespace isocnc::fixes {

Edit replaced(const Request& request, syntax::Span span, std::string text);
Edit inserted(const Request& request, std::uint32_t column, std::string text);
/// Takes a word out with the blanks before it, or behind it at the start of the line.
Edit removed(const Request& request, syntax::Span span);
/// As removed(); the whole line when nothing else stands on it.
Edit removed_with_line(const Request& request, syntax::Span span);

/// Whether the line alone shows less than before with these edits of it: a fix that mends one thing and breaks another
/// is none. What follows from the lines before is not looked at here, nor are edits of other lines.
bool helps(const Request& request, const std::vector<Edit>& edits);

/// The blanks that the line starts with.
std::string_view indentation(std::string_view line);
bool is_blank(std::string_view text);
/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The word that starts where the span does, or null.
const syntax::Word* word_at(const syntax::LineTree& line, syntax::Span span);
/// The instruction that the word belongs to, or null.
const syntax::Instruction* owner_of(const syntax::LineTree& line, const syntax::Word& word);
/// Whether the word is the G of a frame and a dimension stands directly after it that is none of its arguments, as in
/// G27 X5: what it was meant for is not known.
bool lacks_frame_arguments(const syntax::LineTree& line, const syntax::Word& g);
/// The first word that is no line number, or null.
const syntax::Word* first_word(const syntax::LineTree& line);

/// A number as programs write it: at most `decimals`, without zeros at the end.
std::string written(double value, int decimals);

}  // namespace isocnc::fixes
