#include <cstdint>
#include <string>

#include "interpreter/system/source_file.h"
#include "lsp/documents/analyzed_document.h"
#include "require.h"
#include "tests/support/report_text.h"

namespace isocnc::fuzz {

using documents::AnalyzedDocument;
using documents::ContentChange;
using documents::SettingsStore;
using protocol::ClientPosition;
using protocol::Encoding;

static constexpr const char* kUri = "untitled:part";

/// Takes what it needs from the front of the input.
class Input {
 public:
  explicit Input(std::string_view bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }
  std::uint32_t number() {
    if (bytes_.empty()) return 0;
    const auto value = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return value;
  }
  std::string text(std::size_t size) {
    const std::string taken(bytes_.substr(0, size));
    bytes_.remove_prefix(taken.size());
    return taken;
  }
  /// A place that need not be in the document.
  ClientPosition place() {
    const std::uint32_t line = number() % 32;
    return {line, number() % 64};
  }

 private:
  std::string_view bytes_;
};

/// The whole text, with the byte-order mark that the document keeps apart: another may follow it.
static std::string text_of(const AnalyzedDocument& document) {
  const bool has_mark = document.to_client({0, 0}, Encoding::Utf8).character > 0;
  return std::string(has_mark ? system::kByteOrderMark : "") + document.document().text();
}

/// What the document says, and what one says that has been opened with its text.
static void compare(AnalyzedDocument& edited, SettingsStore& settings) {
  AnalyzedDocument fresh(kUri, settings);
  fresh.open(1, text_of(edited));
  fresh.update();
  edited.update();
  require(support::texts_of(edited.report()) == support::texts_of(fresh.report()), "edited equals opened afresh");
}

static void edit(std::string_view bytes) {
  Input input(bytes);
  SettingsStore settings;
  const auto encoding = static_cast<Encoding>(input.number() % 3);
  AnalyzedDocument document(kUri, settings);
  document.open(1, input.text(2 * std::size_t{input.number()}));
  for (int version = 2; !input.empty(); ++version) {
    ContentChange change{.range = protocol::ClientRange{input.place(), input.place()},
                         .text = input.text(input.number() % 48)};
    document.edit(version, {change}, encoding);
    if (version % 4 == 0) document.update();
  }
  compare(document, settings);
  for (std::uint32_t line = 0; line < 8; ++line)
    for (std::uint32_t column = 0; column < 32; ++column) {
      const auto place = document.from_client({line, column}, encoding);
      require(document.from_client(document.to_client(place, encoding), encoding) == place, "places come back");
    }
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::edit(isocnc::fuzz::as_text(data, size));
  return 0;
}
