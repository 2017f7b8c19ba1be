#pragma once

#include "lapwing/recipe/key_visitor.h"

namespace lapwing::viewer {

/// Draws the parameters of a step by the descriptions of their keys, one line each, with the key's
/// help as a tooltip. Leaves out meshes and regions.
class ParameterPanel final : public KeyVisitor {
 public:
  /// Limits of lengths are shares of `size`, such as the mesh's diagonal.
  explicit ParameterPanel(double size) : size_(size) {}

  bool edited() const { return edited_; }  ///< a value has changed
  /// Whether a choice is made: by a click, or a slider or field that was released.
  bool chosen() const { return chosen_; }

  void number(const StepKey& key, double& value, const Range& range) override;
  void number(const StepKey& key, std::optional<double>& value, const Range& range) override;
  void whole(const StepKey& key, int& value, const Range& range) override;
  void boolean(const StepKey& key, bool& value) override;

 protected:
  void choose(const StepKey& key, std::size_t& chosen,
              const std::vector<std::string_view>& names) override;
  bool enter(const StepKey& key, bool& given, ObjectForm form, bool is_default) override;

 private:
  // Notes whether the last widget changed its value or was released.
  void take(const StepKey& key, bool changed);
  void draw_number(const StepKey& key, const std::string& label, double& value, const Range& range);

  double size_;
  bool edited_ = false;
  bool chosen_ = false;
};

}  // namespace lapwing::viewer
