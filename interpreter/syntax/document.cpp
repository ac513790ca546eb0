#include "interpreter/syntax/document.h"

#include <algorithm>

#include "interpreter/text/characters.h"

namespace isocnc::syntax {

/// Number of lines per new chunk: few enough that an edit reads the lines of its chunk again at little cost, many
/// enough that a long program has few chunks.
static constexpr std::size_t kChunkLines = 128;
static constexpr std::size_t kMaxChunkLines = 2 * kChunkLines;

/// Line ends after the text of each chunk, so that its last lines are plain for the parser as well, which reads a
/// little ahead.
static constexpr std::string_view kPadding = "\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n";

class Document::Chunk {
 public:
  /// Starts a new line.
  void add(std::string_view line_with_terminator) {
    begins_.push_back(static_cast<std::uint32_t>(text_.size()));
    text_ += line_with_terminator;
  }
  /// To be called once, after the last line.
  void pad() { text_ += kPadding; }
  void clear() {
    text_.clear();
    begins_.clear();
  }

  std::size_t lines() const { return begins_.size(); }
  std::string_view text() const { return std::string_view(text_).substr(0, text_.size() - kPadding.size()); }
  std::string_view with_terminator(std::size_t line) const {
    return {start_of(line), static_cast<std::size_t>(start_of(line + 1) - start_of(line))};
  }
  /// The start of a line, or the end of the last one.
  const char* start_of(std::size_t line) const {
    return text_.data() + (line < begins_.size() ? begins_[line] : text_.size() - kPadding.size());
  }
  const char* end_of_padding() const { return text_.data() + text_.size(); }

 private:
  std::string text_;                   // Lines with terminators, and the padding.
  std::vector<std::uint32_t> begins_;  // Offsets of the lines in the text.
};

Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

Document::Document(std::string_view text) { rebuild(0, 0, text, true); }

std::size_t Document::line_count() const { return chunks_.back().first_line + chunks_.back().chunk->lines(); }
std::size_t Document::chunk_lines(std::size_t chunk) const { return chunks_[chunk].chunk->lines(); }
std::string_view Document::chunk_text(std::size_t chunk) const { return chunks_[chunk].chunk->text(); }

Document::Place Document::locate(std::size_t line) const {
  const auto after =
      std::upper_bound(chunks_.begin(), chunks_.end(), line,
                       [](std::size_t wanted, const ChunkEntry& entry) { return wanted < entry.first_line; });
  const auto chunk = static_cast<std::size_t>(after - chunks_.begin()) - 1;
  return {chunk, line - chunks_[chunk].first_line};
}

DocumentLine Document::line(std::size_t index) const {
  const Place place = locate(index);
  const Chunk& chunk = *chunks_[place.chunk].chunk;
  return {chunk.start_of(place.line), chunk.end_of_padding()};
}

std::string_view Document::text_of_line(std::size_t index) const {
  const std::string_view whole = line_with_terminator(index);
  return whole.substr(0, whole.find_last_not_of("\r\n") + 1);
}

std::string_view Document::line_with_terminator(std::size_t line) const {
  const Place place = locate(line);
  return chunks_[place.chunk].chunk->with_terminator(place.line);
}

std::string_view Document::terminator(std::size_t line) const {
  const std::string_view whole = line_with_terminator(line);
  return whole.substr(whole.find_last_not_of("\r\n") + 1);
}

std::string Document::text() const {
  std::string all;
  for (const ChunkEntry& entry : chunks_) all += entry.chunk->text();
  return all;
}

Position Document::clamp(Position position) const {
  if (position.line >= line_count()) {
    const std::size_t last = line_count() - 1;
    return {last, line_with_terminator(last).size()};
  }
  return {position.line, std::min(position.column, line_with_terminator(position.line).size())};
}

Change Document::replace(Position begin, Position end, std::string_view text) {
  begin = clamp(begin);
  end = std::max(begin, clamp(end));
  std::size_t first = begin.line;
  std::size_t last = end.line;
  std::string fresh(line_with_terminator(first).substr(0, begin.column));
  fresh += text;
  fresh += line_with_terminator(last).substr(end.column);
  const auto ends_line = [&] { return !fresh.empty() && text::is_line_end(fresh.back()); };
  while (last + 1 < line_count() &&
         (!ends_line() || (fresh.back() == '\r' && line_with_terminator(last + 1).starts_with('\n'))))
    fresh += line_with_terminator(++last);
  // A CR and an LF that the edit brings together are one terminator, at the start as well as at the end.
  if (first > 0 && fresh.starts_with('\n') && line_with_terminator(first - 1).ends_with('\r'))
    fresh.insert(0, line_with_terminator(--first));
  const std::size_t before = line_count();
  const std::size_t removed = last - first + 1;
  rebuild(first, removed, fresh, last + 1 == before);
  return {first, removed, line_count() + removed - before};
}

/// Makes chunks of lines. Collects lines in one buffer, then allocates each chunk at its exact size.
class Document::ChunkMaker {
 public:
  ChunkMaker(std::size_t max_lines, std::uint64_t& next_version) : max_lines_(max_lines), next_version_(next_version) {}

  void add(std::string_view line) {
    if (gathered_.lines() >= max_lines_) end_chunk();
    gathered_.add(line);
  }
  std::vector<ChunkEntry> finish() {
    if (gathered_.lines() > 0) end_chunk();
    return std::move(chunks_);
  }

 private:
  void end_chunk() {
    gathered_.pad();
    chunks_.push_back({.version = next_version_++, .chunk = std::make_unique<Chunk>(gathered_)});
    gathered_.clear();
  }

  const std::size_t max_lines_;
  std::uint64_t& next_version_;
  Chunk gathered_;
  std::vector<ChunkEntry> chunks_;
};

/// Replaces `removed` lines by `text`, which consists of whole lines; only the last line of the document (`is_end`) may
/// lack its terminator.
void Document::rebuild(std::size_t first_line, std::size_t removed, std::string_view text, bool is_end) {
  const bool is_new = chunks_.empty();
  const Place from = is_new ? Place{0, 0} : locate(first_line);
  // The last removed line; the lines after it in its chunk are kept.
  const Place last = is_new ? Place{0, 0} : locate(first_line + removed - 1);
  ChunkMaker maker(is_new ? kChunkLines : kMaxChunkLines, next_version_);
  if (!is_new)
    for (std::size_t i = 0; i < from.line; ++i) maker.add(chunks_[from.chunk].chunk->with_terminator(i));
  const char* p = text.data();
  const char* const end = text.data() + text.size();
  while (p != end) {
    const char* const next = text::next_line(p, end);
    maker.add({p, static_cast<std::size_t>(next - p)});
    p = next;
  }
  if (is_end && (text.empty() || text::is_line_end(text.back()))) maker.add({});
  if (!is_new) {
    const Chunk& source = *chunks_[last.chunk].chunk;
    for (std::size_t i = last.line + 1; i < source.lines(); ++i) maker.add(source.with_terminator(i));
  }
  std::vector<ChunkEntry> fresh = maker.finish();
  const std::size_t count = fresh.size();
  if (is_new) {
    chunks_ = std::move(fresh);
  } else {
    const auto begin = chunks_.begin() + static_cast<std::ptrdiff_t>(from.chunk);
    const auto after = chunks_.begin() + static_cast<std::ptrdiff_t>(last.chunk) + 1;
    const auto common = std::min(after - begin, static_cast<std::ptrdiff_t>(count));
    std::move(fresh.begin(), fresh.begin() + common, begin);
    if (common < after - begin) {
      chunks_.erase(begin + common, after);
    } else {
      chunks_.insert(after, std::make_move_iterator(fresh.begin() + common), std::make_move_iterator(fresh.end()));
    }
  }
  renumber(from.chunk, count);
}

/// Numbers the lines of `count` new chunks, and shifts all later chunks by the same number of lines.
void Document::renumber(std::size_t first, std::size_t count) {
  std::size_t line = 0;
  if (first > 0) line = chunks_[first - 1].first_line + chunks_[first - 1].chunk->lines();
  std::size_t chunk = first;
  for (; chunk < first + count; ++chunk) {
    chunks_[chunk].first_line = line;
    line += chunks_[chunk].chunk->lines();
  }
  if (chunk == chunks_.size() || chunks_[chunk].first_line == line) return;
  const std::size_t shift = line - chunks_[chunk].first_line;  // Modulo 2^n, so that shifts to lower lines work, too.
  for (; chunk < chunks_.size(); ++chunk) chunks_[chunk].first_line += shift;
}

void ChunkTrees::read(const Document& document, std::size_t chunk, std::size_t lines) {
  chunk_ = document.chunks_[chunk].chunk.get();
  const char* const end = chunk_->end_of_padding();
  store_.clear();
  store_.append_lines(chunk_->start_of(0), chunk_->start_of(lines), end);
  if (store_.size() < lines) store_.append_line(chunk_->start_of(lines), end);  // The empty last line of a document.
}

LineTree ChunkTrees::operator[](std::size_t index) const { return store_.tree(index, chunk_->start_of(index)); }

}  // namespace isocnc::syntax
