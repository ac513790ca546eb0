#include "interpreter/system/system_texts.h"

#include <gtest/gtest.h>

#include <cerrno>

namespace isocnc::system {
namespace {

using dialect::Language;

TEST(SystemTexts, SayWhyInTheReadersLanguage) {
  EXPECT_EQ(cannot_read(ENOENT, Language::English), "cannot read: No such file or directory");
  EXPECT_EQ(cannot_read(ENOENT, Language::Italian), "non si può leggere: file o directory non esistente");
  EXPECT_EQ(cannot_write(ENOSPC, Language::English), "cannot write: No space left on device");
  EXPECT_EQ(cannot_write(ENOSPC, Language::Italian), "non si può scrivere: spazio su disco esaurito");
}

TEST(SystemTexts, ErrorsWithoutATextOfOursHaveTheSystems) {
  EXPECT_EQ(cannot_read(ENOTTY, Language::English), "cannot read: Inappropriate ioctl for device");
}

}  // namespace
}  // namespace isocnc::system
