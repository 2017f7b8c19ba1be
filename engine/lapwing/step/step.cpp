#include "lapwing/step/step.h"

#include <array>
#include <utility>

namespace lapwing {
namespace {

template <std::size_t... K>
std::array<Operation, sizeof...(K)> each_operation(std::index_sequence<K...>) {
  return {Operation{words_of(static_cast<const std::variant_alternative_t<K, Step>*>(nullptr)),
                    std::variant_alternative_t<K, Step>{}}...};
}

// Records the device, and notes once that it took over from another.
void tell_device(const DeviceInfo& device, RunResult& result) {
  if (!device.took_over.empty() && device.took_over != result.report.device.took_over) {
    result.note(std::array{device.took_over});
  }
  result.report.device = device;
}

}  // namespace

std::span<const Operation> operations() {
  static const auto kOperations =
      each_operation(std::make_index_sequence<std::variant_size_v<Step>>{});
  return kOperations;
}

const Operation& operation_of(const Step& step) {
  return operations()[step.index()];
}

void describe(Step& step, KeyVisitor& visitor) {
  std::visit([&](auto& each) { describe(each, visitor); }, step);
}

StepReport run_step(const Step& step, const StepContext& on) {
  // Only another deform on the same triangles can reuse the workspace.
  if (!std::holds_alternative<DeformRequest>(step)) on.result.deformed = {};
  StepReport report = std::visit([&](const auto& each) { return run_step(each, on); }, step);
  report.op = operation_of(step).name;
  tell_device(on.kernels.device(), on.result);
  return report;
}

}  // namespace lapwing
