#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lsp/extensions/extension.h"
#include "lsp/queries/outline.h"
#include "lsp/queries/section_times.h"

/// Our own request `isocnc/operations`: what the program does from one tool change to the next, with the time, the path
/// and the room that it takes.
namespace isocnc::extensions {
namespace {

/// An operation as it stands in the program.
struct ListedOperation {
  queries::Section section;
  std::optional<double> removed;  ///< mm^3, by the last verification.
};

std::optional<double> removed_in(const Snapshot& snapshot, const queries::Section& section) {
  return snapshot.removed_between(section.head_line, section.last_line + 1);
}

Json extents_json(const queries::TimedSection& timed, const geometry::Vec3& origin) {
  if (!timed.has_feed_move) return nullptr;
  Json extents;
  for (std::size_t axis = 0; axis < timed.cut.size(); ++axis) {
    const double zero = origin[static_cast<Eigen::Index>(axis)];
    extents[std::string(1, "XYZ"[axis])] = {timed.cut[axis].minimum - zero, timed.cut[axis].maximum - zero};
  }
  return extents;
}

/// `sections`: of a run with VGPL 0; an operation that it does not come to has no time.
Json operation_json(const ListedOperation& operation, const queries::Sections& sections, const geometry::Vec3& origin) {
  const queries::Section& section = operation.section;
  Json json = {{"line", section.head_line},     {"firstLine", section.first_line},
               {"lastLine", section.last_line}, {"tool", section.title},
               {"name", section.detail},        {"removed", operation.removed ? Json(*operation.removed) : Json()}};
  const auto timed = sections.find(section.head_line);
  const bool is_run = timed != sections.end();
  json["start"] = is_run ? Json(timed->second.start) : Json();
  json["seconds"] = is_run ? Json(timed->second.seconds) : Json();
  json["length"] = is_run ? Json(timed->second.mm) : Json();
  json["extents"] = is_run ? extents_json(timed->second, origin) : Json();
  return json;
}

BackgroundRequest answer_operations(const Snapshot& snapshot, const protocol::DocumentParams&) {
  std::vector<ListedOperation> operations;
  for (queries::Section& section : queries::outline(snapshot)) {
    if (section.kind != queries::SectionKind::Tool) continue;
    const std::optional<double> removed = removed_in(snapshot, section);
    operations.push_back({std::move(section), removed});
  }
  const auto times = queries::SectionTimes::of(snapshot);
  const auto program = std::make_shared<queries::TimedProgram>(snapshot, 0);
  return [times, program, operations = std::move(operations)](const std::function<bool()>& stop) {
    const auto sections = times->time(*program, stop);
    const geometry::Vec3 origin = program->workpiece_origin();
    Json all = Json::array();
    for (const ListedOperation& operation : operations) all.push_back(operation_json(operation, *sections, origin));
    return rpc::write({{"version", program->version()}, {"operations", std::move(all)}});
  };
}

}  // namespace

extern const features::Feature operations = {.methods = {in_background<&answer_operations>("isocnc/operations")}};

}  // namespace isocnc::extensions
