#include <cmath>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "analyzer/transforming/transform.h"
#include "interpreter/syntax/each_tree.h"
#include "lsp/extensions/extension.h"
#include "lsp/queries/text_edits.h"

/// The program mirrored, rotated, shifted, or with other feeds, as `isofmt --mirror` and its like write it.
namespace isocnc::extensions {

using transforming::Movement;
using transforming::Transformation;

namespace {

struct TransformParams {
  Transformation transformation;
};

[[noreturn]] void reject(const char* why, const Json& json) { throw Json::type_error::create(302, why, &json); }

double number_of(const Json& json, double minimum, double maximum) {
  if (!json.is_number()) reject("a number is missing", json);
  const double number = json;
  if (!(number >= minimum && number <= maximum)) reject("the number is too large or too small", json);
  return number;
}

double length_of(const Json& json) { return number_of(json, -transforming::kMaxPlace, transforming::kMaxPlace); }

/// Two coordinates, or three where so many are allowed; a missing one is 0.
geometry::Vec3 point_of(const Json& json, std::size_t maximum) {
  if (!json.is_array() || json.size() < 2 || json.size() > maximum) reject("these are no coordinates", json);
  geometry::Vec3 point = geometry::Vec3::Zero();
  for (std::size_t i = 0; i < json.size(); ++i) point[static_cast<Eigen::Index>(i)] = length_of(json[i]);
  return point;
}

void from_json(const Json& json, TransformParams& params) {
  Transformation& transformation = params.transformation;
  const int movements = json.contains("mirror") + json.contains("rotate") + json.contains("shift");
  if (movements > 1) reject("one movement at a time", json);
  if (json.contains("mirror")) {
    const Json& axis = json.at("mirror");
    if (axis != "X" && axis != "Y") reject("mirror is X or Y", json);
    const double place = length_of(json.at("about"));
    transformation.movement = axis == "X" ? Movement::MirrorX : Movement::MirrorY;
    transformation.place = {place, place, 0};
  } else if (json.contains("rotate")) {
    transformation.movement = Movement::Rotate;
    transformation.degrees = length_of(json.at("rotate"));
    transformation.place = point_of(json.at("about"), 2);
  } else if (json.contains("shift")) {
    transformation.movement = Movement::Shift;
    transformation.place = point_of(json.at("shift"), 3);
  }
  if (json.contains("scaleFeed")) {
    transformation.feed_factor =
        number_of(json.at("scaleFeed"), transforming::kMinFeedFactor, transforming::kMaxFeedFactor);
  } else if (movements == 0) {
    reject("there is nothing to do", json);
  }
}

Json transform_program(const Snapshot& snapshot, const TransformParams& params) {
  const auto made =
      transforming::transform(snapshot.document().text(), params.transformation, snapshot.setup(), snapshot.language());
  if (const auto* refusal = std::get_if<transforming::TransformationRefusal>(&made))
    throw rpc::Error(rpc::ErrorCode::RequestFailed, refusal->message(snapshot.language()));
  std::vector<protocol::TextEdit> edits;
  std::size_t line = 0;
  syntax::each_tree(std::get<std::string>(made), [&](const syntax::LineTree& tree, std::string_view) {
    if (auto edit = queries::line_edit(snapshot, line++, tree.text)) edits.push_back(std::move(*edit));
  });
  return {{"edit", queries::workspace_edit(snapshot, edits)}};
}

}  // namespace

extern const features::Feature transform = {.commands = {on<&transform_program>("isocnc.transform")}};

}  // namespace isocnc::extensions
