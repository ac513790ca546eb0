#include <cstdint>
#include <string>

#include "analyzer/check/analysis.h"
#include "analyzer/check/check_text.h"
#include "require.h"
#include "tests/support/report_text.h"

namespace isocnc::fuzz {

using syntax::Document;
using syntax::Position;

/// Takes what it needs from the front of the input.
class Input {
 public:
  explicit Input(std::string_view bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }
  std::size_t number() {
    if (bytes_.empty()) return 0;
    const auto value = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return value;
  }
  std::string_view text(std::size_t size) {
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(taken.size());
    return taken;
  }

 private:
  std::string_view bytes_;
};

/// An edit is five bytes of places, one of length, and its text.
static void edit_once(Input& input, Document& document) {
  const std::size_t line = input.number() * 256 + input.number();
  const Position begin{line % (document.line_count() + 1), input.number() % 64};
  const Position end{begin.line + input.number() % 8, input.number() % 64};
  document.replace(begin, end, input.text(input.number() % 48));
}

/// One text in four is repeated until there are lines that an edit far away does not concern.
static std::string first_text(Input& input) {
  constexpr std::size_t kLong = 8 * 1024;
  const bool is_repeated = input.number() % 4 == 0;
  const std::string_view once = input.text(2 * input.number());
  std::string text(once);
  while (is_repeated && !once.empty() && text.size() < kLong) text.append("\n").append(once);
  return text;
}

static void check_document(std::string_view bytes) {
  Input input(bytes);
  const rules::CheckSetup setup;
  Document document(first_text(input));
  check::Analysis analysis(document, setup);
  while (!input.empty()) {
    edit_once(input, document);
    analysis.update();
  }
  const std::string text = document.text();
  require(support::text_of(document) == support::text_of(Document(text)), "an edited document equals a fresh one");
  const auto report = support::texts_of(analysis.report());
  require(report == support::texts_of(check::Analysis(document, setup).report()),
          "an edited analysis equals a fresh one");
  require(report == support::texts_of(check::check_text(text, setup)), "an analysis equals a check of the text");
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::check_document(isocnc::fuzz::as_text(data, size));
  return 0;
}
