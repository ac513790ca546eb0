#include "analyzer/transforming/proof.h"

#include <gtest/gtest.h>

namespace isocnc::transforming {
namespace {

constexpr std::string_view kPart =
    "M06 T101001\n"           // 1
    "S9000 M03\n"             // 2
    "G00 X0 Y0 Z5 B30 C20\n"  // 3
    "G01 X10 F1000\n"         // 4
    "G02 X20 Y10 I20 J0\n"    // 5
    "G41\n"                   // 6
    "G01 X50\n"               // 7
    "Y60\n"                   // 8
    "G40\n"                   // 9
    "G29 X5 B90 C10\n"        // 10
    "G00 X1 Y2 Z3\n"          // 11
    "G27\n"                   // 12
    "M100 P1=3\n"             // 13
    "G04 P1\n"                // 14
    "M02\n";                  // 15
constexpr std::string_view kMirroredPart =
    "M06 T101001\nS9000 M03\nG00 X800 Y0 Z5 B-30 C-20\nG01 X790 F1000\nG03 X780 Y10 I780 J0\nG42\nG01 X750\nY60\nG40\n"
    "G29 X795 B-90 C-10\nG00 X-1 Y2 Z3\nG27\nM100 P1=3\nG04 P1\nM02\n";

std::optional<TransformationRefusal> difference(std::string_view transformed) {
  const Transformation mirror{Movement::MirrorX, {400, 0, 0}};
  return find_difference(kPart, transformed, ProgramMap(mirror, kPart), {}, dialect::Language::English);
}

TEST(Proof, FindsNothingWhereAllIsMirrored) { EXPECT_FALSE(difference(kMirroredPart)); }

struct Slip {
  std::string_view right;
  std::string_view wrong;
  std::size_t line;  ///< From 1, where it shows.
  TransformObstacle obstacle;
};

TEST(Proof, FindsEachSlip) {
  const Slip slips[] = {
      {"T101001", "T101002", 1, TransformObstacle::EffectDiffers},
      {"S9000", "S9001", 2, TransformObstacle::EffectDiffers},
      {"M03", "M04", 2, TransformObstacle::EffectDiffers},
      {"X800", "X799.99", 3, TransformObstacle::PlaceDiffers},
      {"B-30", "B30", 3, TransformObstacle::PlaceDiffers},
      {"C-20", "C20", 3, TransformObstacle::PlaceDiffers},
      {"X790", "X790.001", 4, TransformObstacle::PlaceDiffers},
      {"G01 X790", "G00 X790", 4, TransformObstacle::EffectDiffers},
      {"F1000", "F1001", 4, TransformObstacle::FeedDiffers},
      {"G03 X780", "G02 X780", 5, TransformObstacle::ArcDiffers},
      {"X780 Y10 I780 J0", "X780 Y10 I790 J10", 5, TransformObstacle::ArcDiffers},
      {"I780 J0", "I780 J5", 5, TransformObstacle::NewError},
      {"G42", "G41", 7, TransformObstacle::SideDiffers},
      {"G42", "", 7, TransformObstacle::SideDiffers},
      {"X795", "X796", 10, TransformObstacle::FaceUnknown},
      {"B-90", "B90", 10, TransformObstacle::FaceUnknown},
      {"C-10", "C10", 10, TransformObstacle::FaceUnknown},
      {"X-1 ", "X1 ", 11, TransformObstacle::PlaceDiffers},
      {"G27", "", 12, TransformObstacle::EffectDiffers},
      {"P1=3", "P1=-3", 13, TransformObstacle::EffectDiffers},
      {"G04 P1", "G04 P2", 14, TransformObstacle::EffectDiffers},
      {"G04 P1", "M02", 14, TransformObstacle::EffectDiffers},
      {"M02", "", 15, TransformObstacle::EffectDiffers},
  };
  for (const Slip& slip : slips) {
    std::string text(kMirroredPart);
    const std::size_t place = text.find(slip.right);
    ASSERT_NE(place, std::string::npos) << slip.right;
    text.replace(place, slip.right.size(), slip.wrong);
    const auto found = difference(text);
    ASSERT_TRUE(found) << slip.right << " as " << slip.wrong;
    EXPECT_EQ(found->line + 1, slip.line) << slip.right << " as " << slip.wrong;
    EXPECT_EQ(found->obstacle, slip.obstacle) << slip.right << " as " << slip.wrong;
  }
}

}  // namespace
}  // namespace isocnc::transforming
