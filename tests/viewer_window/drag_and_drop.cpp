#include "viewer_window/drag_and_drop.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <array>
#include <chrono>
#include <memory>
#include <thread>

namespace lapwing::test {
namespace {

constexpr long kProtocolVersion = 5;

// The dragging side of XDND (freedesktop.org, "Drag-and-Drop Protocol for the X Window System").
class FileManager {
 public:
  FileManager(Display& display, Window target)
      : display_(display),
        target_(target),
        self_(XCreateSimpleWindow(&display, DefaultRootWindow(&display), 0, 0, 1, 1, 0, 0, 0)) {
    XSetSelectionOwner(&display_, atom("XdndSelection"), self_, CurrentTime);
  }
  ~FileManager() { XDestroyWindow(&display_, self_); }
  FileManager(const FileManager&) = delete;
  FileManager& operator=(const FileManager&) = delete;

  bool drop(const std::string& uris) {
    const auto own = static_cast<long>(self_);
    const auto list_of_uris = static_cast<long>(atom("text/uri-list"));
    constexpr long kPlace = 100L << 16 | 100L;
    send("XdndEnter", {own, kProtocolVersion << 24, list_of_uris, 0, 0});
    send("XdndPosition", {own, 0, kPlace, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
    XEvent event;
    if (!wait_for(event, ClientMessage) || event.xclient.message_type != atom("XdndStatus")) {
      return false;
    }
    send("XdndDrop", {own, 0, CurrentTime, 0, 0});
    if (!wait_for(event, SelectionRequest)) return false;
    hand_over(event.xselectionrequest, uris);
    return wait_for(event, ClientMessage) && event.xclient.message_type == atom("XdndFinished");
  }

 private:
  Atom atom(const char* name) { return XInternAtom(&display_, name, False); }

  void send(const char* type, const std::array<long, 5>& data) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    for (std::size_t i = 0; i < data.size(); ++i) event.xclient.data.l[i] = data[i];
    XSendEvent(&display_, target_, False, NoEventMask, &event);
    XFlush(&display_);
  }

  bool wait_for(XEvent& event, int type) {
    constexpr auto kPatience = std::chrono::seconds(20);
    constexpr auto kStep = std::chrono::milliseconds(10);
    for (auto waited = kStep; waited < kPatience; waited += kStep) {
      while (XPending(&display_) > 0) {
        XNextEvent(&display_, &event);
        if (event.type == type) return true;
      }
      std::this_thread::sleep_for(kStep);
    }
    return false;
  }

  void hand_over(const XSelectionRequestEvent& request, const std::string& uris) {
    XChangeProperty(&display_, request.requestor, request.property, request.target, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(uris.data()),
                    static_cast<int>(uris.size()));
    XEvent answer{};
    answer.xselection.type = SelectionNotify;
    answer.xselection.requestor = request.requestor;
    answer.xselection.selection = request.selection;
    answer.xselection.target = request.target;
    answer.xselection.property = request.property;
    answer.xselection.time = request.time;
    XSendEvent(&display_, request.requestor, False, NoEventMask, &answer);
    XFlush(&display_);
  }

  Display& display_;
  Window target_;
  Window self_;
};

}  // namespace

bool drop_file(const std::string& display, const std::string& window,
               const std::filesystem::path& file) {
  const std::unique_ptr<Display, int (*)(Display*)> connection(XOpenDisplay(display.c_str()),
                                                               XCloseDisplay);
  if (!connection) return false;
  FileManager manager(*connection, std::stoul(window));
  return manager.drop("file://" + file.string() + "\r\n");
}

}  // namespace lapwing::test
