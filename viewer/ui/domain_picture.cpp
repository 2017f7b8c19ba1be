#include <algorithm>
#include <imgui.h>

#include "lapwing/coating/layered_coat.h"
#include "ui/panels.h"

namespace lapwing::viewer {
namespace {

constexpr ImU32 kFrame = IM_COL32(30, 30, 34, 255);
constexpr ImU32 kSource = IM_COL32(242, 194, 77, 150);
constexpr ImU32 kTarget = IM_COL32(110, 170, 255, 150);
constexpr ImU32 kPin = IM_COL32(255, 90, 90, 255);
constexpr float kPinLetters = 0.27F;  // radius of a pin, in letters of the font
// More lines than this are only a grey area, and cost more than drawing the surface.
constexpr std::size_t kMostEdges = 12'000;

// Maps points of the domain to the screen.
struct DomainWindow {
  ImVec2 corner;
  float width;
  Domain domain;

  ImVec2 at(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d share =
        domain == Domain::disk ? Eigen::Vector2d(0.5 * (point.array() + 1.0)) : point;
    return {corner.x + width * static_cast<float>(0.04 + 0.92 * share.x()),
            corner.y + width * static_cast<float>(0.96 - 0.92 * share.y())};
  }
};

// Draws each inner edge once, or every n-th one if there are too many.
void draw_edges(ImDrawList& list, const DomainWindow& window, const Patch& patch,
                const DomainMap& map, ImU32 color) {
  const std::size_t every = patch.triangles.size() * 3 / 2 / kMostEdges + 1;
  std::size_t number = 0;
  for (const Triangle& triangle : patch.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Index a = triangle[c];
      const Index b = triangle[(c + 1) % 3];
      if (a < b && number++ % every == 0) {
        list.AddLine(window.at(map.points[a]), window.at(map.points[b]), color);
      }
    }
  }
}

}  // namespace

void draw_domain(const LayeredCoat* layers, std::size_t source) {
  const float width =
      std::max(4.0F * ImGui::GetFontSize(),
               std::min(ImGui::GetContentRegionAvail().x, 18.0F * ImGui::GetFontSize()));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + width, corner.y + width}, kFrame);
  ImGui::Dummy({width, width});
  if (layers == nullptr || source >= layers->source_count()) return;
  const Correspondence& map = layers->map(source);
  const DomainWindow window{corner, width, map.target.domain};
  draw_edges(list, window, layers->source_patch(source), map.source, kSource);
  draw_edges(list, window, layers->target_patch(), map.target, kTarget);
  for (const VertexPair& pin : map.pins) {
    const Index own = layers->target_patch().own_number(pin[1]);
    if (own == kNoIndex) continue;
    list.AddCircleFilled(window.at(map.target.points[own]), kPinLetters * ImGui::GetFontSize(),
                         kPin);
  }
  // Each name has the colour of its lines and their background.
  const float line = ImGui::GetFontSize();
  list.AddText({corner.x + 0.3F * line, corner.y + 0.1F * line}, kSource | IM_COL32_A_MASK,
               "Source");
  list.AddText({corner.x + 0.3F * line, corner.y + 1.2F * line}, kTarget | IM_COL32_A_MASK,
               "Target");
}

}  // namespace lapwing::viewer
