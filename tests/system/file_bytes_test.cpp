#include "interpreter/system/source_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <variant>

#include "tests/support/temporary_folder.h"

namespace isocnc::system {
namespace {

using dialect::Language;
using Kind = FileBytesProblem::Kind;

class FileBytes : public testing::Test {
 protected:
  std::variant<std::string, FileBytesProblem> read(const std::string& name, std::size_t limit = 100) {
    return read_bytes(folder_.path(name), limit, Language::English);
  }
  FileBytesProblem problem(const std::string& name) { return std::get<FileBytesProblem>(read(name)); }

  support::TemporaryFolder folder_;
};

TEST_F(FileBytes, AreReadAsTheyStand) {
  using namespace std::string_literals;
  const std::string bytes = "\0\xFF\r\n\x1A\xEF\xBB\xBF"s;
  folder_.write("a", bytes);
  folder_.write("empty", "");
  EXPECT_EQ(std::get<std::string>(read("a")), bytes);
  EXPECT_EQ(std::get<std::string>(read("a", bytes.size())), bytes);
  EXPECT_EQ(std::get<std::string>(read("empty", 0)), "");
}

TEST_F(FileBytes, AreRefusedWithAReason) {
  folder_.write("large", std::string(101, 'x'));
  ASSERT_EQ(::mkfifo(folder_.path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(problem("large").kind, Kind::TooLarge);
  EXPECT_EQ(problem("pipe").kind, Kind::NotRegular);
  EXPECT_EQ(problem("").kind, Kind::NotRegular);
  EXPECT_EQ(problem("gone").kind, Kind::Unreadable);
  EXPECT_EQ(problem("gone").message, "cannot read: No such file or directory");
}

}  // namespace
}  // namespace isocnc::system
