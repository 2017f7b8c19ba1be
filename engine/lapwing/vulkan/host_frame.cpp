#include "lapwing/vulkan/host_frame.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/parallel.h"
#include "lapwing/vulkan/vertex_normals.h"

namespace lapwing {
namespace {

constexpr std::size_t kVerticesPerHostTask = 4096;

// A Vec4 in a register. Device memory has the required alignment.
typedef float Lanes __attribute__((vector_size(sizeof(Vec4)), may_alias));

const Lanes& lanes(const Vec4& v) {
  return reinterpret_cast<const Lanes&>(v);
}
Lanes& lanes(Vec4& v) {
  return reinterpret_cast<Lanes&>(v);
}

float sum_of(Lanes v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

Lanes yzx(Lanes v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3);
}

// Returns the sum of the normals of the triangles in the fan. Each normal has twice the area of its
// triangle as its length.
Lanes area_around(const Vec4& here, std::span<const Index> fan, std::span<const Vec4> positions) {
  // a x b = yzx(a yzx(b) - yzx(a) b). The outer yzx is applied once, to the sum.
  Lanes sum{};
  Lanes previous{};
  Lanes turned_previous{};
  for (const Index corner : fan) {
    const Lanes next = lanes(positions[corner & ~kFanBegins]) - lanes(here);
    const Lanes turned_next = yzx(next);
    if ((corner & kFanBegins) == 0) sum += previous * turned_next - turned_previous * next;
    previous = next;
    turned_previous = turned_next;
  }
  return yzx(sum);
}

}  // namespace

void blend_on_host(const BlendRange& range, std::span<const BlendGroup> groups,
                   std::span<Vec4> positions) {
  const std::size_t count = range.moving.size();
  parallel_for(count, kVerticesPerHostTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      Lanes x{};
      Lanes y{};
      Lanes z{};
      for (const BlendGroup& group : groups) {
        const Lanes parameters = lanes(group.parameters);
        const Vec4* const texels = range.basis.data() + 3 * group.number * count + m;
        x += lanes(texels[0]) * parameters;
        y += lanes(texels[count]) * parameters;
        z += lanes(texels[2 * count]) * parameters;
      }
      lanes(positions[range.moving[m]]) =
          lanes(range.rests[m]) + Lanes{sum_of(x), sum_of(y), sum_of(z), 0.0F};
    }
  });
}

void normals_on_host(std::span<const Index> which, const FanLists& fans,
                     std::span<const Vec4> positions, std::span<Vec4> normals) {
  parallel_for(which.size(), kVerticesPerHostTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      const Index v = which[m];
      auto rest = fans.corners.subspan(fans.starts[v], fans.starts[v + 1] - fans.starts[v]);
      Index number = v;
      for (;;) {
        const auto next =
            std::ranges::find_if(rest, [](Index c) { return (c & kNormalBegins) != 0; });
        const auto length = static_cast<std::size_t>(next - rest.begin());
        const Lanes sum = area_around(positions[v], rest.first(length), positions);
        const float size = std::sqrt(sum_of(sum * sum));
        lanes(normals[number]) = size > 0.0F ? sum / size : Lanes{};
        if (next == rest.end()) break;
        number = *next & ~kNormalBegins;
        rest = rest.subspan(length + 1);
      }
    }
  });
}

}  // namespace lapwing
