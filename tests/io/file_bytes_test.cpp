#include "lapwing/io/file_bytes.h"

#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;

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

}  // namespace
}  // namespace lapwing
