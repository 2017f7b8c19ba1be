#include "viewer_window/person.h"

#include <algorithm>
#include <csignal>
#include <stdexcept>

#include "state/journal.h"

namespace lapwing::test {
namespace {

namespace fs = std::filesystem;

constexpr double kWidth = 1280.0;
constexpr double kHeight = 800.0;
// Steps on a software device and a busy machine.
constexpr double kPersonPatience = 90.0;

std::string at(const Eigen::Vector2d& pixel) {
  return "mousemove " + std::to_string(static_cast<int>(pixel.x())) + " " +
         std::to_string(static_cast<int>(pixel.y())) + " ";
}

std::string pressed_along(const std::vector<Eigen::Vector2d>& pixels) {
  std::string gesture = at(pixels.front()) + "mousedown 1 ";
  for (std::size_t k = 1; k < pixels.size(); ++k) gesture += at(pixels[k]) + "sleep 0.05 ";
  return gesture;
}

const char* key_of(View view) {
  switch (view) {
    case View::front:
      return "1";
    case View::right:
      return "3";
    case View::top:
      return "7";
    default:
      throw std::invalid_argument("no key looks from there");
  }
}

}  // namespace

Person::Person(const Desktop& desktop, fs::path folder)
    : desktop_(desktop), folder_(std::move(folder)) {}

void Person::start() {
  open({});
}

void Person::open(const fs::path& mesh, const std::vector<std::string>& flags) {
  std::vector<std::string> arguments{LAPWING_VIEWER};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  if (!mesh.empty()) arguments.push_back(mesh);
  viewer_ = std::make_unique<Process>(arguments, viewer_environment(desktop_, folder_),
                                      folder_ / "errors");
}

bool Person::waits_for_window() {
  std::string window;
  const bool shown = eventually(kPersonPatience, [&] {
    window = desktop_.xdotool("search --onlyvisible --name Lapwing");
    return !window.empty() || !viewer_->running();
  });
  return shown && viewer_->running();
}

void Person::kill() {
  viewer_->send(SIGKILL);
  viewer_->wait(kPersonPatience);
}

int Person::quit() {
  keys("ctrl+q");
  return wait();
}

int Person::discard_and_quit() {
  open_dialog("ctrl+q");
  keys("Delete");
  return wait();
}

void Person::open_dialog(const std::string& names) const {
  const Image before = desktop_.settled_picture();
  keys(names);
  eventually(kPersonPatience, [&] { return mean_difference(desktop_.picture(), before) > 1.0; });
  desktop_.settled_picture();
}

int Person::wait() {
  return viewer_->wait(kPersonPatience);
}

std::string Person::errors() const {
  return viewer_->errors();
}

void Person::look_from(View view, const Positions& positions) {
  keys(std::string("Tab key ") + key_of(view) + " key Home");
  camera_ = fit(positions, view_axes(view), kWidth / kHeight);
  desktop_.settled_picture();
}

void Person::look_again_from(View view, const Positions& positions, double covered) {
  keys(std::string(key_of(view)) + " key Home");
  Framing framing;
  framing.legend = covered;
  camera_ = fit(positions, view_axes(view), kWidth / kHeight, framing);
  camera_.target_across = covered;
  desktop_.settled_picture();
}

viewer::Projection Person::projection() const {
  return {camera_.projection(kWidth / kHeight) * camera_.view(), {kWidth, kHeight}};
}

Eigen::Vector2d Person::pixel_of(const Vector3d& point) const {
  return projection().to_pixel(point).value();
}

void Person::keys(const std::string& names) const {
  desktop_.xdotool("key " + names);
}

void Person::type(const std::string& text) const {
  desktop_.xdotool("type --delay 5 '" + text + "'");
}

void Person::click(const Vector2d& pixel) const {
  desktop_.xdotool(at(pixel) + "click 1");
}

void Person::scroll(const Vector2d& pixel, int notches, const std::string& held) const {
  std::string gesture = at(pixel);
  if (!held.empty()) gesture += "keydown " + held + " ";
  gesture += "click --repeat " + std::to_string(std::abs(notches)) + (notches > 0 ? " 4" : " 5");
  if (!held.empty()) gesture += " keyup " + held;
  desktop_.xdotool(gesture);
}

void Person::drag(const std::vector<Vector2d>& pixels, const std::string& held) const {
  std::string gesture = held.empty() ? "" : "keydown " + held + " ";
  gesture += pressed_along(pixels) + "mouseup 1";
  if (!held.empty()) gesture += " keyup " + held;
  desktop_.xdotool(gesture);
}

void Person::drag_disk(const Vector3d& center, const Vector3d& rim) const {
  keys("d");
  drag_between(center, rim);
}

void Person::drag_between(const Vector3d& from, const Vector3d& to) const {
  const Vector2d first = pixel_of(from);
  const Vector2d last = pixel_of(to);
  drag({first, 0.5 * (first + last), last});
}

void Person::hold(const std::vector<Vector2d>& pixels) const {
  desktop_.xdotool(pressed_along(pixels));
}

void Person::let_go() const {
  desktop_.xdotool("mouseup 1");
}

void Person::move_to(const Vector2d& pixel) const {
  desktop_.xdotool(at(pixel));
}

std::optional<viewer::Draft> Person::draft() const {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(journals(), none)) {
    if (entry.path().extension() != ".journal") continue;
    if (auto edit = viewer::read_journal(entry.path())) return edit->draft;
  }
  return {};
}

bool Person::eventually_is(const std::function<bool(const viewer::Draft&)>& wanted) const {
  return eventually(kPersonPatience, [&] {
    const auto now = draft();
    return now && wanted(*now);
  });
}

Eigen::Vector2d middle_of(const viewer::Gizmo& gizmo, viewer::GizmoPart part,
                          const viewer::Projection& projection) {
  const viewer::GizmoLines lines(gizmo, projection);
  for (const viewer::GizmoLine& line : lines.lines()) {
    if (line.part != part) continue;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    if (viewer::is_plane(part)) {
      for (const Eigen::Vector2d& pixel : line.pixels) sum += pixel;
      return sum / static_cast<double>(line.pixels.size());
    }
    return line.pixels.size() > 2 ? line.pixels[line.pixels.size() / 2]
                                  : 0.5 * (line.pixels.front() + line.pixels.back());
  }
  throw std::invalid_argument("that part of the gizmo does not show from here");
}

}  // namespace lapwing::test
