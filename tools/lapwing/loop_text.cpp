#include "loop_text.h"

#include <array>
#include <cstdio>

#include "lapwing/transplant/loop_curve.h"

namespace lapwing::cli {

std::string loop_text(const BoundaryLoop& loop, std::span<const Eigen::Vector3d> positions) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%zu vertices from vertex %zu, %.4g long", loop.size(),
                std::size_t{loop.front()}, loop_length(loop, positions));
  return text.data();
}

}  // namespace lapwing::cli
