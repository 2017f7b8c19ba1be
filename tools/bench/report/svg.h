#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lapwing::bench {

/// In pixels, y downwards.
struct Point {
  double x = 0;
  double y = 0;
};

enum class Anchor { start, middle, end };

/// "&", "<", ">" and quotes as HTML and SVG need them.
std::string escaped(std::string_view text);

/// Height of the text of plots, in pixels.
inline constexpr double kTextSize = 12;

/// How wide the text is at most in any usual typeface of that size; nobody can ask the reader's.
double text_width(std::string_view text);

/// A picture made of shapes, which say by class how they look (theme.h).
class Svg {
 public:
  Svg(double width, double height) : width_(width), height_(height) {}

  double width() const { return width_; }
  double height() const { return height_; }

  void line(Point from, Point to, std::string_view classes);
  void polyline(const std::vector<Point>& points, std::string_view classes);
  /// `tooltip` is shown when the pointer rests on it; none if empty.
  void rectangle(Point corner, double width, double height, std::string_view classes,
                 std::string_view tooltip = {});
  /// A sign about 9 pixels wide, of one of kMarkers shapes (taken round).
  void marker(Point at, std::size_t shape, std::string_view classes, std::string_view tooltip = {});
  /// `at` is on the base line.
  void text(Point at, std::string_view text, std::string_view classes, Anchor anchor);
  /// Another picture with its upper left corner at `corner`.
  void place(const Svg& picture, Point corner);

  /// The whole as an element that can stand in a page or in a file; `label` says what is seen, for
  /// who cannot see it; `style` is put in if it is not empty.
  std::string element(std::string_view label, std::string_view style = {}) const;

  static constexpr std::size_t kMarkers = 5;

 private:
  void close(std::string_view name, std::string_view tooltip);

  double width_;
  double height_;
  std::string body_;
};

}  // namespace lapwing::bench
