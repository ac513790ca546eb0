#include "lsp/documents/program_index.h"

#include <algorithm>

namespace isocnc::documents {

using syntax::Instruction;
using syntax::InstructionKind;
using syntax::LineTree;
using syntax::Word;

/// The landmarks of one line, in the order of its columns.
class LandmarkReader {
 public:
  LandmarkReader(const LineTree& tree, std::uint32_t line, std::vector<Landmark>& landmarks)
      : tree_(tree), line_(line), landmarks_(landmarks) {}

  void read() {
    for (const Instruction& instruction : tree_.instructions) read_instruction(instruction);
    if (tree_.is_empty())
      for (const syntax::Span comment : tree_.comments) add(LandmarkKind::Comment, comment, 0);
  }

 private:
  void read_instruction(const Instruction& instruction) {
    const Word& command = tree_.command(instruction);
    switch (instruction.kind) {
      case InstructionKind::G:
        return read_g(instruction.g(), command);
      case InstructionKind::ToolChange:
        return add(LandmarkKind::ToolChange, command.span(), tool_of(instruction));
      case InstructionKind::Function:
        if (command.value == dialect::kProgramEnd) add(LandmarkKind::ProgramEnd, command.span(), 0);
        return;
      case InstructionKind::Assignment:
        if (const int number = command.register_number(); number > 0)
          add(LandmarkKind::Assignment, command.span(), static_cast<std::uint64_t>(number));
        return;
      case InstructionKind::Jump:
        return read_jump();
      default:
        return;
    }
  }

  void read_g(const dialect::GCode* code, const Word& command) {
    if (!code) return;
    const auto number = static_cast<std::uint64_t>(code->number);
    if (code->role == dialect::GRole::Workpiece) add(LandmarkKind::WorkpieceFrame, command.span(), number);
    if (code->group != dialect::ModalGroup::Face) return;
    add(code->mounts_face() ? LandmarkKind::FaceFrame : LandmarkKind::FaceDismounted, command.span(), number);
  }

  void read_jump() {
    if (!tree_.jump) return;
    const syntax::Jump& jump = *tree_.jump;
    if (jump.variable > 0) add(LandmarkKind::Comparison, jump.variable_span, static_cast<std::uint64_t>(jump.variable));
    if (jump.has_target) add(LandmarkKind::Jump, jump.target_span, jump.target);
  }

  std::uint64_t tool_of(const Instruction& instruction) const {
    for (std::size_t i = instruction.begin; i < instruction.end; ++i) {
      const Word& word = tree_.words[i];
      if (word.owner == instruction.number && word.letter == 'T' && word.is_plain_integer())
        return static_cast<std::uint64_t>(word.whole().value_or(0));
    }
    return 0;
  }

  void add(LandmarkKind kind, syntax::Span span, std::uint64_t number) {
    landmarks_.push_back({line_, kind, span, number});
  }

  const LineTree& tree_;
  std::uint32_t line_;
  std::vector<Landmark>& landmarks_;
};

ProgramIndex::IndexChunk ProgramIndex::read_chunk(const syntax::ChunkTrees& trees) {
  IndexChunk read;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const LineTree tree = trees[i];
    if (tree.has_label()) {
      read.min_label = std::min(read.min_label, tree.label);
      read.max_label = std::max(read.max_label, tree.label);
    }
    if (tree.plain_arguments == 0) LandmarkReader(tree, static_cast<std::uint32_t>(i), read.landmarks).read();
  }
  read.landmarks.shrink_to_fit();
  return read;
}

void ProgramIndex::update(const syntax::Document& document) {
  document_ = &document;
  syntax::ChunkTrees trees;
  chunks_.update(document, [&](std::size_t chunk) {
    trees.read(document, chunk);
    return read_chunk(trees);
  });
}

template <class IsWanted>
std::vector<Landmark> ProgramIndex::select(IsWanted is_wanted) const {
  std::vector<Landmark> found;
  for (std::size_t i = 0; i < chunks_.size(); ++i)
    for (Landmark landmark : chunks_[i].landmarks) {
      if (!is_wanted(landmark)) continue;
      landmark.line += static_cast<std::uint32_t>(document_->first_line_of_chunk(i));
      found.push_back(landmark);
    }
  return found;
}

std::vector<Landmark> ProgramIndex::landmarks(LandmarkKinds wanted) const {
  return select([&](const Landmark& landmark) { return (kinds(landmark.kind) & wanted) != 0; });
}

std::vector<Landmark> ProgramIndex::landmarks(LandmarkKinds wanted, std::uint64_t number) const {
  return select(
      [&](const Landmark& landmark) { return (kinds(landmark.kind) & wanted) != 0 && landmark.number == number; });
}

std::vector<std::size_t> ProgramIndex::lines_of_label(std::uint64_t label) const {
  std::vector<std::size_t> lines;
  syntax::ChunkTrees trees;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    if (label < chunks_[i].min_label || label > chunks_[i].max_label) continue;
    trees.read(*document_, i);
    for (std::size_t line = 0; line < trees.size(); ++line) {
      const LineTree tree = trees[line];
      if (tree.has_label() && tree.label == label) lines.push_back(document_->first_line_of_chunk(i) + line);
    }
  }
  return lines;
}

std::uint64_t ProgramIndex::highest_label() const {
  std::uint64_t highest = 0;
  for (std::size_t i = 0; i < chunks_.size(); ++i) highest = std::max(highest, chunks_[i].max_label);
  return highest;
}

}  // namespace isocnc::documents
