#include "interpreter/system/replace_file.h"
#include "interpreter/system/temporary_file.h"
#include "tests/support/in_child.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace isocnc::system {
namespace {

namespace fs = std::filesystem;
using dialect::Language;
using support::in_child;
using testing::HasSubstr;
using testing::Optional;

/// A folder with one program in it.
class FileReplacements : public testing::Test {
 protected:
  FileReplacements() { std::ofstream(file) << "old\n"; }
  ~FileReplacements() override {
    std::error_code ignored;
    fs::permissions(folder, fs::perms::owner_all, ignored);
  }

  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  /// Nothing but the file with its old text.
  void expect_untouched() const {
    EXPECT_EQ(text_of_file(file), "old\n");
    EXPECT_EQ(files_in_folder(), 1u);
  }

  const support::TemporaryFolder own;
  const fs::path folder = own.path();
  const fs::path file = folder / "part.iso";
};

std::optional<std::string> replace(const fs::path& file, std::string_view text) {
  FileReplacement replacement(file);
  replacement.write(text);
  return replacement.commit(Language::English);
}

TEST_F(FileReplacements, PutTheNewTextInPlace) {
  fs::permissions(file, fs::perms(0640));
  EXPECT_EQ(replace(file, "new\n"), std::nullopt);
  EXPECT_EQ(text_of_file(file), "new\n");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0640));
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(FileReplacements, MayBeEmptyOrLarge) {
  EXPECT_EQ(replace(file, ""), std::nullopt);
  EXPECT_EQ(text_of_file(file), "");
  const std::string large(3'000'000, 'x');
  EXPECT_EQ(replace(file, large), std::nullopt);
  EXPECT_TRUE(text_of_file(file) == large);
}

TEST_F(FileReplacements, ThatAreNotCommittedLeaveNothing) {
  {
    FileReplacement replacement(file);
    replacement.write(std::string(200'000, 'x'));
    EXPECT_EQ(files_in_folder(), 2u);
  }
  expect_untouched();
}

TEST_F(FileReplacements, FollowSymlinks) {
  const fs::path elsewhere = folder / "links";
  fs::create_directory(elsewhere);
  fs::create_symlink("../part.iso", elsewhere / "link.iso");
  EXPECT_EQ(replace(elsewhere / "link.iso", "new\n"), std::nullopt);
  EXPECT_EQ(text_of_file(file), "new\n");
  EXPECT_TRUE(fs::is_symlink(elsewhere / "link.iso"));
}

TEST_F(FileReplacements, LeaveAFileThatHasChangedMeanwhile) {
  FileReplacement replacement(file);
  replacement.write("new\n");
  std::ofstream(file) << "somebody else's\n";
  EXPECT_THAT(replacement.commit(Language::English), Optional(HasSubstr("changed meanwhile")));
  EXPECT_EQ(text_of_file(file), "somebody else's\n");
  EXPECT_EQ(files_in_folder(), 1u);
}

/// As after a clock that was set back.
TEST_F(FileReplacements, LeaveAFileThatHasBecomeOlderMeanwhile) {
  FileReplacement replacement(file);
  replacement.write("new\n");
  const auto before = fs::last_write_time(file);
  std::ofstream(file) << "OLD\n";
  fs::last_write_time(file, before - std::chrono::hours(24));
  EXPECT_THAT(replacement.commit(Language::English), Optional(HasSubstr("changed meanwhile")));
  EXPECT_EQ(text_of_file(file), "OLD\n");
}

TEST_F(FileReplacements, LeaveAFileThatHasBeenReplacedMeanwhile) {
  FileReplacement replacement(file);
  replacement.write("new\n");
  std::ofstream(folder / "other") << "old\n";
  fs::last_write_time(folder / "other", fs::last_write_time(file));
  fs::rename(folder / "other", file);
  EXPECT_THAT(replacement.commit(Language::Italian), Optional(HasSubstr("modificato nel frattempo")));
  expect_untouched();
}

TEST_F(FileReplacements, DoNotBringBackARemovedFile) {
  FileReplacement replacement(file);
  replacement.write("new\n");
  fs::remove(file);
  EXPECT_TRUE(replacement.commit(Language::English).has_value());
  EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(FileReplacements, RefuseWhatIsNoPlainFile) {
  EXPECT_THAT(replace(folder, "new\n"), Optional(HasSubstr("not a regular file")));
  EXPECT_THAT(replace("/dev/null", "new\n"), Optional(HasSubstr("not a regular file")));
  EXPECT_THAT(replace(folder / "none.iso", "new\n"), Optional(HasSubstr("No such file")));
  fs::create_hard_link(file, folder / "other.iso");
  EXPECT_THAT(replace(file, "new\n"), Optional(HasSubstr("hard links")));
  EXPECT_EQ(text_of_file(file), "old\n");
}

bool fails_for(const fs::path& file, std::string_view text, std::string_view reason) {
  ::signal(SIGXFSZ, SIG_IGN);  // As program_main does.
  const auto why_not = replace(file, text);
  return why_not && why_not->find(reason) != std::string::npos;
}

TEST_F(FileReplacements, ThatDoNotFitLeaveTheOldText) {
  fs::permissions(folder, fs::perms::all);
  fs::permissions(file, fs::perms(0666));
  EXPECT_EQ(in_child([&] { return fails_for(file, std::string(300'000, 'x'), "File too large"); }, 100'000), 0);
  EXPECT_EQ(in_child([&] { return fails_for(file, "more than ten bytes\n", "File too large"); }, 10), 0);
  expect_untouched();
}

TEST_F(FileReplacements, InAReadOnlyFolderLeaveTheOldText) {
  fs::permissions(file, fs::perms(0666));
  fs::permissions(folder, fs::perms(0555));
  EXPECT_EQ(in_child([&] { return fails_for(file, "new\n", "cannot write: Permission denied"); }), 0);
  expect_untouched();
}

TEST_F(FileReplacements, OfAWriteProtectedFileAreRefused) {
  fs::permissions(folder, fs::perms::all);
  fs::permissions(file, fs::perms(0444));
  EXPECT_EQ(in_child([&] { return fails_for(file, "new\n", "cannot write: Permission denied"); }), 0);
  expect_untouched();
}

/// Ctrl-C while the new text is being written.
TEST_F(FileReplacements, ThatAreInterruptedLeaveNothingBeside) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    fs::permissions(folder, fs::perms::all);
    fs::permissions(file, fs::perms(0666));
    const int ending = in_child([&] {
      leave_no_temporary_files();
      FileReplacement replacement(file);
      replacement.write(std::string(200'000, 'x'));
      if (files_in_folder() == 2) ::raise(signal);
      return false;
    });
    EXPECT_EQ(ending, -1) << signal;
    expect_untouched();
  }
}

TEST_F(FileReplacements, GoOnWhereASignalIsToBeIgnored) {
  const int ending = in_child([&] {
    ::signal(SIGHUP, SIG_IGN);
    leave_no_temporary_files();
    ::raise(SIGHUP);
    return true;
  });
  EXPECT_EQ(ending, 0);
}

/// A child replaces the text over and over, and is killed at one moment or another.
TEST_F(FileReplacements, ThatAreKilledLeaveTheOldTextOrTheNew) {
  const std::string a(300'000, 'a');
  const std::string b(200'000, 'b');
  std::ofstream(file) << a;
  for (int i = 0; i < 40; ++i) {
    const pid_t child = ::fork();
    if (child == 0)
      for (;;)
        if (replace(file, b) || replace(file, a)) ::_exit(1);
    ::usleep(static_cast<useconds_t>(500 + 377 * i));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << WEXITSTATUS(status);
    const std::string text = text_of_file(file);
    EXPECT_TRUE(text == a || text == b) << text.size();
  }
}

}  // namespace
}  // namespace isocnc::system
