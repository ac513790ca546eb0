#include "lsp/queries/outline.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "interpreter/text/unicode.h"

namespace isocnc::queries {

int symbol_kind(SectionKind kind) {
  switch (kind) {
    case SectionKind::Tool:
      return 2;  // Module
    case SectionKind::Face:
    case SectionKind::Workpiece:
      return 3;  // Namespace
    case SectionKind::Label:
      return 20;  // Key
    case SectionKind::Heading:
      return 15;  // String
  }
  return 15;
}

/// The text of a comment without its signs and decoration: `(--- ROUGHING ---)` gives ROUGHING.
static std::string comment_text(std::string_view comment) {
  constexpr std::string_view kAdornment = " \t;()-=*#_~+.:/\\<>|!";
  const std::size_t first = comment.find_first_not_of(kAdornment);
  if (first == std::string_view::npos) return {};
  constexpr std::string_view kAtEnd = " \t-=*#_~+/\\<>|";
  if (comment.starts_with('(') && comment.ends_with(')')) comment.remove_suffix(1);
  return text::printable(comment.substr(first, comment.find_last_not_of(kAtEnd) + 1 - first));
}

std::vector<CommentBlock> comment_blocks(const documents::Snapshot& snapshot) {
  std::vector<CommentBlock> blocks;
  for (const documents::Landmark& comment : snapshot.index().landmarks(documents::LandmarkKind::Comment)) {
    if (blocks.empty() || comment.line > blocks.back().last_line + 1)
      blocks.push_back({comment.line, comment.line, comment.span});
    blocks.back().last_line = comment.line;
  }
  return blocks;
}

namespace {

/// Builds the outline from the places where sections start and end, in the order of the program.
class Builder {
 public:
  explicit Builder(const documents::Snapshot& snapshot) : snapshot_(snapshot) {}

  std::vector<Section> build() {
    collect();
    sort();
    for (OutlineEvent& event : events_) take(event);
    if (last_end_) close_above(*last_end_);
    const std::size_t last = snapshot_.document().line_count() - 1;
    close(face_, last);
    close(tool_, last);
    return std::move(sections_);
  }

 private:
  enum class EventOrder { OpensTool, OpensFace, Stands, Closes };  // The order of the events on one line.
  struct OutlineEvent {
    EventOrder order = EventOrder::Stands;
    Section section;
  };

  static bool is_opening(const OutlineEvent& event) { return event.order <= EventOrder::OpensFace; }

  static Section section_at(SectionKind kind, const documents::Landmark& landmark) {
    return {.kind = kind,
            .first_line = landmark.line,
            .last_line = landmark.line,
            .head_line = landmark.line,
            .head = landmark.span,
            .number = landmark.number,
            .parent = -1,
            .title = {},
            .detail = {}};
  }

  void collect() {
    const documents::ProgramIndex& index = snapshot_.index();
    const auto wanted = documents::kinds(documents::LandmarkKind::ToolChange) |
                        documents::kinds(documents::LandmarkKind::FaceFrame) |
                        documents::kinds(documents::LandmarkKind::FaceDismounted) |
                        documents::kinds(documents::LandmarkKind::WorkpieceFrame) |
                        documents::kinds(documents::LandmarkKind::ProgramEnd);
    for (const documents::Landmark& landmark : index.landmarks(static_cast<documents::LandmarkKinds>(wanted)))
      collect(landmark);
    sort();
    collect_comments();
    std::set<std::uint64_t> named;
    for (const documents::Landmark& jump : index.landmarks(documents::LandmarkKind::Jump)) named.insert(jump.number);
    for (const std::uint64_t label : named) collect_label(label);
  }

  void sort() {
    std::stable_sort(events_.begin(), events_.end(), [](const OutlineEvent& a, const OutlineEvent& b) {
      return std::pair(a.section.first_line, a.order) < std::pair(b.section.first_line, b.order);
    });
  }

  void collect(const documents::Landmark& landmark) {
    switch (landmark.kind) {
      case documents::LandmarkKind::ToolChange: {
        Section section = section_at(SectionKind::Tool, landmark);
        section.title = landmark.number == 0 ? "M06" : fmt::format("T{:06}", landmark.number);
        section.detail = tool_name(landmark.number);
        return add(EventOrder::OpensTool, std::move(section));
      }
      case documents::LandmarkKind::FaceFrame:
      case documents::LandmarkKind::WorkpieceFrame: {
        const bool is_face = landmark.kind == documents::LandmarkKind::FaceFrame;
        Section section = section_at(is_face ? SectionKind::Face : SectionKind::Workpiece, landmark);
        section.title = instruction_text(landmark);
        return add(is_face ? EventOrder::OpensFace : EventOrder::Stands, std::move(section));
      }
      case documents::LandmarkKind::ProgramEnd:
        last_end_ = landmark.line;
        return;
      default:
        return add(EventOrder::Closes, section_at(SectionKind::Face, landmark));
    }
  }

  void collect_label(std::uint64_t label) {
    for (const std::size_t line : snapshot_.index().lines_of_label(label)) {
      const syntax::DocumentLine read = snapshot_.document().line(line);
      const syntax::LineTree& tree = *read;
      const syntax::Word* const word = tree.label_word();
      if (!word) continue;
      Section section = section_at(SectionKind::Label, {static_cast<std::uint32_t>(line), {}, word->span(), label});
      section.title = fmt::format("N{}", label);
      add(EventOrder::Stands, std::move(section));
    }
  }

  /// Turns comments into headings; a comment directly above a section becomes part of that section.
  void collect_comments() {
    std::vector<std::pair<std::size_t, std::size_t>> openings;  // Pairs of the head line and the index of the event.
    for (std::size_t i = 0; i < events_.size(); ++i)
      if (is_opening(events_[i])) openings.emplace_back(events_[i].section.head_line, i);
    for (const CommentBlock& block : comment_blocks(snapshot_)) {
      const std::string title = title_of(block);
      const auto opening =
          std::lower_bound(openings.begin(), openings.end(), std::pair(block.last_line + 1, std::size_t{0}));
      if (opening != openings.end() && opening->first == block.last_line + 1) {
        Section& section = events_[opening->second].section;
        section.first_line = block.first_line;
        if (section.detail.empty()) section.detail = title;
      } else if (!title.empty()) {
        Section section = section_at(SectionKind::Heading, {static_cast<std::uint32_t>(block.first_line),
                                                            documents::LandmarkKind::Comment, block.head, 0});
        section.last_line = block.last_line;
        section.title = title;
        add(EventOrder::Stands, std::move(section));
      }
    }
  }

  /// The text of the first line of the block that is more than decoration.
  std::string title_of(const CommentBlock& block) const {
    for (std::size_t line = block.first_line; line <= block.last_line; ++line) {
      const syntax::DocumentLine read = snapshot_.document().line(line);
      const syntax::LineTree& tree = *read;
      for (const syntax::Span comment : tree.comments)
        if (std::string text = comment_text(tree.text_of(comment)); !text.empty()) return text;
    }
    return {};
  }

  /// The tool's name in the machine's configuration.
  std::string tool_name(std::uint64_t number) const {
    if (number > 999'999) return {};
    const configuration::Tool* const tool =
        snapshot_.configuration().machine.find_tool(execution::tool_code(static_cast<int>(number)));
    return tool ? tool->name : std::string();
  }

  /// A G with its arguments, as written.
  std::string instruction_text(const documents::Landmark& landmark) const {
    const syntax::DocumentLine read = snapshot_.document().line(landmark.line);
    const syntax::LineTree& tree = *read;
    syntax::Span all = landmark.span;
    for (const syntax::Instruction& instruction : tree.instructions)
      if (tree.command(instruction).span() == landmark.span)
        for (std::size_t i = instruction.begin; i < instruction.end; ++i) all = syntax::hull(all, tree.words[i].span());
    return text::printable(tree.text_of(all));
  }

  void add(EventOrder order, Section section) { events_.push_back({order, std::move(section)}); }

  void take(OutlineEvent& event) {
    Section& section = event.section;
    if (last_end_ && section.first_line > *last_end_) close_above(*last_end_);
    if (event.order == EventOrder::Closes) return close(face_, section.head_line);
    if (is_opening(event)) {
      const std::size_t above = section.first_line == 0 ? 0 : section.first_line - 1;
      close(face_, above);
      if (event.order == EventOrder::OpensTool) close(tool_, above);
    }
    section.parent = face_ ? *face_ : tool_.value_or(-1);
    const int index = static_cast<int>(sections_.size());
    if (is_opening(event)) (event.order == EventOrder::OpensTool ? tool_ : face_) = index;
    sections_.push_back(std::move(section));
  }

  void close(std::optional<int>& open, std::size_t last_line) {
    if (!open) return;
    Section& section = sections_[static_cast<std::size_t>(*open)];
    section.last_line = std::max(section.head_line, last_line);
    open.reset();
  }

  /// Ends the open sections that started above the last M02.
  void close_above(std::size_t end) {
    for (std::optional<int>* const open : {&face_, &tool_})
      if (*open && sections_[static_cast<std::size_t>(**open)].head_line <= end) close(*open, end);
  }

  const documents::Snapshot& snapshot_;
  std::vector<OutlineEvent> events_;
  std::vector<Section> sections_;
  std::optional<int> tool_;  // The index of the open tool section.
  std::optional<int> face_;
  std::optional<std::size_t> last_end_;
};

}  // namespace

std::vector<Section> outline(const documents::Snapshot& snapshot) { return Builder(snapshot).build(); }

}  // namespace isocnc::queries
