#include "report/svg.h"

#include <array>
#include <cstdio>

#include "report/number_text.h"

namespace lapwing::bench {
namespace {

// A tenth of a pixel is finer than anyone sees.
std::string pixels(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  std::string digits = text;
  if (digits.ends_with(".0")) digits.resize(digits.size() - 2);
  return digits == "-0" ? "0" : digits;
}

std::string attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + pixels(value) + "\"";
}

std::string class_of(std::string_view classes) {
  return " class=\"" + std::string(classes) + "\"";
}

// About (0, 0): a disc's octagon, a square, a triangle, a diamond, a triangle upside down.
constexpr std::array<const char*, Svg::kMarkers> kShapes{
    "M-4-1.7L-1.7-4H1.7L4-1.7V1.7L1.7 4H-1.7L-4 1.7Z", "M-3.6-3.6H3.6V3.6H-3.6Z",
    "M0-4.6L4.4 3.4H-4.4Z", "M0-5L5 0L0 5L-5 0Z", "M0 4.6L4.4-3.4H-4.4Z"};

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

double text_width(std::string_view text) {
  // In ems, as wide as in DejaVu Sans, the widest of the usual ones.
  double width = 0.0;
  for (const char c : text) {
    const bool continues = (static_cast<unsigned char>(c) >> 6) == 2;  // of a UTF-8 sequence
    const bool is_capital = c >= 'A' && c <= 'Z';
    if (continues) continue;
    if (std::string_view("fijlrtI.,:;' ()|/").find(c) != std::string_view::npos) {
      width += 0.38;
    } else if (std::string_view("mwMW%^~+").find(c) != std::string_view::npos) {
      width += 0.9;
    } else {
      width += is_capital ? 0.78 : 0.62;
    }
  }
  return width * kTextSize;
}

void Svg::close(std::string_view name, std::string_view tooltip) {
  if (tooltip.empty()) {
    body_ += "/>\n";
  } else {
    body_ += "><title>" + escaped(tooltip) + "</title></" + std::string(name) + ">\n";
  }
}

void Svg::line(Point from, Point to, std::string_view classes) {
  body_ += "<line" + class_of(classes) + attribute("x1", from.x) + attribute("y1", from.y) +
           attribute("x2", to.x) + attribute("y2", to.y) + "/>\n";
}

void Svg::polyline(const std::vector<Point>& points, std::string_view classes) {
  body_ += "<polyline" + class_of(classes) + " points=\"";
  for (const Point& point : points) {
    if (body_.back() != '"') body_ += ' ';
    body_ += pixels(point.x) + "," + pixels(point.y);
  }
  body_ += "\"/>\n";
}

void Svg::rectangle(Point corner, double width, double height, std::string_view classes,
                    std::string_view tooltip) {
  body_ += "<rect" + class_of(classes) + attribute("x", corner.x) + attribute("y", corner.y) +
           attribute("width", width) + attribute("height", height);
  close("rect", tooltip);
}

void Svg::marker(Point at, std::size_t shape, std::string_view classes, std::string_view tooltip) {
  body_ += "<path" + class_of(classes) + " transform=\"translate(" + pixels(at.x) + " " +
           pixels(at.y) + ")\" d=\"" + kShapes[shape % kMarkers] + "\"";
  close("path", tooltip);
}

void Svg::text(Point at, std::string_view text, std::string_view classes, Anchor anchor) {
  if (text.empty()) return;
  constexpr std::array<const char*, 3> kAnchors{"start", "middle", "end"};
  body_ += "<text" + class_of(classes) + attribute("x", at.x) + attribute("y", at.y) +
           " text-anchor=\"" + kAnchors[static_cast<std::size_t>(anchor)] + "\">" + escaped(text) +
           "</text>\n";
}

void Svg::place(const Svg& picture, Point corner) {
  body_ += "<g transform=\"translate(" + pixels(corner.x) + " " + pixels(corner.y) + ")\">\n" +
           picture.body_ + "</g>\n";
}

std::string Svg::element(std::string_view label, std::string_view style) const {
  const std::string size = pixels(width_) + " " + pixels(height_);
  std::string text =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" role=\"img\" aria-label=\"" +
      escaped(label) + "\" viewBox=\"0 0 " + size + "\"" + attribute("width", width_) +
      attribute("height", height_) + ">\n";
  if (!style.empty()) text += "<style>\n" + std::string(style) + "</style>\n";
  return text + body_ + "</svg>\n";
}

}  // namespace lapwing::bench
