#include "analyzer/transforming/transform_request.h"

#include <cmath>
#include <string_view>
#include <vector>

#include "interpreter/dialect/format.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::transforming {

using dialect::Text;

static constexpr Text kWrongMirror{"--mirror goes with --about and a place on its axis in mm, such as 400",
                                   "--mirror va con --about e una quota del suo asse in mm, come 400"};
static constexpr Text kWrongRotate{
    "--rotate takes degrees, such as 90, and goes with --about and a center in mm, such as 400,250",
    "--rotate vuole gradi, come 90, e va con --about e un centro in mm, come 400,250"};
static constexpr Text kWrongShift{"--shift takes a way in mm along X, Y and, if need be, Z, such as 100,-50 or 0,0,5",
                                  "--shift vuole uno spostamento in mm lungo X, Y e, se serve, Z, come 100,-50 o "
                                  "0,0,5"};
static constexpr Text kWrongFeed{"--scale-feed takes a factor from 0.001 to 1000, such as 0.8",
                                 "--scale-feed vuole un fattore da 0.001 a 1000, come 0.8"};
static constexpr Text kWrongRepeat{
    "--repeat takes columns and rows, up to {} in all, and the way in mm between columns in X and between rows in Y, "
    "such "
    "as 3,2,120,80",
    "--repeat vuole colonne e righe, in tutto fino a {}, e la distanza in mm fra le colonne in X e fra le righe in Y, "
    "come "
    "3,2,120,80"};
static constexpr Text kOneMovement{"one of --mirror, --rotate, --shift and --repeat at a time",
                                   "uno solo fra --mirror, --rotate, --shift e --repeat alla volta"};
static constexpr Text kAboutAlone{"--about goes with --mirror or --rotate", "--about va con --mirror o --rotate"};

/// Numbers with commas between them, as programs write numbers; nothing if one cannot be read, or is too far away.
static std::optional<std::vector<double>> read_lengths(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    const std::size_t comma = text.find(',');
    // The parser of words reads the number, as it reads those of the program.
    const syntax::ParsedLine line("X" + std::string(text.substr(0, comma)));
    const syntax::LineTree tree = line.tree();
    const bool is_number = tree.words.size() == 1 && tree.findings.empty() && tree.comments.empty();
    if (!is_number || !(std::abs(tree.words.front().value) <= kMaxPlace)) return std::nullopt;
    numbers.push_back(tree.words.front().value);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

static std::optional<std::vector<double>> read_lengths(std::string_view text, std::size_t minimum,
                                                       std::size_t maximum) {
  std::optional<std::vector<double>> numbers = read_lengths(text);
  if (numbers && (numbers->size() < minimum || numbers->size() > maximum)) return std::nullopt;
  return numbers;
}

/// Whether the numbers make sense.
static bool read_repeat(std::string_view text, Transformation& transformation) {
  const auto numbers = read_lengths(text, 4, 4);
  if (!numbers) return false;
  const auto is_count = [](double number) {
    return number >= 1 && number <= kMaxCopies && number == std::floor(number);
  };
  if (!is_count((*numbers)[0]) || !is_count((*numbers)[1])) return false;
  const int count = static_cast<int>((*numbers)[0] * (*numbers)[1]);
  if (count < 2 || count > kMaxCopies) return false;
  transformation.movement = Movement::Repeat;
  transformation.columns = static_cast<int>((*numbers)[0]);
  transformation.rows = static_cast<int>((*numbers)[1]);
  transformation.place = {(*numbers)[2], (*numbers)[3], 0};
  return true;
}

std::variant<std::optional<Transformation>, std::string> TransformRequest::read(dialect::Language language) const {
  const auto wrong = [&](const Text& text) { return std::string(text.in(language)); };
  Transformation transformation;
  if (!mirror.empty() + !rotate.empty() + !shift.empty() + !repeat.empty() > 1) return wrong(kOneMovement);
  if (!mirror.empty()) {
    const auto place = read_lengths(about, 1, 1);
    if (!place) return wrong(kWrongMirror);
    transformation.movement = mirror == "X" ? Movement::MirrorX : Movement::MirrorY;
    transformation.place = {place->front(), place->front(), 0};
  } else if (!rotate.empty()) {
    const auto degrees = read_lengths(rotate, 1, 1);
    const auto center = read_lengths(about, 2, 2);
    if (!degrees || !center) return wrong(kWrongRotate);
    transformation.movement = Movement::Rotate;
    transformation.degrees = degrees->front();
    transformation.place = {center->front(), center->back(), 0};
  } else if (!about.empty()) {
    return wrong(kAboutAlone);
  } else if (!shift.empty()) {
    const auto way = read_lengths(shift, 2, 3);
    if (!way) return wrong(kWrongShift);
    transformation.movement = Movement::Shift;
    transformation.place = {(*way)[0], (*way)[1], way->size() > 2 ? (*way)[2] : 0};
  }
  if (!repeat.empty() && !read_repeat(repeat, transformation))
    return dialect::format(kWrongRepeat, language, kMaxCopies);
  if (!scale_feed.empty()) {
    const auto factor = read_lengths(scale_feed, 1, 1);
    if (!factor || factor->front() < kMinFeedFactor || factor->front() > kMaxFeedFactor) return wrong(kWrongFeed);
    transformation.feed_factor = factor->front();
  } else if (transformation.movement == Movement::None) {
    return std::optional<Transformation>();
  }
  return std::optional(transformation);
}

}  // namespace isocnc::transforming
