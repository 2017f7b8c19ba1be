#include "work/doctor_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/broken_meshes.h"
#include "lapwing/doctor/fix.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing::viewer {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(DoctorWords, OfASoundMeshAreNone) {
  EXPECT_THAT(problems_in_words(check(icosphere(2))), IsEmpty());
}

TEST(DoctorWords, CountInTheSingularToo) {
  EXPECT_EQ(problems_in_words(check(three_winged_edge())), "1 edge with more than two faces");
  Mesh mesh = bow_tie();
  add_polygon(mesh, {0, 1, 2});
  add_polygon(mesh, {0, 1, 1, 2});
  const std::string words = problems_in_words(check(mesh));
  EXPECT_THAT(words, HasSubstr("1 face that repeats a vertex"));
  EXPECT_THAT(words, HasSubstr("1 repeated face"));
}

TEST(DoctorWords, GroupLargeNumbers) {
  Mesh mesh = icosphere(1);
  mesh.positions.resize(mesh.positions.size() + 12345, Eigen::Vector3d(9, 9, 9));
  EXPECT_THAT(problems_in_words(check(mesh)), HasSubstr("12,345 loose vertices"));
}

TEST(DoctorWords, TellWhatKeepsAnEditOffFromWhatDoesNot) {
  EXPECT_THAT(hindrance_in_words(check(bow_tie())), HasSubstr("can edit the mesh"));
  Mesh mesh = icosphere(1);
  mesh.positions[3].x() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(hindrance_in_words(check(mesh)),
              HasSubstr("cannot include vertices without a valid position"));
}

TEST(DoctorWords, SayWhatWasRepaired) {
  Mesh mesh = unwelded_square();
  mesh.positions.emplace_back(5, 5, 5);
  EXPECT_EQ(repairs_in_words(fix(mesh)),
            "2 vertices welded into another along seams, 1 loose vertex removed");
}

TEST(DoctorWords, OfAnEmptyMeshSayWhatItHoldsAndWhatToDo) {
  EXPECT_THAT(emptiness_in_words("a.obj", check(Mesh()).statistics), HasSubstr("no vertices"));
  Mesh cloud;
  cloud.positions.resize(1204, Eigen::Vector3d::Zero());
  const std::string words = emptiness_in_words("cloud.ply", check(cloud).statistics);
  EXPECT_THAT(words, HasSubstr("cloud.ply has 1,204 vertices and no faces"));
  EXPECT_THAT(words, HasSubstr("Attach object"));
}

}  // namespace
}  // namespace lapwing::viewer
