#include "window/frame_input.h"

#include <initializer_list>

#include <gtest/gtest.h>
#include <volk.h>
// volk declares Vulkan before GLFW looks for it.
#include <GLFW/glfw3.h>

namespace lapwing::viewer {
namespace {

using Kind = DesktopEvent::Kind;

DesktopEvent button(int action) {
  return {.kind = Kind::button, .action = action};
}
DesktopEvent key(int code, int action = GLFW_PRESS) {
  return {.kind = Kind::key, .code = code, .action = action};
}
const DesktopEvent kMove{.kind = Kind::move};
const DesktopEvent kScroll{.kind = Kind::scroll};
const DesktopEvent kText{.kind = Kind::text};
const DesktopEvent kPress = button(GLFW_PRESS);
const DesktopEvent kRelease = button(GLFW_RELEASE);
const DesktopEvent kControl = key(GLFW_KEY_LEFT_CONTROL);
const DesktopEvent kControlUp = key(GLFW_KEY_LEFT_CONTROL, GLFW_RELEASE);

// How many frames the panels need to tell the events apart.
int frames_of(std::initializer_list<DesktopEvent> events) {
  FrameInput frame;
  int frames = 1;
  for (const DesktopEvent& event : events) {
    if (!frame.fits(event)) {
      frame.clear();
      ++frames;
      EXPECT_TRUE(frame.fits(event)) << "after a frame anything does";
    }
    frame.add(event);
  }
  return frames;
}

TEST(FrameInput, EveryPressAndReleaseHasAFrameOfItsOwn) {
  EXPECT_EQ(frames_of({kPress, kRelease}), 2);
  EXPECT_EQ(frames_of({kPress, kRelease, kPress, kRelease}), 4);
}

TEST(FrameInput, TheCursorGoesOnOnlyAfterWhatWasPressedWhereItWas) {
  EXPECT_EQ(frames_of({kMove, kPress}), 1);
  EXPECT_EQ(frames_of({kPress, kMove}), 2);
  EXPECT_EQ(frames_of({kScroll, kMove}), 2);
  EXPECT_EQ(frames_of({kPress, kMove, kMove, kMove}), 2) << "but a drag goes on within a frame";
}

TEST(FrameInput, EveryKeyHasAFrameOfItsOwn) {
  const DesktopEvent back = key(GLFW_KEY_BACKSPACE);
  const DesktopEvent back_up = key(GLFW_KEY_BACKSPACE, GLFW_RELEASE);
  EXPECT_EQ(frames_of({back, back_up}), 2);
  EXPECT_EQ(frames_of({back, back_up, back, back_up}), 4);
  EXPECT_EQ(frames_of({key('A'), key('B')}), 2);
}

TEST(FrameInput, AKeyWaitsForWhatAClickBeforeItMeans) {
  EXPECT_EQ(frames_of({kPress, key('A')}), 2);
  EXPECT_EQ(frames_of({key('A'), kPress}), 2);
  EXPECT_EQ(frames_of({key('A'), kScroll}), 2);
}

TEST(FrameInput, WhatAKeyTypesGoesWithIt) {
  EXPECT_EQ(frames_of({key('A'), kText}), 1);
  EXPECT_EQ(frames_of({key('A'), kText, key('B'), kText}), 2);
  EXPECT_EQ(frames_of({key('A'), kMove, kText}), 2) << "unless something came between";
}

TEST(FrameInput, AModifierGoesWithTheKeyThatItChanges) {
  EXPECT_EQ(frames_of({kControl, key('Z')}), 1);
  EXPECT_EQ(frames_of({kControl, key('Z'), kControlUp}), 2);
  EXPECT_EQ(frames_of({kControl, kPress, kControlUp}), 2);
  EXPECT_EQ(frames_of({kControl, kControlUp}), 2);
}

}  // namespace
}  // namespace lapwing::viewer
