#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "interpreter/comparison/comparison_text.h"
#include "interpreter/overlay/aligned_lines.h"
#include "interpreter/plot/picture.h"
#include "interpreter/timing/timing.h"

namespace isocnc::overlay {

/// The changes for a view, as JSON: what isodiff writes, given in both languages, with the text of each change as
/// `{"en", "it"}`.
std::string comparison_facts(nlohmann::ordered_json english, const nlohmann::ordered_json& italian);
/// The same of two runs alone, as comparison::json_of() writes it.
std::string comparison_facts(const comparison::ComparedRuns& runs);

/// The alignment for a view: three packed numbers for each entry.
std::string alignment_bytes(const std::vector<AlignedLines>& lines);

/// A program of which a page shows the path. All must outlive the call.
struct ShownProgram {
  const plot::PlotSubject& subject;
  const running::RunOptions& options;
  const timing::TimedMachine& machine;
};

/// Both runs, and how they are shown.
struct ShownComparison {
  const comparison::RecordedRun& old_run;
  const comparison::RecordedRun& new_run;
  std::string facts;     ///< Of comparison_facts().
  double tolerance = 0;  ///< Of the comparison, mm.
};

/// Writes the page of both paths: the template of the new program's subject with the data of both programs in it
/// (toolpath-view/README.md). Runs both once more, for their paths.
void write_page(system::OutputFile& output, const ShownProgram& old_program, const ShownProgram& new_program,
                const ShownComparison& shown);

}  // namespace isocnc::overlay
