#pragma once

#include <algorithm>
#include <imgui.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "editing/editor.h"
#include "ui/widgets.h"

namespace lapwing::viewer {

inline constexpr ImU32 kHighlight = IM_COL32(255, 220, 90, 255);
inline constexpr ImU32 kLine = IM_COL32(255, 240, 200, 255);
inline constexpr ImU32 kShade = IM_COL32(20, 20, 24, 160);
inline constexpr ImU32 kGround = IM_COL32(20, 20, 24, 225);
inline constexpr double kThickPt = 2.5;

/// Draws text on a dark background, so that it is legible on any scene. The text moves into the
/// window if it would leave it, and wraps if it is wider than half of the window.
inline void draw_words(ImDrawList& list, const Eigen::Vector2d& place, const std::string& words) {
  const ImGuiViewport& window = *ImGui::GetMainViewport();
  const float wrap = 0.5F * window.WorkSize.x;
  const ImVec2 size = ImGui::CalcTextSize(words.c_str(), nullptr, false, wrap);
  const float padding = 0.27F * ImGui::GetFontSize();
  const auto inside = [padding](double wanted, float least, float most, float length) {
    return std::max(std::min(static_cast<float>(wanted), most - length - padding), least + padding);
  };
  const ImVec2 from{
      inside(place.x(), window.WorkPos.x, window.WorkPos.x + window.WorkSize.x, size.x),
      inside(place.y(), window.WorkPos.y, window.WorkPos.y + window.WorkSize.y, size.y)};
  list.AddRectFilled({from.x - padding, from.y - 0.5F * padding},
                     {from.x + size.x + padding, from.y + size.y + 0.5F * padding}, kGround,
                     ImGui::GetStyle().FrameRounding);
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), from, kLine, words.c_str(), nullptr, wrap);
}

/// Draws over the scene and under the panels. Positions are in pixels of the rendered image, sizes
/// in points.
class Pen {
 public:
  Pen(const ViewFrame& view, double pixels_per_unit, std::vector<Eigen::Vector2d>& points,
      const Eigen::Vector2d& corner = Eigen::Vector2d::Zero())
      : list_(*ImGui::GetBackgroundDrawList()),
        projection_(view.projection()),
        corner_(corner),
        unit_(pixels_per_unit),
        units_per_point_(view.pixels_per_point / pixels_per_unit),
        points_(points) {}

  const Projection& projection() const { return projection_; }

  /// Draws the line over a wider dark line, so that it is visible on any surface.
  void line(std::span<const Eigen::Vector2d> pixels, bool closed, ImU32 color,
            double thickness_pt) {
    if (pixels.size() < 2) return;
    for (const auto& [shade, width_pt] :
         {std::pair{kShade, thickness_pt + 2.0}, std::pair{color, thickness_pt}}) {
      for (const Eigen::Vector2d& pixel : pixels) list_.PathLineTo(at(pixel));
      list_.PathStroke(shade, closed ? ImDrawFlags_Closed : ImDrawFlags_None, units(width_pt));
    }
  }

  void area(std::span<const Eigen::Vector2d> pixels, ImU32 color) {
    for (const Eigen::Vector2d& pixel : pixels) list_.PathLineTo(at(pixel));
    list_.PathFillConvex(color);
  }

  void circle(const Eigen::Vector2d& pixel, double radius_pt, ImU32 color) {
    list_.AddCircle(at(pixel), units(radius_pt), kShade, 0, units(kThickPt + 1.0));
    list_.AddCircle(at(pixel), units(radius_pt), color, 0, units(kThickPt - 1.0));
  }

  void dot(const Eigen::Vector2d& pixel, ImU32 color) {
    list_.AddCircleFilled(at(pixel), units(5.0), kShade);
    list_.AddCircleFilled(at(pixel), units(4.0), color);
  }

  /// Draws text. Its upper left corner is at `pixel` plus `offset_pt`.
  void text(const Eigen::Vector2d& pixel, const Eigen::Vector2d& offset_pt,
            const std::string& words) {
    draw_words(list_, (corner_ + pixel) / unit_ + units_per_point_ * offset_pt, words);
  }

  /// Projects the points to pixels. Omits points behind the camera. The span is valid until the
  /// next call.
  std::span<const Eigen::Vector2d> pixels_of(std::span<const Eigen::Vector3d> points) {
    points_.clear();
    for (const Eigen::Vector3d& point : points) {
      if (const auto pixel = projection_.to_pixel(point)) points_.push_back(*pixel);
    }
    return points_;
  }

  /// Projects the vertices to pixels, likewise.
  std::span<const Eigen::Vector2d> pixels_of(const Editor& editor,
                                             std::span<const Index> vertices) {
    points_.clear();
    for (const Index v : vertices) {
      if (const auto pixel = projection_.to_pixel(editor.view().positions()[v]))
        points_.push_back(*pixel);
    }
    return points_;
  }

 private:
  ImVec2 at(const Eigen::Vector2d& pixel) const { return to_imgui((corner_ + pixel) / unit_); }

  float units(double points) const { return static_cast<float>(units_per_point_ * points); }

  ImDrawList& list_;
  const Projection projection_;
  const Eigen::Vector2d corner_;
  const double unit_;  // ImGui's unit, in pixels
  const double units_per_point_;
  std::vector<Eigen::Vector2d>& points_;
};

}  // namespace lapwing::viewer
