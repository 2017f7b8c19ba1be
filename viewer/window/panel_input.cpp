#include "window/panel_input.h"

#include <cfloat>

#include <volk.h>
// Include GLFW after volk.h: GLFW declares its Vulkan functions if Vulkan's types are declared.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>
#include <imgui_internal.h>

namespace lapwing::viewer {
void PanelInput::hand_on(const DesktopEvent& event) {
  using Kind = DesktopEvent::Kind;
  frame_.add(event);
  cursor_ = event.cursor;
  switch (event.kind) {
    case Kind::move:
      is_inside_ = true;
      break;
    case Kind::enter:
      is_inside_ = event.action != 0;
      ImGui_ImplGlfw_CursorEnterCallback(window_, event.action);
      break;
    case Kind::button:
      is_inside_ = true;
      if (const auto button = static_cast<std::size_t>(event.code); button < kButtons) {
        down_[button] = event.action == GLFW_PRESS;
      }
      break;
    case Kind::scroll:
      ImGui_ImplGlfw_ScrollCallback(window_, event.scroll.x(), event.scroll.y());
      break;
    case Kind::key:
      ImGui_ImplGlfw_KeyCallback(window_, event.code, event.scancode, event.action,
                                 event.modifiers);
      break;
    case Kind::text:
      // If a key opens a text field, the character of this key must not be typed into the field.
      if (want_keys()) {
        ImGui_ImplGlfw_CharCallback(window_, static_cast<unsigned int>(event.code));
      }
      break;
    case Kind::focus:
      ImGui_ImplGlfw_WindowFocusCallback(window_, event.action);
      break;
  }
}

void PanelInput::new_frame() {
  popups_ = ImGui::GetCurrentContext()->OpenPopupStack.Size;
  ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = is_inside_
                    ? ImVec2(static_cast<float>(cursor_.x()), static_cast<float>(cursor_.y()))
                    : ImVec2(-FLT_MAX, -FLT_MAX);
  for (std::size_t button = 0; button < kButtons; ++button) io.MouseDown[button] = down_[button];
}

void PanelInput::laid_out() {
  frame_.clear();
  popups_changed_ = ImGui::GetCurrentContext()->OpenPopupStack.Size != popups_;
}

bool PanelInput::focus_is_pending() const {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  return popups_changed_ || context.NavMoveSubmitted || context.NavNextActivateId != 0;
}

// Tests the windows of the last layout, because ImGui's WantCaptureMouse changes only in the next
// frame.
bool PanelInput::is_over_panel(const Eigen::Vector2d& cursor) {
  const ImVec2 place(static_cast<float>(cursor.x()), static_cast<float>(cursor.y()));
  for (const ImGuiWindow* panel : ImGui::GetCurrentContext()->Windows) {
    const bool takes_mouse = (panel->Flags & ImGuiWindowFlags_NoMouseInputs) == 0;
    if (panel->Active && !panel->Hidden && takes_mouse && panel->OuterRectClipped.Contains(place)) {
      return true;
    }
  }
  return false;
}

bool PanelInput::want_mouse(const Eigen::Vector2d& cursor) {
  return is_over_panel(cursor) || ImGui::GetCurrentContext()->OpenPopupStack.Size > 0;
}

// ImGui::GetIO().WantTextInput also changes only in the next frame. InputTextState.ID alone is not
// sufficient, because it remains set while the user drags a slider after typing into it.
bool PanelInput::want_keys() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  return context.WantTextInputNextFrame == 1 && context.ActiveId != 0 &&
         context.ActiveId == context.InputTextState.ID;
}

bool PictureInput::gets(InputKind kind, MouseButton button, const Eigen::Vector2d& cursor) {
  switch (kind) {
    case InputKind::move:
      return true;
    case InputKind::press:
      return gets_press(button, cursor);
    case InputKind::release:
      return gets_release(button);
    case InputKind::scroll:
      return !PanelInput::want_mouse(cursor);
    case InputKind::key:
      // The character of a key has the same receiver as the key, even if the key opened a field.
      types_into_panel_ = PanelInput::want_keys();
      return !types_into_panel_;
    case InputKind::text:
      return !types_into_panel_;
  }
  return false;
}

bool PictureInput::gets_press(MouseButton button, const Eigen::Vector2d& cursor) {
  if (dragging_ != MouseButton::none || PanelInput::want_mouse(cursor)) return false;
  dragging_ = button;
  return true;
}

bool PictureInput::gets_release(MouseButton button) {
  if (dragging_ != button) return false;
  dragging_ = MouseButton::none;
  return true;
}

}  // namespace lapwing::viewer
