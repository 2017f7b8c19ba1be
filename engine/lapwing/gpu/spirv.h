#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lapwing::gpu {

/// What a shader may do with a storage buffer.
enum class BindingAccess { read, write, read_write };

/// What the host needs to know of a shader.
struct ShaderInterface {
  std::vector<std::uint32_t> capabilities;  ///< SPIR-V capability numbers, in order of declaration
  std::vector<BindingAccess> bindings;      ///< storage buffers of set 0, by binding
};

/// Reads the declarations of a SPIR-V module. Throws GpuError when `words` is no SPIR-V module, or
/// when its storage buffers do not have the bindings 0, 1, 2, ... of set 0.
ShaderInterface read_interface(std::span<const std::uint32_t> words);

}  // namespace lapwing::gpu
