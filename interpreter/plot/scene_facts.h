#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "interpreter/kinematics/machine.h"
#include "interpreter/plot/stock_recording.h"
#include "interpreter/verification/verification_report.h"
#include "interpreter/verification/verified_run.h"

namespace isocnc::plot {

/// What surrounds a program, for a view: `{"name", "kinematics", "nose", "tools", "bodies"}`. Bodies of revolution are
/// outlines `[[z, radius], ...]`, mm: of a tool above its tip, of the nose above the spindle nose. Bodies are boxes,
/// cylinders or meshes in the frame of the part of the machine that carries them (`on`), shifted by `at`; `workpiece`
/// is the table that turns, or else the machine. `origin` is that of the first workpiece frame.
nlohmann::ordered_json scene_facts(const verification::Scene& scene, const kinematics::Kinematics& kinematics,
                                   const geometry::Vec3& origin);

/// How the stock is cut, for a view: the grid of the picture in machine coordinates, and what each line has removed;
/// `{"first", "spacing", "columns", "rows", "onTable", "hasTarget", "tolerance", "volume", "blankVolume", "resolution",
/// "removed": [{"line", "volume", "depth", "width"}]}`: lines from 0, mm, mm^3.
nlohmann::ordered_json stock_facts(const StockRecording& cuts, const verification::MaterialReport& material,
                                   const verification::Scene& scene, const kinematics::Kinematics& kinematics);

/// The contacts and near misses of a run, `[{"code", "severity", "line", "endLine", "time", "endTime", "tool", "who",
/// "whom", "point", "distance", "message": {"en", "it"}}]`: lines from 1; mm, seconds; points in the machine frame with
/// all joints at 0; the names in English.
nlohmann::ordered_json contact_facts(const verification::VerifiedRun& run);

/// A text in both languages, between which a view switches: `{"en", "it"}`.
template <class Value>
nlohmann::ordered_json in_both_languages(const Value& value) {
  return {{"en", in_words(value, dialect::Language::English)}, {"it", in_words(value, dialect::Language::Italian)}};
}

}  // namespace isocnc::plot
