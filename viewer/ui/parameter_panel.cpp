#include "ui/parameter_panel.h"

#include <imgui.h>

#include "ui/widgets.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

std::string label_of(const StepKey& key) {
  const KeyWords* words = words_of_key(key.name, key.flag);
  return words != nullptr ? std::string(words->label) : choice_in_words(key.name);
}

void explain_key(const StepKey& key) {
  const KeyWords* words = words_of_key(key.name, key.flag);
  explain(words != nullptr ? words->help : key.help);
}

}  // namespace

void ParameterPanel::take(const StepKey& key, bool changed) {
  edited_ = edited_ || changed;
  chosen_ = chosen_ || ImGui::IsItemDeactivatedAfterEdit();
  explain_key(key);
}

void ParameterPanel::draw_number(const StepKey& key, const std::string& label, double& value,
                                 const Range& range) {
  const std::string field = "##field " + label;
  double typed = value;
  bool changed = false;
  if (range.slider_to > 0.0) {
    const double unit = range.of_size ? size_ : 1.0;
    const double from = range.slider_from * unit;
    const double to = range.slider_to * unit;
    changed = ImGui::SliderScalar(
        field.c_str(), ImGuiDataType_Double, &typed, &from, &to, "%.4g",
        range.slider_from > 0.0 ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
  } else {
    changed = ImGui::InputScalar(field.c_str(), ImGuiDataType_Double, &typed, nullptr, nullptr,
                                 "%.5g", ImGuiInputTextFlags_CharsScientific);
  }
  const bool fits = range.contains(typed);
  if (fits) value = typed;
  take(key, changed && fits);
}

void ParameterPanel::number(const StepKey& key, double& value, const Range& range) {
  label_field(label_of(key).c_str());
  draw_number(key, label_of(key), value, range);
}

void ParameterPanel::number(const StepKey& key, std::optional<double>& value, const Range& range) {
  bool given = value.has_value();
  const std::string label = label_of(key);
  if (ImGui::Checkbox(label.c_str(), &given)) {
    value = given ? std::optional(range.first) : std::nullopt;
    edited_ = chosen_ = true;
  }
  explain_key(key);
  if (!value) return;
  place_field();
  draw_number(key, label, *value, range);
}

void ParameterPanel::whole(const StepKey& key, int& value, const Range& range) {
  int typed = value;
  label_field(label_of(key).c_str());
  const bool changed = ImGui::InputInt(("##field " + label_of(key)).c_str(), &typed, 0);
  const bool fits = range.contains(typed);
  if (fits) value = typed;
  take(key, changed && fits);
}

void ParameterPanel::boolean(const StepKey& key, bool& value) {
  const bool changed = ImGui::Checkbox(label_of(key).c_str(), &value);
  edited_ = edited_ || changed;
  chosen_ = chosen_ || changed;
  explain_key(key);
}

void ParameterPanel::choose(const StepKey& key, std::size_t& chosen,
                            const std::vector<std::string_view>& names) {
  const std::string label = label_of(key);
  const float right = right_end();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label.c_str());
  explain_key(key);
  ImGui::PushID(label.c_str());
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!radio_on_line(choice_in_words(names[k]).c_str(), chosen == k, right)) continue;
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
