#include "interpreter/overlay/comparison_page.h"

#include "interpreter/plot/packed_bytes.h"
#include "interpreter/plot/page_plot.h"
#include "interpreter/plot/path_recording.h"

namespace isocnc::overlay {

using OrderedJson = nlohmann::ordered_json;

std::string comparison_facts(OrderedJson english, const OrderedJson& italian) {
  OrderedJson& changes = english.at("changes");
  for (std::size_t i = 0; i < changes.size(); ++i)
    changes[i]["text"] = {{"en", changes[i]["text"]}, {"it", italian.at("changes").at(i).at("text")}};
  return english.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

std::string comparison_facts(const comparison::ComparedRuns& runs) {
  return comparison_facts(OrderedJson::parse(comparison::json_of(runs, dialect::Language::English)),
                          OrderedJson::parse(comparison::json_of(runs, dialect::Language::Italian)));
}

std::string alignment_bytes(const std::vector<AlignedLines>& lines) {
  plot::PackedBytes bytes;
  for (const AlignedLines& each : lines) {
    bytes.put(each.old_count);
    bytes.put(each.new_count);
    bytes.put(each.repeats);
  }
  return std::string(bytes.bytes());
}

/// Runs a program and adds its path to the page, its blocks named with the prefix.
static void add_path(plot::PageFile& page, std::string_view prefix, const ShownProgram& program) {
  const plot::PlotSubject& subject = program.subject;
  const plot::RecordedPath path = plot::record_path(subject.program, subject, program.options, program.machine);
  const std::string start(prefix);
  page.add_json(start + "facts", path.facts);
  page.add_bytes(start + "steps", path.steps);
  page.add_bytes(start + "points", path.points);
  page.add_bytes(start + "turns", path.turns);
  page.add_bytes(start + "program", subject.program);
}

void write_page(system::OutputFile& output, const ShownProgram& old_program, const ShownProgram& new_program,
                const ShownComparison& shown) {
  plot::PageFile page(output, new_program.subject.page, old_program.subject.name + " → " + new_program.subject.name);
  add_path(page, "", new_program);
  add_path(page, "old-", old_program);
  page.add_json("comparison", shown.facts);
  page.add_bytes("alignment",
                 alignment_bytes(aligned_lines({old_program.subject.program, shown.old_run},
                                               {new_program.subject.program, shown.new_run}, shown.tolerance)));
  page.finish();
}

}  // namespace isocnc::overlay
