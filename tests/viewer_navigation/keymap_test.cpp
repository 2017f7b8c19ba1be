#include "navigation/keymap.h"

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing::viewer {
namespace {

using ModifierKey = std::tuple<int, bool, bool, bool>;

ModifierKey key_of(int what, const Modifiers& m) {
  return {what, m.shift, m.control, m.alt};
}

const Keymap& keymap(std::string_view name) {
  for (const Keymap& candidate : keymaps()) {
    if (candidate.name == name) return candidate;
  }
  throw std::out_of_range("no such keymap");
}

TEST(Keymap, NoDragIsBoundTwice) {
  for (const Keymap& map : keymaps()) {
    std::set<ModifierKey> seen;
    for (const DragBinding& binding : map.drags) {
      EXPECT_TRUE(seen.insert(key_of(static_cast<int>(binding.button), binding.modifiers)).second)
          << map.name;
    }
  }
}

TEST(Keymap, NoKeyIsBoundTwice) {
  std::set<ModifierKey> seen;
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_TRUE(seen.insert(key_of(binding.key, binding.modifiers)).second) << binding.key;
  }
}

TEST(Keymap, EveryKeymapOrbitsPansAndZooms) {
  for (const Keymap& map : keymaps()) {
    std::set<Motion> motions;
    for (const DragBinding& binding : map.drags) motions.insert(binding.motion);
    EXPECT_EQ(motions.size(), 3U) << map.name;
  }
}

TEST(Keymap, DragsAreThoseOfTheProgramsTheyAreNamedAfter) {
  const Modifiers plain;
  const Modifiers shift{.shift = true};
  const Modifiers alt{.alt = true};
  EXPECT_EQ(motion_of(keymap("Blender"), MouseButton::middle, plain), Motion::orbit);
  EXPECT_EQ(motion_of(keymap("Blender"), MouseButton::middle, shift), Motion::pan);
  EXPECT_EQ(motion_of(keymap("Maya"), MouseButton::left, alt), Motion::orbit);
  EXPECT_EQ(motion_of(keymap("Maya"), MouseButton::right, alt), Motion::zoom);
  EXPECT_EQ(motion_of(keymap("MeshLab"), MouseButton::left, plain), Motion::orbit);
  EXPECT_EQ(motion_of(keymap("MeshLab"), MouseButton::middle, plain), Motion::pan);
  EXPECT_EQ(motion_of(keymap("Maya"), MouseButton::right, plain), std::nullopt);
}

TEST(Keymap, KeysNeedTheirModifiers) {
  InputEvent event;
  event.kind = InputKind::key;
  event.key = '1';
  EXPECT_EQ(action_of(event), Action::view_front);
  event.modifiers.control = true;
  EXPECT_EQ(action_of(event), Action::view_back);
  event.modifiers.alt = true;
  EXPECT_EQ(action_of(event), std::nullopt);
}

TEST(Keymap, QuestionMarkIsTheCharacterThatWasTyped) {
  InputEvent event;
  event.kind = InputKind::text;
  event.text = U'?';
  EXPECT_EQ(action_of(event), Action::toggle_controls);
  event.text = U'F';
  EXPECT_EQ(action_of(event), std::nullopt);
}

TEST(Keymap, TheReadmeListsEveryControl) {
  std::ifstream file(LAPWING_VIEWER_README);
  const std::string readme{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(readme, ::testing::HasSubstr(controls_table()))
      << "replace the table by what `lapwing-viewer --controls` prints";
}

}  // namespace
}  // namespace lapwing::viewer
