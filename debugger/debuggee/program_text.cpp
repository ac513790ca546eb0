#include "debugger/debuggee/program_text.h"

#include <cerrno>
#include <utility>

#include "interpreter/syntax/tree_store.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/source_file.h"
#include "interpreter/system/system_texts.h"
#include "interpreter/text/characters.h"

namespace isocnc::debuggee {

ProgramText::ProgramText(std::string text) : text_(std::move(text)) {
  const char* const begin = text_.data();
  const char* const end = begin + text_.size();
  for (const char* p = begin; p != end; p = text::next_line(p, end), ++line_count_)
    if (line_count_ % kStride == 0) offsets_.push_back(static_cast<std::size_t>(p - begin));
}

/// Reads the file into memory: if it were mapped, the text would be lost when the file is cut short.
std::variant<ProgramText, ProgramText::ReadError> ProgramText::read(const std::filesystem::path& file,
                                                                    dialect::Language language) {
  const system::Descriptor descriptor = system::open_to_read_at_once(file);
  if (!descriptor.is_open()) return ReadError{system::cannot_read(errno, language)};
  const auto opened = system::SourceFile::read_stream(descriptor.number(), language);
  if (const auto* const problem = std::get_if<system::SourceFile::Problem>(&opened)) return ReadError{problem->message};
  return ProgramText(std::string(std::get<system::SourceFile>(opened).text()));
}

std::size_t ProgramText::offset_of(std::size_t line) const {
  const char* const begin = text_.data();
  const char* const end = begin + text_.size();
  if (line >= line_count_) return text_.size();
  const char* p = begin + offsets_[line / kStride];
  for (std::size_t i = 0; i < line % kStride; ++i) p = text::next_line(p, end);
  return static_cast<std::size_t>(p - begin);
}

std::string_view ProgramText::line(std::size_t number) const {
  const char* const begin = text_.data() + offset_of(number);
  return {begin, static_cast<std::size_t>(text::find_line_end(begin, text_.data() + text_.size()) - begin)};
}

std::optional<std::size_t> ProgramText::executable_line(std::size_t from) const {
  const char* p = text_.data() + offset_of(from);
  const char* const end = text_.data() + text_.size();
  syntax::TreeStore store;
  for (; p != end; ++from) {
    store.clear();
    const char* const line_end = store.append_line(p, end);
    const syntax::LineTree tree = store.tree(0, p);
    if (!tree.is_empty() || !tree.findings.empty()) return from;
    p = text::skip_line_end(line_end, end);
  }
  return std::nullopt;
}

}  // namespace isocnc::debuggee
