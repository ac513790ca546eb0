#include "analyzer/fixing/program_fixing.h"

#include "analyzer/fixing/unified_diff.h"
#include "interpreter/text/characters.h"

namespace isocnc::fixing {

using system::SourceFile;

void write_fixed(const SourceFile& source, const FixedText& fixed, const std::function<void(std::string_view)>& write) {
  if (source.has_byte_order_mark()) write(system::kByteOrderMark);
  write(fixed.text);
}

std::optional<std::string> FileFixing::finish(const SourceFile& source, const FixedText& fixed,
                                              dialect::Language language) {
  if (fixed.text == source.text()) return std::nullopt;
  write_fixed(source, fixed, [&](std::string_view text) { replacement_.write(text); });
  return replacement_.commit(language);
}

/// Reads a text line by line, with line ends; empty after the last.
class TextLineReader {
 public:
  explicit TextLineReader(std::string_view text) : rest_(text) {}
  std::string_view next() {
    const char* const end = rest_.data() + rest_.size();
    const char* const after = text::next_line(rest_.data(), end);
    const std::string_view line = rest_.substr(0, static_cast<std::size_t>(after - rest_.data()));
    rest_.remove_prefix(line.size());
    return line;
  }

 private:
  std::string_view rest_;
};

bool write_diff(const std::string& name, const SourceFile& source, const FixedText& fixed,
                std::function<void(std::string_view)> write) {
  UnifiedDiff diff(name, source.has_byte_order_mark(), std::move(write));
  TextLineReader before(source.text());
  TextLineReader after(fixed.text);
  std::size_t next = 0;  // The next line of the old text.
  for (const std::size_t origin : fixed.origins) {
    const std::string_view line = after.next();
    for (; origin != FixedText::kNew && next < origin; ++next) diff.remove(before.next());
    const std::string_view old_line = origin == FixedText::kNew ? std::string_view() : before.next();
    if (origin != FixedText::kNew) ++next;
    if (!old_line.empty() && !line.empty()) {
      diff.add(old_line, line);
    } else if (!line.empty()) {
      diff.insert(line);
    } else if (!old_line.empty()) {
      diff.remove(old_line);
    }
  }
  for (std::string_view line = before.next(); !line.empty(); line = before.next()) diff.remove(line);
  diff.finish();
  return diff.has_changes();
}

}  // namespace isocnc::fixing
