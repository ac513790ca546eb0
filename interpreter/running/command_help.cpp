#include "interpreter/running/command_help.h"

#include <algorithm>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace isocnc::running {

static bool is_hidden(const CLI::Option& option) { return option.get_group().empty(); }
static bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

static const CLI::Option* option_named(const CLI::App& app, std::string_view name) {
  for (const CLI::Option* const option : app.get_options()) {
    const auto is_name = [&](std::string_view dashes, const std::vector<std::string>& names) {
      return std::any_of(names.begin(), names.end(),
                         [&](const std::string& each) { return name == fmt::format("{}{}", dashes, each); });
    };
    if (is_name("--", option->get_lnames()) || is_name("-", option->get_snames())) return option;
  }
  return nullptr;
}

std::string completions(const CLI::App& app, const Choices& choices, std::string_view word, std::string_view previous) {
  std::string lines;
  const CLI::Option* const before = previous.starts_with('-') ? option_named(app, previous) : nullptr;
  if (before && takes_value(*before)) {
    const std::size_t last = word.find_last_of(',') + 1;  // 0 where there is no comma.
    for (const std::string& name : before->get_lnames()) {
      const auto known = choices.find("--" + name);
      if (known == choices.end()) continue;
      for (const std::string& choice : known->second)
        if (std::string_view(choice).starts_with(word.substr(last)))
          lines += fmt::format("{}{}\n", word.substr(0, last), choice);
    }
    return lines;
  }
  if (!word.starts_with('-')) return lines;
  for (const CLI::Option* const option : app.get_options()) {
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
    const bool begins_line = escaped.empty() || escaped.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
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
  if (names.empty()) names = fmt::format("\\fI{}\\fR", roff(option.get_name(true)));
  if (takes_value(option) && !option.get_option_text().empty())
    names += fmt::format(" \\fI{}\\fR", roff(option.get_option_text()));
  return names;
}

std::string manual_page(const CLI::App& app, const ManualTexts& texts) {
  std::string capitals(texts.program);
  std::transform(capitals.begin(), capitals.end(), capitals.begin(), ::toupper);
  std::string page = fmt::format(".TH {} 1 \"\" \"isocnc {}\" \"ISOCNC programs\"\n", capitals, texts.version);
  page += fmt::format(".SH NAME\n{} \\- {}\n", texts.program, roff(texts.purpose));
  page += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR [\\fIoptions\\fR] [\\fIPATH\\fR...]\n.SH DESCRIPTION\n", texts.program);
  for (const std::string_view paragraph : texts.description) page += fmt::format(".PP\n{}\n", roff(paragraph));
  page += ".SH OPTIONS\n";
  for (const std::string& group : app.get_groups()) {
    if (group.empty()) continue;
    page += fmt::format(".SS {}\n", roff(group));
    for (const CLI::Option* const option : app.get_options())
      if (option->get_group() == group)
        page += fmt::format(".TP\n{}\n{}\n", roff_names(*option), roff(option->get_description()));
  }
  page += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : texts.exit_statuses) page += fmt::format(".TP\n{}\n{}\n", status, roff(meaning));
  page += ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < texts.see_also.size(); ++i)
    page += fmt::format("\\fB{}\\fR(1){}\n", texts.see_also[i], i + 1 < texts.see_also.size() ? "," : "");
  return page;
}

}  // namespace isocnc::running
