#include "ui/mirror_choice.h"

#include <array>

#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

constexpr std::array kAxes{MirrorChoice::x, MirrorChoice::y, MirrorChoice::z};

}  // namespace

std::optional<MirrorChoice> choice_of(const MirrorPlane& plane) {
  for (const MirrorChoice axis : kAxes) {
    if (plane == plane_of(axis)) return axis;
  }
  return std::nullopt;
}

std::optional<MirrorPlane> plane_of(MirrorChoice choice) {
  for (std::size_t k = 0; k < kAxes.size(); ++k) {
    if (choice != kAxes[k]) continue;
    return MirrorPlane{Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(static_cast<int>(k))};
  }
  return std::nullopt;
}

bool choose_mirror(std::optional<MirrorChoice>& choice) {
  return choose<std::optional<MirrorChoice>>("Mirror", choice,
                                             {{"Off", MirrorChoice::off},
                                              {"X", MirrorChoice::x},
                                              {"Y", MirrorChoice::y},
                                              {"Z", MirrorChoice::z},
                                              {"Shape", MirrorChoice::shape}});
}

}  // namespace lapwing::viewer
