#include <array>

#include "lapwing/recipe/step_keys.h"

namespace lapwing {

std::span<const Operation> operations() {
  static const std::array<Operation, std::variant_size_v<Step>> kOperations{{
      {"deform", "bend a region by its handles", DeformRequest{}},
      {"coat", "put the fine detail of one surface on another", CoatStep{}},
      {"mix", "mix the detail of two surfaces on a third", MixStep{}},
      {"transplant", "put a part of one mesh on another", TransplantStep{}},
  }};
  return kOperations;
}

void describe(Step& step, KeyVisitor& visitor) {
  std::visit([&](auto& each) { describe(each, visitor); }, step);
}

}  // namespace lapwing
