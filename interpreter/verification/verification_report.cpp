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

/// A number of things, its digits in groups of three. The point is that of decimals in both languages, as in programs,
/// so that Italian groups have a space.
static std::string grouped(std::size_t count, Language language) {
  std::string digits = fmt::format("{}", count);
  for (std::size_t at = digits.size(); at > 3; at -= 3)
    digits.insert(at - 3, language == Language::English ? "," : " ");
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
    case Gap::ResolutionTooFine:
      return dialect::format(Text{"the material, which a resolution of {} mm would fit",
                                  "il materiale, per cui ci sta una risoluzione di {} mm"},
                             language, gap.spacing);
    case Gap::SetupMistaken:
      return dialect::format(Text{"what the setup describes", "ciò che l'attrezzaggio descrive"}, language);
    case Gap::Undecided:
      break;
  }
  return dialect::format(kUndecided, language, line);
}

/// `lines 3 to 5 and 8`.
static std::string in_words(const UnknownPlaces& places, Language language) {
  constexpr std::size_t kShown = 4;
  std::vector<std::string> parts;
  for (const auto& [first, last] : places.lines) {
    if (parts.size() == kShown) break;
    parts.push_back(first == last ? fmt::format("{}", first + 1)
                                  : dialect::format(Text{"{} to {}", "da {} a {}"}, language, first + 1, last + 1));
  }
  const std::size_t more = places.lines.size() - parts.size();
  if (more > 0) parts.push_back(dialect::format(Text{"{} more places", "altri {} punti"}, language, more));
  std::string lines = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i)
    lines.append(i + 1 < parts.size() ? ", " : Text{" and ", " e "}.in(language)).append(parts[i]);
  static constexpr Text kLine = {"line {} (it is not known where {} leaves the machine)",
                                 "linea {} (non si sa dove {} lascia la macchina)"};
  static constexpr Text kLines = {"lines {} (it is not known where {} leaves the machine)",
                                  "linee {} (non si sa dove {} lascia la macchina)"};
  const bool is_one = places.lines.size() == 1 && places.lines[0].first == places.lines[0].second;
  return dialect::format(is_one ? kLine : kLines, language, lines, places.after);
}

static std::vector<std::string> not_verified(const Certificate& certificate, Language language) {
  std::vector<std::string> gaps;
  for (const Unverified& each : certificate.gaps) gaps.push_back(in_words(each, language));
  for (const UnknownPlaces& each : certificate.unknown_places) gaps.push_back(in_words(each, language));
  if (!certificate.has_setup)
    gaps.emplace_back(Text{"no setup is for this program", "nessun attrezzaggio è per questo programma"}.in(language));
  if (const auto& window = certificate.window)
    gaps.push_back(dialect::format(
        certificate.is_window_empty
            ? Text{"the material, of which nothing is in X{} to X{}, Y{} to Y{}",
                   "il materiale, di cui non c'è nulla da X{} a X{}, da Y{} a Y{}"}
            : Text{"the material outside X{} to X{}, Y{} to Y{}", "il materiale fuori da X{} a X{}, da Y{} a Y{}"},
        language, window->min().x(), window->max().x(), window->min().y(), window->max().y()));
  if (certificate.stopped_at)
    gaps.push_back(dialect::format(Text{"what follows the error on line {}", "ciò che segue l'errore alla linea {}"},
                                   language, *certificate.stopped_at + 1));
  if (certificate.ended_before)
    gaps.push_back(dialect::format(Text{"what follows from line {} on, which was not run",
                                        "ciò che segue dalla linea {}, che non è stato eseguito"},
                                   language, *certificate.ended_before + 1));
  for (const std::string& tool : certificate.bare_tools)
    gaps.push_back(dialect::format(Text{"{} has no holder", "{} non ha portautensile"}, language, tool));
  if (!certificate.has_nose)
    gaps.emplace_back(Text{"the spindle nose is not described", "il naso del mandrino non è descritto"}.in(language));
  if (certificate.is_setup_empty)
    gaps.emplace_back(Text{"the setup describes no body", "l'attrezzaggio non descrive alcun corpo"}.in(language));
  return gaps;
}

/// Pairs of bodies: `gantry and rails`.
static std::vector<std::string> not_compared(const Certificate& certificate, Language language) {
  std::vector<std::string> pairs;
  for (const auto& [moving, other] : certificate.touching)
    pairs.push_back(dialect::format(Text{"{} and {}", "{} e {}"}, language, moving, other));
  return pairs;
}

std::string in_words(const Certificate& certificate, Language language) {
  static constexpr Text kInSetup = {"verified: {}, {}; nothing nearer than {} mm unseen in the setup of {}",
                                    "verificato: {}, {}; nulla di più vicino di {} mm sfugge nell'attrezzaggio di {}"};
  static constexpr Text kOfMachine = {
      "verified: {}, {}; nothing nearer than {} mm unseen between the bodies of the machine in {}",
      "verificato: {}, {}; nulla di più vicino di {} mm sfugge tra i corpi della macchina in {}"};
  static constexpr Text kWithMaterial = {
      "verified: {}, {}; nothing nearer than {} mm unseen, nor wider than {:.2f} mm and deeper than {:.2f} mm "
      "in the material, in the setup of {}",
      "verificato: {}, {}; nulla di più vicino di {} mm sfugge, né di più largo di {:.2f} mm e profondo più di "
      "{:.2f} mm nel materiale, nell'attrezzaggio di {}"};
  std::string motions = counted(certificate.motions, {"motion", "movimento"}, {"motions", "movimenti"}, language);
  if (certificate.paths > 1)
    motions += dialect::format(Text{" on {} paths", " su {} percorsi"}, language, certificate.paths);
  const std::string contacts =
      counted(certificate.contacts, {"contact", "contatto"}, {"contacts", "contatti"}, language);
  std::string line = certificate.soft_disc
                         ? dialect::format(kWithMaterial, language, motions, contacts, certificate.epsilon,
                                           *certificate.soft_disc, *certificate.soft_depth, certificate.scene)
                         : dialect::format(certificate.has_setup ? kInSetup : kOfMachine, language, motions, contacts,
                                           certificate.epsilon, certificate.scene);
  const std::vector<std::string> gaps = not_verified(certificate, language);
  if (!gaps.empty())
    line += dialect::format(Text{"; not verified: {}", "; non verificato: {}"}, language, fmt::join(gaps, ", "));
  if (const std::vector<std::string> pairs = not_compared(certificate, language); !pairs.empty())
    line += dialect::format(
        Text{"; not compared: {}, which touch at the start", "; non confrontati: {}, che all'inizio si toccano"},
        language, fmt::join(pairs, ", "));
  if (certificate.more_contacts > 0)
    line += dialect::format(Text{"; not listed: {} contacts and near misses that repeat others",
                                 "; non elencati: {} contatti e passaggi ravvicinati che ne ripetono altri"},
                            language, grouped(certificate.more_contacts, language));
  return line;
}

std::string in_words(const Contact& contact, Language language) {
  return syntax::message(finding_of(contact), {}, language);
}

/// `1,234.5 cm3`.
static std::string cubic_centimeters(double volume, Language language) {
  const double tenths = std::round(volume / 100);
  const auto whole = static_cast<std::size_t>(tenths / 10);
  return fmt::format("{}.{:.0f} cm3", grouped(whole, language), tenths - static_cast<double>(whole) * 10);
}

std::string in_words(const MaterialReport& material, Language language) {
  static constexpr Text kVolumes = {"material: {} removed of {}, {} left (resolution {:.3g} mm)\n",
                                    "materiale: asportati {} di {}, restano {} (risoluzione {:.3g} mm)\n"};
  static constexpr Text kTool = {"cut by {}: {} in {:.1f} s, up to {:.2f} mm deep and {:.2f} mm wide\n",
                                 "asportato da {}: {} in {:.1f} s, fino a {:.2f} mm di profondità e {:.2f} mm di "
                                 "larghezza\n"};
  const double left = material.stock.volume();
  std::string text = dialect::format(kVolumes, language, cubic_centimeters(material.blank_volume - left, language),
                                     cubic_centimeters(material.blank_volume, language),
                                     cubic_centimeters(left, language), material.stock.spacing());
  for (const removal::RemovedByTool& each : material.by_tool)
    text += dialect::format(kTool, language, running::tool_name(each.tool),
                            cubic_centimeters(each.removed.volume, language), each.seconds, each.removed.depth,
                            each.removed.width);
  return text;
}

static void add(const MaterialReport& material, OrderedJson& json) {
  const double left = material.stock.volume();
  json["removedVolume"] = material.blank_volume - left;
  json["remainingVolume"] = left;
  json["resolution"] = material.stock.spacing();
  json["tools"] = OrderedJson::array();
  for (const removal::RemovedByTool& each : material.by_tool)
    json["tools"].push_back({{"tool", running::tool_name(each.tool)},
                             {"volume", each.removed.volume},
                             {"depth", each.removed.depth},
                             {"width", each.removed.width},
                             {"seconds", each.seconds}});
}

OrderedJson to_json(const VerifiedRun& verified, Language language) {
  const Certificate& certificate = *verified.certificate;
  OrderedJson json = {{"motions", certificate.motions}, {"contacts", OrderedJson::array()}};
  OrderedJson near_misses = OrderedJson::array();
  for (const Contact& contact : verified.contacts) {
    if (contact.is_hint()) continue;
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
    if (contact.enough) each["enoughZ"] = *contact.enough;
    if (contact.volume) each["volume"] = *contact.volume;
    if (contact.shaped_by) each["shapedBy"] = *contact.shaped_by + 1;
    if (contact.is_near_miss()) {
      each["distance"] = contact.distance;
      near_misses.push_back(std::move(each));
    } else {
      each["depth"] = std::max(0.0, -contact.distance);
      json["contacts"].push_back(std::move(each));
    }
  }
  json["nearMisses"] = std::move(near_misses);
  if (verified.material) add(*verified.material, json);
  json["certificate"] = {{"hardEpsilon", certificate.epsilon}};
  if (certificate.soft_disc) json["certificate"]["softDisc"] = *certificate.soft_disc;
  if (certificate.soft_depth) json["certificate"]["softDepth"] = *certificate.soft_depth;
  json["certificate"]["setup"] = certificate.scene;
  json["certificate"]["notVerified"] = not_verified(certificate, language);
  json["certificate"]["notCompared"] = not_compared(certificate, language);
  json["certificate"]["notListed"] = certificate.more_contacts;
  return json;
}

}  // namespace isocnc::verification
