#include "lapwing/render/draw_order.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"
#include "lapwing/mesh/morton_order.h"

namespace lapwing {
namespace {

using Eigen::Vector4f;

// Triangles per parallel task.
constexpr std::size_t kRun = 4096;

// cos_smooth of shaders/surface.vert. If the cosine between the normals of the face and a vertex is
// at least this, the corner has the vertex's normal.
constexpr float kCosSmooth = 0.87F;

Eigen::Map<const Vector4f, Eigen::Aligned16> lanes(const Vec4& v) {
  return Eigen::Map<const Vector4f, Eigen::Aligned16>(v.data());
}

// Returns false if a normal or a position is NaN.
bool is_smooth(const Triangle& triangle, std::span<const Vec4> positions,
               std::span<const Vec4> normals) {
  const Vector4f a = lanes(positions[triangle[0]]);
  const Vector4f across =
      (lanes(positions[triangle[1]]) - a).cross3(lanes(positions[triangle[2]]) - a);
  const float least = kCosSmooth * across.norm();
  return lanes(normals[triangle[0]]).dot(across) >= least &&
         lanes(normals[triangle[1]]).dot(across) >= least &&
         lanes(normals[triangle[2]]).dot(across) >= least;
}

}  // namespace

std::vector<Index> morton_order(std::span<const Vec4> positions,
                                std::span<const Triangle> triangles) {
  std::vector<Eigen::Vector3f> middles;
  middles.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const auto middle = [&](std::size_t axis) {
      return (positions[t[0]][axis] + positions[t[1]][axis] + positions[t[2]][axis]) / 3.0F;
    };
    middles.emplace_back(middle(0), middle(1), middle(2));
  }
  return morton_order(middles);
}

DrawOrder::DrawOrder(const gpu::Context& context, std::span<const Vec4> positions,
                     std::span<const Triangle> triangles)
    : numbers_(morton_order(positions, triangles)),
      triangles_(triangles.size()),
      is_smooth_(triangles.size(), 0),
      smooth_in_((triangles.size() + kRun - 1) / kRun, 0),
      indices_(context, "drawn corners", (triangles.size() + 1) * sizeof(Triangle)) {
  std::transform(numbers_.begin(), numbers_.end(), triangles_.begin(),
                 [&](Index number) { return triangles[number]; });
  write(0, triangles_.size(), 0);
  indices_.mapped_as<Triangle>().back() = {0, 0, 0};
}

void DrawOrder::split(std::span<const Vec4> positions, std::span<const Vec4> normals) {
  const auto for_runs = [&](const auto& body) {
    parallel_for(smooth_in_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t run = begin; run < end; ++run) {
        body(run, run * kRun, std::min((run + 1) * kRun, triangles_.size()));
      }
    });
  };
  for_runs([&](std::size_t run, std::size_t begin, std::size_t end) {
    std::size_t smooth = 0;
    for (std::size_t t = begin; t < end; ++t) {
      is_smooth_[t] = is_smooth(triangles_[t], positions, normals) ? 1 : 0;
      smooth += static_cast<std::size_t>(is_smooth_[t]);
    }
    smooth_in_[run] = smooth;
  });
  // Turn counts into the number of smooth triangles before each run.
  smooth_count_ = 0;
  for (std::size_t& smooth : smooth_in_) {
    smooth_count_ += std::exchange(smooth, smooth_count_);
  }
  for_runs([&](std::size_t run, std::size_t begin, std::size_t end) {
    write(begin, end, smooth_in_[run]);
  });
}

// Writes the triangles [begin, end), which `smooth_before` smooth ones precede.
void DrawOrder::write(std::size_t begin, std::size_t end, std::size_t smooth_before) {
  const std::span<Triangle> drawn = indices_.mapped_as<Triangle>();
  std::size_t smooth = smooth_before;
  std::size_t sharp = smooth_count_ + begin - smooth_before;
  for (std::size_t t = begin; t < end; ++t) {
    if (is_smooth_[t] != 0) {
      drawn[smooth++] = triangles_[t];
    } else {
      const Index first = 3 * numbers_[t];
      drawn[sharp++] = {first, first + 1, first + 2};
    }
  }
}

}  // namespace lapwing
