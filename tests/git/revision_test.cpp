#include "interpreter/git/revision.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <variant>

#include "interpreter/system/process.h"
#include "tests/support/git_repository.h"

namespace isocnc::git {
namespace {

namespace fs = std::filesystem;
using dialect::Language;
using testing::HasSubstr;
using testing::StartsWith;

std::string parts_of(const std::string& operand) {
  const auto file = revision_file(operand);
  return file ? file->revision + "|" + file->stage + "|" + file->path : "none";
}

TEST(RevisionFile, IsARevisionAndAPath) {
  EXPECT_EQ(parts_of("HEAD:part.iso"), "HEAD||part.iso");
  EXPECT_EQ(parts_of("v1.2^{commit}:./a b:c.iso"), "v1.2^{commit}||./a b:c.iso");
  EXPECT_EQ(parts_of("HEAD^{/fix: it}:a.iso"), "HEAD^{/fix: it}||a.iso");
  EXPECT_EQ(parts_of(":part.iso"), "||part.iso");
  EXPECT_EQ(parts_of(":2:part.iso"), "|2|part.iso");
  EXPECT_EQ(parts_of(":4:part.iso"), "||4:part.iso");
  EXPECT_EQ(parts_of("-x:part.iso"), "-x||part.iso");
  EXPECT_EQ(parts_of("C:part.iso"), "C||part.iso");  // On Windows it is on a drive.
}

TEST(RevisionFile, IsNoFileOfAFolder) {
  for (const char* const operand : {"part.iso", "", "-", R"(C:\x.iso)", "c:/x.iso", "./a:b.iso", "../a:b.iso",
                                    "/tmp/a:b.iso", ":/message", "HEAD^{/fix: it}"})
    EXPECT_EQ(parts_of(operand), "none") << operand;
}

/// A repository in whose folder the test runs.
class Revision : public testing::Test {
 protected:
  Revision() : before_(fs::current_path()) {
    system::prepare_process();
    ::setenv("LC_ALL", "C.UTF-8", 1);
    for (const char* const set_by_hooks : {"GIT_DIR", "GIT_INDEX_FILE", "GIT_WORK_TREE"}) ::unsetenv(set_by_hooks);
    ::setenv("GIT_CONFIG_NOSYSTEM", "1", 1);
    repository_.write("parts/più piatta.iso", "old\n");
    repository_.write("top.iso", "top\n");
    fs::create_symlink("più piatta.iso", repository_.path("parts/link.iso"));
    fs::create_symlink("/etc/passwd", repository_.path("out.iso"));
    repository_.commit("One");
    repository_.write("parts/più piatta.iso", "new\n");
    repository_.commit("Two");
    fs::current_path(repository_.path());
  }
  ~Revision() override { fs::current_path(before_); }

  /// The text and its place, or why there is none.
  static std::string read(const std::string& operand, Language language = Language::English) {
    const auto file = revision_file(operand);
    if (!file) return "none";
    const auto got = git::read(*file, language);
    if (const auto* const problem = std::get_if<std::string>(&got)) return *problem;
    const auto& found = std::get<FileAtRevision>(got);
    return found.place.generic_string() + ": " + found.bytes;
  }

  const fs::path before_;
  support::GitRepository repository_;
};

TEST_F(Revision, HasItsText) {
  EXPECT_EQ(read("HEAD:parts/più piatta.iso"), "parts/più piatta.iso: new\n");
  EXPECT_EQ(read("HEAD~1:parts/più piatta.iso"), "parts/più piatta.iso: old\n");
  EXPECT_EQ(read("HEAD^{/One}:parts/più piatta.iso"), "parts/più piatta.iso: old\n");
  repository_.write("parts/più piatta.iso", "staged\n");
  repository_.must("git add parts");
  EXPECT_EQ(read(":parts/più piatta.iso"), "parts/più piatta.iso: staged\n");
  EXPECT_EQ(read(":0:parts/più piatta.iso"), "parts/più piatta.iso: staged\n");
  EXPECT_EQ(read("HEAD:parts/link.iso"), "parts/link.iso: new\n");
  EXPECT_EQ(read("HEAD:parts/../top.iso"), "top.iso: top\n");
}

TEST_F(Revision, CountsFromTheTopOrFromHere) {
  fs::current_path("parts");
  EXPECT_EQ(read("HEAD:top.iso"), "../top.iso: top\n");
  EXPECT_EQ(read("HEAD:parts/link.iso"), "link.iso: new\n");
  EXPECT_EQ(read("HEAD~1:./più piatta.iso"), "più piatta.iso: old\n");
  EXPECT_EQ(read("HEAD:../top.iso"), "../top.iso: top\n");
  EXPECT_EQ(read("HEAD:link.iso"), "HEAD has no file link.iso; from the current folder it would be HEAD:./link.iso");
  EXPECT_EQ(read("HEAD:../../top.iso"), "is outside of the repository");
}

TEST_F(Revision, SaysWhyThereIsNone) {
  EXPECT_EQ(read("HEAD:none.iso"), "HEAD has no file none.iso");
  EXPECT_EQ(read("HEAD:none.iso", Language::Italian), "in HEAD non c'è il file none.iso");
  EXPECT_EQ(read(":none.iso"), "no file none.iso is staged");
  EXPECT_EQ(read("HEAD:parts"), "is a directory");
  EXPECT_EQ(read("HEAD:"), "is a directory");
  EXPECT_EQ(read("HEAD:out.iso"), "is a symbolic link to what is not in the revision");
  EXPECT_EQ(read("HEAD:/etc/passwd"), "HEAD has no file /etc/passwd");
  EXPECT_EQ(read("HEAD:a\nb.iso"), "has a line end in its name");
  EXPECT_EQ(read("HEAD:parts/../../top.iso"), "is outside of the repository");
  for (const std::string revision : {"nix", "-x", "--output=there", "HEAD~9", "a b"})
    EXPECT_EQ(read(revision + ":top.iso"),
              "no file has this name, and git knows no revision " + revision + ", or several");
  EXPECT_FALSE(fs::exists("there"));
}

TEST_F(Revision, EndsWhereASubmoduleBegins) {
  const std::string commit = repository_.must("git rev-parse HEAD").substr(0, 40);
  repository_.must("git update-index --add --cacheinfo 160000," + commit + ",libs/sub && git commit -q -m Module");
  EXPECT_EQ(read("HEAD:libs/sub/a/b.iso"), "is in a submodule, libs/sub: ask there");
  EXPECT_EQ(read("HEAD:libs/sub"), "is in a submodule, libs/sub: ask there");
  EXPECT_EQ(read("HEAD:libs/other.iso"), "HEAD has no file libs/other.iso");
}

TEST_F(Revision, AFileThatExistsIsMeant) {
  EXPECT_NE(read("HEAD:top.iso"), "none");
  repository_.write("HEAD:top.iso", "file\n");
  EXPECT_EQ(read("HEAD:top.iso"), "none");
}

TEST_F(Revision, IsAsACheckoutWouldWriteIt) {
  repository_.write(".gitattributes", "*.iso text eol=crlf\n");
  EXPECT_EQ(read("HEAD:top.iso"), "top.iso: top\r\n");
}

TEST_F(Revision, IsReadFromABareRepository) {
  repository_.must("git clone -q --bare . bare.git");
  fs::current_path("bare.git");
  EXPECT_EQ(read("HEAD:top.iso"), "top.iso: top\n");
}

TEST_F(Revision, IsReadInFull) {
  std::string large;
  for (int i = 0; large.size() < 5'000'000; ++i) large += "G01 X" + std::to_string(i) + "\n";
  repository_.write("large.iso", large);
  repository_.commit("Large");
  EXPECT_TRUE(read("HEAD:large.iso") == "large.iso: " + large);
}

TEST_F(Revision, TakesARepositoryAndGit) {
  const support::TemporaryFolder elsewhere;
  fs::current_path(elsewhere.path());
  EXPECT_THAT(read("HEAD:top.iso"),
              StartsWith("no file has this name, and git finds no repository: not a git repository"));
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", elsewhere.path().c_str(), 1);
  EXPECT_EQ(read("HEAD:top.iso"), "no file has this name, and git was not found, which would know a revision");
  EXPECT_THAT(read("HEAD:top.iso", Language::Italian), HasSubstr("non si trova git"));
  ::setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace isocnc::git
