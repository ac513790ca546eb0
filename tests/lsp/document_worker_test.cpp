#include "lsp/document_worker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "lsp/documents/settings_store.h"
#include "lsp/feature_list.h"

/// An edit by which so many lines are to be checked again that other work need not wait for them.
namespace isocnc::lsp {
namespace {

using rpc::Json;

constexpr const char* kEditedUri = "untitled:part.iso";

std::string zigzag(int lines) {
  std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\n";
  for (int i = 2; i + 1 < lines; ++i) text += "G1 X" + std::to_string(i % 100) + " Y" + std::to_string(i % 70) + "\n";
  return text + "M02\n";
}

/// A worker of one document whose other work always waits.
class LongProgram : public testing::Test {
 protected:
  static constexpr int kLines = 20'000;

  LongProgram()
      : pool_(loop_, 0),
        worker_(pool_, settings_, kEditedUri,
                {.notify = [this](std::string_view method, const std::string& params) { take(method, params); },
                 .configuration = {loop_, [](const std::string&, const std::string&) {}},
                 .progress = {loop_, [](const std::string&, const std::optional<std::string>&) {}},
                 .request = {loop_, [](const std::string&) {}}},
                signals_) {
    change("didOpen", {{"textDocument", {{"uri", kEditedUri}, {"version", 1}, {"text", zigzag(kLines)}}}});
    EXPECT_GT(report(), 3);
    EXPECT_EQ(published_.size(), 1u) << "nothing is known before the first check has ended";
    published_.clear();
  }

  /// Types a line above another one.
  void type(int line, const std::string& text) {
    const Json at = {{"line", line}, {"character", 0}};
    change("didChange", {{"textDocument", {{"uri", kEditedUri}, {"version", ++version_}}},
                         {"contentChanges", Json::array({{{"range", {{"start", at}, {"end", at}}}, {"text", text}}})}});
  }

  void change(const std::string& what, const Json& params) {
    const rpc::Message message =
        rpc::read_message(Json{{"jsonrpc", "2.0"}, {"method", "textDocument/" + what}, {"params", params}}.dump());
    ++signals_->edits_waiting;
    const auto& call = std::get<rpc::Call>(message);
    what == "didOpen" ? worker_.open(call, client_) : worker_.edit(call, client_);
  }

  /// False if the rest is put off.
  bool report_part(std::uint64_t change) { return worker_.report_change(change, client_, others_wait_); }
  /// Reports the change, in as many parts as it takes.
  int report() {
    int parts = 1;
    while (!report_part(worker_.change_count())) ++parts;
    return parts;
  }

  /// Asks once. Null if the answer is put off.
  Json ask(const std::string& method, const Json& more = Json::object()) {
    Json params = {{"textDocument", {{"uri", kEditedUri}}}};
    params.update(more);
    Json answer;
    const background::WorkerRequest request{
        std::make_shared<std::atomic<bool>>(false),
        rpc::OnWorker<std::string>([&](const std::string& result) { answer = Json::parse(result); }),
        rpc::OnWorker<rpc::Error>([&](const rpc::Error& error) { answer = static_cast<int>(error.code()); })};
    const bool is_answered =
        worker_.answer(method_named(method), Json::parse(params.dump()), client_, request, {asked_, others_wait_});
    EXPECT_EQ(is_answered, !answer.is_null());
    return answer;
  }
  void remember_when_asked() { asked_ = worker_.revision(); }
  std::uint64_t change_count() const { return worker_.change_count(); }

  /// The lines of the findings in the last diagnostics, as they were published.
  std::vector<int> lines_found() const {
    std::vector<int> lines;
    for (const Json& each : published_.back()["diagnostics"]) lines.push_back(each["range"]["start"]["line"]);
    return lines;
  }

  /// The texts of its first findings.
  std::string messages() const {
    std::string texts;
    for (std::size_t i = 0; i < 3; ++i)
      texts += published_.back()["diagnostics"][i]["message"].get<std::string>() + "\n";
    return texts;
  }

  std::vector<Json> published_;

 private:
  void take(std::string_view method, const std::string& params) {
    if (method == "textDocument/publishDiagnostics") published_.push_back(Json::parse(params));
  }
  static const features::Method& method_named(const std::string& name) {
    for (const features::Feature* const feature : all_features())
      for (const features::Method& method : feature->methods)
        if (method.name == name) return method;
    throw std::invalid_argument(name);
  }

  rpc::Loop loop_;
  rpc::Pool pool_;
  documents::SettingsStore settings_;
  const std::shared_ptr<DocumentSignals> signals_ = std::make_shared<DocumentSignals>();
  const protocol::Client client_;
  const rpc::OthersWait others_wait_ = [] { return true; };
  DocumentWorker worker_;
  int version_ = 1;
  std::uint64_t asked_ = 0;
};

TEST_F(LongProgram, ReportsFirstWhatIsKnown) {
  type(500, "G93\nG9\n");
  EXPECT_GT(report(), 3);
  ASSERT_EQ(published_.size(), 2u);
  EXPECT_EQ(published_[0]["version"], 2);
  EXPECT_EQ(published_[1]["version"], 2);
  const std::string all = messages();
  published_.pop_back();
  const std::vector<int> first = lines_found();
  ASSERT_GT(first.size(), 2u);
  EXPECT_EQ(first[0], 501);
  EXPECT_LT(first.back(), 4'000);
  EXPECT_THAT(messages(), testing::HasSubstr("(and 1931 more lines, to line 2434)"));
  EXPECT_THAT(all, testing::HasSubstr("(and 19498 more lines, to line 20001)"));
}

TEST_F(LongProgram, ReportsOnceWhatIsCheckedInAMoment) {
  type(500, "G9\nG1 X0 Y0\n");
  EXPECT_EQ(report(), 1);
  EXPECT_EQ(published_.size(), 1u);
}

TEST_F(LongProgram, AnswersWhatIsAskedAboutALineBeforeAllIsChecked) {
  type(500, "G91\n");
  remember_when_asked();
  const Json completed =
      ask("textDocument/completion", {{"position", {{"line", 501}, {"character", 0}}}, {"context", Json::object()}});
  EXPECT_TRUE(completed.is_object()) << completed;
  EXPECT_TRUE(ask("textDocument/documentSymbol").is_array());
  EXPECT_TRUE(ask("textDocument/diagnostic").is_null());
  int put_off = 1;
  Json pulled;
  while ((pulled = ask("textDocument/diagnostic")).is_null()) ++put_off;
  EXPECT_GT(put_off, 3);
  EXPECT_TRUE(pulled.is_object());
}

/// The client has typed on meanwhile.
TEST_F(LongProgram, RefusesWhatWasPutOffBeforeAnotherEdit) {
  type(500, "G91\n");
  remember_when_asked();
  EXPECT_TRUE(ask("textDocument/diagnostic").is_null());
  type(600, "X1\n");
  EXPECT_EQ(ask("textDocument/diagnostic"), static_cast<int>(rpc::ErrorCode::ContentModified));
}

TEST_F(LongProgram, ReportsTheLastOfTwoEditsOnce) {
  type(500, "G93\n");
  const std::uint64_t first = change_count();
  EXPECT_FALSE(report_part(first));
  type(600, "G9\n");
  EXPECT_TRUE(report_part(first)) << "the other one will be reported";
  EXPECT_EQ(published_.size(), 1u);
  report();
  EXPECT_EQ(published_.back()["version"], 3);
}

/// Of lines that have been changed and not yet checked nothing is known.
TEST_F(LongProgram, ReportsNothingBeforeAllChangedLinesAreChecked) {
  type(9'000, "G1 X1 X2\n");
  report();
  published_.clear();
  const auto insert = [](int line, const std::string& text) {
    const Json at = {{"line", line}, {"character", 0}};
    return Json{{"range", {{"start", at}, {"end", at}}}, {"text", text}};
  };
  change("didChange", {{"textDocument", {{"uri", kEditedUri}, {"version", 7}}},
                       {"contentChanges", {insert(9'001, "(near it)\n"), insert(500, "G91\n")}}});
  report();
  ASSERT_EQ(published_.size(), 1u);
  EXPECT_EQ(lines_found().front(), 9'001);
}

}  // namespace
}  // namespace isocnc::lsp
