#include "analyzer/analysis.h"

#include <algorithm>
#include <unordered_map>

namespace isocnc::analyzer {

Analysis::Analysis(const syntax::Document& document, const execution::Setup& setup)
    : document_(document), setup_(setup) {
  update();
}

JumpMap Analysis::find_jumps() const {
  JumpMap jumps;
  for (std::size_t chunk = 0; chunk < document_.chunk_count(); ++chunk)
    for (std::size_t i = 0; i < document_.chunk_lines(chunk); ++i) {
      const syntax::LineTree line = document_.line_of_chunk(chunk, i);
      if (line.jump && line.jump->has_target) jumps.add(document_.first_line_of_chunk(chunk) + i, *line.jump);
    }
  if (jumps.compares_registers())
    for (std::size_t chunk = 0; chunk < document_.chunk_count(); ++chunk)
      for (std::size_t i = 0; i < document_.chunk_lines(chunk); ++i)
        jumps.note_registers(document_.line_of_chunk(chunk, i));
  jumps.complete();
  if (jumps.empty()) return jumps;
  std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> labels;
  for (std::size_t chunk = 0; chunk < document_.chunk_count(); ++chunk)
    for (std::size_t i = 0; i < document_.chunk_lines(chunk); ++i) {
      const syntax::LineTree line = document_.line_of_chunk(chunk, i);
      if (line.has_label() && jumps.names(line.label))
        labels[line.label].push_back(document_.first_line_of_chunk(chunk) + i);
    }
  jumps.resolve(labels);
  return jumps;
}

void Analysis::update() {
  JumpMap jumps = find_jumps();
  const bool jumps_stand = !chunks_.empty() && jumps.means_the_same(jumps_);
  jumps_ = std::move(jumps);
  // Frontiers name jumps by number and compare registers by cells: with other jumps all of them mean something else.
  std::vector<Checked> old;
  if (jumps_stand) old.swap(chunks_);
  chunks_.clear();
  lines_checked_ = 0;

  const std::size_t count = document_.chunk_count();
  std::size_t head = 0;  // Chunks at the start that are as they were.
  while (head < std::min(count, old.size()) && old[head].version == document_.chunk_version(head)) ++head;
  std::unordered_map<std::uint64_t, std::size_t> old_index;
  for (std::size_t i = head; i < old.size(); ++i) old_index[old[i].version] = i;

  Checker checker(setup_, jumps_);
  if (head > 0) checker.frontier = head < old.size() ? old[head].before : end_;
  chunks_.reserve(count);
  for (std::size_t i = 0; i < head; ++i) chunks_.push_back(std::move(old[i]));
  for (std::size_t i = head; i < count; ++i) {
    const auto kept = old_index.find(document_.chunk_version(i));
    if (kept != old_index.end() && old[kept->second].before == checker.frontier) {
      Checked& reused = old[kept->second];
      checker.frontier = kept->second + 1 < old.size() ? old[kept->second + 1].before : end_;
      chunks_.push_back(std::move(reused));
      continue;
    }
    Checked checked{.version = document_.chunk_version(i), .before = checker.frontier};
    for (std::size_t line = 0; line < document_.chunk_lines(i); ++line)
      checker.check(document_.line_of_chunk(i, line), line, checked.outcome);
    lines_checked_ += document_.chunk_lines(i);
    chunks_.push_back(std::move(checked));
  }
  end_ = checker.frontier;
}

Report Analysis::report() const {
  std::vector<Outcome> outcomes;
  outcomes.reserve(chunks_.size());
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    Outcome outcome = chunks_[i].outcome;
    const std::uint64_t first = document_.first_line_of_chunk(i);
    for (LocatedFinding& located : outcome.findings) located.line += first;
    for (Outcome::Label& label : outcome.labels) label.line += first;
    outcome.last_text_line += first;
    outcomes.push_back(std::move(outcome));
  }
  return conclude(std::move(outcomes), end_, jumps_,
                  [&](std::uint64_t line) { return document_.line(static_cast<std::size_t>(line)).text; });
}

Frontier Analysis::frontier_before(std::size_t line) const {
  std::size_t chunk = 0;
  while (chunk + 1 < chunks_.size() && document_.first_line_of_chunk(chunk + 1) <= line) ++chunk;
  Checker checker(setup_, jumps_);
  checker.frontier = chunks_[chunk].before;
  Outcome ignored;
  for (std::size_t i = document_.first_line_of_chunk(chunk); i < std::min(line, document_.line_count()); ++i)
    checker.check(document_.line(i), i, ignored);
  return checker.frontier;
}

}  // namespace isocnc::analyzer
