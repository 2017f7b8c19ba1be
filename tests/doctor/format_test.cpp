#include "lapwing/doctor/format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/broken_meshes.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(Format, CleanMeshSaysSo) {
  EXPECT_EQ(format(check(icosphere(1))), "no defects\n");
}

TEST(Format, DefectLineHoldsCountPlacesMeaningAndNextStep) {
  const std::string text = format(check(unwelded_square()));
  EXPECT_THAT(text, AllOf(HasSubstr("warning  2 unwelded seam edges"), HasSubstr("edges 1-2, 3-4"),
                          HasSubstr("edits them as one surface"), HasSubstr("--fix OUT"),
                          EndsWith("1 kind of defect, 1 repairable\n")));
}

TEST(Format, LongListsEndInDots) {
  Mesh mesh = grid(1, 1);
  for (int i = 0; i < 9; ++i) mesh.positions.emplace_back(i, 9, 9);
  EXPECT_THAT(format(check(mesh)), HasSubstr("vertices 4, 5, 6, 7, 8, 9, 10, 11, ...\n"));
}

TEST(Format, InformationAloneIsNoDefect) {
  Mesh mesh = unwelded_square();
  for (std::size_t v = 3; v < 6; ++v) mesh.positions[v].z() += 5.0;
  EXPECT_THAT(format(check(mesh)), AllOf(HasSubstr("info     2 components"),
                                         HasSubstr("at vertices 0, 3"), EndsWith("no defects\n")));
}

TEST(Format, HolesHaveTheNumbersOfTheirRimVertices) {
  EXPECT_THAT(format(check(cylinder(9, 5, 1.0, 2.0))),
              AllOf(HasSubstr("info     2 holes"), HasSubstr("at vertices 0, 36, with 9 and 9 rim "
                                                             "vertices\n")));
}

TEST(Format, StatisticsNameGenusAndBoundary) {
  EXPECT_THAT(format(check(torus(8, 6, 2.0, 0.5)).statistics),
              AllOf(HasSubstr("Euler number  0, genus 1\n"), HasSubstr("boundary      none\n")));
  EXPECT_THAT(format(check(grid(2, 2)).statistics), HasSubstr("boundary      8 edges in 1 loop\n"));
}

TEST(Format, FixReportCountsEachRepair) {
  Mesh mesh = bow_tie();
  mesh.positions.emplace_back(9, 9, 9);
  EXPECT_EQ(format(fix(mesh)),
            "1 loose vertex removed\n1 bow-tie vertex split into one vertex per surface\n");
  EXPECT_EQ(format(fix(mesh)), "nothing to repair\n");
}

}  // namespace
}  // namespace lapwing
