#include "lapwing/base/counted.h"

#include <gtest/gtest.h>

namespace lapwing {
namespace {

TEST(Counted, OneHasTheSingularAndOtherNumbersThePlural) {
  EXPECT_EQ(counted(0, "vertices"), "0 vertices");
  EXPECT_EQ(counted(1, "vertices"), "1 vertex");
  EXPECT_EQ(counted(2, "vertices"), "2 vertices");
  EXPECT_EQ(counted(26002, "free vertices"), "26002 free vertices");
}

TEST(Counted, OnlyTheNounThatIsCountedBecomesSingular) {
  EXPECT_EQ(counted(1, "unwelded seam edges"), "1 unwelded seam edge");
  EXPECT_EQ(counted(1, "edges with more than two faces"), "1 edge with more than two faces");
  EXPECT_EQ(counted(1, "vertices with all neighbours on one line"),
            "1 vertex with all neighbours on one line");
}

TEST(Counted, ItsVerbFollows) {
  EXPECT_EQ(counted(1, "faces that repeat a vertex"), "1 face that repeats a vertex");
  EXPECT_EQ(counted(3, "faces that cut through others"), "3 faces that cut through others");
  EXPECT_EQ(counted(1, "faces that repeated a vertex cut down to their proper parts"),
            "1 face that repeated a vertex cut down to their proper parts");
}

TEST(Counted, PartOfACountBeforeHasNoNoun) {
  EXPECT_EQ(counted(1, "of these had another colour; that was kept"),
            "1 of these had another colour; that was kept");
}

}  // namespace
}  // namespace lapwing
