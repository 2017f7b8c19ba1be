#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lapwing::gpu {

/// How a shader may access a buffer bound to it.
enum class BindingAccess {
  read,        ///< storage buffer, `readonly`
  write,       ///< storage buffer, `writeonly`
  read_write,  ///< storage buffer, neither
};

/// The capabilities and buffers that a shader declares.
struct ShaderInterface {
  /// Numbers of SPIR-V capabilities, in order of declaration.
  std::vector<std::uint32_t> capabilities;
  std::vector<BindingAccess> bindings;  ///< bindings of set 0
};

/// Reads the declarations of a SPIR-V module. Throws GpuError if `words` is not a SPIR-V module, if
/// the module binds other resources than buffers, or if the bindings are not 0, 1, 2, ... of set 0.
ShaderInterface read_interface(std::span<const std::uint32_t> words);

}  // namespace lapwing::gpu
