#include "navigation/axis_gizmo.h"

#include <algorithm>

namespace lapwing::viewer {

std::array<AxisEnd, 6> axis_ends(const Camera& camera) {
  const Eigen::Matrix3d axes = camera.view().topLeftCorner<3, 3>();
  std::array<AxisEnd, 6> ends;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    AxisEnd& end = ends[e];
    end.axis = static_cast<Eigen::Index>(e / 2);
    end.positive = e % 2 == 0;
    const Eigen::Vector3d direction = (end.positive ? 1.0 : -1.0) * axes.col(end.axis);
    end.offset_pt = kAxisPt * Eigen::Vector2d(direction.x(), -direction.y());
    end.toward_eye = direction.z();
  }
  // std::stable_sort would allocate in every frame.
  std::sort(ends.begin(), ends.end(),
            [](const AxisEnd& a, const AxisEnd& b) { return a.toward_eye < b.toward_eye; });
  return ends;
}

std::optional<AxisEnd> axis_end_at(const Camera& camera, const Eigen::Vector2d& offset_pt) {
  const std::array<AxisEnd, 6> ends = axis_ends(camera);
  const auto found = std::find_if(ends.rbegin(), ends.rend(), [&](const AxisEnd& end) {
    return (offset_pt - end.offset_pt).norm() <= kAxisEndPt;
  });
  if (found == ends.rend()) return {};
  return *found;
}

View view_from(const AxisEnd& end, UpAxis up_axis) {
  const Eigen::Vector3d direction = (end.positive ? 1.0 : -1.0) * Eigen::Vector3d::Unit(end.axis);
  for (const View view : {View::front, View::back, View::left, View::right, View::top}) {
    if (view_axes(view, up_axis).toward_eye.dot(direction) > 0.5) return view;
  }
  return View::bottom;
}

}  // namespace lapwing::viewer
