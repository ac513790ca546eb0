#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "interpreter/removal/kept_repeats.h"
#include "interpreter/verification/contact.h"
#include "interpreter/verification/encounter.h"

namespace isocnc::verification {

/// A stretch that an encounter happens on, as the log needs it.
struct StretchPlace {
  std::size_t number = 0;     ///< Of the stretch, counted from the start of the run.
  std::size_t line = 0;       ///< From 0.
  geometry::Frame frame;      ///< In force; in the machine frame.
  bool is_in_inches = false;  ///< G70 is in force.
};

/// Puts encounters together: a mover that touches an obstacle is one contact until all of it has left the obstacle,
/// however many motions it takes and whichever part of the tool is nearest; a mover that comes near an obstacle and
/// leaves it again without a touch is one near miss.
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
  std::size_t contact_count() const { return count_; }       ///< Without near misses, with those that are not kept.
  std::size_t left_out() const { return kept_.left_out(); }  ///< Contacts and near misses that are not kept.

 private:
  using ContactPlace = std::pair<std::size_t, Mover>;  ///< An obstacle and what comes near it.

  /// What is going on at an obstacle.
  struct Episode {
    bool is_open = false;
    bool has_touched = false;
    bool reports_near = false;
    bool is_together = false;      ///< Whether a part touches at the end of the last stretch.
    bool is_rough = false;         ///< Only touches whose depth says little have been taken.
    bool is_apart = false;         ///< Whether all parts are beyond their limits at the end of the last stretch.
    std::size_t last_stretch = 0;  ///< On which the mover came near.
    Contact contact;
  };

  /// An encounter on the present stretch.
  struct Visit {
    ContactPlace place;
    std::size_t part = 0;  ///< Among BodyPairs::parts.
    bool reports_near = false;
    bool is_rough = false;  ///< Another pair of both measures how deep a touch is (BodyPair::core).
    Contact contact;        ///< Without times and lines.
    Encounter encounter;
  };

  /// A touch on the present stretch, with the visit that it belongs to.
  struct VisitTouch {
    const Visit* visit = nullptr;
    const Touch* touch = nullptr;
  };

  void take_one(const Encounter& encounter, const StretchPlace& at, const BodyPairs& bodies,
                const execution::ToolCode& tool);
  void settle();
  void settle(std::span<const Visit> visits);
  void take_touch(Episode& episode, const VisitTouch& touch) const;
  void take_near(Episode& episode, const Visit& visit) const;
  void close(Episode& episode);

  /// What one slip with a tool repeats at an obstacle.
  using ContactCause = std::tuple<dialect::DiagnosticId, Mover, std::uint32_t, BodyDescription, execution::ToolCode>;
  static ContactCause cause_of(const Contact& contact);

  std::map<ContactPlace, Episode> episodes_;
  StretchPlace at_;            ///< The present stretch.
  std::vector<Visit> visits_;  ///< Encounters on it.
  std::vector<Contact> contacts_;
  removal::KeptRepeats<ContactCause> kept_;
  std::size_t count_ = 0;
};

}  // namespace isocnc::verification
