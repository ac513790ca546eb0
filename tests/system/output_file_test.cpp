#include "interpreter/system/output_file.h"
#include "tests/support/in_child.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace isocnc::system {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test.
class OutputFiles : public testing::Test {
 protected:
  std::ptrdiff_t files_in_folder() const {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  }
  void put(std::string_view text) const { std::ofstream(path) << text; }

  const support::TemporaryFolder own;
  const fs::path folder = own.path();
  const fs::path path = folder / "report";
};

int write_whole(const fs::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  return file.commit();
}

TEST_F(OutputFiles, HoldAllThatWasWritten) {
  put("what was there before");
  std::string expected;
  {
    OutputFile file(path);
    for (int i = 0; i < 50'000; ++i) {
      file.write("line\n");
      expected += "line\n";
    }
    EXPECT_EQ(text_of_file(path), "what was there before");
    EXPECT_EQ(file.commit(), 0);
  }
  EXPECT_TRUE(text_of_file(path) == expected);
  EXPECT_EQ(files_in_folder(), 1);
}

TEST_F(OutputFiles, ThatAreNotCommittedLeaveNothing) {
  {
    OutputFile file(path);
    file.write(std::string(200'000, 'x'));
    EXPECT_EQ(file.flush(), 0);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_EQ(files_in_folder(), 1);
  }
  EXPECT_EQ(files_in_folder(), 0);
}

TEST_F(OutputFiles, KeepTheModeOfTheFileAndElseFollowTheUmask) {
  const mode_t before = ::umask(0027);
  EXPECT_EQ(write_whole(path, "new\n"), 0);
  EXPECT_EQ(fs::status(path).permissions(), fs::perms(0640));
  fs::permissions(path, fs::perms(0606));
  EXPECT_EQ(write_whole(path, "newer\n"), 0);
  EXPECT_EQ(fs::status(path).permissions(), fs::perms(0606));
  ::umask(before);
}

TEST_F(OutputFiles, GoThroughSymlinks) {
  put("old\n");
  fs::create_directory(folder / "links");
  fs::create_symlink("../report", folder / "links" / "there");
  fs::create_symlink("../made", folder / "links" / "nowhere");
  EXPECT_EQ(write_whole(folder / "links" / "there", "new\n"), 0);
  EXPECT_EQ(write_whole(folder / "links" / "nowhere", "made\n"), 0);
  EXPECT_EQ(text_of_file(path), "new\n");
  EXPECT_EQ(text_of_file(folder / "made"), "made\n");
  EXPECT_TRUE(fs::is_symlink(folder / "links" / "there") && fs::is_symlink(folder / "links" / "nowhere"));
}

/// `--output /dev/stdout >> log`: the log stays the file that the shell has opened.
TEST_F(OutputFiles, ThatAreOpenAlreadyAreWrittenInPlace) {
  put("before\n");
  const int log = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  ASSERT_GE(log, 0);
  EXPECT_EQ(write_whole("/dev/fd/" + std::to_string(log), "findings\n"), 0);
  EXPECT_EQ(::write(log, "more\n", 5), 5);
  ::close(log);
  EXPECT_EQ(text_of_file(path), "before\nfindings\nmore\n");
}

TEST_F(OutputFiles, OfAWriteProtectedFileAreRefused) {
  put("old\n");
  fs::permissions(folder, fs::perms::all);
  fs::permissions(path, fs::perms(0444));
  EXPECT_EQ(support::in_child([&] { return write_whole(path, "new\n") == EACCES; }), 0);
  EXPECT_EQ(text_of_file(path), "old\n");
}

TEST_F(OutputFiles, InTheSameFolderDoNotMeet) {
  OutputFile one(path);
  OutputFile other(path);
  one.write("one\n");
  other.write("other\n");
  EXPECT_EQ(one.commit(), 0);
  EXPECT_EQ(text_of_file(path), "one\n");
  EXPECT_EQ(other.commit(), 0);
  EXPECT_EQ(text_of_file(path), "other\n");
}

TEST_F(OutputFiles, KeepTheFirstError) {
  OutputFile full("/dev/full");
  full.write(std::string(1'000'000, 'x'));
  EXPECT_EQ(full.error(), ENOSPC);
  errno = EIO;
  full.write("more");
  EXPECT_EQ(full.flush(), ENOSPC);
}

TEST_F(OutputFiles, ThatCannotBeMadeHaveAnError) {
  OutputFile file("/no/such/folder/trace");
  EXPECT_EQ(file.error(), ENOENT);
  file.write("lost");
  EXPECT_EQ(file.flush(), ENOENT);
}

}  // namespace
}  // namespace isocnc::system
