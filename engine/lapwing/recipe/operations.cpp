#include <array>
#include <cmath>

#include "lapwing/base/errors.h"
#include "lapwing/recipe/step_keys.h"

namespace lapwing {
namespace {

class Validation final : public KeyVisitor {
 public:
  void number(const StepKey& key, double& value, const Range& range) override {
    if (range.contains(value) && std::isfinite(value)) return;
    throw InputError(std::string(key.name) + ": expected " + range.words() + ", got " +
                     std::to_string(value));
  }
  void number(const StepKey& key, std::optional<double>& value, const Range& range) override {
    if (value) number(key, *value, range);
  }
  void whole(const StepKey& key, int& value, const Range& range) override {
    double count = value;
    number(key, count, range);
  }

 protected:
  bool enter(const StepKey&, bool& given, ObjectForm, bool) override { return given; }
};

}  // namespace

void require_valid(DeformParameters parameters) {
  Validation validation;
  describe(parameters, validation);
}

void describe(LaplacianWeights& weights, KeyVisitor& visitor) {
  visitor.choice(
      {.name = "weights", .help = "of the Laplacians"}, weights,
      {{LaplacianWeights::uniform, "uniform"}, {LaplacianWeights::cotangent, "cotangent"}});
}

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
