#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "interpreter/verification/contact.h"
#include "interpreter/verification/encounter.h"

namespace isocnc::verification {

/// A stretch that an encounter happens on, as the log needs it.
struct StretchPlace {
  std::size_t number = 0;  ///< Of the stretch, counted from the start of the run.
  std::size_t line = 0;    ///< From 0.
  geometry::Frame frame;   ///< In force; in the machine frame.
};

/// Puts encounters together: a mover that comes near an obstacle and leaves it again is one contact or one near miss,
/// however many motions it takes and whichever part of the tool is nearest.
class ContactLog {
 public:
  /// Takes what stretches that were examined together have shown; in the order of the run. `place_of` tells where each
  /// of them is.
  template <class PlaceOf>
  void take(const std::vector<Encounter>& encounters, PlaceOf&& place_of, const BodyPairs& bodies,
            const execution::ToolCode& tool) {
    for (const Encounter& encounter : encounters) take_one(encounter, place_of(encounter.stretch), bodies, tool);
  }
  /// Nothing lasts from before to after, as at a tool change.
  void close_all();

  /// After close_all(): sorted by time.
  std::vector<Contact> contacts() const;
  std::size_t contact_count() const { return count_; }  ///< Without near misses, with those that are not kept.
  std::size_t left_out() const { return left_out_; }    ///< Contacts and near misses beyond kMaxContacts.

 private:
  /// What is going on at an obstacle.
  struct Episode {
    std::size_t last_stretch = 0;
    bool has_touched = false;
    bool reports_near = false;
    Contact contact;
  };

  void take_one(const Encounter& encounter, const StretchPlace& at, const BodyPairs& bodies,
                const execution::ToolCode& tool);
  void close(const Episode& episode);

  static constexpr std::size_t kMaxContacts = 10'000;

  std::map<std::pair<std::size_t, Mover>, Episode> open_;  ///< By obstacle and what comes near it.
  std::vector<Contact> contacts_;
  std::size_t count_ = 0;
  std::size_t left_out_ = 0;
};

}  // namespace isocnc::verification
