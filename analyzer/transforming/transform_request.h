#pragma once

#include <optional>
#include <string>
#include <variant>

#include "analyzer/transforming/transformation.h"
#include "interpreter/dialect/diagnostic.h"

namespace isocnc::transforming {

/// A transformation as a user writes it: the values of the options of isofmt, empty where they are not given.
struct TransformRequest {
  std::string mirror;  ///< X or Y.
  std::string rotate;
  std::string about;
  std::string shift;
  std::string repeat;
  std::string scale_feed;

  /// What they ask for; nothing without any; or what is wrong with them, in a language.
  std::variant<std::optional<Transformation>, std::string> read(dialect::Language language) const;
};

}  // namespace isocnc::transforming
