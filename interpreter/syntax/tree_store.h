#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/syntax/buffer.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::syntax {

/// Trees of successive lines, packed. Does not store the text; the caller passes the line's text with each query.
class TreeStore {
 public:
  /// Parses the line that starts at `begin` and appends its tree. Returns the end of the line's text: its CR or LF, or
  /// `end`. Reads nothing beyond `end`.
  const char* append_line(const char* begin, const char* end) {
    if (append_plain_lines(begin, begin == end ? end : begin + 1, end) == begin) return append_rarer_line(begin, end);
    return begin + lines_.back().length;
  }
  /// Parses and appends all lines that start before `stop`. Returns the start of the line after them, or `end`.
  const char* append_lines(const char* begin, const char* stop, const char* end);
  void clear();

  std::size_t size() const { return lines_.size(); }
  /// `text` is the text that was parsed, at its present address.
  LineTree tree(std::size_t index, const char* text) const {
    const Line& line = lines_[index];
    if (line.is_plain)
      return {.text = {text, line.length},
              .words = {words_.data() + line.first_word, line.words},
              .instructions = {&line.motion, line.plain_arguments == 0 ? 0u : 1u},
              .comments = {comments_.data() + line.first_comment, line.comments},
              .findings = {},
              .label = line.label,
              .feed = line.feed,
              .flags = line.flags,
              .plain_arguments = line.plain_arguments};
    return {.text = {text, line.length},
            .words = {words_.data() + line.first_word, line.words},
            .instructions = {instructions_.data() + line.first_instruction, line.instructions},
            .comments = {comments_.data() + line.first_comment, line.comments},
            .findings = {findings_.data() + line.first_finding, line.findings},
            .jump = line.jump < 0 ? nullptr : &jumps_[static_cast<std::size_t>(line.jump)],
            .label = line.label,
            .feed = line.feed,
            .spindle = line.spindle,
            .flags = line.flags};
  }
  /// Same as tree(index, text).plain(), without building the tree; for loops over millions of lines.
  PlainLine plain(std::size_t index) const {
    const Line& line = lines_[index];
    if (!line.is_plain) return {};
    return {.words = {words_.data() + line.first_word, line.words},
            .arguments = line.plain_arguments,
            .feed = line.feed,
            .row = line.motion.row,
            .has_label = (line.flags & LineTree::kHasLabel) != 0,
            .label = line.label};
  }
  /// Whether a plain line has a number or comments and nothing else.
  bool changes_nothing(std::size_t index) const {
    const Line& line = lines_[index];
    return line.is_plain && line.plain_arguments == 0 && line.feed < 0 && (line.words > 0 || line.comments > 0);
  }
  /// Number of bytes of the line's text.
  std::uint32_t length(std::size_t index) const { return lines_[index].length; }
  /// append_line() without its fast path for plain lines: the same trees, but slower. Public for tests, which compare
  /// the trees.
  const char* append_any_line(const char* begin, const char* end);

 private:
  friend class LineParser;

  const char* append_plain_lines(const char* begin, const char* stop, const char* end);
  const char* append_rarer_line(const char* begin, const char* end);
  const char* append_plain_assignment(const char* begin, const char* end);

  struct PlainPart {
    std::uint64_t label = 0;
    std::uint32_t comments = 0;
    std::int32_t feed = -1;
    std::uint32_t length = 0;
    std::uint32_t first_word = 0;
    std::uint32_t first_comment = 0;
    dialect::LetterSet plain_arguments = 0;
    std::uint16_t words = 0;
    std::uint8_t flags = 0;
    bool is_plain = false;
    Instruction motion;  ///< Set if there are plain arguments.
  };
  /// For a plain line (LineTree::plain_arguments) only the PlainPart is initialized.
  struct Line : PlainPart {
    std::uint32_t first_instruction = 0;
    std::uint32_t first_finding = 0;
    std::uint32_t findings = 0;
    std::uint16_t instructions = 0;
    std::int32_t jump = -1;
    std::int32_t spindle = -1;
  };

  static bool finish_plain_line(PlainPart& line, std::size_t words, dialect::LetterSet taken);
  const char* read_plain_line(const char* begin, const char* last, const char* end, PlainPart& line, Word*& words);

  Buffer<Line> lines_;
  Buffer<Word> words_;
  Buffer<Instruction> instructions_;
  std::vector<Span> comments_;
  std::vector<Finding> findings_;
  std::vector<Jump> jumps_;
};

/// A single line with its tree.
class ParsedLine {
 public:
  explicit ParsedLine(std::string_view text) : text_(text) {
    store_.append_line(text_.data(), text_.data() + text_.size());
  }
  LineTree tree() const { return store_.tree(0, text_.data()); }

 private:
  std::string text_;
  TreeStore store_;
};

}  // namespace isocnc::syntax
