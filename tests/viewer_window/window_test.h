#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_window/desktop.h"
#include "viewer_window/person.h"

namespace lapwing::test {

/// A person at a desktop of their own. Whoever derives from this and sets more up goes on only
/// where this is not skipped.
class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_DESKTOP();
    desktop_ = std::make_unique<Desktop>(folder_.path());
    person_ = std::make_unique<Person>(*desktop_, folder_.path());
  }

  /// Waits until the mesh is on the screen.
  void open(const std::filesystem::path& mesh) {
    person_->open(mesh);
    ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
    desktop_->settled_picture();
  }

  /// These functions wait until the screen differs from the image, or equals it.
  bool differs_from(const Image& picture, double by) const {
    return eventually(kPatienceSeconds,
                      [&] { return mean_difference(desktop_->picture(), picture) > by; });
  }
  bool shows(const Image& picture, double within) const {
    return eventually(kPatienceSeconds,
                      [&] { return mean_difference(desktop_->picture(), picture) < within; });
  }

  /// Waits for a window whose title begins with `name`.
  bool is_open(const std::string& name) const {
    return eventually(kPatienceSeconds, [&] { return has_window(name); });
  }
  bool has_window(const std::string& name) const {
    return !desktop_->xdotool("search --onlyvisible --name '^" + name + "'").empty();
  }

  /// These functions wait until the journal contains this draft.
  bool has_steps(std::size_t count) const {
    return person_->eventually_is(
        [&](const viewer::Draft& draft) { return draft.steps.size() == count; });
  }
  bool has_handles(std::size_t count) const {
    return person_->eventually_is(
        [&](const viewer::Draft& draft) { return draft.open.handles.size() == count; });
  }
  bool has_disk_as_roi() const {
    return person_->eventually_is([](const viewer::Draft& draft) {
      return std::holds_alternative<GeodesicDisk>(draft.open.roi.form);
    });
  }

  /// By the dialog that the keys open.
  bool saves_as(const std::string& keys, const std::filesystem::path& path) const {
    person_->open_dialog(keys);
    person_->type(path.string());
    person_->keys("Return");
    const bool saved = eventually(kPatienceSeconds, [&] { return std::filesystem::exists(path); });
    desktop_->settled_picture();
    return saved;
  }

  void keep_picture(const std::string& name) const {
    test::keep_picture(desktop_->settled_picture(), name);
  }

  void expect_quits_silently() {
    EXPECT_EQ(person_->quit(), 0);
    EXPECT_THAT(person_->errors(), ::testing::IsEmpty());
  }
  /// Quits without saving the edit.
  void expect_discards_silently() {
    EXPECT_EQ(person_->discard_and_quit(), 0);
    EXPECT_THAT(person_->errors(), ::testing::IsEmpty());
  }

  static constexpr double kPatienceSeconds = 60.0;

  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  std::unique_ptr<Person> person_;
};

}  // namespace lapwing::test
