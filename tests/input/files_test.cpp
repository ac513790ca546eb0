#include "analyzer/input/files.h"
#include "tests/support/in_child.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

namespace isocnc::input {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

/// Every test works in an empty directory of its own.
class Files : public testing::Test {
 protected:
  void SetUp() override { fs::current_path(directory_); }
  void TearDown() override { fs::current_path(before_); }

  static void write(const fs::path& path, std::string_view text = "M02\n") {
    if (path.has_parent_path()) fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }

  static void write_all(std::initializer_list<const char*> paths) {
    for (const char* path : paths) write(path);
  }

  static FileSelection select(const std::vector<std::string>& paths,
                              dialect::Language language = dialect::Language::English) {
    return select_files(paths, kProgramExtensions, language);
  }

  static std::vector<std::string> files(const std::vector<std::string>& paths) {
    const FileSelection selection = select(paths);
    EXPECT_THAT(selection.problems, IsEmpty());
    return {selection.files.begin(), selection.files.end()};
  }

  const support::TemporaryFolder folder_;
  const fs::path directory_ = folder_.path();

 private:
  const fs::path before_ = fs::current_path();
};

TEST_F(Files, FileIsTakenWhateverItIsCalled) {
  write_all({"part.iso", "notes.txt", "O1234"});
  EXPECT_THAT(files({"notes.txt", "O1234", "part.iso"}), ElementsAre("notes.txt", "O1234", "part.iso"));
}

TEST_F(Files, DirectoryIsSearchedForProgramsInUpperAndLowerCase) {
  write_all({"a.iso", "b.nc", "c.cnc", "d.tap", "e.ngc", "F.ISO", "g.Nc", "h.txt", "i", "jiso", ".iso", "k.iso.bak"});
  EXPECT_THAT(files({"."}), ElementsAre("F.ISO", "a.iso", "b.nc", "c.cnc", "d.tap", "e.ngc", "g.Nc"));
}

TEST_F(Files, ExtensionsCanBeChosen) {
  write_all({"a.iso", "b.mpf", "c.out.nc", "d.nc"});
  const FileSelection selection = select_files(std::vector<std::string>{"."},
                                               std::vector<std::string>{".MPF", ".out.nc"}, dialect::Language::English);
  EXPECT_THAT(selection.files, ElementsAre("b.mpf", "c.out.nc"));
}

TEST_F(Files, DirectoriesInDirectoriesAreSearched) {
  write_all({"shop/a.iso", "shop/old/b.iso", "shop/old/2019/c.iso", "shop/.hidden/d.iso"});
  fs::create_directory("shop/empty");
  EXPECT_THAT(files({"shop"}),
              ElementsAre("shop/.hidden/d.iso", "shop/a.iso", "shop/old/2019/c.iso", "shop/old/b.iso"));
}

TEST_F(Files, PathsKeepTheirOrderAndFilesOfADirectoryAreSortedByteByByte) {
  write_all({"shop/a/x.iso", "shop/a-b/x.iso", "shop/B.iso", "shop/\xC3\xA8.iso", "first.iso", "zero/z.iso"});
  EXPECT_THAT(files({"zero", "shop", "first.iso"}), ElementsAre("zero/z.iso", "shop/B.iso", "shop/a-b/x.iso",
                                                                "shop/a/x.iso", "shop/\xC3\xA8.iso", "first.iso"));
}

TEST_F(Files, EachFileIsTakenOnce) {
  write_all({"shop/a.iso", "shop/b.iso"});
  EXPECT_THAT(files({"shop/b.iso", "shop", "./shop/a.iso", "shop/../shop/b.iso", fs::absolute("shop/a.iso")}),
              ElementsAre("shop/b.iso", "shop/a.iso"));
}

TEST_F(Files, PathsAreShownAsTheyWereGiven) {
  write_all({"shop/a.iso", "b.iso"});
  EXPECT_THAT(files({"."}), ElementsAre("b.iso", "shop/a.iso"));
  EXPECT_THAT(files({"./"}), ElementsAre("b.iso", "shop/a.iso"));
  EXPECT_THAT(files({"./b.iso"}), ElementsAre("./b.iso"));
  EXPECT_THAT(files({"./shop"}), ElementsAre("./shop/a.iso"));
  EXPECT_THAT(files({"shop//"}), ElementsAre("shop/a.iso"));
  EXPECT_THAT(files({directory_ / "shop"}), ElementsAre(directory_ / "shop/a.iso"));
  fs::current_path("shop");
  EXPECT_THAT(files({".."}), ElementsAre("../b.iso", "../shop/a.iso"));
}

TEST_F(Files, PathThatDoesNotExistIsAProblem) {
  write("part.iso");
  const FileSelection selection = select({"none.iso", "part.iso", "part.iso/x", ""});
  EXPECT_THAT(selection.files, ElementsAre("part.iso"));
  EXPECT_THAT(selection.problems,
              ElementsAre("none.iso: cannot read: No such file or directory",
                          "part.iso/x: cannot read: Not a directory", ": cannot read: No such file or directory"));
}

TEST_F(Files, ProblemsAreInTheLanguageAskedFor) {
  EXPECT_THAT(select({"none.iso"}, dialect::Language::Italian).problems,
              ElementsAre("none.iso: non si può leggere: file o directory non esistente"));
}

TEST_F(Files, DirectoryThatCannotBeReadIsAProblem) {
  write_all({"shop/a.iso", "shop/closed/b.iso"});
  fs::permissions(".", fs::perms(0755));
  fs::permissions("shop/closed", fs::perms::none);
  const int is_otherwise = support::in_child([&] {
    const FileSelection inside = select({"shop"});
    const FileSelection itself = select({"shop/closed"});
    const std::vector<std::string> problems = {"shop/closed: cannot read: Permission denied"};
    return inside.files == std::vector<fs::path>{"shop/a.iso"} && inside.problems == problems &&
           itself.problems == problems;
  });
  fs::permissions("shop/closed", fs::perms::owner_all);
  EXPECT_EQ(is_otherwise, 0);
}

TEST_F(Files, DirectoriesOfGitAreSkippedUnlessNamed) {
  write_all({".git/a.iso", ".github/b.iso", "shop/.git/c.iso", "git/d.iso", ".gitter.iso"});
  EXPECT_THAT(files({"."}), ElementsAre(".gitter.iso", "git/d.iso"));
  EXPECT_THAT(files({".github"}), ElementsAre(".github/b.iso"));
}

TEST_F(Files, SymlinksToFilesAreNotFollowedUnlessNamed) {
  write_all({"elsewhere/part.txt", "elsewhere/part.iso", "shop/a.iso"});
  fs::create_symlink("../elsewhere/part.txt", "shop/b.iso");
  fs::create_symlink("../elsewhere/part.iso", "shop/c.iso");
  fs::create_symlink("a.iso", "shop/d.iso");
  EXPECT_THAT(files({"shop"}), ElementsAre("shop/a.iso"));
  EXPECT_THAT(files({"shop/b.iso"}), ElementsAre("shop/b.iso"));
  EXPECT_THAT(files({"shop/d.iso", "shop"}), ElementsAre("shop/d.iso"));
}

TEST_F(Files, SymlinksToDirectoriesAreNotFollowedUnlessNamed) {
  write_all({"elsewhere/part.iso", "shop/a.iso"});
  fs::create_directory_symlink("../elsewhere", "shop/link.iso");
  fs::create_directory_symlink("..", "shop/up");
  EXPECT_THAT(files({"shop"}), ElementsAre("shop/a.iso"));
  EXPECT_THAT(files({"shop/link.iso"}), ElementsAre("shop/link.iso/part.iso"));
}

TEST_F(Files, PipesAndBrokenSymlinksAreTakenOnlyWhenNamed) {
  write("a.iso");
  ASSERT_EQ(::mkfifo("pipe.iso", 0600), 0);
  fs::create_symlink("nobody@nowhere", ".#a.iso");
  EXPECT_THAT(files({"."}), ElementsAre("a.iso"));
  EXPECT_THAT(files({"pipe.iso"}), ElementsAre("pipe.iso"));
  EXPECT_THAT(select({".#a.iso"}).problems, ElementsAre(".#a.iso: cannot read: No such file or directory"));
}

TEST_F(Files, DirectoriesMayLieDeeperThanFilesCanBeOpen) {
  const fs::path path = "1/2/3/4/5/6/7/8/9/10/11/12/13/14/15/16/17/18/19/20/21/22/23/24/25/26/27/28/29/30/31/32";
  write(path / "part.iso");
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit few{24, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  const FileSelection selection = select({"."});
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_THAT(selection.problems, IsEmpty());
  EXPECT_THAT(selection.files, ElementsAre(path / "part.iso"));
}

TEST_F(Files, RulesOfGitHoldInAWorkTree) {
  fs::create_directory(".git");
  write_all({"a.iso", "b.tap", "build/c.iso", "shop/d.iso", "shop/build/e.iso", "shop/b.tap"});
  write(".gitignore", "build/\n/b.tap\n");
  EXPECT_THAT(files({"."}), ElementsAre("a.iso", "shop/b.tap", "shop/d.iso"));
}

TEST_F(Files, RulesHoldFromTheRootOfTheWorkTreeDown) {
  fs::create_directory(".git");
  write(".gitignore", "*.tap\n/shop/lathe/x.iso\n");
  write("shop/.gitignore", "!keep.tap\ny.iso\n");
  write("shop/lathe/.gitignore", "/z.iso\n");
  write_all({"shop/lathe/a.iso", "shop/lathe/a.tap", "shop/lathe/keep.tap", "shop/lathe/x.iso", "shop/lathe/y.iso",
             "shop/lathe/z.iso", "shop/lathe/old/z.iso"});
  const auto found = ElementsAre("shop/lathe/a.iso", "shop/lathe/keep.tap", "shop/lathe/old/z.iso");
  EXPECT_THAT(files({"."}), found);
  EXPECT_THAT(files({"shop/lathe"}), found);
  fs::current_path("shop/lathe");
  EXPECT_THAT(files({"."}), ElementsAre("a.iso", "keep.tap", "old/z.iso"));
}

TEST_F(Files, RulesDoNotHoldOutsideOfWorkTrees) {
  write(".gitignore", "*.iso\n");
  write("shop/.gitignore", "*.iso\n");
  write_all({"a.iso", "shop/b.iso"});
  EXPECT_THAT(files({"."}), ElementsAre("a.iso", "shop/b.iso"));
}

TEST_F(Files, WorkTreeInADirectoryHasItsOwnRulesOnly) {
  fs::create_directories(".git");
  fs::create_directories("module/.git");
  write(".gitignore", "*.tap\n");
  write("module/.gitignore", "*.nc\n");
  write_all({"a.tap", "a.nc", "module/b.tap", "module/b.nc"});
  EXPECT_THAT(files({"."}), ElementsAre("a.nc", "module/b.tap"));
  fs::remove_all(".git");
  EXPECT_THAT(files({"."}), ElementsAre("a.nc", "a.tap", "module/b.tap"));
}

TEST_F(Files, ExcludesOfTheRepositoryAreWeakerThanGitignore) {
  write(".git/info/exclude", "*.tap\n*.nc\n");
  write("shop/.gitignore", "!a.tap\n");
  write_all({"shop/a.tap", "shop/b.tap", "shop/c.nc", "shop/d.iso"});
  EXPECT_THAT(files({"."}), ElementsAre("shop/a.tap", "shop/d.iso"));
}

TEST_F(Files, ExcludesAreFoundWhereAFileNamedGitPoints) {
  write("main/.git/modules/lathe/info/exclude", "*.tap\n");
  write("main/lathe/.git", "gitdir: ../.git/modules/lathe\n");
  write("main/.git/info/exclude", "*.nc\n");
  write("main/.git/worktrees/copy/commondir", "../..\n");
  write("copy/.git", "gitdir: " + (directory_ / "main/.git/worktrees/copy").native() + "\n");
  write_all({"main/lathe/a.tap", "main/lathe/a.nc", "copy/b.tap", "copy/b.nc"});
  EXPECT_THAT(files({"main"}), ElementsAre("main/lathe/a.nc"));
  EXPECT_THAT(files({"copy"}), ElementsAre("copy/b.tap"));
}

TEST_F(Files, NothingComesBackFromAnIgnoredDirectory) {
  fs::create_directory(".git");
  write(".gitignore", "old\n!old/part.iso\n");
  write("old/.gitignore", "!part.iso\n");
  write_all({"old/part.iso", "a.iso"});
  EXPECT_THAT(files({"."}), ElementsAre("a.iso"));
}

TEST_F(Files, WhatIsNamedIsTakenThoughGitIgnoresIt) {
  fs::create_directory(".git");
  write(".gitignore", "build/\n*.tap\n");
  write_all({"a.tap", "build/b.iso", "build/c.tap"});
  EXPECT_THAT(files({"a.tap", "build/c.tap"}), ElementsAre("a.tap", "build/c.tap"));
  EXPECT_THAT(files({"build"}), ElementsAre("build/b.iso"));
}

TEST_F(Files, GitignoreWithoutEndIsNotRead) {
  fs::create_directory(".git");
  write(".gitignore", "*.iso\n");
  write("a.iso");
  EXPECT_THAT(files({"."}), IsEmpty());
  std::error_code error;
  fs::resize_file(".gitignore", std::uintmax_t{5} << 30, error);
  if (error) GTEST_SKIP() << "no such file can be made here";
  EXPECT_THAT(files({"."}), ElementsAre("a.iso"));
}

TEST_F(Files, GitignoreThatIsASymlinkIsNotRead) {
  fs::create_directory(".git");
  write("rules", "*.iso\n");
  fs::create_symlink("rules", ".gitignore");
  write("a.iso");
  EXPECT_THAT(files({"."}), ElementsAre("a.iso"));
}

}  // namespace
}  // namespace isocnc::input
