#pragma once

#include <array>
#include <imgui.h>
#include <memory>
#include <vector>

#include "lapwing/mesh/shapes.h"
#include "lapwing/render/surface.h"
#include "window/app.h"
#include "window/theme.h"

namespace lapwing::viewer::test {

/// A sphere on a device that its twelve parameters move: an affine motion of its upper half.
class DraggedSphere {
 public:
  explicit DraggedSphere(const std::shared_ptr<gpu::Context>& context)
      : mesh_(icosphere(3)),
        topology_(mesh_.topology()),
        surface_(context, mesh_.positions, topology_),
        blend_(make(context)),
        paint_(surface_) {
    surface_.begin(*blend_, mesh_.positions);
    scene_.surface = &surface_;
    scene_.paint = &paint_;
    scene_.camera = fit(mesh_.positions, view_axes(View::front), 1.6);
  }

  Surface& surface() { return surface_; }

  /// Moves it along x by `distance`, and a little in every other way.
  void drag(double distance) {
    std::array<double, 12> parameters;
    parameters.fill(0.01 * distance);
    parameters[9] = distance;
    surface_.blend(blend_, parameters);
  }

  const Scene& scene() const { return scene_; }

 private:
  // Column 3 r + a: coordinate r of a vertex, and 1 for r = 3, along axis a.
  std::shared_ptr<BlendResponse> make(const std::shared_ptr<gpu::Context>& context) {
    std::vector<Index> moving;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (mesh_.positions[v].y() >= 0.0) moving.push_back(v);
    }
    std::vector<double> basis;
    for (std::size_t column = 0; column < 12; ++column) {
      for (const Index v : moving) {
        const double value =
            column < 9 ? mesh_.positions[v][static_cast<Eigen::Index>(column / 3)] : 1.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          basis.push_back(axis == column % 3 ? value : 0.0);
        }
      }
    }
    return upload_response(context, {moving, 12, basis}, topology_);
  }

  Mesh mesh_;
  Topology topology_;
  Surface surface_;
  std::shared_ptr<BlendResponse> blend_;
  SurfacePaint paint_;
  Scene scene_;
};

/// Panels of a frame laid out without a window.
class WindowlessPanels {
 public:
  explicit WindowlessPanels(VkExtent2D size) {
    ImGui::CreateContext();
    set_fonts(1.0);
    set_theme(Theme::dark, 1.0);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    io.DeltaTime = 1.0F / 60.0F;
  }
  ~WindowlessPanels() { ImGui::DestroyContext(); }
  WindowlessPanels(const WindowlessPanels&) = delete;
  WindowlessPanels& operator=(const WindowlessPanels&) = delete;

  /// One panel at the left edge.
  const ImDrawData& lay_out() {
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize({80.0F, 100.0F});
    if (ImGui::Begin("Panel")) ImGui::TextUnformatted("a text");
    ImGui::End();
    ImGui::Render();
    return *ImGui::GetDrawData();
  }
};

}  // namespace lapwing::viewer::test
