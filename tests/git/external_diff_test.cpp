#include "interpreter/git/external_diff.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace isocnc::git {
namespace {

using dialect::Language;
using Arguments = std::vector<std::string>;

const std::string kObject(40, 'a');

std::string heading_of(const Arguments& arguments, Language language = Language::English) {
  const auto diff = read_external_diff(arguments);
  return diff ? diff->heading(language) : "none";
}

TEST(ExternalDiff, HasTwoVersions) {
  const auto diff = read_external_diff(Arguments{"a b.iso", "/tmp/x", kObject, "100644", "a b.iso", ".", "100755"});
  ASSERT_TRUE(diff);
  EXPECT_EQ(diff->old_version.path, "a b.iso");
  EXPECT_EQ(diff->old_version.file, "/tmp/x");
  EXPECT_EQ(diff->old_version.object, kObject);
  EXPECT_EQ(diff->old_version.mode, "100644");
  EXPECT_EQ(diff->new_version.path, "a b.iso");
  EXPECT_EQ(diff->new_version.file, "a b.iso");
  EXPECT_EQ(diff->new_version.mode, "100755");
  EXPECT_FALSE(diff->is_unmerged);
}

TEST(ExternalDiff, ItsHeadingSaysWhatChangesOfTheFile) {
  const std::string none = "/dev/null";
  EXPECT_EQ(heading_of({"a.iso", "x", kObject, "100644", "y", kObject, "100644"}), "a.iso");
  EXPECT_EQ(heading_of({"a.iso", "x", kObject, "100644", "y", kObject, "100755"}), "a.iso (mode 100644 -> 100755)");
  EXPECT_EQ(heading_of({"a.iso", none, ".", ".", "y", kObject, "100644"}), "a.iso (new)");
  EXPECT_EQ(heading_of({"a.iso", "x", kObject, "100644", none, ".", "."}), "a.iso (deleted)");
  EXPECT_EQ(heading_of({"a.iso", "x", kObject, "100644", none, ".", "."}, Language::Italian), "a.iso (cancellato)");
  EXPECT_EQ(heading_of({"a.iso", "x", kObject, "100644", "y", kObject, "100644", "b.iso", "similarity index 90%\n"}),
            "a.iso -> b.iso");
  EXPECT_EQ(heading_of({"a.iso"}), "a.iso (with merge conflicts)");
}

TEST(ExternalDiff, KnowsWhatIsNoFile) {
  const auto link = read_external_diff(Arguments{"a.iso", "x", kObject, "120000", "y", kObject, "100644"});
  ASSERT_TRUE(link);
  EXPECT_FALSE(link->old_version.is_file());
  EXPECT_TRUE(link->new_version.is_file());
}

TEST(ExternalDiff, IsNothingElse) {
  const Arguments right = {"a.iso", "x", kObject, "100644", "y", kObject, "100644", "b.iso", ""};
  for (const std::size_t count : {0U, 2U, 3U, 6U, 8U})
    EXPECT_EQ(heading_of(Arguments(right.begin(), right.begin() + static_cast<std::ptrdiff_t>(count))), "none");
  // Options where git's arguments should begin.
  EXPECT_EQ(heading_of({"--lang", "it", "a.iso", "x", kObject, "100644", "y", kObject, "100644"}), "none");
  EXPECT_EQ(heading_of({"a.iso", "x", "no object", "100644", "y", kObject, "100644"}), "none");
  EXPECT_EQ(heading_of({"a.iso", "x", kObject, "100648", "y", kObject, "100644"}), "none");
  EXPECT_EQ(heading_of({"a.iso", "", kObject, "100644", "y", kObject, "100644"}), "none");
}

}  // namespace
}  // namespace isocnc::git
