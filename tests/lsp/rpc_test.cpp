#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "lsp/rpc/frame.h"
#include "lsp/rpc/hosted_peer.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/on_loop.h"
#include "lsp/rpc/strand.h"
#include "lsp/rpc/strand_bound.h"
#include "tests/support/random.h"

namespace isocnc::rpc {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The bodies read from a stream, with the name of the problem for a bad frame.
std::vector<std::string> read(const std::vector<std::string>& pieces, std::size_t longest = 100) {
  FrameReader reader(longest);
  std::deque<MessageFrame> frames;
  for (const std::string& piece : pieces) reader.read(piece, frames);
  std::vector<std::string> bodies;
  for (const MessageFrame& frame : frames)
    bodies.push_back(frame.error == MessageFrame::FramingError::None       ? frame.body
                     : frame.error == MessageFrame::FramingError::NoLength ? "<no length>"
                                                                           : "<too long>");
  return bodies;
}

struct FrameCase {
  std::string stream;
  std::vector<std::string> frames;
};

const FrameCase kFrameCases[] = {
    {"", {}},
    {"Content-Length: 2\r\n\r\n{}", {"{}"}},
    {"content-length:2\n\n{}", {"{}"}},
    {"Content-Type: x; charset=utf-8\r\nContent-Length:\t2 \r\n\r\n{}Content-Length: 1\r\n\r\n3", {"{}", "3"}},
    {"Content-Length: 0\r\n\r\nContent-Length: 2\r\n\r\n{}", {"", "{}"}},
    {"Content-Length: 2\r\nContent-Length: 2\r\n\r\n{}", {"{}"}},
    {"Content-Length: 5\r\n\r\n{}", {}},
    // Without a valid length, reading continues at the next header, wherever it is.
    {"X: 1\r\n\r\n{}Content-Length: 2\r\n\r\n{}", {"<no length>", "{}"}},
    {"Content-Length: -2\r\n\r\n{}{}Content-Length: 2\r\n\r\n{}", {"<no length>", "{}"}},
    {"Content-Length: 0x2\r\n\r\n{}", {"<no length>"}},
    {"Content-Length: +2\r\n\r\n{}", {"<no length>"}},
    {"Content-Length: 2a\r\n\r\n{}", {"<no length>"}},
    {"Content-Length:\r\n\r\n{}", {"<no length>"}},
    {"Content-Length: 2\r\nContent-Length: 3\r\n\r\n{}", {"<no length>"}},
    {"\r\n\r\n\r\nContent-Length: 2\r\n\r\n{}", {"<no length>", "{}"}},
    {"GET / HTTP/1.1\r\nHost: x\r\n\r\nCoCoContent-Length: 2\r\n\r\n{}", {"<no length>", "{}"}},
    {std::string(100'000, 'x') + "Content-Length: 2\r\n\r\n{}", {"<no length>", "{}"}},
    // A message longer than the maximum is skipped.
    {"Content-Length: 101\r\n\r\n" + std::string(101, 'x') + "Content-Length: 2\r\n\r\n{}", {"<too long>", "{}"}},
    {"Content-Length: 99999999999999999999999999\r\n\r\n{}", {"<too long>"}},
};

TEST(FrameReader, CutsAStreamIntoMessages) {
  for (const FrameCase& each : kFrameCases) EXPECT_EQ(read({each.stream}), each.frames) << each.stream;
}

TEST(FrameReader, DoesNotCareHowTheStreamIsCut) {
  for (const FrameCase& each : kFrameCases) {
    std::vector<std::string> bytes;
    for (const char c : each.stream) bytes.emplace_back(1, c);
    EXPECT_EQ(read(bytes), each.frames) << each.stream;
  }
}

/// A message with a long text, given in its JSON form.
std::string message_with(const std::string& written) { return R"({"a":[1,")" + written + R"(",{"b":"short"}]})"; }

TEST(ParsedMessage, ReadsLongStringsAsJsonDoes) {
  support::Random random(1);
  for (int i = 0; i < 200; ++i) {
    std::string written;
    while (written.size() < ParsedMessage::kLong)
      written += random.any_of({"G01 X1", "\\n", "\\r\\n", "\\\\", "\\\"", "\\/", "\\t", "\\b\\f", "\\u00e0",
                                "\xC3\xA0", "\\ud83d\\ude00", "\xF0\x9F\x98\x80", "\\u0000", "\\u20AC"});
    const std::string message = message_with(written);
    const Json expected = Json::parse(message);
    const ParsedMessage parsed = ParsedMessage::parse(message);
    ASSERT_FALSE(parsed.json.is_discarded());
    EXPECT_LT(parsed.json.dump().size(), 100u);
    EXPECT_EQ(parsed.text(parsed.json["a"][1]), expected["a"][1].get<std::string>());
    EXPECT_EQ(parsed.text(parsed.json["a"][2]["b"]), "short");
  }
}

TEST(ParsedMessage, HalfACharacterIsReplacedInALongString) {
  const std::string padding(ParsedMessage::kLong, 'x');
  const std::pair<std::string, std::string> kCases[] = {
      {"\\ud800", "\xEF\xBF\xBD"},
      {"\\udc00\\ud800", "\xEF\xBF\xBD\xEF\xBF\xBD"},
      {"\\ud800\\u0041", "\xEF\xBF\xBD\x41"},
      {"\\u12", "\xEF\xBF\xBD\x31\x32"},
  };
  for (const auto& [written, text] : kCases) {
    const ParsedMessage parsed = ParsedMessage::parse(message_with(padding + written));
    EXPECT_EQ(parsed.text(parsed.json["a"][1]), padding + text) << written;
  }
}

/// Also at the borders of whole characters, and after backslashes that start no escape of a unit.
TEST(ParsedMessage, HalfACharacterIsReplacedInAShortString) {
  const std::pair<std::string, std::string> kCases[] = {
      {"\\ud83d", "\xEF\xBF\xBD"},
      {"x\\uDE00", "x\xEF\xBF\xBD"},
      {"\\ude00\\ud83d", "\xEF\xBF\xBD\xEF\xBF\xBD"},
      {"\\ud83d\\ud83d\\ude00", "\xEF\xBF\xBD\xF0\x9F\x98\x80"},
      {"\\ud83d\\ude00\\ude00", "\xF0\x9F\x98\x80\xEF\xBF\xBD"},
      {"\\ud83d\\u00e0", "\xEF\xBF\xBD\xC3\xA0"},
      {"\\ud83d\\n", "\xEF\xBF\xBD\n"},
      {"\\\\ud83d\\ud83d", "\\ud83d\xEF\xBF\xBD"},
  };
  for (const auto& [written, text] : kCases) {
    const ParsedMessage parsed = ParsedMessage::parse(message_with(written));
    ASSERT_FALSE(parsed.json.is_discarded()) << written;
    EXPECT_EQ(parsed.text(parsed.json["a"][1]), text) << written;
  }
  for (const std::string written : {"\\ud83", "\\ud83x", "\\ud83d\\u", "\\ud83d\\x"})
    EXPECT_TRUE(ParsedMessage::parse(message_with(written)).json.is_discarded()) << written;
}

TEST(ParsedMessage, WhatIsNoJsonIsNoneHoweverLong) {
  const std::string padding(ParsedMessage::kLong, 'x');
  for (const std::string& text : {"\"" + padding, padding, "{\"a\":\"" + padding + "\"", "[\"" + padding + "\"]]"})
    EXPECT_TRUE(ParsedMessage::parse(text).json.is_discarded());
}

std::string nested(std::size_t depth, const std::string& innermost = "1") {
  return std::string(depth, '[') + innermost + std::string(depth, ']');
}

TEST(ParsedMessage, WhatNestsTooDeeplyIsNoneHoweverLong) {
  const std::string padding(ParsedMessage::kLong, ' ');
  for (const std::string& space : {std::string(), padding}) {
    EXPECT_FALSE(ParsedMessage::parse(space + nested(kDeepestMessage)).json.is_discarded());
    EXPECT_TRUE(ParsedMessage::parse(space + nested(kDeepestMessage + 1)).json.is_discarded());
    EXPECT_TRUE(ParsedMessage::parse(space + nested(1'000'000)).json.is_discarded());
    // Any number of brackets is allowed side by side, or within strings.
    std::string many = "[";
    for (std::size_t i = 0; i < kDeepestMessage; ++i) many += nested(2, R"("[{\"[{\\")") + ",";
    EXPECT_FALSE(ParsedMessage::parse(space + many + "1]").json.is_discarded());
  }
}

TEST(Strand, DoesItsTasksInTheirOrderBesideOthers) {
  Loop loop;
  Pool pool(loop, 4);
  constexpr int kStrands = 8;
  constexpr int kTasks = 500;
  std::vector<std::vector<int>> done(kStrands);
  std::mutex mutex;
  std::condition_variable changed;
  int left = kStrands;
  std::vector<Strand> strands;
  for (int i = 0; i < kStrands; ++i) strands.emplace_back(pool);
  for (int task = 0; task < kTasks; ++task)
    for (std::size_t i = 0; i < kStrands; ++i)
      strands[i].post([&, task, i] {
        done[i].push_back(task);
        if (task + 1 < kTasks) return;
        const std::lock_guard lock(mutex);
        --left;
        changed.notify_all();
      });
  std::unique_lock lock(mutex);
  changed.wait(lock, [&] { return left == 0; });
  for (const std::vector<int>& each : done) {
    EXPECT_EQ(each.size(), static_cast<std::size_t>(kTasks));
    EXPECT_TRUE(std::is_sorted(each.begin(), each.end()));
  }
}

/// A task that never runs may own the strand itself.
TEST(Strand, IsDestroyedWithAPoolThatHasNotRunIt) {
  struct Owner {
    explicit Owner(Pool& pool) : strand(pool) {}
    Strand strand;
  };
  std::optional<Loop> loop(std::in_place);
  std::optional<Pool> pool(std::in_place, *loop, 0);  // Its tasks are the loop's, which does not run.
  auto owner = std::make_shared<Owner>(*pool);
  const std::weak_ptr<Owner> watched = owner;
  for (int i = 0; i < 2; ++i) owner->strand.post([owner] {});
  owner.reset();
  EXPECT_FALSE(watched.expired());
  pool.reset();
  loop.reset();
  EXPECT_TRUE(watched.expired());
}

TEST(StrandBound, GoesOnWithALongTaskAfterTheOthers) {
  Loop loop;
  Pool pool(loop, 0);
  StrandBound<std::string> log(pool);
  std::string result;
  log.post_in_parts([&, part = 0](std::string& bound, const OthersWait& others_wait) mutable {
    bound += std::to_string(++part) + (others_wait() ? " others wait, " : " ");
    result = bound;
    return part == 3;
  });
  log.post([](std::string& bound) { bound += "other, "; });
  loop.run_due(std::chrono::steady_clock::time_point::max());
  EXPECT_EQ(result, "1 others wait, other, 2 3 ");
}

TEST(Pool, WithoutThreadsRunsItsTasksOnTheLoop) {
  Loop loop;
  Pool pool(loop, 0);
  StrandBound<std::vector<int>> numbers(pool);
  std::vector<int> result;
  for (int i = 0; i < 3; ++i) numbers.post([i](std::vector<int>& bound) { bound.push_back(i); });
  loop.post([&] { numbers.post([&](const std::vector<int>& bound) { result = bound; }); });
  EXPECT_TRUE(result.empty());
  EXPECT_EQ(loop.run_due(std::chrono::steady_clock::time_point::max()), std::nullopt);
  EXPECT_EQ(result, (std::vector{0, 1, 2}));
}

TEST(Loop, RunsWhatIsDueUntilItsTimeIsOver) {
  using Clock = std::chrono::steady_clock;
  Loop loop;
  int done = 0;
  for (int i = 0; i < 3; ++i) loop.post([&] { ++done; });
  const Clock::time_point later = Clock::now() + std::chrono::hours(1);
  loop.post_at(later, [&] { ++done; });
  EXPECT_LT(loop.run_due(Clock::time_point::min()), later);  // One task each time.
  EXPECT_EQ(done, 1);
  EXPECT_EQ(loop.run_due(Clock::time_point::max()), later);
  EXPECT_EQ(done, 3);
  loop.post([&] { loop.stop(); });
  loop.post([&] { ++done; });
  EXPECT_EQ(loop.run_due(Clock::time_point::max()), std::nullopt);
  EXPECT_EQ(done, 3);
}

/// Sends back what it receives, and ends at `exit`.
class Echo final : public Peer {
 public:
  Echo(Loop& loop, Send send) : loop_(loop), send_(std::move(send)) {}

  void receive(MessageFrame frame) override {
    if (frame.body == "exit") return loop_.stop();
    if (frame.body == "later") loop_.post_at(std::chrono::steady_clock::now() + std::chrono::hours(1), [] {});
    send_(std::move(frame.body));
  }
  void end() override {}
  int exit_status() const override { return 7; }

 private:
  Loop& loop_;
  const Send send_;
};

TEST(HostedPeer, WorksWhenItsHostLetsIt) {
  std::vector<std::string> sent;
  HostedPeer peer([](Loop& loop, Send send) { return std::make_unique<Echo>(loop, std::move(send)); },
                  [&](std::string body) { sent.push_back(std::move(body)); });
  constexpr std::chrono::milliseconds kLong = std::chrono::minutes(1);
  EXPECT_EQ(peer.work(kLong), std::nullopt);
  peer.receive("one");
  peer.receive("two");
  EXPECT_THAT(sent, testing::IsEmpty());
  EXPECT_EQ(peer.work(std::chrono::milliseconds(0)), std::chrono::milliseconds(0));  // One task, and more to do.
  EXPECT_THAT(sent, testing::ElementsAre("one"));
  peer.receive("later");
  EXPECT_GT(peer.work(kLong), std::chrono::minutes(59));
  EXPECT_THAT(sent, testing::ElementsAre("one", "two", "later"));
  EXPECT_FALSE(peer.is_done());
  peer.receive("exit");
  EXPECT_EQ(peer.work(kLong), std::nullopt);
  EXPECT_TRUE(peer.is_done());
  EXPECT_EQ(peer.exit_status(), 7);
}

TEST(OnLoop, RunsOnTheThreadOfTheLoop) {
  Loop loop;
  std::string received;
  std::thread::id thread;
  const OnLoop<std::string> take(loop, [&](std::string text) {
    received = std::move(text);
    thread = std::this_thread::get_id();
    loop.stop();
  });
  std::thread worker([&] { take("result"); });
  loop.run(std::chrono::minutes(1), [&] { loop.stop(); });
  worker.join();
  EXPECT_EQ(received, "result");
  EXPECT_EQ(thread, std::this_thread::get_id());
}

TEST(StrandBound, KeepsItsValueForTheTasksThatWait) {
  Loop loop;
  Pool pool(loop, 1);
  std::promise<void> start;
  std::promise<int> result;
  {
    StrandBound<int> value(pool, 40);
    value.post([started = start.get_future().share()](int& bound) {
      started.wait();
      ++bound;
    });
    value.post([&](int& bound) { result.set_value(bound + 1); });
  }
  start.set_value();
  EXPECT_EQ(result.get_future().get(), 42);
}

TEST(Pool, EndsWhileTasksWait) {
  std::atomic<int> done = 0;
  {
    Loop loop;
    Pool pool(loop, 1);
    for (int i = 0; i < 100; ++i) pool.post([&] { ++done; });
  }
  EXPECT_LE(done, 100);
}

/// A task that is posted while the pool is ending does not start.
TEST(Pool, EndsWhileTasksPostOthers) {
  for (int round = 0; round < 200; ++round) {
    Loop loop;
    Pool pool(loop, 32);
    for (int i = 0; i < 8; ++i)
      pool.post([&] {
        for (int j = 0; j < 16; ++j) pool.post([] {});
      });
  }
}

TEST(Strand, MayBePostedToWhileItsPoolEnds) {
  for (int round = 0; round < 200; ++round) {
    Loop loop;
    std::optional<Pool> pool(std::in_place, loop, 4);
    const auto strand = std::make_shared<Strand>(*pool);
    const std::weak_ptr<Strand> watched = strand;
    for (int i = 0; i < 4; ++i)
      pool->post([strand] {
        for (int j = 0; j < 16; ++j) strand->post([strand] {});
      });
    pool.reset();
    EXPECT_EQ(watched.use_count(), 1) << "round " << round;
  }
}

}  // namespace
}  // namespace isocnc::rpc
