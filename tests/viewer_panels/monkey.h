#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {

/// Does at random what a person can do with mouse and keys, but for one thing: files are named in
/// the viewer's folder alone. Of one seed it does the same wherever the viewer shows the same.
class Monkey {
 public:
  Monkey(ShownViewer& viewer, std::uint64_t seed) : viewer_(&viewer), random_(seed) {}

  /// One gesture; what it was, in words.
  std::string act();
  /// As one does who knows how: a disk, a smaller one within it as the handle, and that is moved.
  std::string edit();
  /// Goes on with another viewer.
  void go_to(ShownViewer& viewer) { viewer_ = &viewer; }

 private:
  using Gesture = std::string (Monkey::*)();

  std::size_t below(std::size_t count) { return random_() % count; }
  /// Between 0 and 1.
  double share() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
  template <typename Items>
  const auto& one_of(const Items& items) {
    return items[below(items.size())];
  }
  bool has_own_file() const;
  Eigen::Vector2d place();
  Eigen::Vector2d place_on_mesh();
  Modifiers modifiers();
  void send(InputKind kind, const Eigen::Vector2d& at, MouseButton button, const Modifiers& held);
  void click_at(const Eigen::Vector2d& at, MouseButton button, const Modifiers& held);
  void drag_along(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  void press_key(int key, const Modifiers& held = {});
  void type(std::string_view text);

  std::string drag();
  std::string click();
  std::string click_on_text();
  std::string pull_on_text();
  std::string scroll();
  std::string press_bound_key();
  std::string coat_or_mix();
  std::string transplant();
  std::string move_handle();
  std::string type_number();
  std::string undo_or_redo();
  std::string open_file();
  std::string wait();
  std::string answer_browser();

  ShownViewer* viewer_;
  std::mt19937_64 random_;
};

}  // namespace lapwing::viewer::test
