#include <stdlib.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "examples.h"
#include "interpreter/configuration/keys.h"
#include "interpreter/configuration/read.h"
#include "interpreter/configuration/show.h"

namespace isocnc::configuration {
namespace {

using dialect::Language;
using nlohmann::json;

const std::filesystem::path kRoot = ISOCNC_SOURCE_DIR;

std::string read_file(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

json parsed(std::string_view text) { return json::parse(text, nullptr, true, true); }

/// The first example of a page.
std::string example_of(const std::filesystem::path& name) {
  const std::string page = read_file(kRoot / name);
  static constexpr std::string_view kFence = "```jsonc\n";
  const std::size_t begin = page.find(kFence) + kFence.size();
  return page.substr(begin, page.find("```", begin) - begin);
}

std::string complete_example() { return example_of("docs/configuration.md"); }

/// What a command prints.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) text.push_back(static_cast<char>(c));
  return text;
}

/// What a validator of JSON Schema has to say; it needs python3-jsonschema.
std::string validate(const json& documents, const std::string& schema = json_schema(Language::English)) {
  std::string name = std::filesystem::temp_directory_path() / "isocnc-schema-XXXXXX";
  ::close(::mkstemp(name.data()));
  std::ofstream(name) << json{{"schema", json::parse(schema)}, {"documents", documents}};
  std::string said =
      output_of(fmt::format("python3 '{}' '{}' 2>&1", (kRoot / "tests/support/validate.py").string(), name));
  std::filesystem::remove(name);
  return said;
}

TEST(Schema, AgreesWithTheReader) {
  json documents = json::array();
  const auto add = [&](std::string_view text, bool valid) {
    documents.push_back({{"document", parsed(text)}, {"valid", valid}});
  };
  add(complete_example(), true);
  add(to_json({}), true);
  for (const std::string_view text : kRightTexts) {
    add(text, true);
    add(to_json(read_configuration(text, "/").configuration), true);
  }
  for (const WrongText& wrong : kWrongTexts)
    if (wrong.schema_rejects) add(wrong.text, false);
  EXPECT_EQ(validate(documents), fmt::format("{} documents\n", documents.size()));
}

/// A setup that is a file of its own is an entry of `setups`, without `paths`.
TEST(Schema, OfSetupsAgreesWithTheReader) {
  json setups = parsed(complete_example())["setups"];
  ASSERT_FALSE(setups.empty());
  json documents = json::array();
  const auto add = [&](const json& setup) {
    documents.push_back({{"document", setup}, {"valid", read_setup(setup.dump()).mistakes.empty()}});
  };
  for (json setup : setups) {
    add(setup);
    setup.erase("paths");
    setup["$schema"] = "isocnc-setup.schema.json";
    add(setup);
    EXPECT_EQ(documents.back()["valid"], true) << setup;
  }
  for (const std::string_view text :
       {R"({})", R"([])", R"({"clearance": -1})", R"({"clearanc": 1})", R"({"target": {}})",
        R"({"spoilboard": {"top": 1}})", R"({"fixtures": [{}]})", R"({"frame": "part"})", R"({"setups": []})"})
    add(parsed(text));
  EXPECT_EQ(validate(documents, setup_schema(Language::English)), fmt::format("{} documents\n", documents.size()));
}

TEST(Schema, OfSetupsIsShipped) {
  const auto same = [](const char* page, Language language) {
    return read_file(kRoot / page) == setup_schema(language);
  };
  EXPECT_TRUE(same("docs/isocnc-setup.schema.json", Language::English)) << "isolint --lang en --setup-schema";
  EXPECT_TRUE(same("docs/isocnc-setup.schema.it.json", Language::Italian)) << "isolint --lang it --setup-schema";
}

TEST(Schema, IsShipped) {
  const auto same = [](const char* page, Language language) {
    return read_file(kRoot / page) == json_schema(language);
  };
  EXPECT_TRUE(same("docs/isocnc.schema.json", Language::English)) << "isolint --lang en --config-schema";
  EXPECT_TRUE(same("docs/isocnc.schema.it.json", Language::Italian)) << "isolint --lang it --config-schema";
}

TEST(Documentation, ListsAllKeys) {
  const auto lists = [](const std::string& page, Language language) {
    return read_file(kRoot / page).find("\n" + key_page(language)) != std::string::npos;
  };
  EXPECT_TRUE(lists("docs/configuration.md", Language::English))
      << "the table of docs/configuration.md is what isolint --config-keys prints";
  EXPECT_TRUE(lists("docs/it/configurazione.md", Language::Italian))
      << "the table of docs/it/configurazione.md is what isolint --lang it --config-keys prints";
}

TEST(Documentation, ListsTheKeysOfTheMachine) {
  const std::string page = machine_page(Language::English);
  EXPECT_TRUE(read_file(kRoot / "docs/machine.md") == page) << "isolint --machine-page > docs/machine.md";
  EXPECT_TRUE(read_file(kRoot / "docs/it/macchina.md") == machine_page(Language::Italian))
      << "isolint --lang it --machine-page > docs/it/macchina.md";
  // Without the section that a key stands in: `X.min` of machine.axes.X.min, `head` of machine.tools[].head.
  static const std::regex kMember(R"(machine\.(?:\w+(?:\[\])?\.(?:\*\.)?)?(.+))");
  for (const Key& key : all_keys()) {
    std::smatch match;
    if (key.kind < KeyKind::Number || !std::regex_match(key.path, match, kMember)) continue;
    EXPECT_NE(page.find("`" + match[1].str() + "`"), std::string::npos) << key.path;
  }
}

TEST(Documentation, HasAMachineToBeginWith) {
  const ReadConfiguration read = read_configuration(example_of("docs/machine.md"), "/");
  EXPECT_TRUE(read.mistakes.empty());
  EXPECT_EQ(read.configuration.machine.tools->size(), 1U);
}

TEST(Documentation, NamesNoKeyThatThereIsNot) {
  static const std::regex kNamed(R"(`((?:machine\.(?!h`)|lint\.|format\.|setups\[\]\.)[A-Za-z0-9_.*\[\]]+)`)");
  std::size_t named = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() != ".md") continue;
    const std::string page = read_file(entry.path());
    for (std::sregex_iterator it(page.begin(), page.end(), kNamed); it != std::sregex_iterator(); ++it) {
      const std::string path = (*it)[1];
      const std::vector<Key>& keys = all_keys();
      EXPECT_TRUE(std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.path == path; }))
          << entry.path() << ": " << path;
      ++named;
    }
  }
  EXPECT_GT(named, 30U);
}

TEST(Documentation, OfCodesNamesTheirKeys) {
  const auto paths = [](std::string_view code) {
    std::string all;
    for (const CodeOption& option : options_of(code, Language::English))
      all += option.path + "=" + option.fallback + " ";
    return all;
  };
  EXPECT_EQ(paths("W115"), "lint.options.longestDwell=120 s ");
  EXPECT_EQ(paths("W128"), "lint.options.vectorError=0.001 ");
  EXPECT_EQ(paths("W130"), "machine.axes= ");
  EXPECT_EQ(paths("W001"), "");
}

/// A code named in one language alone would be linked to its key by half.
TEST(Documentation, OfKeysIsInBothLanguages) {
  static const std::regex kCode(R"((ISO\d{3}|W\d{3}|--[a-z-]+))");
  const auto codes_in = [](std::string_view text) {
    const std::string copy(text);
    return std::vector<std::string>(std::sregex_token_iterator(copy.begin(), copy.end(), kCode),
                                    std::sregex_token_iterator());
  };
  for (const Key& key : all_keys()) {
    EXPECT_FALSE(key.documentation.it.empty()) << key.path;
    EXPECT_NE(key.documentation.it, key.documentation.en) << key.path;
    EXPECT_EQ(key.unit.en.empty(), key.unit.it.empty()) << key.path;
    EXPECT_EQ(codes_in(key.documentation.it), codes_in(key.documentation.en)) << key.path;
  }
}

/// Expects every key that the table knows. Elements of a list exclude some of each other's keys, so each key
/// is in one of them.
void expect_all_keys(const std::vector<json>& objects, const Key* key) {
  for (const Key* each : keys_below(key)) {
    std::vector<json> values;
    for (const json& object : objects)
      if (const auto found = object.find(std::string(each->name())); found != object.end()) values.push_back(*found);
    ASSERT_FALSE(values.empty()) << each->path;
    std::vector<json> below;
    for (const json& value : values) {
      if (each->kind == KeyKind::Object) below.push_back(value);
      if (each->kind == KeyKind::Objects || each->kind == KeyKind::Named)
        below.insert(below.end(), value.begin(), value.end());
    }
    if (each->kind <= KeyKind::Named) expect_all_keys(below, each);
  }
}

TEST(Documentation, HasACompleteExample) {
  const std::string text = complete_example();
  for (const Mistake& mistake : read_configuration(text, "/").mistakes)
    ADD_FAILURE() << place_of(mistake.at, text).line << ": " << mistake.message(Language::English);
  expect_all_keys({parsed(text)}, nullptr);
}

TEST(Documentation, ExampleIsReadAsItStands) {
  // All that the example says comes back, and nothing else: no key is read into another one's place.
  const std::string text = complete_example();
  json said = parsed(text);
  said.erase("$schema");
  EXPECT_EQ(json::parse(to_json(read_configuration(text, "/").configuration)), said);
}

}  // namespace
}  // namespace isocnc::configuration
