#pragma once

#include <span>
#include <string>
#include <string_view>

#include "analyzer/fixes/makers.h"

namespace isocnc::fixes {

Edit replaced(const FixRequest& request, syntax::Span span, std::string text);
Edit inserted(const FixRequest& request, std::uint32_t column, std::string text);
/// A word with the blanks before it, or with those after it at the start of the line.
syntax::Span with_blanks(std::string_view line, syntax::Span span);
/// Removes a word with_blanks().
Edit removed(const FixRequest& request, syntax::Span span);
/// Like removed(), but removes the whole line if nothing else is on it.
Edit removed_with_line(const FixRequest& request, syntax::Span span);

/// A line with edits that are all on it.
std::string edited(std::string_view line, std::vector<Edit> edits);

/// Whether the line alone loses the finding with these edits and gains no other: a fix must not break something else.
/// Effects of earlier lines and edits of other lines are not considered.
bool helps(const FixRequest& request, const std::vector<Edit>& edits);

/// The maximum number of decimals that fixes write.
inline constexpr int kMaxDecimals = 9;
/// The number of decimals of a written number, at most kMaxDecimals.
int decimals_of(std::string_view number);

/// The blanks at the start of the line.
std::string_view indentation(std::string_view line);
bool is_blank(std::string_view text);

/// The word that starts where the span does, or null.
const syntax::Word* word_at(const syntax::LineTree& line, syntax::Span span);
/// The instruction that the word belongs to, or null.
const syntax::Instruction* owner_of(const syntax::LineTree& line, const syntax::Word& word);
/// Whether the word is the G of a frame and a dimension follows that is not one of its arguments, as in G27 X5: its
/// purpose is unknown.
bool lacks_frame_arguments(const syntax::LineTree& line, const syntax::Word& g);
/// Whether a word is the G of this number.
bool is_g(const syntax::Word& word, double number);
/// The first word that is no line number, or null.
const syntax::Word* first_word(const syntax::LineTree& line);

}  // namespace isocnc::fixes
