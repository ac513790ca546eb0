#include "analyzer/input/program_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

/// What a watch checks, and when: without files and without waiting.
namespace isocnc::input {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

ProgramStamp written(std::uint64_t size, std::int64_t changed = 1) {
  ProgramStamp stamp;
  stamp.program = {.identity = {1, 2, 3}, .size = size, .changed = changed};
  return stamp;
}

/// Times count from the start of the watch.
class Changes : public testing::Test {
 protected:
  ProgramChanges::Settled at(std::chrono::milliseconds time, const ProgramChanges::Stamps& programs) {
    changes_.see(programs, ProgramChanges::Time(time));
    return changes_.take(ProgramChanges::Time(time));
  }
  /// The programs that are to be checked then.
  std::vector<std::string> checked_at(std::chrono::milliseconds time, const ProgramChanges::Stamps& programs) {
    const ProgramChanges::Settled settled = at(time, programs);
    EXPECT_THAT(settled.removed, IsEmpty());
    return {settled.to_check.begin(), settled.to_check.end()};
  }

  ProgramChanges changes_;
};

TEST_F(Changes, AreCheckedOnceTheyAreStill) {
  EXPECT_THAT(checked_at(0ms, {{"a", written(10)}, {"b", written(20)}}), IsEmpty());
  EXPECT_TRUE(changes_.is_unsettled());
  EXPECT_THAT(checked_at(299ms, {{"a", written(10)}, {"b", written(21)}}), IsEmpty());
  EXPECT_THAT(checked_at(300ms, {{"a", written(10)}, {"b", written(21)}}), ElementsAre("a"));
  EXPECT_THAT(checked_at(599ms, {{"a", written(10)}, {"b", written(21)}}), ElementsAre("b"));
  EXPECT_FALSE(changes_.is_unsettled());
  EXPECT_THAT(checked_at(5s, {{"a", written(10)}, {"b", written(21)}}), IsEmpty());
}

/// A program that is written in pieces for minutes, with the time of the file as the only sign at the end.
TEST_F(Changes, OfAGrowingFileAreNotSeen) {
  for (int i = 0; i < 500; ++i)
    EXPECT_THAT(checked_at(i * 250ms, {{"a", written(static_cast<std::uint64_t>(i))}}), IsEmpty());
  EXPECT_THAT(checked_at(125s, {{"a", written(499, 2)}}), IsEmpty());
  EXPECT_THAT(checked_at(125'300ms, {{"a", written(499, 2)}}), ElementsAre("a"));
}

TEST_F(Changes, AreSeenByAnyPartOfTheStamp) {
  ProgramStamp stamp = written(10);
  at(0s, {{"a", stamp}});
  at(1s, {{"a", stamp}});
  std::vector<ProgramStamp> others(7, stamp);
  others[0].program.size = 11;
  others[1].program.changed = 0;      // An older file, taken out of an archive.
  others[2].program.identity[1] = 9;  // Written beside it, and renamed.
  others[3].program.mode = 0600;
  others[4].configuration = "isocnc.json";
  others[5].configuration_content = FileStamp{};
  others[6].baseline = FileStamp{};
  for (std::size_t i = 0; i < others.size(); ++i) {
    const std::chrono::seconds time(2 * (i + 1));
    EXPECT_THAT(checked_at(time, {{"a", others[i]}}), IsEmpty()) << i;
    EXPECT_THAT(checked_at(time + 1s, {{"a", others[i]}}), ElementsAre("a")) << i;
  }
}

/// A change that is taken back, such as a file that is touched with its old time, is none.
TEST_F(Changes, AreNoneIfTheOldStateComesBack) {
  at(0s, {{"a", written(10)}});
  at(1s, {{"a", written(10)}});
  EXPECT_THAT(checked_at(2s, {{"a", written(11)}}), IsEmpty());
  EXPECT_THAT(checked_at(3s, {{"a", written(10)}}), IsEmpty());
  EXPECT_THAT(checked_at(4s, {{"a", written(10)}}), IsEmpty());
  EXPECT_FALSE(changes_.is_unsettled());
}

TEST_F(Changes, AreRemovalsAndNewNames) {
  at(0s, {{"a", written(10)}});
  at(1s, {{"a", written(10)}});
  EXPECT_THAT(at(2s, {{"b", written(10)}}).removed, IsEmpty());
  const ProgramChanges::Settled settled = at(3s, {{"b", written(10)}});
  EXPECT_THAT(settled.to_check, ElementsAre("b"));
  EXPECT_THAT(settled.removed, ElementsAre("a"));
  EXPECT_THAT(at(4s, {{"b", written(10)}}).removed, IsEmpty());
  EXPECT_THAT(checked_at(5s, {{"a", written(10)}, {"b", written(10)}}), IsEmpty());
  EXPECT_THAT(checked_at(6s, {{"a", written(10)}, {"b", written(10)}}), ElementsAre("a"));
}

/// Some programs remove the old file before they rename the new one.
TEST_F(Changes, OfAReplacedFileAreNoRemoval) {
  at(0s, {{"a", written(10)}});
  at(1s, {{"a", written(10)}});
  EXPECT_THAT(checked_at(2s, {}), IsEmpty());
  EXPECT_THAT(checked_at(2'200ms, {{"a", written(11)}}), IsEmpty());
  EXPECT_THAT(checked_at(2'500ms, {{"a", written(11)}}), ElementsAre("a"));
}

TEST_F(Changes, OfFilesThatExistForAMomentAreNone) {
  EXPECT_THAT(checked_at(0ms, {{"a.tmp.iso", written(10)}}), IsEmpty());
  EXPECT_THAT(checked_at(100ms, {}), IsEmpty());
  EXPECT_THAT(checked_at(10s, {}), IsEmpty());
  EXPECT_FALSE(changes_.is_unsettled());
}

TEST_F(Changes, AreTriedAgainOnRequest) {
  at(0s, {{"a", written(10)}});
  EXPECT_THAT(checked_at(1s, {{"a", written(10)}}), ElementsAre("a"));
  changes_.repeat("a", ProgramChanges::Time(1s));
  changes_.repeat("unknown", ProgramChanges::Time(1s));
  EXPECT_TRUE(changes_.is_unsettled());
  EXPECT_THAT(checked_at(1'299ms, {{"a", written(10)}}), IsEmpty());
  EXPECT_THAT(checked_at(1'300ms, {{"a", written(10)}}), ElementsAre("a"));
  changes_.repeat("a", ProgramChanges::Time(2s));
  EXPECT_THAT(at(3s, {}).removed, IsEmpty());
  EXPECT_THAT(at(4s, {}).removed, ElementsAre("a"));
}

TEST(Stamp, IsOfRegularFilesOnly) {
  const support::TemporaryFolder folder;
  folder.write("a.iso", "M02\n");
  const fs::path file = fs::path(folder.path()) / "a.iso";
  const auto before = stamp_of(file);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->size, 4u);
  EXPECT_EQ(stamp_of(file), before);
  folder.write("b.iso", "M02\n");
  fs::rename(fs::path(folder.path()) / "b.iso", file);
  EXPECT_NE(stamp_of(file), before);
  EXPECT_FALSE(stamp_of(folder.path()));
  EXPECT_FALSE(stamp_of(fs::path(folder.path()) / "gone.iso"));
  EXPECT_FALSE(stamp_of(""));
  ASSERT_EQ(::mkfifo((fs::path(folder.path()) / "pipe.iso").c_str(), 0600), 0);
  EXPECT_FALSE(stamp_of(fs::path(folder.path()) / "pipe.iso"));
}

TEST(Rest, IsLongerWhereAPassTakesLonger) {
  EXPECT_EQ(rest_after(1us, false), 500ms);
  EXPECT_EQ(rest_after(20ms, false), 500ms);
  EXPECT_EQ(rest_after(100ms, false), 1'900ms);
  EXPECT_EQ(rest_after(1us, true), 300ms);
  EXPECT_EQ(rest_after(1s, true), 2s);
}

}  // namespace
}  // namespace isocnc::input
