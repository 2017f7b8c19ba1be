#include "lapwing/recipe/step.h"

#include <array>

namespace lapwing {

std::span<const Operation> operations() {
  static const std::array<Operation, std::variant_size_v<Step>> kOperations{
      {{"deform", "bend a region by its handles", " ", DeformRequest{}},
       {"coat", "put the fine detail of one surface on another", " from ", CoatStep{}},
       {"mix", "mix the detail of two surfaces on a third", " ", MixStep{}},
       {"transplant", "put a part of one mesh on another", " ", TransplantStep{}},
       {"peel", "take the fine detail off a surface", " ", PeelRequest{}},
       {"remesh", "make the triangles of a region nearly equilateral", " ", RemeshRequest{}},
       {"decimate", "reduce the number of vertices", " ", DecimateRequest{}},
       {"subdivide", "cut each triangle into four", " ", SubdivideRequest{}},
       {"fill_holes", "close the holes of a mesh", " ", FillRequest{}},
       {"wrap", "deform a template so that it covers a scan", " onto ", WrapStep{}}}};
  return kOperations;
}

const Operation& operation_of(const Step& step) {
  return operations()[step.index()];
}

void describe(Step& step, KeyVisitor& visitor) {
  std::visit([&](auto& each) { describe(each, visitor); }, step);
}

}  // namespace lapwing
