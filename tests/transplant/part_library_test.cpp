#include "lapwing/transplant/part_library.h"

#include <chrono>

#include <gmock/gmock.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/transplant/loop_curve.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A cone cut off: its loops are of different lengths.
Mesh funnel() {
  Mesh mesh = cylinder(12, 5, 0.5, 2.0);
  for (auto& p : mesh.positions) p.head<2>() *= 1.0 + p.z();
  return mesh;
}

struct PartLibrary : testing::Test {
  TemporaryFolder temporary;
  std::filesystem::path folder = temporary / "parts";
  std::filesystem::path funnel_path = temporary / "funnel.obj";

  void SetUp() override { write_mesh(funnel(), funnel_path); }

  AddedPart add(const std::string& name = "", std::optional<std::size_t> loop = std::nullopt) {
    return add_part(folder, funnel_path, name, loop);
  }
  template <class Act>
  static std::string refused(Act&& act) {
    return error_message<InputError>(act);
  }
};

TEST_F(PartLibrary, AddedPartIsFoundAsItWasAdded) {
  const AddedPart added = add("horn", 0);
  EXPECT_THAT(part_files(folder), ElementsAre(folder / "horn.obj"));
  const Part part = find_part(folder, "horn");
  EXPECT_EQ(part.name, "horn");
  EXPECT_EQ(part.mesh.positions, funnel().positions);
  EXPECT_EQ(part.loops, added.part.loops);
  EXPECT_EQ(part.loop, 0U);
}

TEST_F(PartLibrary, BareMeshIsAPartJoinedAtItsLongestLoop) {
  const Part part = read_part(funnel_path);
  EXPECT_EQ(part.name, "funnel");
  ASSERT_EQ(part.loops.size(), 2U);
  const auto& positions = part.mesh.positions;
  EXPECT_EQ(part.loop, 1U);
  EXPECT_GT(loop_length(part.loops[1], positions), 2.0 * loop_length(part.loops[0], positions));
  EXPECT_EQ(add().part.loop, 1U);
}

TEST_F(PartLibrary, ClosedMeshIsNoPart) {
  write_mesh(icosphere(1), temporary / "ball.obj");
  EXPECT_THAT(refused([&] { add_part(folder, temporary / "ball.obj", "", {}); }),
              AllOf(HasSubstr("ball.obj"), HasSubstr("`lapwing cut`")));
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST_F(PartLibrary, LoopThatIsNotThereIsNamed) {
  EXPECT_THAT(refused([&] { add("", 2); }),
              AllOf(HasSubstr("loop 2"), HasSubstr("2 boundary loops")));
  temporary.file("funnel.json", "{\"loop\": 5}");
  EXPECT_THAT(refused([&] { read_part(funnel_path); }),
              AllOf(HasSubstr("funnel.json: /loop"), HasSubstr("loop 5")));
  temporary.file("funnel.json", "{\"lop\": 1}");
  EXPECT_THAT(refused([&] { read_part(funnel_path); }), HasSubstr("\"loop\""));
}

TEST_F(PartLibrary, NamesAreFileNamesAndTakenOnce) {
  add("horn");
  EXPECT_THAT(refused([&] { add("horn"); }), AllOf(HasSubstr("horn.obj"), HasSubstr("--name")));
  EXPECT_NE(refused([&] { add("../horn"); }), "");
  EXPECT_NE(refused([&] { add(".horn"); }), "");
  add("horn.2");
  EXPECT_EQ(find_part(folder, "horn.2").name, "horn.2");
  EXPECT_THAT(part_files(folder), ElementsAre(folder / "horn.obj", folder / "horn.2.obj"));
  std::filesystem::remove(folder / "horn.2.obj");
  EXPECT_THAT(refused([&] { add("horn.2"); }), HasSubstr("horn.2.json"));
}

TEST_F(PartLibrary, TakesAMeshThatIsInNoFile) {
  const AddedPart added = add_part(folder, cylinder(12, 5, 1.0, 2.0), "horn.3");
  EXPECT_EQ(added.part.mesh_path, folder / "horn.3.obj");
  const Part read = find_part(folder, "horn.3");
  EXPECT_EQ(read.mesh.positions, added.part.mesh.positions);
  EXPECT_EQ(read.loop, added.part.loop);
  EXPECT_THAT(refused([&] { add_part(folder, icosphere(1), "ball"); }), HasSubstr("ball"));
}

TEST_F(PartLibrary, UnknownPartIsAnsweredWithThoseThatAreThere) {
  add("horn");
  add("tail");
  EXPECT_THAT(refused([&] { find_part(folder, "wing"); }), HasSubstr("the folder has horn, tail"));
  EXPECT_NE(error_message<IoError>([&] { part_files(temporary / "nowhere"); }), "");
}

TEST_F(PartLibrary, PictureIsWrittenOverNothingButItsOwn) {
  const auto path = add("horn").part.mesh_path;
  const Image picture{.width = 1, .height = 1, .rgba = {9, 9, 9, 255}};
  EXPECT_TRUE(picture_may_be_written(path));
  write_part_picture(path, picture);
  EXPECT_TRUE(picture_may_be_written(path));
  EXPECT_EQ(read_image(folder / "horn.png").rgba, picture.rgba);
  write_png(folder / "horn.png", picture);
  EXPECT_FALSE(picture_may_be_written(path)) << "a texture, say";
  std::filesystem::remove(folder / "horn.png");
  std::filesystem::create_symlink("elsewhere.png", folder / "horn.png");
  EXPECT_FALSE(picture_may_be_written(path)) << "a link";
}

TEST_F(PartLibrary, NameThatAPictureOfOthersHasIsTaken) {
  std::filesystem::create_directories(folder);
  temporary.file("parts/horn.png", "a texture");
  EXPECT_THAT(refused([&] { add("horn"); }), HasSubstr("horn.png already exists"));
}

TEST_F(PartLibrary, PictureIsCurrentUntilTheMeshOrTheDetailsChange) {
  const auto path = add("horn").part.mesh_path;
  EXPECT_FALSE(picture_is_current(path));
  temporary.file("parts/horn.png", "picture");
  EXPECT_TRUE(picture_is_current(path));
  const auto later = std::filesystem::last_write_time(folder / "horn.png") + std::chrono::hours(1);
  for (const std::string name : {"horn.obj", "horn.json"}) {
    const auto before = std::filesystem::last_write_time(folder / name);
    std::filesystem::last_write_time(folder / name, later);
    EXPECT_FALSE(picture_is_current(path)) << name;
    std::filesystem::last_write_time(folder / name, before);
  }
  std::filesystem::remove(folder / "horn.json");
  EXPECT_TRUE(picture_is_current(path));
}

}  // namespace
}  // namespace lapwing
