#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "interpreter/verification/contact.h"

namespace isocnc::verification {

/// The certificate as one line without its end: `verified: 48,120 motions, 2 contacts; nothing nearer than 0.01 mm
/// unseen in the setup of isocnc.json; not verified: T103001 has no shape`. It never says "safe".
std::string in_words(const Certificate& certificate, dialect::Language language);

/// What a contact's finding says.
std::string in_words(const Contact& contact, dialect::Language language);

/// `{"motions", "contacts": [{"code", "line", "endLine", "time", "tool", "body", "obstacle", "point", "depth"}],
/// "nearMisses": [... "distance" ...], "certificate": {"hardEpsilon", "setup", "notVerified"}}`: lines from 1, seconds,
/// mm, points in machine coordinates.
nlohmann::ordered_json to_json(const std::vector<Contact>& contacts, const Certificate& certificate,
                               dialect::Language language);

}  // namespace isocnc::verification
