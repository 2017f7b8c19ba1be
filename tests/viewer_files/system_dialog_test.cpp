#include "files/system_dialog.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/environment.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using What = DialogAnswer::What;

template <typename Happened>
bool soon(Happened happened) {
  for (int k = 0; k < 2000; ++k) {
    if (happened()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return happened();
}

// A program that stands for zenity.
class Dialog : public ::testing::Test {
 protected:
  fs::path program(const std::string& script) const {
    const fs::path path = folder_.file("zenity", "#!/bin/sh\n" + script);
    fs::permissions(path, fs::perms::owner_all);
    return path;
  }
  DialogAnswer answer(const std::string& script) const {
    SystemDialog dialog({program(script), "--title=a b"});
    std::optional<DialogAnswer> answer;
    EXPECT_TRUE(soon([&] { return (answer = dialog.take()).has_value(); }));
    return answer.value_or(DialogAnswer{});
  }
  TemporaryFolder folder_;
};

TEST_F(Dialog, AnswersWithThePathThatWasChosen) {
  const DialogAnswer chosen = answer("echo '/tmp/größe 1/my \"hand\".ply'");
  EXPECT_EQ(chosen.what, What::chosen);
  EXPECT_EQ(chosen.path, "/tmp/größe 1/my \"hand\".ply");
}

TEST_F(Dialog, IsStartedWithoutAShell) {
  EXPECT_EQ(answer("echo \"/$1\"").path, "/--title=a b");
}

TEST_F(Dialog, TellsCancelledFromFailed) {
  EXPECT_EQ(answer("exit 1").what, What::cancelled);
  const DialogAnswer blind = answer("echo 'Gtk-WARNING: cannot open display: :7' >&2; exit 1");
  EXPECT_EQ(blind.what, What::failed);
  EXPECT_THAT(blind.reason, HasSubstr("cannot open display: :7"));
  EXPECT_THAT(answer("echo one >&2; echo 'no such option' >&2; exit 255").reason,
              HasSubstr("zenity: no such option"));
  EXPECT_THAT(answer("exit 3").reason, HasSubstr("code 3"));
  EXPECT_THAT(answer("exit 0").reason, HasSubstr("returned no file"));
  EXPECT_THAT(answer("kill -SEGV $$").reason, HasSubstr("signal 11"));
}

TEST_F(Dialog, OfAProgramThatIsNotThereThrows) {
  EXPECT_THROW(SystemDialog({(folder_ / "nothing").string()}), IoError);
}

TEST_F(Dialog, ThatNeverAnswersHoldsNobodyUpAndEndsWithAllThatItStarted) {
  const fs::path started = folder_ / "started";
  const std::string script = "sleep 600 &\necho $! > " + started.string() + ".new\nmv " +
                             started.string() + ".new " + started.string() + "\nwait";
  pid_t child = 0;
  {
    SystemDialog dialog({program(script)});
    ASSERT_TRUE(soon([&] { return fs::exists(started); }));
    EXPECT_FALSE(dialog.take());
    child = std::stoi(content_of(started));
  }
  // A zombie until whoever takes orphans looks after it.
  EXPECT_TRUE(soon([&] {
    const std::string status = content_of("/proc/" + std::to_string(child) + "/stat");
    return status.empty() || status.find(") Z") != std::string::npos;
  }));
}

TEST_F(Dialog, ThatClosesItsOutputAndStaysIsGivenUpToo) {
  const SystemDialog dialog({program("exec >&- 2>&-; sleep 600")});
}

TEST_F(Dialog, WakesTheWindowWhenItHasAnAnswer) {
  std::atomic<int> woken = 0;
  SystemDialog dialog({program("echo /a")}, [&] { ++woken; });
  EXPECT_TRUE(soon([&] { return woken == 1; }));
  EXPECT_TRUE(dialog.take());
  EXPECT_FALSE(dialog.take()) << "once";
}

TEST_F(Dialog, IsFoundOnThePathWhereThereIsADisplay) {
  const test::Environment path("PATH", "/nowhere::" + folder_.path().string());
  const test::Environment desktop("XDG_CURRENT_DESKTOP", "X-Cinnamon");
  const test::Environment wayland("WAYLAND_DISPLAY", "");
  const test::Environment display("DISPLAY", ":7");
  EXPECT_FALSE(find_dialog_program()) << "no program";
  const fs::path zenity = program("");
  ASSERT_TRUE(find_dialog_program());
  EXPECT_EQ(find_dialog_program()->path, zenity);
  fs::copy_file(zenity, folder_ / "kdialog");
  EXPECT_EQ(find_dialog_program()->kind, DialogProgram::Kind::zenity);
  {
    const test::Environment kde("XDG_CURRENT_DESKTOP", "KDE");
    EXPECT_EQ(find_dialog_program()->kind, DialogProgram::Kind::kdialog);
  }
  const test::Environment none("DISPLAY", "");
  EXPECT_FALSE(find_dialog_program()) << "no display";
}

TEST(DialogCommand, SaysWhatIsAskedFor) {
  const DialogProgram zenity{DialogProgram::Kind::zenity, "/bin/zenity"};
  EXPECT_THAT(dialog_command(zenity, {PathPurpose::save_recipe, "/a b", "hand.json"}),
              ElementsAre("/bin/zenity", "--file-selection", "--title=Save recipe", "--save",
                          "--filename=/a b/hand.json", "--file-filter=Recipes | *.json *.JSON",
                          "--file-filter=All files | *"));
  EXPECT_THAT(dialog_command(zenity, {PathPurpose::parts_folder, "/a", ""}),
              ElementsAre("/bin/zenity", "--file-selection", "--title=Choose parts folder",
                          "--directory", "--filename=/a/"));
  const DialogProgram kdialog{DialogProgram::Kind::kdialog, "/bin/kdialog"};
  EXPECT_THAT(dialog_command(kdialog, {PathPurpose::save_picture, "/a", "hand.png"}),
              ElementsAre("/bin/kdialog", "--title", "Save image", "--getsavefilename",
                          "/a/hand.png", "*.png *.PNG|Images\n*|All files"));
}

}  // namespace
}  // namespace lapwing::viewer
