#include <limits>
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

constexpr std::size_t kNewLine = std::numeric_limits<std::size_t>::max();

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

/// Columns, rows, and how far they are apart.
void read_repeat(const Json& json, Transformation& transformation) {
  if (!json.is_array() || json.size() != 4) reject("repeat is columns, rows and two lengths", json);
  const auto count_of = [](const Json& count) {
    if (!count.is_number_integer()) reject("a number of copies is missing", count);
    return static_cast<int>(number_of(count, 1, transforming::kMaxCopies));
  };
  transformation.movement = Movement::Repeat;
  transformation.columns = count_of(json[0]);
  transformation.rows = count_of(json[1]);
  transformation.place = {length_of(json[2]), length_of(json[3]), 0};
  const int count = transformation.columns * transformation.rows;
  if (count < 2 || count > transforming::kMaxCopies) reject("there are too few copies, or too many", json);
}

void from_json(const Json& json, TransformParams& params) {
  Transformation& transformation = params.transformation;
  const int movements =
      json.contains("mirror") + json.contains("rotate") + json.contains("shift") + json.contains("repeat");
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
  } else if (json.contains("repeat")) {
    read_repeat(json.at("repeat"), transformation);
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
  const auto& text = std::get<std::string>(made);
  std::vector<std::size_t> origins;
  const std::size_t count = snapshot.document().line_count();
  syntax::each_tree(text, [&](const syntax::LineTree& tree, std::string_view) {
    const std::size_t line = origins.size();
    // Up to the first copy, the document stays.
    const bool is_copied = params.transformation.movement == Movement::Repeat &&
                           ((line > 0 && origins.back() == kNewLine) || line >= count ||
                            snapshot.document().text_of_line(line) != tree.text);
    const bool is_kept = line < count && !is_copied;
    origins.push_back(is_kept ? line : kNewLine);
  });
  const std::vector<protocol::TextEdit> edits = queries::edits_to(snapshot, text, origins);
  return {{"edit", queries::workspace_edit(snapshot, edits)}};
}

}  // namespace

extern const features::Feature transform = {.commands = {on<&transform_program>("isocnc.transform")}};

}  // namespace isocnc::extensions
