#include "interpreter/verification/verification_report.h"

#include <cmath>

#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/running/runner.h"
#include "interpreter/running/vector_json.h"
#include "interpreter/verification/verified_run.h"

namespace isocnc::verification {

using dialect::Language;
using dialect::Text;
using OrderedJson = nlohmann::ordered_json;

/// A number of things, its digits in groups of three.
static std::string grouped(std::size_t count, Language language) {
  std::string digits = fmt::format("{}", count);
  for (std::size_t at = digits.size(); at > 3; at -= 3)
    digits.insert(at - 3, language == Language::English ? "," : ".");
  return digits;
}

static std::string counted(std::size_t count, const Text& one, const Text& several, Language language) {
  return fmt::format("{} {}", grouped(count, language), (count == 1 ? one : several).in(language));
}

static std::string in_words(const Unverified& gap, Language language) {
  static constexpr Text kWithoutShape = {"{} has no shape", "{} non ha forma"};
  static constexpr Text kWithoutLength = {"{} has no length", "{} non ha lunghezza"};
  static constexpr Text kUndecided = {"motions that could not be decided, from line {} on",
                                      "movimenti su cui non si è potuto decidere, dalla linea {}"};
  static constexpr Text kOtherValues = {"other values of {} at the jump of line {}",
                                        "altri valori di {} al salto della linea {}"};
  const std::string_view name = gap.name.in(language);
  const std::size_t line = gap.line + 1;
  switch (gap.gap) {
    case Gap::ToolWithoutShape:
      return dialect::format(kWithoutShape, language, name);
    case Gap::ToolWithoutLength:
      return dialect::format(kWithoutLength, language, name);
    case Gap::OtherPaths:
      return dialect::format(kOtherValues, language, "VGPL", line);
    case Gap::OtherRegisters:
      return dialect::format(kOtherValues, language, name, line);
    case Gap::Undecided:
      break;
  }
  return dialect::format(kUndecided, language, line);
}

static std::vector<std::string> not_verified(const Certificate& certificate, Language language) {
  std::vector<std::string> gaps;
  for (const Unverified& each : certificate.gaps) gaps.push_back(in_words(each, language));
  if (!certificate.has_setup)
    gaps.emplace_back(Text{"no setup is for this program", "nessun attrezzaggio è per questo programma"}.in(language));
  if (certificate.stopped_at)
    gaps.push_back(dialect::format(Text{"what follows the error on line {}", "ciò che segue l'errore alla linea {}"},
                                   language, *certificate.stopped_at + 1));
  return gaps;
}

std::string in_words(const Certificate& certificate, Language language) {
  static constexpr Text kInSetup = {"verified: {}, {}; nothing nearer than {} mm unseen in the setup of {}",
                                    "verificato: {}, {}; nulla di più vicino di {} mm sfugge nell'attrezzaggio di {}"};
  static constexpr Text kOfMachine = {
      "verified: {}, {}; nothing nearer than {} mm unseen between the bodies of the machine in {}",
      "verificato: {}, {}; nulla di più vicino di {} mm sfugge tra i corpi della macchina in {}"};
  std::string line =
      dialect::format(certificate.has_setup ? kInSetup : kOfMachine, language,
                      counted(certificate.motions, {"motion", "movimento"}, {"motions", "movimenti"}, language),
                      counted(certificate.contacts, {"contact", "contatto"}, {"contacts", "contatti"}, language),
                      certificate.epsilon, certificate.scene);
  const std::vector<std::string> gaps = not_verified(certificate, language);
  if (gaps.empty()) return line;
  return line + dialect::format(Text{"; not verified: {}", "; non verificato: {}"}, language, fmt::join(gaps, ", "));
}

std::string in_words(const Contact& contact, Language language) {
  return syntax::message(finding_of(contact), {}, language);
}

OrderedJson to_json(const std::vector<Contact>& contacts, const Certificate& certificate, Language language) {
  OrderedJson json = {{"motions", certificate.motions}, {"contacts", OrderedJson::array()}};
  OrderedJson near_misses = OrderedJson::array();
  for (const Contact& contact : contacts) {
    OrderedJson each = {{"code", dialect::definition(contact.id).code},
                        {"line", contact.line + 1},
                        {"endLine", contact.end_line + 1},
                        {"time", contact.time},
                        {"endTime", contact.end_time},
                        {"tool", nullptr},
                        {"body", contact.who.in(language)},
                        {"obstacle", contact.whom.in(language)},
                        {"point", running::array(contact.point)}};
    if (contact.tool != execution::ToolCode()) each["tool"] = running::tool_name(contact.tool);
    if (contact.is_near_miss()) {
      each["distance"] = contact.distance;
      near_misses.push_back(std::move(each));
    } else {
      each["depth"] = std::max(0.0, -contact.distance);
      json["contacts"].push_back(std::move(each));
    }
  }
  json["nearMisses"] = std::move(near_misses);
  json["certificate"] = {{"hardEpsilon", certificate.epsilon},
                         {"setup", certificate.scene},
                         {"notVerified", not_verified(certificate, language)}};
  return json;
}

}  // namespace isocnc::verification
