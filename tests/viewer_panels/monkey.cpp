#include "viewer_panels/monkey.h"

#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <thread>

#include "navigation/keymap.h"

namespace lapwing::viewer::test {
namespace {

using Eigen::Vector2d;

// Beside those that start something.
constexpr auto kOtherKeys = std::to_array<int>(
    {'G', 'R', 'S', 'W', 'E', 'Q', 'X', 'Y', 'Z', kEnter, kEscape, kBackspace, kDelete, kEnd});
constexpr auto kNames = std::to_array<std::string_view>(
    {"tube.obj", "ball.ply", "other.obj", "result.ply", "steps.json", "view.png", "nothing.obj"});
constexpr auto kNumbers = std::to_array<std::string_view>(
    {"0", "1", "-0.5", "3", "1e3", "0.01", "-", "90", "abc", "1e-12", "12.5"});

std::string words_of(const Vector2d& place) {
  return std::to_string(std::lround(place.x())) + "," + std::to_string(std::lround(place.y()));
}

std::string words_of(const Modifiers& held) {
  return std::string(held.control ? "Ctrl " : "") + (held.shift ? "Shift " : "") +
         (held.alt ? "Alt " : "");
}

}  // namespace

// Half of them near the middle of the picture, where the mesh is.
Vector2d Monkey::place() {
  const auto& [width, height] = viewer_->look().size;
  if (below(2) == 0) return {share() * width, share() * height};
  return {(0.45 + 0.4 * share()) * width, (0.25 + 0.5 * share()) * height};
}

// Where all of the mesh is shown.
Vector2d Monkey::place_on_mesh() {
  const auto& [width, height] = viewer_->look().size;
  return {(0.60 + 0.15 * share()) * width, (0.4 + 0.3 * share()) * height};
}

Modifiers Monkey::modifiers() {
  switch (below(8)) {
    case 0:
      return {.shift = true};
    case 1:
      return kControl;
    case 2:
      return {.shift = true, .control = true};
    case 3:
      return {.alt = true};
    default:
      return {};
  }
}

void Monkey::send(InputKind kind, const Vector2d& at, MouseButton button, const Modifiers& held) {
  viewer_->send({.kind = kind, .position = at, .button = button, .modifiers = held});
}

void Monkey::click_at(const Vector2d& at, MouseButton button, const Modifiers& held) {
  send(InputKind::move, at, MouseButton::none, held);
  send(InputKind::press, at, button, held);
  send(InputKind::release, at, button, held);
}

void Monkey::press_key(int key, const Modifiers& held) {
  // On most keyboards a '?' is on another key, with Shift.
  const bool is_shifted = key == '?';
  viewer_->send({.kind = InputKind::key,
                 .modifiers = is_shifted ? Modifiers{.shift = true} : held,
                 .key = is_shifted ? '/' : key});
  if (key > ' ' && key < 128 && !held.control && !held.alt) {
    viewer_->send({.kind = InputKind::text, .text = static_cast<char32_t>(std::tolower(key))});
  }
}

void Monkey::type(std::string_view text) {
  for (const char letter : text) press_key(std::toupper(static_cast<unsigned char>(letter)));
}

std::string Monkey::drag() {
  constexpr auto kButtons = std::to_array({MouseButton::left, MouseButton::left, MouseButton::left,
                                           MouseButton::middle, MouseButton::right});
  const MouseButton button = one_of(kButtons);
  const Modifiers held = modifiers();
  Vector2d at = place();
  std::string words = "drag " + words_of(held) + std::to_string(static_cast<int>(button));
  send(InputKind::move, at, MouseButton::none, held);
  send(InputKind::press, at, button, held);
  words += " " + words_of(at);
  for (std::size_t moves = 1 + below(4); moves > 0; --moves) {
    at = below(3) == 0 ? place() : at + 60.0 * Vector2d(share() - 0.5, share() - 0.5);
    send(InputKind::move, at, button, held);
    words += " " + words_of(at);
  }
  if (below(12) == 0) {
    press_key(kEscape);
    words += " Escape";
  }
  send(InputKind::release, at, button, held);
  return words;
}

std::string Monkey::click() {
  const MouseButton button = below(6) == 0 ? MouseButton::right : MouseButton::left;
  const Modifiers held = modifiers();
  const Vector2d at = place();
  click_at(at, button, held);
  return "click " + words_of(held) + words_of(at);
}

std::string Monkey::click_on_text() {
  const std::vector<ShownText> texts = viewer_->look_at();
  if (texts.empty()) return "click on nothing";
  const ShownText text = one_of(texts);
  const Vector2d at(text.middle().x, text.middle().y);
  const Modifiers held = below(8) == 0 ? kControl : Modifiers{};
  click_at(at, MouseButton::left, held);
  return "click on \"" + text.words + "\" " + words_of(held);
}

// A slider follows.
std::string Monkey::pull_on_text() {
  const std::vector<ShownText> texts = viewer_->look_at();
  if (texts.empty()) return "pull on nothing";
  const ShownText text = one_of(texts);
  Vector2d at(text.middle().x, text.middle().y);
  send(InputKind::move, at, MouseButton::none, {});
  send(InputKind::press, at, MouseButton::left, {});
  for (int moves = 0; moves < 3; ++moves) {
    at.x() += 80.0 * (share() - 0.5);
    send(InputKind::move, at, MouseButton::left, {});
  }
  send(InputKind::release, at, MouseButton::left, {});
  return "pull on \"" + text.words + "\"";
}

std::string Monkey::scroll() {
  const Vector2d at = place();
  const Modifiers held = modifiers();
  const double notches = std::floor(7.0 * share()) - 3.0;
  send(InputKind::move, at, MouseButton::none, held);
  viewer_->send({.kind = InputKind::scroll, .position = at, .modifiers = held, .scroll = notches});
  return "scroll " + words_of(held) + std::to_string(std::lround(notches)) + " at " + words_of(at);
}

std::string Monkey::press_bound_key() {
  if (below(3) == 0) {
    const int key = one_of(kOtherKeys);
    press_key(key);
    return "key " + std::to_string(key);
  }
  const KeyBinding binding = one_of(key_bindings());
  press_key(binding.key, binding.modifiers);
  return "key for " + control_of(binding.action).what;
}

void Monkey::drag_along(const Vector2d& from, const Vector2d& to) {
  send(InputKind::move, from, MouseButton::none, {});
  send(InputKind::press, from, MouseButton::left, {});
  send(InputKind::move, 0.5 * (from + to), MouseButton::left, {});
  send(InputKind::move, to, MouseButton::left, {});
  send(InputKind::release, to, MouseButton::left, {});
}

std::string Monkey::edit() {
  press_key(kHome);
  press_key('D');
  press_key('I');
  const Vector2d middle = place_on_mesh();
  const double radius = 40.0 + 80.0 * share();
  drag_along(middle, middle + Vector2d(radius, 0.0));
  press_key('H');
  drag_along(middle, middle + Vector2d(0.3 * radius, 0.0));
  return "edit about " + words_of(middle) + ", " + move_handle();
}

std::string Monkey::coat_or_mix() {
  const bool coats = below(2) == 0;
  press_key(coats ? 'K' : 'M', kControl);
  viewer_->look_at();
  const auto& [width, height] = viewer_->look().size;
  for (int source = 0; source < (coats ? 1 : 2); ++source) {
    if (source == 1) press_key('K', {.shift = true});
    const Vector2d middle((0.42 + 0.1 * share()) * width, (0.35 + 0.3 * share()) * height);
    drag_along(middle, middle + Vector2d(20.0 + 40.0 * share(), 0.0));
  }
  press_key(kEnter, kControl);
  return coats ? "coat" : "mix";
}

std::string Monkey::transplant() {
  press_key('N');
  wait();
  const Vector2d at = place_on_mesh();
  click_at(at, MouseButton::left, {});
  press_key(kEnter);
  return "transplant to " + words_of(at);
}

std::string Monkey::move_handle() {
  constexpr std::array kMoves{'G', 'R', 'S'};
  constexpr std::array kAxes{'X', 'Y', 'Z'};
  const char move = one_of(kMoves);
  std::string words = std::string("move by ") + move;
  press_key(move);
  if (below(2) == 0) {
    const char axis = one_of(kAxes);
    press_key(axis);
    words += axis;
  }
  if (below(2) == 0) {
    const std::string_view number = one_of(kNumbers);
    type(number);
    words += " " + std::string(number);
  } else {
    const Vector2d at = place();
    send(InputKind::move, at, MouseButton::none, {});
    words += " to " + words_of(at);
  }
  const bool gives_up = below(5) == 0;
  press_key(gives_up ? kEscape : kEnter);
  return words + (gives_up ? ", given up" : "");
}

std::string Monkey::type_number() {
  const std::string_view number = one_of(kNumbers);
  type(number);
  press_key(kEnter);
  return "type " + std::string(number);
}

std::string Monkey::undo_or_redo() {
  const std::size_t times = 1 + below(4);
  const bool undoes = below(5) < 3;
  for (std::size_t k = 0; k < times; ++k) {
    press_key('Z', {.shift = !undoes, .control = true});
  }
  return (undoes ? "undo " : "redo ") + std::to_string(times) + " times";
}

std::string Monkey::open_file() {
  const std::string_view name = kNames[below(3)];
  viewer_->app().open(viewer_->folder() / name);
  viewer_->look_at();
  // Where there is nothing else to do. Another file would take its place before it is read.
  if (!has_own_file()) viewer_->wait_for([this] { return has_own_file(); }, "a mesh is open");
  return "drop " + std::string(name) + " on the window";
}

std::string Monkey::wait() {
  const auto pause = std::chrono::milliseconds(below(60));
  std::this_thread::sleep_for(pause);
  viewer_->look_at();
  return "wait";
}

// It could reach files of others.
std::string Monkey::answer_browser() {
  if (below(2) == 0) {
    press_key(kEscape);
    return "close the browser";
  }
  const std::string_view name = one_of(kNames);
  const std::string path = (viewer_->folder() / name).string();
  press_key('A', kControl);
  for (const char letter : path) {
    viewer_->send({.kind = InputKind::text, .text = static_cast<unsigned char>(letter)});
  }
  press_key(kEnter);
  return "choose " + std::string(name);
}

// The samples of the start are files of others as well.
bool Monkey::has_own_file() const {
  const Document* document = viewer_->app().document();
  return document != nullptr && document->opened.file &&
         document->opened.file->path.parent_path() == viewer_->folder();
}

std::string Monkey::act() {
  if (viewer_->app().asks_for_path()) return answer_browser();
  if (!has_own_file()) return open_file();
  struct Choice {
    std::size_t weight;
    Gesture gesture;
  };
  static constexpr auto kGestures = std::to_array<Choice>({{18, &Monkey::drag},
                                                           {12, &Monkey::click},
                                                           {14, &Monkey::click_on_text},
                                                           {5, &Monkey::pull_on_text},
                                                           {7, &Monkey::scroll},
                                                           {18, &Monkey::press_bound_key},
                                                           {6, &Monkey::edit},
                                                           {2, &Monkey::coat_or_mix},
                                                           {2, &Monkey::transplant},
                                                           {10, &Monkey::move_handle},
                                                           {4, &Monkey::type_number},
                                                           {7, &Monkey::undo_or_redo},
                                                           {1, &Monkey::open_file},
                                                           {4, &Monkey::wait}});
  std::size_t total = 0;
  for (const Choice& choice : kGestures) total += choice.weight;
  std::size_t at = below(total);
  for (const Choice& choice : kGestures) {
    if (at < choice.weight) return (this->*choice.gesture)();
    at -= choice.weight;
  }
  return {};
}

}  // namespace lapwing::viewer::test
