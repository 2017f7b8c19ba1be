#include "ui/parameter_panel.h"

#include <algorithm>
#include <imgui.h>

#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

std::string in_words(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace

void ParameterPanel::take(const StepKey& key, bool changed) {
  edited_ = edited_ || changed;
  chosen_ = chosen_ || ImGui::IsItemDeactivatedAfterEdit();
  explain(key.help);
}

void ParameterPanel::draw_number(const StepKey& key, const std::string& label, double& value,
                                 const Range& range) {
  double typed = value;
  bool changed = false;
  if (range.slider_to > 0.0) {
    const double unit = range.of_size ? size_ : 1.0;
    const double from = range.slider_from * unit;
    const double to = range.slider_to * unit;
    changed = ImGui::SliderScalar(
        label.c_str(), ImGuiDataType_Double, &typed, &from, &to, "%.4g",
        range.slider_from > 0.0 ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
  } else {
    changed =
        ImGui::InputScalar(label.c_str(), ImGuiDataType_Double, &typed, nullptr, nullptr, "%.5g");
  }
  const bool fits = range.contains(typed);
  if (fits) value = typed;
  take(key, changed && fits);
}

void ParameterPanel::number(const StepKey& key, double& value, const Range& range) {
  draw_number(key, in_words(key.name), value, range);
}

void ParameterPanel::number(const StepKey& key, std::optional<double>& value, const Range& range) {
  bool given = value.has_value();
  const std::string label = in_words(key.name);
  if (ImGui::Checkbox(given ? ("##" + label).c_str() : label.c_str(), &given)) {
    value = given ? std::optional(range.first) : std::nullopt;
    edited_ = chosen_ = true;
  }
  explain(key.help);
  if (!value) return;
  ImGui::SameLine();
  draw_number(key, label, *value, range);
}

void ParameterPanel::whole(const StepKey& key, int& value, const Range& range) {
  int typed = value;
  const bool changed = ImGui::InputInt(in_words(key.name).c_str(), &typed, 0);
  const bool fits = range.contains(typed);
  if (fits) value = typed;
  take(key, changed && fits);
}

void ParameterPanel::boolean(const StepKey& key, bool& value) {
  const bool changed = ImGui::Checkbox(in_words(key.name).c_str(), &value);
  edited_ = edited_ || changed;
  chosen_ = chosen_ || changed;
  explain(key.help);
}

void ParameterPanel::choose(const StepKey& key, std::size_t& chosen,
                            const std::vector<std::string_view>& names) {
  const std::string label = in_words(key.name);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label.c_str());
  explain(key.help);
  ImGui::PushID(label.c_str());
  for (std::size_t k = 0; k < names.size(); ++k) {
    ImGui::SameLine();
    if (!ImGui::RadioButton(in_words(names[k]).c_str(), chosen == k)) continue;
    chosen = k;
    edited_ = chosen_ = true;
  }
  ImGui::PopID();
}

bool ParameterPanel::enter(const StepKey& key, bool& given, ObjectForm, bool) {
  boolean(key, given);
  return given;
}

}  // namespace lapwing::viewer
