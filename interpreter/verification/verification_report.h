#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "interpreter/verification/verified_run.h"

namespace isocnc::verification {

/// The certificate as one line without its end: `verified: 48,120 motions, 2 contacts; nothing nearer than 0.01 mm
/// unseen in the setup of isocnc.json; not verified: T103001 has no shape`. It never says "safe".
std::string in_words(const Certificate& certificate, dialect::Language language);

/// What a contact's finding says.
std::string in_words(const Contact& contact, dialect::Language language);

/// What has become of the material, as lines: the volume that is removed and remains, and the work of each tool.
std::string in_words(const MaterialReport& material, dialect::Language language);

/// `{"motions", "contacts": [{"code", "line", "endLine", "time", "tool", "body", "obstacle", "point", "depth"}],
/// "nearMisses": [... "distance" ...], "removedVolume", "remainingVolume", "resolution", "tools": [{"tool", "volume",
/// "depth", "width", "seconds"}], "certificate": {"hardEpsilon", "softDisc", "softDepth", "setup", "notVerified",
/// "notCompared"}}`: lines from 1, seconds, mm, mm^3, points in machine coordinates. What is about material is there
/// where the setup describes a stock. `verified` has a certificate.
nlohmann::ordered_json to_json(const VerifiedRun& verified, dialect::Language language);

}  // namespace isocnc::verification
