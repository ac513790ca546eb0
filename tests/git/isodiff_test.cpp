#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/git_repository.h"

/// isodiff with the real git: files of revisions, and the program that git calls for differences.
namespace isocnc::git {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A program whose last cut ends at this X and Y.
std::string program(int x, int y) {
  return "M06 T101001\nS12000 M03\nG00 X10 Y20 Z40\nG01 Z-5 F2000\nX" + std::to_string(x) + "\nY" + std::to_string(y) +
         "\nG00 Z40\nM02\n";
}

const std::string kNone = "no difference\n";

class IsodiffWithGit : public testing::Test {
 protected:
  IsodiffWithGit() {
    repository_.write(".gitattributes", "*.iso diff=isocnc\n");
    repository_.must("git config diff.isocnc.command 'isodiff --git'");
  }

  void commit(const std::string& message = "Programs") { repository_.commit(message); }
  /// What a command writes, which must succeed and complain of nothing.
  std::string shown_by(const std::string& command, const std::string& in = "") const {
    const auto done = repository_.run(command, in);
    EXPECT_EQ(done.status, 0) << command;
    EXPECT_EQ(done.err, "") << command;
    return done.out;
  }

  support::GitRepository repository_;
};

TEST_F(IsodiffWithGit, ComparesFilesOfRevisions) {
  repository_.write("parts/a.iso", program(100, 80));
  commit();
  repository_.write("parts/a.iso", program(101, 80));
  const std::string moved = "T101001\n  lines 5-7: moved by X1\n";
  for (const char* const command : {"isodiff HEAD:parts/a.iso parts/a.iso", "isodiff @:parts/a.iso - <parts/a.iso"}) {
    const auto done = repository_.run(command);
    EXPECT_EQ(done.status, 1) << command << done.err;
    EXPECT_THAT(done.out, StartsWith(moved)) << command;
  }
  EXPECT_THAT(repository_.run("isodiff HEAD:./a.iso a.iso", "parts").out, StartsWith(moved));
  commit();
  EXPECT_THAT(repository_.run("isodiff HEAD~1:parts/a.iso HEAD:parts/a.iso").out, StartsWith(moved));
  EXPECT_EQ(shown_by("isodiff HEAD:parts/a.iso parts/a.iso"), kNone);
  repository_.write("parts/a.iso", program(102, 80));
  repository_.must("git add .");
  EXPECT_THAT(repository_.run("isodiff :parts/a.iso HEAD:parts/a.iso").out, HasSubstr("moved by X-1"));
}

TEST_F(IsodiffWithGit, BothRunOnTheMachineOfTheWorkingTree) {
  repository_.write("parts/a.iso", program(100, 80));
  repository_.write("isocnc.json", R"({"machine": {"home": {"z": 100}}})");
  commit();
  repository_.write("parts/isocnc.json", R"({"machine": {"home": {"z": 150}}})");
  EXPECT_EQ(shown_by("isodiff HEAD:parts/a.iso parts/a.iso"), kNone);
  EXPECT_EQ(shown_by("isodiff HEAD:parts/a.iso a.iso", "parts"), kNone);
  repository_.write("parts/isocnc.json", "{");
  const auto done = repository_.run("isodiff HEAD:parts/a.iso parts/a.iso");
  EXPECT_EQ(done.status, 2);
  EXPECT_THAT(done.err, StartsWith("parts/isocnc.json:1:"));
}

TEST_F(IsodiffWithGit, BothHaveTheSetupOfTheWorkingTree) {
  repository_.write("parts/a.iso", program(100, 80));
  commit();
  repository_.write("parts/a.setup.json", "{");
  for (const char* const command : {"isodiff --verify HEAD:parts/a.iso - <parts/a.iso",
                                    "isodiff --verify --git parts/a.iso parts/a.iso . 100644 /dev/null . ."}) {
    EXPECT_EQ(repository_.run(command).status, 2) << command;
    EXPECT_THAT(repository_.run(command).err, StartsWith("parts/a.setup.json:1:")) << command;
  }
  EXPECT_EQ(shown_by("isodiff HEAD:parts/a.iso parts/a.iso"), kNone);
}

TEST_F(IsodiffWithGit, SaysWhyARevisionHasNoText) {
  repository_.write("a.iso", program(100, 80));
  repository_.write("binary.iso", std::string(1000, '\0'));
  repository_.write("wide.iso",
                    "\xFF\xFEM\0"
                    "0\0");
  commit();
  const auto refusal = [&](const std::string& command) {
    const auto done = repository_.run(command);
    EXPECT_EQ(done.status, 2) << command;
    EXPECT_EQ(done.out, "") << command;
    return done.err;
  };
  EXPECT_EQ(refusal("isodiff HEAD:b.iso a.iso"), "isodiff: HEAD:b.iso: HEAD has no file b.iso\n");
  EXPECT_EQ(refusal("isodiff --lang it a.iso HEAD:b.iso"), "isodiff: HEAD:b.iso: in HEAD non c'è il file b.iso\n");
  EXPECT_EQ(refusal("isodiff nix:a.iso a.iso"),
            "isodiff: nix:a.iso: no file has this name, and git knows no revision nix, or several\n");
  EXPECT_EQ(refusal("isodiff -- --output=x:a.iso a.iso"),
            "isodiff: --output=x:a.iso: no file has this name, and git knows no revision --output=x, or several\n");
  EXPECT_EQ(refusal("isodiff HEAD:binary.iso a.iso"), "isodiff: HEAD:binary.iso: looks like a binary file\n");
  EXPECT_EQ(refusal("isodiff HEAD:wide.iso a.iso"), "isodiff: HEAD:wide.iso: is UTF-16; save it as UTF-8 or ASCII\n");
  EXPECT_THAT(refusal("isodiff 'C:\\x.iso' a.iso"), StartsWith("isodiff: C:\\x.iso: cannot read: "));
  EXPECT_EQ(refusal("mkdir empty && PATH=empty \"$(command -v isodiff)\" HEAD:a.iso a.iso"),
            "isodiff: HEAD:a.iso: no file has this name, and git was not found, which would know a revision\n");
  EXPECT_THAT(refusal("cd / && isodiff HEAD:a.iso a.iso"),
              StartsWith("isodiff: HEAD:a.iso: no file has this name, and git finds no repository: not a git "));
}

TEST_F(IsodiffWithGit, AFileWithAColonIsNoRevision) {
  repository_.write("a:b.iso", program(100, 80));
  repository_.write("a.iso", program(100, 80));
  EXPECT_EQ(shown_by("isodiff a:b.iso a.iso"), kNone);
}

/// Each kind of change, in names with blanks and umlauts, too.
class GitShows : public IsodiffWithGit {
 protected:
  GitShows() {
    std::string remarks;  // By which git sees that it is not gone.iso with another name.
    for (int i = 0; i < 40; ++i) remarks += "( remark " + std::to_string(i * i) + " )\n";
    repository_.write("gone.iso", program(10, 20));
    repository_.write("mode.iso", program(10, 30));
    repository_.write("p ü/like this.iso", program(90, 70));
    repository_.write("notes.txt", "old\n");
    commit("One");
    fs::remove(repository_.path("gone.iso"));
    fs::permissions(repository_.path("mode.iso"), fs::perms::owner_exec, fs::perm_options::add);
    fs::rename(repository_.path("p ü/like this.iso"), repository_.path("p ü/größer.iso"));
    repository_.write("p ü/größer.iso", program(91, 70));
    repository_.write("notes.txt", "new\n");
    repository_.write("-new one.iso", program(50, 60) + remarks);
    repository_.must("git add -A .");
  }

  const std::string new_ =
      "-new one.iso (new)\n"
      "T101001\n"
      "  new lines 1-7: added: operation of T101001, 5 motions\n";
  const std::string gone_ =
      "1 difference\n\ngone.iso (deleted)\n"
      "T101001\n"
      "  old lines 1-7: removed: operation of T101001, 3 motions\n";
  const std::string mode_ = "\nmode.iso (mode 100644 -> 100755)\n" + kNone;
  const std::string moved_ = "T101001\n  lines 5-7: moved by X1\n";
  const std::string renamed_ = "\np ü/like this.iso -> p ü/größer.iso\n" + moved_;
};

TEST_F(GitShows, InItsDiffs) {
  const std::string shown = shown_by("git diff HEAD");
  EXPECT_THAT(shown, StartsWith(new_));
  for (const std::string& part : {gone_, mode_, renamed_}) EXPECT_THAT(shown, HasSubstr(part));
  EXPECT_THAT(shown, HasSubstr("\n-old\n+new\n"));  // Other files are git's.
  EXPECT_EQ(repository_.run("git diff --exit-code HEAD").status, 1);
}

TEST_F(GitShows, InItsLog) {
  commit("Two");
  for (const char* const command : {"git show --ext-diff", "git log -p --ext-diff -n 1"}) {
    const std::string shown = shown_by(command);
    for (const std::string& part : {new_, gone_, mode_, renamed_}) EXPECT_THAT(shown, HasSubstr(part)) << command;
  }
  EXPECT_THAT(shown_by("git log -p --ext-diff"), HasSubstr("p ü/like this.iso (new)\n"));
  EXPECT_THAT(shown_by("git show"), Not(HasSubstr("moved by")));
}

TEST_F(GitShows, WhereItIsCalledFromAFolder) {
  EXPECT_THAT(shown_by("git diff HEAD -- .", "p ü"), HasSubstr("p ü/größer.iso"));
  repository_.write("isocnc.json", R"({"machine": {"home": {"z": 100}}})");
  repository_.write("p ü/isocnc.json", "{");
  const auto done = repository_.run("git diff HEAD -- .", "p ü");
  EXPECT_EQ(done.status, 128);
  EXPECT_THAT(done.err, StartsWith("p ü/isocnc.json:1:"));
  EXPECT_THAT(done.err, HasSubstr("external diff died"));
}

TEST_F(GitShows, WithADifftool) {
  repository_.must("git config --unset diff.isocnc.command");  // Else git would ask it alone.
  repository_.must(R"(git config difftool.isocnc.cmd 'isodiff --git "$MERGED" "$LOCAL" . . "$REMOTE" . .')");
  const std::string shown = shown_by("git difftool -y --tool=isocnc HEAD -- '*.iso'");
  EXPECT_THAT(shown, StartsWith(new_));
  EXPECT_THAT(shown, HasSubstr(gone_));
  EXPECT_THAT(shown, HasSubstr("\nmode.iso\n" + kNone));
  EXPECT_THAT(shown, HasSubstr(moved_));
}

TEST_F(GitShows, AsItsOnlyProgramForDifferences) {
  const std::string shown =
      shown_by("git config --unset diff.isocnc.command; GIT_EXTERNAL_DIFF='isodiff --git' git diff HEAD");
  for (const std::string& part : {new_, gone_, mode_, renamed_}) EXPECT_THAT(shown, HasSubstr(part));
  EXPECT_THAT(shown, HasSubstr("\nnotes.txt\nis no program, by its name\n"));
}

TEST_F(GitShows, WhatHasTheExtensionsOfTheConfiguration) {
  repository_.write("isocnc.json", R"({"lint": {"extensions": [".txt"]}})");
  repository_.write("notes.TXT", program(10, 20));
  repository_.must("git add -A .");
  commit();
  repository_.write("notes.TXT", program(11, 20));
  const std::string shown =
      shown_by("git config --unset diff.isocnc.command; GIT_EXTERNAL_DIFF='isodiff --git' git diff HEAD");
  EXPECT_THAT(shown, StartsWith("notes.TXT\nT101001\n"));
}

TEST_F(GitShows, AsMarkdown) {
  const std::string shown = shown_by("git -c diff.isocnc.command='isodiff --format markdown --git' diff HEAD");
  EXPECT_THAT(shown, HasSubstr("\n### `p ü/like this.iso -> p ü/größer.iso`\n\n```text\n" + moved_));
  EXPECT_THAT(shown, EndsWith("\n1 difference\n```\n"));
}

/// Who leaves the pager early wants no more, and no message.
TEST_F(GitShows, NothingToNobody) {
  EXPECT_EQ(shown_by("{ sleep 0.2; git diff HEAD; } 2>complaints | :; cat complaints"), "");
}

TEST_F(IsodiffWithGit, ShowsConflictsOfAMerge) {
  repository_.write("a b.iso", program(100, 80));
  commit();
  repository_.must("git checkout -q -b side");
  repository_.write("a b.iso", program(105, 85));
  commit();
  repository_.must("git checkout -q main");
  repository_.write("a b.iso", program(101, 81));
  commit();
  EXPECT_EQ(repository_.run("git merge -q side").status, 1);
  EXPECT_EQ(shown_by("git diff --cached"),
            "a b.iso (with merge conflicts)\nboth sides of the merge: isodiff ':2:a b.iso' ':3:a b.iso'\n");
  EXPECT_THAT(repository_.run("isodiff ':2:a b.iso' ':3:a b.iso'").out, HasSubstr("moved by X4"));
  EXPECT_THAT(shown_by("git diff --ours"), HasSubstr("a b.iso"));
}

TEST_F(IsodiffWithGit, OneUnreadableFileStopsNoLog) {
  repository_.write("a.iso", std::string(1000, '\0'));
  repository_.write("b.iso", program(100, 80));
  fs::create_symlink("b.iso", repository_.path("link.iso"));
  commit();
  const std::string shown = shown_by("git show --ext-diff");
  EXPECT_THAT(shown, HasSubstr("a.iso (new)\na.iso: looks like a binary file\n"));
  EXPECT_THAT(shown, HasSubstr("\nb.iso (new)\nT101001\n"));
  EXPECT_THAT(shown, HasSubstr("\nlink.iso (new)\nis not a regular file\n"));
}

/// What git 2.47 calls with diff.isocnc.trustExitCode.
TEST_F(IsodiffWithGit, TellsOfDifferencesWhereItIsAsked) {
  repository_.write("a.iso", program(100, 80));
  repository_.write("b.iso", program(101, 80));
  const std::string arguments = " --git x.iso a.iso . 100644 b.iso . 100644";
  EXPECT_EQ(repository_.run("isodiff" + arguments).status, 0);
  EXPECT_EQ(repository_.run("isodiff --exit-code" + arguments).status, 1);
  EXPECT_EQ(repository_.run("isodiff --exit-code --git x.iso a.iso . 100644 a.iso . 100644").status, 0);
}

TEST_F(IsodiffWithGit, RefusesWhatGitDoesNotCall) {
  const auto refusal = [&](const std::string& command) {
    const auto done = repository_.run(command);
    EXPECT_EQ(done.status, 2) << command;
    EXPECT_EQ(done.out, "") << command;
    return done.err;
  };
  const std::string arguments =
      "isodiff: --git is followed by the arguments that git gives, 1, 7 or 9, and by no options\n";
  EXPECT_EQ(refusal("isodiff --git"), arguments);
  EXPECT_EQ(refusal("isodiff --git a.iso b.iso"), arguments);
  EXPECT_EQ(refusal("isodiff --git --lang it x.iso a.iso . 100644 b.iso . 100644"), arguments);
  const std::string format = "isodiff: --git writes text or markdown, to standard output\n";
  EXPECT_EQ(refusal("isodiff --format json --git x.iso a.iso . 100644 b.iso . 100644"), format);
  EXPECT_EQ(refusal("isodiff -o x --git x.iso a.iso . 100644 b.iso . 100644"), format);
  EXPECT_THAT(refusal("isodiff --exit-code a.iso b.iso"), HasSubstr("--git"));
}

TEST_F(IsodiffWithGit, MarkdownIsReadAsNothingElse) {
  std::string longer = "M06 T101001\nS12000 M03\nG00 X0 Y0 Z40\nG01 Z-5 F2000\n";
  std::string other = longer;
  for (int i = 1; i <= 40; ++i) {
    const std::string x = "X" + std::to_string(i);
    longer += x + " F" + std::to_string(1000 + i % 2) + "\n";
    other += x + " F" + std::to_string(2000 + i % 2) + "\n";
  }
  repository_.write("`a`.iso", longer + "M02\n");
  repository_.write("<b>.iso", other + "M02\n");
  const std::string shown = repository_.run("isodiff --format markdown '`a`.iso' '<b>.iso'").out;
  EXPECT_THAT(shown,
              StartsWith("### `` `a`.iso -> <b>.iso ``\n\n<details><summary>40 differences</summary>\n\n```text\n"));
  EXPECT_THAT(shown, EndsWith("\n40 differences\n```\n\n</details>\n"));
}

}  // namespace
}  // namespace isocnc::git
