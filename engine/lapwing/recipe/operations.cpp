#include <array>
#include <charconv>

#include "lapwing/recipe/step_keys.h"

namespace lapwing {

bool Range::contains(double number) const {
  return (takes_least ? number >= least : number > least) && number <= most;
}

std::string Range::words(bool whole) const {
  const auto digits = [](double number) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
    return std::string(text.data(), end.ptr);
  };
  const bool has_most = most < std::numeric_limits<double>::infinity();
  std::string text = whole ? "a whole number" : "a number";
  if (has_most && takes_least) {
    text += " from " + digits(least) + " to " + digits(most);
  } else if (!takes_least) {
    text += " above " + digits(least) + (has_most ? " and at most " + digits(most) : "");
  } else if (least == 0.0) {
    text = "0 or more";
  }
  return reason.empty() ? text : text + " (" + std::string(reason) + ")";
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
