#include "window/frame_input.h"

#include <algorithm>

#include <volk.h>
// Include GLFW after volk.h: GLFW declares its Vulkan functions if Vulkan's types are declared.
#include <GLFW/glfw3.h>

namespace lapwing::viewer {
namespace {

using Kind = DesktopEvent::Kind;

bool is_modifier(int key) {
  return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

bool contains(const std::vector<int>& keys, int key) {
  return std::ranges::find(keys, key) != keys.end();
}

}  // namespace

bool FrameInput::fits(const DesktopEvent& event) const {
  switch (event.kind) {
    case Kind::move:
    case Kind::enter:
      return !pressed_or_released_ && !scrolled_;
    case Kind::button:
      return !pressed_or_released_ && !scrolled_ && !has_keys();
    case Kind::scroll:
      return !pressed_or_released_ && !has_keys();
    case Kind::key:
      return fits_key(event);
    case Kind::text:
      return ends_with_key_ || (!pressed_or_released_ && !has_keys());
    case Kind::focus:
      return !pressed_or_released_ && !has_keys();
  }
  return true;
}

bool FrameInput::fits_key(const DesktopEvent& event) const {
  if (event.action == GLFW_RELEASE) {
    const bool is_used = is_modifier(event.code) && (has_keys() || pressed_or_released_);
    return !is_used && !contains(keys_, event.code) && !contains(modifiers_, event.code);
  }
  return !pressed_or_released_ && !has_keys() && !contains(released_, event.code);
}

void FrameInput::add(const DesktopEvent& event) {
  ends_with_key_ = event.kind == Kind::key && event.action != GLFW_RELEASE;
  switch (event.kind) {
    case Kind::button:
      pressed_or_released_ = true;
      break;
    case Kind::scroll:
      scrolled_ = true;
      break;
    case Kind::text:
      typed_ = true;
      break;
    case Kind::key:
      if (event.action == GLFW_RELEASE) {
        released_.push_back(event.code);
      } else {
        (is_modifier(event.code) ? modifiers_ : keys_).push_back(event.code);
      }
      break;
    case Kind::move:
    case Kind::enter:
    case Kind::focus:
      break;
  }
}

void FrameInput::clear() {
  pressed_or_released_ = scrolled_ = typed_ = ends_with_key_ = false;
  keys_.clear();
  modifiers_.clear();
  released_.clear();
}

}  // namespace lapwing::viewer
