#include "lapwing/transplant/join.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "transplant/loop_scenes.h"

namespace lapwing {
namespace {

TEST(Join, PutsHostPartAndStripOneAfterTheOther) {
  const test::Rim host = test::hole_in_sheet(8, test::circle(1.0));
  const test::Rim part = test::flat_part(6, test::circle(0.5));
  const Joined joined = test::join(host, part, test::zip(host, part));
  EXPECT_EQ(joined.mesh.vertex_count(), 16U + 12U);
  EXPECT_EQ(joined.mesh.face_count(), 16U + 12U + 14U);
  EXPECT_EQ(joined.strip_faces.front(), 28U);
}

}  // namespace
}  // namespace lapwing
