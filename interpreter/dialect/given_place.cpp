#include "interpreter/dialect/given_place.h"

#include "interpreter/dialect/kept_values.h"

namespace isocnc::dialect {

static KeptValues<FilePlace>& places() {
  static KeptValues<FilePlace> places;
  return places;
}

GivenPlace GivenPlace::of(const FilePlace& place) { return {places().number_of(place)}; }

const FilePlace& GivenPlace::place() const { return places().at(number); }

}  // namespace isocnc::dialect
