#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lapwing/gpu/pipeline_layout.h"
#include "lapwing/gpu/spirv.h"

namespace lapwing::gpu {

/// A compute shader that is ready to dispatch, with push constants and one set of buffers, which
/// are bound by push descriptors. The number of buffers and their access (`readonly`, `writeonly`)
/// are read from the shader module, so that host and shader always agree. The context must outlive
/// the kernel. Movable.
class Kernel {
 public:
  /// `workgroup_size` becomes specialization constant 0 (layout(local_size_x_id = 0)). Throws
  /// GpuError if a buffer is neither `readonly` nor `writeonly`, if bindings are not 0, 1, 2, ...,
  /// or if the device cannot run the shader.
  Kernel(const Context& context, std::string name, std::span<const std::uint32_t> spirv,
         std::uint32_t push_constant_bytes = 0, std::uint32_t workgroup_size = 64);

  const std::string& name() const { return name_; }
  /// One entry per buffer, in order of binding.
  std::span<const BindingAccess> bindings() const { return bindings_; }
  std::uint32_t push_constant_bytes() const { return push_constant_bytes_; }
  std::uint32_t workgroup_size() const { return workgroup_size_; }
  VkPipeline pipeline() const { return pipeline_.get(); }
  const PipelineLayout& layout() const { return layout_; }

 private:
  std::string name_;
  std::vector<BindingAccess> bindings_;
  std::uint32_t push_constant_bytes_;
  std::uint32_t workgroup_size_;
  PipelineLayout layout_;
  Owned<VkPipeline> pipeline_;
};

}  // namespace lapwing::gpu
