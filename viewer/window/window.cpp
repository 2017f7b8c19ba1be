#include "window/window.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <dlfcn.h>
#include <string_view>
#include <unistd.h>
#include <utility>

// The window's header includes volk.h. GLFW declares its Vulkan functions only if Vulkan's types
// are declared before.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include "lapwing/gpu/instance.h"

namespace lapwing::viewer {
namespace {

using Kind = DesktopEvent::Kind;

// A global variable, because `Window::wake` is static and may be called from any thread.
std::atomic<bool> woken = false;

int code_without_display = 0;

// Xlib may call this on any thread while it holds locks, so the handler calls only `write` and
// `_exit`.
int end_without_display(void*) {
  constexpr std::string_view kWords =
      "lapwing-viewer: lost the connection to the display; start it again on a desktop\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kWords.data(), kWords.size());
  _exit(code_without_display);
}

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

[[noreturn]] void throw_no_window() {
  throw WindowError("Cannot open a window: " + glfw_reason() +
                    ". Start the viewer on a desktop (or under xvfb-run), or use `lapwing "
                    "render`, which "
                    "needs no window.");
}

Modifiers modifiers_of(int mods) {
  return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0};
}

// Returns the pressed modifiers as a bit mask of GLFW.
int pressed_modifiers(GLFWwindow* window) {
  const auto bit_if_down = [&](int bit, int left, int right) {
    const bool is_down =
        glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
    return is_down ? bit : 0;
  };
  return bit_if_down(GLFW_MOD_SHIFT, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) |
         bit_if_down(GLFW_MOD_CONTROL, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL) |
         bit_if_down(GLFW_MOD_ALT, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
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

// Converts a GLFW key to a key code of InputEvent. The code of a letter belongs to the key that
// types this letter in the user's keyboard layout.
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

// GLFW's callbacks. They add the events to the window's queue in order.
struct WindowCallbacks {
  static Window& of(GLFWwindow* handle) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
  }

  static void add(GLFWwindow* handle, DesktopEvent event) {
    Window& window = of(handle);
    event.cursor = window.cursor_;
    window.waiting_.push_back(event);
  }

  static void on_button(GLFWwindow* handle, int button, int action, int mods) {
    of(handle).buttons_down_ += action == GLFW_PRESS ? 1 : -1;
    add(handle, {.kind = Kind::button, .code = button, .action = action, .modifiers = mods});
  }

  static void on_move(GLFWwindow* handle, double x, double y) {
    Window& window = of(handle);
    window.cursor_ = {x, y};
    // While a button is pressed, every position is needed, for example for a lasso. Otherwise the
    // latest position is sufficient.
    if (window.buttons_down_ == 0 && window.has_input() &&
        window.waiting_.back().kind == Kind::move) {
      window.waiting_.pop_back();
    }
    add(handle, {.kind = Kind::move, .modifiers = pressed_modifiers(handle)});
  }

  static void install(GLFWwindow* handle) {
    glfwSetMouseButtonCallback(handle, on_button);
    glfwSetCursorPosCallback(handle, on_move);
    glfwSetScrollCallback(handle, [](GLFWwindow* own, double x, double y) {
      add(own, {.kind = Kind::scroll, .modifiers = pressed_modifiers(own), .scroll = {x, y}});
    });
    glfwSetKeyCallback(handle, [](GLFWwindow* own, int key, int scancode, int action, int mods) {
      add(own, {.kind = Kind::key,
                .code = key,
                .scancode = scancode,
                .action = action,
                .modifiers = mods});
    });
    glfwSetCharCallback(handle, [](GLFWwindow* own, unsigned int character) {
      add(own, {.kind = Kind::text, .code = static_cast<int>(character)});
    });
    glfwSetWindowFocusCallback(handle, [](GLFWwindow* own, int focused) {
      add(own, {.kind = Kind::focus, .action = focused});
    });
    glfwSetCursorEnterCallback(handle, [](GLFWwindow* own, int entered) {
      add(own, {.kind = Kind::enter, .action = entered});
    });
    glfwSetDropCallback(handle, [](GLFWwindow* own, int count, const char** paths) {
      of(own).changed_ = true;
      of(own).dropped_.insert(of(own).dropped_.end(), paths, paths + count);
    });
    glfwSetWindowCloseCallback(handle, [](GLFWwindow* own) { of(own).changed_ = true; });
    glfwSetWindowRefreshCallback(handle, [](GLFWwindow* own) { of(own).changed_ = true; });
    const auto on_resize = [](GLFWwindow* own, int, int) { of(own).changed_ = true; };
    glfwSetFramebufferSizeCallback(handle, on_resize);
    const auto on_scale = [](GLFWwindow* own, float, float) { of(own).changed_ = true; };
    glfwSetWindowContentScaleCallback(handle, on_scale);
  }
};

Window::Window(const std::string& title, int width, int height) {
  if (glfwInit() == GLFW_FALSE) throw_no_window();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  handle_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (handle_ == nullptr) {
    // GLFW's error message must be read before `glfwTerminate`.
    try {
      throw_no_window();
    } catch (...) {
      glfwTerminate();
      throw;
    }
  }
  glfwSetWindowUserPointer(handle_, this);
  // In a smaller window, the sidebar would leave no room for the view.
  glfwSetWindowSizeLimits(handle_, 640, 480, GLFW_DONT_CARE, GLFW_DONT_CARE);
  ImGui::CreateContext();
  ImGui_ImplGlfw_InitForOther(handle_, false);
  panels_ = std::make_unique<PanelInput>(handle_);
  WindowCallbacks::install(handle_);
}

Window::~Window() {
  panels_.reset();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(handle_);
  glfwTerminate();
}

std::vector<const char*> Window::instance_extensions() const {
  // If Vulkan is not installed, this throws an error with a clear message.
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
    throw GpuError("Vulkan cannot draw into the window: " + glfw_reason() +
                   "; choose another device with --device (`lapwing info` lists them)");
  }
  return surface;
}

void Window::exit_when_display_goes(int code) {
  // GLFW has loaded Xlib if it uses X11. Other platforms need no handler.
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

// Removed events stay at the front of waiting_ until all are removed, so that the vector keeps its
// capacity.
std::optional<InputEvent> Window::hand_on() {
  const DesktopEvent event = waiting_[handed_on_++];
  if (!has_input()) {
    waiting_.clear();
    handed_on_ = 0;
  }
  const bool over_panel = PanelInput::is_over_panel(event.cursor) || ImGui::IsAnyItemActive();
  // A move changes the panels only if the cursor is over a panel, which is then highlighted.
  if (event.kind != DesktopEvent::Kind::move || over_panel || was_over_panel_) changed_ = true;
  was_over_panel_ = over_panel;
  const auto input = input_event(event);
  const bool is_for_picture = input && picture_.gets(input->kind, input->button, event.cursor);
  panels_->hand_on(event);
  if (!is_for_picture) return {};
  const bool is_release_or_unknown =
      event.kind == DesktopEvent::Kind::key && (event.action == GLFW_RELEASE || input->key == 0);
  return is_release_or_unknown ? std::nullopt : input;
}

// Converts an event for the view. Returns nullopt for events that the view does not use.
std::optional<InputEvent> Window::input_event(const DesktopEvent& event) const {
  InputEvent input;
  input.position = in_pixels(event.cursor);
  input.modifiers = modifiers_of(event.modifiers);
  switch (event.kind) {
    case Kind::button:
      input.kind = event.action == GLFW_PRESS ? InputKind::press : InputKind::release;
      input.button = button_of(event.code);
      break;
    case Kind::scroll:
      input.kind = InputKind::scroll;
      input.scroll = event.scroll.y();
      break;
    case Kind::key:
      input.kind = InputKind::key;
      input.key = key_of(event.code, event.scancode);
      break;
    case Kind::text:
      input.kind = InputKind::text;
      input.text = static_cast<char32_t>(event.code);
      break;
    case Kind::move:
      input.button = picture_.dragging();
      break;
    case Kind::enter:
    case Kind::focus:
      return {};
  }
  return input;
}

Eigen::Vector2d Window::in_pixels(const Eigen::Vector2d& cursor) const {
  int width = 0;
  int height = 0;
  glfwGetWindowSize(handle_, &width, &height);
  const VkExtent2D pixels = this->pixels();
  if (width == 0 || height == 0) return cursor;
  return {cursor.x() * pixels.width / width, cursor.y() * pixels.height / height};
}

std::vector<std::filesystem::path> Window::take_dropped_files() {
  return std::exchange(dropped_, {});
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
