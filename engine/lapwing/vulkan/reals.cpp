#include "lapwing/vulkan/reals.h"

#include <algorithm>
#include <vector>

namespace lapwing {

std::size_t real_bytes(const VulkanState& state, std::size_t count) {
  return count * (state.float64 ? sizeof(double) : sizeof(float));
}

void upload_reals(VulkanState& state, const gpu::Buffer& buffer, std::span<const double> numbers) {
  if (state.float64) {
    state.transfer.upload(buffer, numbers);
  } else {
    const std::vector<float> rounded(numbers.begin(), numbers.end());
    state.transfer.upload(buffer, std::span<const float>(rounded));
  }
}

void download_reals(VulkanState& state, const gpu::Buffer& buffer, std::span<double> numbers) {
  if (state.float64) {
    state.transfer.download(buffer, numbers);
  } else {
    std::vector<float> values(numbers.size());
    state.transfer.download(buffer, std::span<float>(values));
    std::copy(values.begin(), values.end(), numbers.begin());
  }
}

void upload_places(VulkanState& state, const gpu::Buffer& buffer,
                   std::span<const Eigen::Vector3d> vectors) {
  if (state.float64) {
    static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
    state.transfer.upload(buffer, vectors);
    return;
  }
  std::vector<float> parts(vectors.size() * 6);
  for (std::size_t v = 0; v < vectors.size(); ++v) {
    // Number by number: for whole vectors, g++ 12 drops the rounding to float and back, and with it
    // the low part.
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double exact = vectors[v][axis];
      const auto high = static_cast<float>(exact);
      float* const out = parts.data() + 6 * v + axis;
      out[0] = high;
      out[3] = static_cast<float>(exact - static_cast<double>(high));
    }
  }
  state.transfer.upload(buffer, std::span<const float>(parts));
}

}  // namespace lapwing
