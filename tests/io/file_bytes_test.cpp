#include "lapwing/io/file_bytes.h"

#include <array>
#include <ostream>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/image.h"
#include "lapwing/io/mesh_file.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(FileBytes, OfAPipeThatNobodyWritesIntoAreRefusedAtOnce) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.obj").c_str(), 0600), 0);
  EXPECT_THAT(error_message<IoError>([&] { FileBytes::read(folder / "pipe.obj"); }),
              HasSubstr("not a regular file"));
}

TEST(FileBytes, OfAFolderOrADeviceAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_message<IoError>([&] { FileBytes::read(folder.path()); }),
              HasSubstr("not a regular file"));
  EXPECT_THAT(error_message<IoError>([] { FileBytes::read("/dev/zero"); }),
              HasSubstr("not a regular file"));
}

struct OtherKind {
  std::string content;
  std::string message;  ///< a part of it

  friend void PrintTo(const OtherKind& other, std::ostream* out) { *out << other.message; }
};

const std::array kOtherKinds{
    OtherKind{"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n",
              "Git LFS pointer, which only names its content; run `git lfs pull`"},
    OtherKind{"<!DOCTYPE html>\n<html>", "web page (HTML); download the file itself"},
    OtherKind{"\xEF\xBB\xBF\r\n <HTML lang=\"en\">", "web page (HTML)"},
    OtherKind{"\x1F\x8B\x08", "compressed by gzip; decompress it"},
    OtherKind{"PK\x03\x04\x14", "zip archive; unpack it"},
};

class FileOfAnotherKind : public ::testing::TestWithParam<OtherKind> {};

TEST_P(FileOfAnotherKind, IsNamedInsteadOfAnErrorOfItsFormat) {
  const TemporaryFolder folder;
  for (const std::string name : {"a.obj", "a.off", "a.ply", "a.stl", "a.glb", "a.gltf"}) {
    const auto path = folder.file(name, GetParam().content);
    const std::string start = path.string() + ": the file is ";
    EXPECT_THAT(error_message<InputError>([&] { read_mesh(path); }),
                AllOf(StartsWith(start), HasSubstr(GetParam().message)));
    EXPECT_THAT(error_message<InputError>([&] { read_damaged_mesh(path); }), StartsWith(start));
  }
  EXPECT_THAT(
      error_message<InputError>([&] { read_image(folder.file("a.png", GetParam().content)); }),
      HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(All, FileOfAnotherKind, ::testing::ValuesIn(kOtherKinds));

}  // namespace
}  // namespace lapwing
