#include "interpreter/running/program_app.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpreter/dialect/near_names.h"

namespace isocnc::running {

using dialect::Language;

static bool is_hidden(const CLI::Option& option) { return option.get_group().empty(); }
static bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

ProgramApp::ProgramApp(std::string description, ManualTexts texts)
    : app_(std::move(description), texts.program), texts_(std::move(texts)) {
  app_.set_version_flag("--version", fmt::format("{} {}", texts_.program, texts_.version));
  app_.get_formatter()->column_width(27);
}

CLI::Option* ProgramApp::add_choice(const std::string& name, std::string& value, std::vector<std::string> choices,
                                    const char* placeholder, const std::string& description) {
  suggest(name, choices);
  const auto complain = [choices = std::move(choices)](const std::string& given) -> std::string {
    if (std::find(choices.begin(), choices.end(), given) != choices.end()) return {};
    return fmt::format("there is no {}, only {}{}", given, fmt::join(choices, ", "),
                       dialect::did_you_mean(dialect::nearest_name(given, choices), Language::English));
  };
  return app_.add_option(name, value, description)->check(complain)->option_text(placeholder);
}

ProgramApp::Said ProgramApp::read(int argc, const char* const* argv, const std::function<Language()>& language) {
  const std::string_view request = argc > 1 ? argv[1] : "";
  if (request == "--manual-page") return {.answer = manual_page(), .complaint = {}};
  if (request == "--complete")
    return {.answer = completions(argc > 3 ? argv[3] : "", argc > 4 ? argv[4] : ""), .complaint = {}};
  try {
    app_.parse(argc, argv);
  } catch (const CLI::Success& success) {
    std::ostringstream said;
    app_.exit(success, said, said);
    return {.answer = said.str(), .complaint = {}};
  } catch (const CLI::ParseError& error) {
    return {.answer = {}, .complaint = complaint_about(error, language())};
  }
  return {};
}

std::string ProgramApp::complaint_about(const CLI::ParseError& error, Language language) const {
  static constexpr dialect::Text kNoSuchOption = {"no such option", "opzione sconosciuta"};
  const std::vector<std::string> unexpected = app_.remaining();
  if (unexpected.empty() || !unexpected.front().starts_with('-')) return error.what();
  std::vector<std::string> names;
  for (const CLI::Option* const option : app_.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::string given = unexpected.front().substr(0, unexpected.front().find('='));
  return fmt::format("{}: {}{}", kNoSuchOption.in(language), given,
                     dialect::did_you_mean(dialect::nearest_name(given, names), language));
}

std::string ProgramApp::completions(std::string_view word, std::string_view previous) const {
  std::string lines;
  const CLI::Option* const before =
      previous.starts_with('-') ? app_.get_option_no_throw(std::string(previous)) : nullptr;
  if (before != nullptr && takes_value(*before)) {
    const auto words = words_.find("--" + before->get_lnames().front());
    if (words == words_.end()) return lines;
    const std::size_t last = word.find_last_of(',') + 1;  // 0 where there is no comma.
    for (const std::string_view each : words->second)
      if (dialect::begins_with(each, word.substr(last))) lines += fmt::format("{}{}\n", word.substr(0, last), each);
    return lines;
  }
  if (!word.starts_with('-')) return lines;
  for (const CLI::Option* const option : app_.get_options()) {
    if (is_hidden(*option)) continue;
    for (const std::string& name : option->get_lnames())
      if (("--" + name).starts_with(word)) lines += fmt::format("--{}\n", name);
  }
  return lines;
}

/// Dashes as they are typed, and no line that begins as a request would.
static std::string roff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (escaped.empty() && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\' || c == '-') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

static std::string roff_names(const CLI::Option& option) {
  std::string names;
  const auto add = [&](std::string_view dashes, const std::vector<std::string>& all) {
    for (const std::string& name : all)
      names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(fmt::format("{}{}", dashes, name)));
  };
  add("-", option.get_snames());
  add("--", option.get_lnames());
  if (names.empty()) return fmt::format("\\fI{}\\fR", roff(option.get_name(true)));
  const std::string placeholder = option.get_option_text().empty() ? option.get_type_name() : option.get_option_text();
  return takes_value(option) ? fmt::format("{} \\fI{}\\fR", names, roff(placeholder)) : names;
}

std::string ProgramApp::manual_page() const {
  std::string capitals = texts_.program;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string page = fmt::format(".TH {} 1 \"\" \"isocnc {}\" \"ISOCNC programs\"\n", capitals, texts_.version);
  page += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n", texts_.program, roff(texts_.purpose));
  page += fmt::format("\\fB{}\\fR [\\fIoptions\\fR] {}\n.SH DESCRIPTION\n", texts_.program, roff(texts_.operands));
  for (const std::string_view paragraph : texts_.paragraphs) page += fmt::format(".PP\n{}\n", roff(paragraph));
  page += ".SH OPTIONS\n";
  for (const std::string& group : app_.get_groups()) {
    if (group.empty()) continue;
    page += fmt::format(".SS {}\n", roff(group));
    for (const CLI::Option* const option : app_.get_options())
      if (option->get_group() == group)
        page += fmt::format(".TP\n{}\n{}\n", roff_names(*option), roff(option->get_description()));
  }
  page += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : texts_.exit) page += fmt::format(".TP\n{}\n{}\n", status, roff(meaning));
  page += ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < texts_.see_also.size(); ++i)
    page += fmt::format("\\fB{}\\fR(1){}\n", texts_.see_also[i], i + 1 < texts_.see_also.size() ? "," : "");
  return page;
}

}  // namespace isocnc::running
