#include <random>

#include <gtest/gtest.h>

#include "io/rich_mesh.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {
namespace {

// Small valid files of every format, cut short and with bytes changed: each either reads as a mesh
// whose faces name vertices it has, or is refused as malformed.
class Mutation : public ::testing::TestWithParam<Storage> {
 protected:
  void SetUp() override {
    const auto path = folder_ / GetParam().name;
    write_mesh(rich_mesh(), path, {.encoding = GetParam().encoding});
    bytes_ = content_of(path);
  }

  void expect_read_or_refused(const std::string& bytes) {
    const auto path = folder_.file("x-" + GetParam().name, bytes);
    try {
      const Mesh mesh = read_mesh(path);
      EXPECT_NO_THROW(validate_indices(mesh));
      EXPECT_EQ(mesh.face_starts().back(), mesh.face_vertices().size());
    } catch (const InputError&) {
      ++refused_;
    }
  }

  TemporaryFolder folder_;
  std::string bytes_;
  int refused_ = 0;
};

TEST_P(Mutation, CutFilesAreReadOrRefused) {
  for (std::size_t size = 0; size < bytes_.size(); size += 1 + bytes_.size() / 120) {
    expect_read_or_refused(bytes_.substr(0, size));
  }
  EXPECT_GT(refused_, 50);
}

TEST_P(Mutation, FilesWithChangedBytesAreReadOrRefused) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::string bytes = bytes_;
    for (int change = 0; change < 1 + trial % 4; ++change) {
      // Half of the changes hit the header, where the counts are.
      const std::size_t range =
          change % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 600);
      bytes[random() % range] = static_cast<char>(random() % 256);
    }
    expect_read_or_refused(bytes);
  }
  EXPECT_GT(refused_, 0);
}

TEST_P(Mutation, FilesWithChangedDigitsAreReadOrRefused) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    std::string bytes = bytes_;
    for (int change = 0; change < 20; ++change) {
      char& byte = bytes[random() % bytes.size()];
      if (byte >= '0' && byte <= '9') byte = "0123456789-+.e/ \n#n"[random() % 19];
    }
    expect_read_or_refused(bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Mutation, ::testing::ValuesIn(kStorages));
INSTANTIATE_TEST_SUITE_P(Gltf, Mutation,
                         ::testing::Values(Storage{"a.glb", Encoding::little_endian}));

}  // namespace
}  // namespace lapwing
