#include "interpreter/running/output_file.h"
#include "tests/support/text_of_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

namespace isocnc::running {
namespace {

namespace fs = std::filesystem;

TEST(OutputFiles, HoldAllThatWasWritten) {
  const fs::path path = fs::temp_directory_path() / ("isocnc-output-" + std::to_string(::getpid()));
  std::ofstream(path) << "what was there before";
  std::string expected;
  {
    OutputFile file(path);
    for (int i = 0; i < 50'000; ++i) {
      file.write("line\n");
      expected += "line\n";
    }
    EXPECT_EQ(file.flush(), 0);
  }
  EXPECT_TRUE(text_of_file(path) == expected);
  fs::remove(path);
}

TEST(OutputFiles, KeepTheFirstError) {
  OutputFile full("/dev/full");
  full.write(std::string(1'000'000, 'x'));
  EXPECT_EQ(full.error(), ENOSPC);
  errno = EIO;
  full.write("more");
  EXPECT_EQ(full.flush(), ENOSPC);
}

TEST(OutputFiles, ThatCannotBeMadeHaveAnError) {
  OutputFile file("/no/such/folder/trace");
  EXPECT_EQ(file.error(), ENOENT);
  file.write("lost");
  EXPECT_EQ(file.flush(), ENOENT);
}

}  // namespace
}  // namespace isocnc::running
