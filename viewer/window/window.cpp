#include "window/window.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <dlfcn.h>
#include <string_view>
#include <unistd.h>
#include <utility>

// volk declares Vulkan before GLFW looks for it.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/instance.h"
#include "window/window_error.h"

namespace lapwing::viewer {
namespace {

// There is one window, and whoever wakes it may not know it.
std::atomic<bool> woken = false;

int code_without_display = 0;

// Called by Xlib, on any thread, perhaps with its locks held.
int end_without_display(void*) {
  constexpr std::string_view kWords =
      "lapwing-viewer: the display went away; start again where there is one\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kWords.data(), kWords.size());
  _exit(code_without_display);
}

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

[[noreturn]] void throw_no_window() {
  throw WindowError("no window can be opened: " + glfw_reason() +
                    "; start it on a desktop (or under xvfb-run), or use `lapwing render`, which "
                    "makes pictures without one");
}

Modifiers modifiers_of(int mods) {
  return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0};
}

Modifiers pressed_modifiers(GLFWwindow* window) {
  const auto down = [&](int left, int right) {
    return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
  };
  return {down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
          down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
          down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)};
}

MouseButton button_of(int button) {
  switch (button) {
    case GLFW_MOUSE_BUTTON_LEFT:
      return MouseButton::left;
    case GLFW_MOUSE_BUTTON_MIDDLE:
      return MouseButton::middle;
    case GLFW_MOUSE_BUTTON_RIGHT:
      return MouseButton::right;
    default:
      return MouseButton::none;
  }
}

constexpr std::array<std::pair<int, int>, 12> kNamedKeys{{{GLFW_KEY_ESCAPE, kEscape},
                                                          {GLFW_KEY_ENTER, kEnter},
                                                          {GLFW_KEY_TAB, kTab},
                                                          {GLFW_KEY_BACKSPACE, kBackspace},
                                                          {GLFW_KEY_DELETE, kDelete},
                                                          {GLFW_KEY_HOME, kHome},
                                                          {GLFW_KEY_END, kEnd},
                                                          {GLFW_KEY_LEFT, kLeft},
                                                          {GLFW_KEY_RIGHT, kRight},
                                                          {GLFW_KEY_UP, kUp},
                                                          {GLFW_KEY_DOWN, kDown},
                                                          {GLFW_KEY_F1, kF1}}};

// A letter's key is the one that types it, wherever the person's layout has it.
int key_of(int key, int scancode) {
  for (const auto& [glfw, ours] : kNamedKeys) {
    if (key == glfw) return ours;
  }
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return '0' + key - GLFW_KEY_KP_0;
  if (key == GLFW_KEY_KP_DECIMAL) return '.';
  if (key == GLFW_KEY_KP_ADD) return '=';
  if (key == GLFW_KEY_KP_SUBTRACT) return '-';
  if (key == GLFW_KEY_KP_ENTER) return kEnter;
  const char* name = glfwGetKeyName(key, scancode);
  if (name != nullptr && name[0] > ' ' && name[0] < 127 && name[1] == '\0') {
    return name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0];
  }
  return key > ' ' && key < 127 ? key : 0;
}

}  // namespace

// GLFW's callbacks: each goes to ImGui first, which says whether a panel wants it.
struct WindowCallbacks {
  static Window& of(GLFWwindow* handle) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
  }

  // Where the cursor was when the event that is handled came: GLFW, asked, says where it is by now.
  static Eigen::Vector2d in_pixels(GLFWwindow* handle) {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(handle, &width, &height);
    const VkExtent2D pixels = of(handle).pixels();
    const Eigen::Vector2d& cursor = of(handle).cursor_;
    if (width == 0 || height == 0) return cursor;
    return {cursor.x() * pixels.width / width, cursor.y() * pixels.height / height};
  }

  // ImGui itself knows only at the next frame.
  static bool over_panel(const Eigen::Vector2d& cursor) {
    const ImVec2 place(static_cast<float>(cursor.x()), static_cast<float>(cursor.y()));
    for (const ImGuiWindow* panel : ImGui::GetCurrentContext()->Windows) {
      if ((panel->Flags & ImGuiWindowFlags_NoMouseInputs) != 0) continue;
      if (panel->WasActive && panel->OuterRectClipped.Contains(place)) return true;
    }
    return false;
  }

  // A click beside an open menu closes it.
  static bool panels_want_mouse(GLFWwindow* handle) {
    return over_panel(of(handle).cursor_) || ImGui::GetCurrentContext()->OpenPopupStack.Size > 0;
  }

  static void add(GLFWwindow* handle, InputEvent event) {
    Window& window = of(handle);
    window.changed_ = true;
    window.events_.push_back(event);
  }

  static void on_button(GLFWwindow* handle, int button, int action, int mods) {
    ImGui_ImplGlfw_MouseButtonCallback(handle, button, action, mods);
    Window& window = of(handle);
    window.changed_ = true;
    InputEvent event;
    event.kind = action == GLFW_PRESS ? InputKind::press : InputKind::release;
    event.position = in_pixels(handle);
    event.button = button_of(button);
    event.modifiers = modifiers_of(mods);
    if (event.kind == InputKind::press) {
      if (window.dragging_ != MouseButton::none || panels_want_mouse(handle)) return;
      window.dragging_ = event.button;
    } else {
      if (window.dragging_ != event.button) return;
      window.dragging_ = MouseButton::none;
    }
    add(handle, event);
  }

  static void on_move(GLFWwindow* handle, double x, double y) {
    Window& window = of(handle);
    window.cursor_ = {x, y};
    // Panels light up under the cursor; what changes in the picture the app says.
    if (ImGui::GetIO().WantCaptureMouse || over_panel(window.cursor_)) window.changed_ = true;
    InputEvent event;
    event.kind = InputKind::move;
    event.position = in_pixels(handle);
    event.button = window.dragging_;
    event.modifiers = pressed_modifiers(handle);
    // A lasso is all of its way, however long a frame takes; otherwise where the cursor is by now
    // is enough.
    const bool may_skip = window.dragging_ == MouseButton::none && !window.events_.empty() &&
                          window.events_.back().kind == InputKind::move;
    if (may_skip) {
      window.events_.back() = event;
    } else {
      window.events_.push_back(event);
    }
  }

  static void on_scroll(GLFWwindow* handle, double x, double y) {
    ImGui_ImplGlfw_ScrollCallback(handle, x, y);
    of(handle).changed_ = true;
    if (panels_want_mouse(handle)) return;
    InputEvent event;
    event.kind = InputKind::scroll;
    event.position = in_pixels(handle);
    event.modifiers = pressed_modifiers(handle);
    event.scroll = y;
    add(handle, event);
  }

  // ImGui sees keys as they are at each frame: one that goes down and up between two would be lost
  // to it, however long a frame takes.
  static void tell_imgui(GLFWwindow* handle, const Window::KeyRelease& key, int action) {
    Window& window = of(handle);
    if (action == GLFW_PRESS) window.pressed_since_frame_.push_back(key.key);
    const auto& pressed = window.pressed_since_frame_;
    const bool is_new = std::find(pressed.begin(), pressed.end(), key.key) != pressed.end();
    if (action == GLFW_RELEASE && is_new) {
      window.late_releases_.push_back(key);
    } else {
      ImGui_ImplGlfw_KeyCallback(handle, key.key, key.scancode, action, key.modifiers);
    }
  }

  static void on_key(GLFWwindow* handle, int key, int scancode, int action, int mods) {
    tell_imgui(handle, {key, scancode, mods}, action);
    of(handle).changed_ = true;
    if (action == GLFW_RELEASE || ImGui::GetIO().WantTextInput) return;
    InputEvent event;
    event.kind = InputKind::key;
    event.position = in_pixels(handle);
    event.modifiers = modifiers_of(mods);
    event.key = key_of(key, scancode);
    if (event.key != 0) add(handle, event);
  }

  static void on_text(GLFWwindow* handle, unsigned int character) {
    ImGui_ImplGlfw_CharCallback(handle, character);
    of(handle).changed_ = true;
    if (ImGui::GetIO().WantTextInput) return;
    InputEvent event;
    event.kind = InputKind::text;
    event.position = in_pixels(handle);
    event.text = static_cast<char32_t>(character);
    add(handle, event);
  }

  static void on_focus(GLFWwindow* handle, int focused) {
    ImGui_ImplGlfw_WindowFocusCallback(handle, focused);
    of(handle).changed_ = true;
  }

  static void on_enter(GLFWwindow* handle, int entered) {
    ImGui_ImplGlfw_CursorEnterCallback(handle, entered);
    of(handle).changed_ = true;
  }

  static void on_drop(GLFWwindow* handle, int count, const char** paths) {
    of(handle).changed_ = true;
    for (int i = 0; i < count; ++i) of(handle).dropped_.emplace_back(paths[i]);
  }

  static void on_close(GLFWwindow* handle) { of(handle).changed_ = true; }
  static void on_resize(GLFWwindow* handle, int, int) { of(handle).changed_ = true; }
  static void on_refresh(GLFWwindow* handle) { of(handle).changed_ = true; }
  static void on_scale(GLFWwindow* handle, float, float) { of(handle).changed_ = true; }

  static void install(GLFWwindow* handle) {
    glfwSetMouseButtonCallback(handle, on_button);
    glfwSetCursorPosCallback(handle, on_move);
    glfwSetScrollCallback(handle, on_scroll);
    glfwSetKeyCallback(handle, on_key);
    glfwSetCharCallback(handle, on_text);
    glfwSetWindowFocusCallback(handle, on_focus);
    glfwSetCursorEnterCallback(handle, on_enter);
    glfwSetDropCallback(handle, on_drop);
    glfwSetWindowCloseCallback(handle, on_close);
    glfwSetFramebufferSizeCallback(handle, on_resize);
    glfwSetWindowRefreshCallback(handle, on_refresh);
    glfwSetWindowContentScaleCallback(handle, on_scale);
  }
};

Window::Window(const std::string& title, int width, int height) {
  if (glfwInit() == GLFW_FALSE) throw_no_window();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  handle_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (handle_ == nullptr) {
    // The reason must be read before GLFW ends.
    try {
      throw_no_window();
    } catch (...) {
      glfwTerminate();
      throw;
    }
  }
  glfwSetWindowUserPointer(handle_, this);
  glfwSetWindowSizeLimits(handle_, 64, 64, GLFW_DONT_CARE, GLFW_DONT_CARE);
  ImGui::CreateContext();
  ImGui_ImplGlfw_InitForOther(handle_, false);
  WindowCallbacks::install(handle_);
}

Window::~Window() {
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(handle_);
  glfwTerminate();
}

std::vector<const char*> Window::instance_extensions() const {
  // Says in the project's own words when there is no Vulkan at all.
  gpu::open_loader();
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) {
    throw GpuError("Vulkan cannot draw into windows of this desktop: " + glfw_reason() +
                   "; install mesa-vulkan-drivers, or use `lapwing render`");
  }
  return {names, names + count};
}

VkSurfaceKHR Window::create_surface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  const VkResult result = glfwCreateWindowSurface(instance, handle_, nullptr, &surface);
  if (result != VK_SUCCESS) {
    throw GpuError("Vulkan cannot draw into the window: " + glfw_reason());
  }
  return surface;
}

void Window::exit_when_display_goes(int code) {
  // GLFW brought Xlib along, unless it runs on something else that closes windows in order.
  using Handler = int (*)(void* display);
  auto* const set_handler =
      reinterpret_cast<Handler (*)(Handler)>(dlsym(RTLD_DEFAULT, "XSetIOErrorHandler"));
  if (set_handler == nullptr) return;
  code_without_display = code;
  set_handler(end_without_display);
}

void Window::wait(double seconds) {
  glfwWaitEventsTimeout(seconds);
}
void Window::poll() {
  glfwPollEvents();
}
void Window::wake() {
  woken = true;
  glfwPostEmptyEvent();
}

std::span<const InputEvent> Window::take_events() {
  // Swapped, so that both keep their memory.
  taken_.clear();
  taken_.swap(events_);
  return taken_;
}
std::vector<std::filesystem::path> Window::take_dropped_files() {
  return std::exchange(dropped_, {});
}
void Window::panels_have_seen_keys() {
  pressed_since_frame_.clear();
  for (const KeyRelease& key : late_releases_) {
    ImGui_ImplGlfw_KeyCallback(handle_, key.key, key.scancode, GLFW_RELEASE, key.modifiers);
    changed_ = true;
  }
  late_releases_.clear();
}
bool Window::take_changed() {
  const bool changed = std::exchange(changed_, false);
  return woken.exchange(false) || changed;
}

bool Window::take_close_request() {
  const bool requested = glfwWindowShouldClose(handle_) != GLFW_FALSE;
  glfwSetWindowShouldClose(handle_, GLFW_FALSE);
  return requested;
}

VkExtent2D Window::pixels() const {
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(handle_, &width, &height);
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

double Window::content_scale() const {
  float x = 1.0F;
  float y = 1.0F;
  glfwGetWindowContentScale(handle_, &x, &y);
  return x;
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(handle_, title.c_str());
}

}  // namespace lapwing::viewer
