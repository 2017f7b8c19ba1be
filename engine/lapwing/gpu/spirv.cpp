#include "lapwing/gpu/spirv.h"

#include <map>
#include <string>

#include "lapwing/base/errors.h"

namespace lapwing::gpu {
namespace {

// Numbers defined in section 3 of the SPIR-V specification.
constexpr std::uint32_t kMagic = 0x07230203;
constexpr std::size_t kHeaderWords = 5;
enum Op : std::uint32_t {
  kOpCapability = 17,
  kOpTypePointer = 32,
  kOpVariable = 59,
  kOpDecorate = 71,
  kOpMemberDecorate = 72,
};
enum Decoration : std::uint32_t {
  kNonWritable = 24,
  kNonReadable = 25,
  kBinding = 33,
  kDescriptorSet = 34,
};
constexpr std::uint32_t kUniformConstantClass = 0;
constexpr std::uint32_t kStorageBufferClass = 12;

struct Decorations {
  bool non_writable = false;
  bool non_readable = false;
  std::uint32_t binding = 0;
  std::uint32_t set = 0;
};

struct Variable {
  std::uint32_t id;
  std::uint32_t pointer_type;
  bool is_storage;
};

struct Module {
  std::vector<std::uint32_t> capabilities;
  // By id; decorations of a block's members are stored with the block.
  std::map<std::uint32_t, Decorations> decorations;
  std::map<std::uint32_t, std::uint32_t> pointees;  // type to which each pointer type points
  std::vector<Variable> bound;
};

void decorate(Decorations& target, std::uint32_t decoration, std::span<const std::uint32_t> rest) {
  switch (decoration) {
    case kNonWritable:
      target.non_writable = true;
      break;
    case kNonReadable:
      target.non_readable = true;
      break;
    case kBinding:
      if (!rest.empty()) target.binding = rest[0];
      break;
    case kDescriptorSet:
      if (!rest.empty()) target.set = rest[0];
      break;
    default:
      break;
  }
}

void read_instruction(Module& module, std::uint32_t op, std::span<const std::uint32_t> operands) {
  const std::size_t n = operands.size();
  if (op == kOpCapability && n >= 1) {
    module.capabilities.push_back(operands[0]);
  } else if (op == kOpDecorate && n >= 2) {
    decorate(module.decorations[operands[0]], operands[1], operands.subspan(2));
  } else if (op == kOpMemberDecorate && n >= 3) {
    decorate(module.decorations[operands[0]], operands[2], operands.subspan(3));
  } else if (op == kOpTypePointer && n >= 3) {
    module.pointees[operands[0]] = operands[2];
  } else if (op == kOpVariable && n >= 3 &&
             (operands[2] == kStorageBufferClass || operands[2] == kUniformConstantClass)) {
    module.bound.push_back({operands[1], operands[0], operands[2] == kStorageBufferClass});
  }
}

Module read_module(std::span<const std::uint32_t> words) {
  if (words.size() < kHeaderWords || words[0] != kMagic) throw GpuError("not a SPIR-V module");
  Module module;
  for (std::size_t at = kHeaderWords; at < words.size();) {
    const std::size_t length = words[at] >> 16U;
    if (length == 0 || length > words.size() - at) {
      throw GpuError("SPIR-V module cut off at word " + std::to_string(at));
    }
    read_instruction(module, words[at] & 0xFFFFU, words.subspan(at + 1, length - 1));
    at += length;
  }
  return module;
}

BindingAccess access_of(Module& module, const Variable& variable) {
  if (!variable.is_storage) throw GpuError("a kernel can bind only buffers");
  const Decorations& own = module.decorations[variable.id];
  const Decorations& block = module.decorations[module.pointees[variable.pointer_type]];
  if (own.non_writable || block.non_writable) return BindingAccess::read;
  if (own.non_readable || block.non_readable) return BindingAccess::write;
  return BindingAccess::read_write;
}

}  // namespace

ShaderInterface read_interface(std::span<const std::uint32_t> words) {
  Module module = read_module(words);
  std::map<std::uint32_t, BindingAccess> by_binding;
  for (const Variable& variable : module.bound) {
    const Decorations own = module.decorations[variable.id];
    if (own.set != 0 || !by_binding.emplace(own.binding, access_of(module, variable)).second) {
      throw GpuError("each buffer of a shader must have its own binding in set 0");
    }
  }
  ShaderInterface result;
  result.capabilities = std::move(module.capabilities);
  for (const auto& [binding, access] : by_binding) {
    if (binding != result.bindings.size()) {
      throw GpuError("no buffer of the shader has the binding " +
                     std::to_string(result.bindings.size()));
    }
    result.bindings.push_back(access);
  }
  return result;
}

}  // namespace lapwing::gpu
