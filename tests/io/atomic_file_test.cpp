#include "lapwing/io/atomic_file.h"

#include <signal.h>
#include <sys/resource.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

// While this object exists, no file of this process can exceed the limit, as on a full disk.
class SmallFilesOnly {
 public:
  explicit SmallFilesOnly(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    old_handler_ = ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallFilesOnly() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, old_handler_);
  }
  SmallFilesOnly(const SmallFilesOnly&) = delete;
  SmallFilesOnly& operator=(const SmallFilesOnly&) = delete;

 private:
  rlimit before_{};
  void (*old_handler_)(int) = nullptr;
};

// File permissions do not restrict the superuser. While this object exists, the process therefore
// runs as the user nobody, who owns the folder and its files.
class Unprivileged {
 public:
  explicit Unprivileged(const fs::path& folder) {
    if (::geteuid() != 0) return;
    constexpr uid_t kNobody = 65534;
    bool changed = ::chown(folder.c_str(), kNobody, kNobody) == 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
      changed = changed && ::chown(entry.path().c_str(), kNobody, kNobody) == 0;
    }
    if (!changed || ::seteuid(kNobody) != 0) throw std::runtime_error("cannot change the user");
    changed_ = true;
  }
  ~Unprivileged() {
    if (changed_ && ::seteuid(0) != 0) std::abort();
  }
  Unprivileged(const Unprivileged&) = delete;
  Unprivileged& operator=(const Unprivileged&) = delete;

 private:
  bool changed_ = false;
};

std::size_t files_in(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

TEST(ReplaceFile, MakesAFileAndReplacesIt) {
  const TemporaryFolder folder;
  replace_file(folder / "a.txt", "one");
  replace_file(folder / "a.txt", "two and more");
  EXPECT_EQ(content_of(folder / "a.txt"), "two and more");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(ReplaceFile, FailedWriteLeavesTheOldFileAndNoTemporary) {
  const TemporaryFolder folder;
  folder.file("mesh.obj", "v 1 2 3\n");
  {
    const SmallFilesOnly full(1024);
    EXPECT_THROW(write_mesh(icosphere(2), folder / "mesh.obj"), IoError);
  }
  EXPECT_EQ(content_of(folder / "mesh.obj"), "v 1 2 3\n");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(ReplaceFile, KeepsPermissionBits) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "one");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  replace_file(path, "two");
  EXPECT_EQ(fs::status(path).permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST(ReplaceFile, FollowsASymbolicLinkAndKeepsIt) {
  const TemporaryFolder folder;
  folder.file("target.txt", "one");
  fs::create_symlink("target.txt", folder / "link.txt");
  replace_file(folder / "link.txt", "two");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(content_of(folder / "target.txt"), "two");
}

TEST(ReplaceFile, MakesTheTargetOfADanglingLink) {
  const TemporaryFolder folder;
  fs::create_symlink("later.txt", folder / "link.txt");
  replace_file(folder / "link.txt", "here");
  EXPECT_EQ(content_of(folder / "later.txt"), "here");
}

TEST(ReplaceFile, RefusesWhatCannotBeReplacedWithTheReason) {
  const TemporaryFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  const auto reason_of = [](const fs::path& path) {
    return error_message<IoError>([&] { replace_file(path, "x"); });
  };
  EXPECT_THAT(reason_of(folder.path()), ::testing::HasSubstr("Is a directory"));
  EXPECT_THAT(reason_of(folder / "none/a.txt"), ::testing::HasSubstr("No such file"));
  EXPECT_THAT(reason_of(folder / "a"), ::testing::HasSubstr("symbolic links"));
  EXPECT_THAT(reason_of("/dev/null"), ::testing::HasSubstr("not a regular file"));
}

TEST(ReplaceFile, ReadOnlyFileStays) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "one");
  fs::permissions(path, fs::perms::owner_read);
  const Unprivileged user(folder.path());
  EXPECT_THROW(replace_file(path, "two"), IoError);
  EXPECT_EQ(content_of(path), "one");
}

TEST(ReplaceFile, ReadOnlyFolderKeepsItsFile) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "one");
  const Unprivileged user(folder.path());
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(replace_file(path, "two"), IoError);
  fs::permissions(folder.path(), fs::perms::owner_all);
  EXPECT_EQ(content_of(path), "one");
}

TEST(FileReplacement, IsThereOnceItIsCommitted) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "old");
  {
    FileReplacement replacement(path);
    std::ofstream(replacement.temporary()) << "by another program";
    EXPECT_EQ(content_of(path), "old");
    EXPECT_EQ(replacement.temporary().parent_path(), path.parent_path());
    replacement.commit();
  }
  EXPECT_EQ(content_of(path), "by another program");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(FileReplacement, IsTheUsersAloneUntilItIsWhole) {
  const TemporaryFolder folder;
  FileReplacement replacement(folder / "a.txt");
  EXPECT_EQ(fs::status(replacement.temporary()).permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  replacement.commit();
  folder.file("as-the-system-makes-it.txt", "");
  EXPECT_EQ(fs::status(folder / "a.txt").permissions(),
            fs::status(folder / "as-the-system-makes-it.txt").permissions());
}

TEST(FileReplacement, HasNoNameWhileNobodyAsks) {
  const TemporaryFolder folder;
  FileReplacement replacement(folder / "a.txt");
  replacement.write("new");
  EXPECT_EQ(files_in(folder), 0U);
  replacement.commit();
  EXPECT_EQ(content_of(folder / "a.txt"), "new");
}

TEST(FileReplacements, ChangeNothingUntilAllAreWhole) {
  const TemporaryFolder folder;
  folder.file("a.txt", "old a");
  folder.file("b.txt", "old b");
  FileReplacements files;
  files.add(folder / "a.txt", "new a");
  EXPECT_THROW(files.add(folder / "none/b.txt", "new b"), IoError);
  files.add(folder / "b.txt", "new b");
  EXPECT_EQ(content_of(folder / "a.txt"), "old a");
  EXPECT_EQ(content_of(folder / "b.txt"), "old b");
  files.commit();
  EXPECT_EQ(content_of(folder / "a.txt"), "new a");
  EXPECT_EQ(content_of(folder / "b.txt"), "new b");
  EXPECT_EQ(files_in(folder), 2U);
}

TEST(FileReplacements, SayWhichAreInPlaceWhereALaterOneCannotBe) {
  const TemporaryFolder folder;
  FileReplacements files;
  files.add(folder / "a.txt", "new a");
  files.add(folder / "b.txt", "new b");
  fs::create_directory(folder / "b.txt");
  EXPECT_THAT(error_message<IoError>([&] { files.commit(); }),
              ::testing::HasSubstr("Already written: " + (folder / "a.txt").string()));
}

TEST(RequireReplaceable, TellsBeforeTheWorkWhatReplacingWouldTell) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(require_replaceable(folder / "a.txt"));
  EXPECT_NO_THROW(require_replaceable(folder.file("b.txt", "")));
  EXPECT_THROW(require_replaceable(folder / "none/a.txt"), IoError);
  EXPECT_THROW(require_replaceable(folder.path()), IoError);
  EXPECT_THROW(require_replaceable("/dev/null"), IoError);
  const fs::path fixed = folder.file("fixed.txt", "one");
  fs::permissions(fixed, fs::perms::owner_read);
  const Unprivileged user(folder.path());
  EXPECT_THROW(require_replaceable(fixed), IoError);
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(require_replaceable(folder / "a.txt"), IoError);
  EXPECT_THROW(require_replaceable(folder / "b.txt"), IoError);
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(FileReplacement, WithoutCommitLeavesTheOldFileAndNoTemporary) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "old");
  FileReplacement(path).write("new");
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(files_in(folder), 1U);
}

}  // namespace
}  // namespace lapwing
