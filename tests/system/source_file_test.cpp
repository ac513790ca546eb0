#include "interpreter/system/source_file.h"
#include "tests/support/in_child.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

namespace isocnc::system {
namespace {

namespace fs = std::filesystem;
using dialect::Language;
using namespace std::string_literals;
using Result = std::variant<SourceFile, SourceFile::Problem>;

static_assert(std::is_nothrow_move_constructible_v<SourceFile> && std::is_move_assignable_v<SourceFile>);
static_assert(!std::is_copy_constructible_v<SourceFile>);

/// The text, or the problem in brackets, which no test has in a text.
std::string shown(const Result& result) {
  if (const auto* problem = std::get_if<SourceFile::Problem>(&result)) return "[" + problem->message + "]";
  return std::string(std::get<SourceFile>(result).text());
}

/// Both ends of a pipe into which a thread writes `text` bit by bit, with all signals blocked, so that they interrupt
/// the reader alone.
class SlowPipe {
 public:
  explicit SlowPipe(std::string text) {
    EXPECT_EQ(::pipe(ends_), 0);
    sigset_t all, before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    writer_ = std::thread([this, text = std::move(text)] { write(text); });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  ~SlowPipe() {
    writer_.join();
    ::close(ends_[0]);
  }

  int reading_end() const { return ends_[0]; }

 private:
  void write(const std::string& text) const {
    for (const char& c : text) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      EXPECT_EQ(::write(ends_[1], &c, 1), 1);
    }
    ::close(ends_[1]);
  }

  int ends_[2] = {-1, -1};
  std::thread writer_;
};

/// While it lives, a signal interrupts whatever waits, again and again.
class Interruptions {
 public:
  Interruptions() {
    struct sigaction action {};
    action.sa_handler = [](int) {};  // Without SA_RESTART.
    ::sigaction(SIGALRM, &action, &before_);
    every(500);
  }
  ~Interruptions() {
    every(0);
    ::sigaction(SIGALRM, &before_, nullptr);
  }

 private:
  static void every(suseconds_t microseconds) {
    const itimerval timer{{0, microseconds}, {0, microseconds}};
    ::setitimer(ITIMER_REAL, &timer, nullptr);
  }

  struct sigaction before_ {};
};

/// Every test works in an empty directory of its own.
class SourceFiles : public testing::Test {
 protected:
  fs::path path(const std::string& name = "part.iso") const { return folder_.path(name); }

  fs::path write(const std::string& text) const {
    std::ofstream(path(), std::ios::binary) << text;
    return path();
  }

  /// What becomes of a file with this text.
  std::string opened(const std::string& text, Language language = Language::English) const {
    return shown(SourceFile::open(write(text), language));
  }

 private:
  const support::TemporaryFolder folder_;
};

TEST_F(SourceFiles, TextIsTheFileByteByByteAfterAByteOrderMark) {
  EXPECT_EQ(opened("\xEF\xBB\xBFG00 X1\r\n;\xE8\n\x1A"), "G00 X1\r\n;\xE8\n\x1A");
  EXPECT_EQ(opened("\xEF\xBB\xBF\xEF\xBB\xBFM02"), "\xEF\xBB\xBFM02");  // One is a mark, two are text.
}

TEST_F(SourceFiles, EmptyFileIsAnEmptyText) { EXPECT_EQ(opened(""), ""); }

TEST_F(SourceFiles, LargeFileIsReadWhole) {
  std::string text;
  while (text.size() < 3'000'000) text += "G01 X" + std::to_string(text.size()) + "\n";
  EXPECT_TRUE(opened(text) == text);
}

TEST_F(SourceFiles, TextSurvivesAMove) {
  for (const std::string& text : {"M02\n"s, ""s}) {
    Result result = SourceFile::open(write(text), Language::English);
    SourceFile moved = std::get<SourceFile>(std::move(result));
    EXPECT_EQ(moved.text(), text);
    moved = std::get<SourceFile>(SourceFile::open(write("G00\n"), Language::English));
    EXPECT_EQ(moved.text(), "G00\n");
  }
}

TEST_F(SourceFiles, TextOutlivesTheName) {
  const Result result = SourceFile::open(write("M02\n"), Language::English);
  fs::remove(path());
  EXPECT_EQ(shown(result), "M02\n");
}

/// Another program saves it anew meanwhile.
TEST_F(SourceFiles, TextOutlivesTheContent) {
  std::string text;
  while (text.size() < 1'000'000) text += "G01 X10 F1000\n";
  const Result result = SourceFile::open(write(text), Language::English);
  write("M02\n");
  EXPECT_TRUE(std::get<SourceFile>(result).text() == text);
}

TEST_F(SourceFiles, FileThatDoesNotExistIsAProblem) {
  EXPECT_EQ(shown(SourceFile::open(path("none"), Language::English)), "[cannot read: No such file or directory]");
  EXPECT_EQ(shown(SourceFile::open(path("none"), Language::Italian)),
            "[non si può leggere: file o directory non esistente]");
}

TEST_F(SourceFiles, FileThatMayNotBeReadIsAProblem) {
  fs::permissions(write("M02\n"), fs::perms::none);
  fs::permissions(path().parent_path(), fs::perms(0755));
  const int is_otherwise = support::in_child([&] {
    return shown(SourceFile::open(path(), Language::English)) == "[cannot read: Permission denied]" &&
           shown(SourceFile::open(path(), Language::Italian)) == "[non si può leggere: permesso negato]";
  });
  EXPECT_EQ(is_otherwise, 0);
}

TEST_F(SourceFiles, DirectoryIsAProblem) {
  EXPECT_EQ(shown(SourceFile::open(path(""), Language::English)), "[is a directory]");
  EXPECT_EQ(shown(SourceFile::open(path(""), Language::Italian)), "[è una directory]");
  const int descriptor = ::open(path("").c_str(), O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(shown(SourceFile::read_stream(descriptor, Language::English)), "[cannot read: Is a directory]");
  ::close(descriptor);
}

TEST_F(SourceFiles, PipeIsReadToItsEnd) {
  std::string text(300'000, 'X');
  text += '\n';
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  std::thread writer([&] {
    EXPECT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ::close(ends[1]);
  });
  EXPECT_TRUE(shown(SourceFile::read_stream(ends[0], Language::English)) == text);
  writer.join();
  ::close(ends[0]);
}

TEST_F(SourceFiles, StreamIsReadFromWhereItStandsAndLeftOpen) {
  const int descriptor = ::open(write("G00\nM02\n").c_str(), O_RDONLY | O_CLOEXEC);
  ::lseek(descriptor, 4, SEEK_SET);
  EXPECT_EQ(shown(SourceFile::read_stream(descriptor, Language::English)), "M02\n");
  EXPECT_EQ(::lseek(descriptor, 0, SEEK_CUR), 8);
  ::close(descriptor);
}

TEST_F(SourceFiles, NamedPipeIsRead) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(path("pipe")) << "M02\n"; });
  EXPECT_EQ(shown(SourceFile::open(path("pipe"), Language::English)), "M02\n");
  writer.join();
}

TEST_F(SourceFiles, DevicesAreRead) {
  EXPECT_EQ(shown(SourceFile::open("/dev/null", Language::English)), "");
  EXPECT_EQ(shown(SourceFile::open("/dev/zero", Language::English)), "[looks like a binary file]");
}

TEST_F(SourceFiles, FilesThatTheKernelMakesUpAreRead) {
  for (const char* made_up : {"/proc/self/status", "/sys/kernel/mm/transparent_hugepage/enabled"}) {
    if (!fs::exists(made_up)) continue;
    const std::string text = shown(SourceFile::open(made_up, Language::English));
    EXPECT_TRUE(text.ends_with('\n')) << made_up << text;
  }
}

/// What isols must be able to live on from.
TEST_F(SourceFiles, ThatAreNotMappedKeepTheirBytesWhenTheFileIsCutShort) {
  const std::string text(9 * 1024 * 1024, 'X');
  const fs::path file = write(text);
  const Result result = SourceFile::open_unmapped(file, Language::English);
  fs::resize_file(file, 10);
  EXPECT_TRUE(shown(result) == text);
}

TEST_F(SourceFiles, FileTooLargeForTheMemoryIsAProblem) {
  const int descriptor = ::memfd_create("part.iso", MFD_CLOEXEC);
  if (descriptor < 0 || ::ftruncate(descriptor, off_t{1} << 50) != 0) GTEST_SKIP() << "no such file can be made here";
  const std::string head(9000, 'X');
  ASSERT_EQ(::pwrite(descriptor, head.data(), head.size(), 0), 9000);
  const fs::path file = "/proc/self/fd/" + std::to_string(descriptor);
  EXPECT_EQ(shown(SourceFile::open(file, Language::English)), "[cannot read: Cannot allocate memory]");
  EXPECT_EQ(shown(SourceFile::open(file, Language::Italian)), "[non si può leggere: memoria insufficiente]");
  if (support::kTriesAll) {  // The address sanitizer ends a program that asks for so much.
    EXPECT_EQ(shown(SourceFile::open_unmapped(file, Language::English)), "[cannot read: Cannot allocate memory]");
  }
  ::close(descriptor);
}

TEST_F(SourceFiles, SignalsDoNotEndAReading) {
  SlowPipe pipe("G00 X1\nM02\n");
  const Interruptions interruptions;
  EXPECT_EQ(shown(SourceFile::read_stream(pipe.reading_end(), Language::English)), "G00 X1\nM02\n");
}

TEST_F(SourceFiles, Utf16IsAProblem) {
  const std::string problem = "[is UTF-16; save it as UTF-8 or ASCII]";
  EXPECT_EQ(opened("\xFF\xFEM\0\n\0"s), problem);
  EXPECT_EQ(opened("\xFE\xFF\0M\0\n"s), problem);
  EXPECT_EQ(opened("\xFF\xFE"), problem);
  EXPECT_EQ(opened("M\0000\0002\0\n\0"s), problem);
  EXPECT_EQ(opened("\0M\0000\0002\0\n"s), problem);
  EXPECT_EQ(opened("\xFF\xFEM\0\n\0"s, Language::Italian), "[è in UTF-16: va salvato in UTF-8 o ASCII]");
}

TEST_F(SourceFiles, Utf16WithoutAMarkMayHaveLettersOfOtherScripts) {
  std::string text = "\x20\x26"s;  // A sun, which fills both of its bytes.
  for (int i = 0; i < 5000; ++i) text += "X\0"s;
  EXPECT_EQ(opened(text), "[is UTF-16; save it as UTF-8 or ASCII]");
}

TEST_F(SourceFiles, Utf32IsAProblem) {
  const std::string problem = "[is UTF-32; save it as UTF-8 or ASCII]";
  EXPECT_EQ(opened("\xFF\xFE\0\0M\0\0\0"s), problem);
  EXPECT_EQ(opened("\0\0\xFE\xFF\0\0\0M"s), problem);
  EXPECT_EQ(opened("M\0\0\0\n\0\0\0"s), problem);
  EXPECT_EQ(opened("\0\0\0M\0\0\0\n"s), problem);
}

TEST_F(SourceFiles, BinaryFileIsAProblem) {
  std::string noise;
  for (unsigned i = 0, value = 1; i < 20'000; ++i)
    noise += static_cast<char>((value = value * 1664525 + 1013904223) >> 24);
  EXPECT_EQ(opened(noise), "[looks like a binary file]");
  EXPECT_EQ(opened("\x7F"
                   "ELF\2\1\1\0\0\0\0\0\0\0\0\0"s),
            "[looks like a binary file]");
  EXPECT_EQ(opened(noise, Language::Italian), "[sembra un file binario]");
}

TEST_F(SourceFiles, TenthOfControlsIsTheMaximumOfAText) {
  const std::string nine(9, 'X');
  std::string tenth;
  for (int i = 0; i < 100; ++i) tenth += nine + "\x01";
  EXPECT_EQ(opened(tenth), tenth);
  EXPECT_EQ(opened(tenth + "\x01"), "[looks like a binary file]");
}

TEST_F(SourceFiles, ManyNulsAreBinary) {
  EXPECT_EQ(opened(std::string(2000, 'X') + std::string(8, '\0')), "[looks like a binary file]");
}

TEST_F(SourceFiles, TabsLineEndsAndEndOfFileMarksAreText) {
  const std::string text = "\t\t\r\n\r\n\f\f\n\n\x1A\x1A\x1A";
  EXPECT_EQ(opened(text), text);
}

TEST_F(SourceFiles, StrayControlsAreText) {
  for (const std::string& text : {"G00\0X1\nM02\n"s, "M02\n\x01"s, "\0"s, "\x02"s, "M02\0"s})
    EXPECT_EQ(opened(text), text);
}

TEST_F(SourceFiles, OnlyTheFirstBytesDistinguishBinaryFromText) {
  const std::string text = std::string(8 * 1024, 'X') + std::string(5000, '\0');
  EXPECT_TRUE(opened(text) == text);
}

TEST_F(SourceFiles, StreamsAreLookedAtAsFilesAre) {
  SlowPipe pipe("\xFF\xFEM\0"s);
  EXPECT_EQ(shown(SourceFile::read_stream(pipe.reading_end(), Language::English)),
            "[is UTF-16; save it as UTF-8 or ASCII]");
}

TEST_F(SourceFiles, FileMayBeLongerThanALine) {
  const off_t over = (off_t{1} << 32) + 100;
  const int descriptor = ::memfd_create("part.iso", MFD_CLOEXEC);
  if (descriptor < 0 || ::ftruncate(descriptor, over) != 0) GTEST_SKIP() << "no such file can be made here";
  const std::string text(9000, 'X');
  ASSERT_EQ(::pwrite(descriptor, text.data(), text.size(), 0), 9000);
  ASSERT_EQ(::pwrite(descriptor, "\n", 1, over - 200), 1);
  const Result result = SourceFile::open("/proc/self/fd/" + std::to_string(descriptor), Language::English);
  ASSERT_TRUE(std::holds_alternative<SourceFile>(result)) << shown(result);
  EXPECT_EQ(std::get<SourceFile>(result).text().size(), static_cast<std::size_t>(over));
  ::close(descriptor);
}

TEST(LineLength, IsCountedBetweenLineEnds) {
  EXPECT_FALSE(has_line_longer_than(3, ""));
  EXPECT_FALSE(has_line_longer_than(3, "M02"));
  EXPECT_TRUE(has_line_longer_than(3, "M002"));
  EXPECT_FALSE(has_line_longer_than(3, "M02\nM02\rM02\r\nM02\n"));
  EXPECT_TRUE(has_line_longer_than(3, "M002\nM02"));
  EXPECT_TRUE(has_line_longer_than(3, "M02\nM002"));
  EXPECT_TRUE(has_line_longer_than(3, "M02\r\nM002\r\nM02"));
  EXPECT_FALSE(has_line_longer_than(3, "\n\n\n\n\n\n"));
  EXPECT_TRUE(has_line_longer_than(3, "\n\n\n\n\nM002"));
}

}  // namespace
}  // namespace isocnc::system
