#pragma once

#include "lapwing/step/key_visitor.h"

namespace lapwing::viewer {

/// Lays out what there is to choose of a step's parameters, by the descriptions of their keys: a
/// line each, with the key's sentence where the cursor rests. Nothing of meshes or regions.
class ParameterPanel final : public KeyVisitor {
 public:
  /// `size` is what lengths are shares of, such as the mesh's diagonal.
  explicit ParameterPanel(double size) : size_(size) {}

  bool edited() const { return edited_; }  ///< something is another than it was
  /// That is what the person wants: a click, or a slider or field that was let go.
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
  // Of the widget that was laid out last, which changed its value now or not.
  void take(const StepKey& key, bool changed);
  void draw_number(const StepKey& key, const std::string& label, double& value, const Range& range);

  double size_;
  bool edited_ = false;
  bool chosen_ = false;
};

}  // namespace lapwing::viewer
