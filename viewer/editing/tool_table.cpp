#include "editing/tool_table.h"

#include <array>

namespace lapwing::viewer {
namespace {

template <PaintTool::Shape shape>
SceneTool& take_paint(Tools& tools) {
  tools.paint.options().shape = shape;
  return tools.paint;
}

using Shape = PaintTool::Shape;

constexpr std::array kRows{
    ToolRow{"Grab", Action::take_grab, [](Tools& tools) -> SceneTool& { return tools.grab; }},
    ToolRow{"Disk", Action::take_disk, [](Tools& tools) -> SceneTool& { return tools.disk; }},
    ToolRow{"Loop", Action::take_loop, [](Tools& tools) -> SceneTool& { return tools.loop; }},
    ToolRow{"Brush", Action::take_brush, take_paint<Shape::brush>},
    ToolRow{"Lasso", Action::take_lasso, take_paint<Shape::lasso>},
    ToolRow{"Box", Action::take_box, take_paint<Shape::box>},
    ToolRow{"Pin", Action::take_pin, [](Tools& tools) -> SceneTool& { return tools.pin; }},
    ToolRow{"Stiffness", Action::take_stiffness,
            [](Tools& tools) -> SceneTool& { return tools.stiffness; }},
    ToolRow{"Move", Action::take_move, [](Tools& tools) -> SceneTool& { return tools.gizmo; }},
    ToolRow{"Measure", Action::take_ruler, [](Tools& tools) -> SceneTool& { return tools.ruler; }}};

}  // namespace

std::span<const ToolRow> tool_rows() {
  return kRows;
}

}  // namespace lapwing::viewer
