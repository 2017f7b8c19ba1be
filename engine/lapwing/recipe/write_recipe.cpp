#include <array>
#include <charconv>

#include "lapwing/base/errors.h"
#include "lapwing/recipe/key_visitor.h"
#include "lapwing/recipe/recipe.h"
#include "lapwing/recipe/write_values.h"

namespace lapwing {
namespace {

// Writes every key that has a value.
class KeyWriter final : public KeyVisitor {
 public:
  explicit KeyWriter(std::string_view op) { open_.front()["op"] = op; }

  Json take() { return std::move(open_.front()); }

  void number(const StepKey& key, double& value, const Range&) override { put(key, value); }
  void number(const StepKey& key, std::optional<double>& value, const Range&) override {
    if (value) return put(key, *value);
    if (key.automatic) put(key, "auto");
  }
  void whole(const StepKey& key, int& value, const Range&) override { put(key, value); }
  void whole(const StepKey& key, std::optional<std::size_t>& value) override {
    if (value) put(key, *value);
  }
  void boolean(const StepKey& key, bool& value) override { put(key, value); }

  void region(const StepKey& key, RegionSpec& value) override { put(key, json_of(value)); }
  void belt(const StepKey& key, BeltSpec& value) override { put(key, json_of(value)); }
  void handles(const StepKey& key, std::vector<MovedHandle>& value, HandleForm) override {
    if (key.required || !value.empty()) put(key, json_of(value));
  }
  void targets(const StepKey& key, TargetSpec& value) override {
    if (!value.empty()) put(key, json_of(value));
  }
  void landmarks(const StepKey& key, LandmarkSpec& value) override {
    if (!value.empty()) put(key, json_of(value));
  }
  void stiffness(const StepKey& key, std::vector<StiffnessSpec>& value) override {
    if (!value.empty()) put(key, json_of(value));
  }
  void mirror(const StepKey& key, std::optional<MirrorSpec>& value) override {
    if (value) put(key, json_of(*value));
  }
  void carry(const StepKey& key, std::vector<CarrySpec>& value) override {
    if (!value.empty()) put(key, json_of(value));
  }
  void pairs(const StepKey& key, std::vector<VertexPair>& value) override {
    if (!value.empty()) put(key, value);
  }
  void weight(const StepKey& key, MixWeight& value) override { put(key, json_of(value)); }
  void file(const StepKey& key, std::filesystem::path& value) override {
    if (!value.empty()) put(key, value.string());
  }
  void part(const StepKey& key, std::filesystem::path& mesh,
            std::optional<RegionSpec>& region) override {
    if (!region) return put(key, mesh.string());
    Json part;
    if (!mesh.empty()) part["mesh"] = mesh.string();
    part["region"] = json_of(*region);
    put(key, std::move(part));
  }
  void place(const StepKey& key, PartPlace& value, const StepKey& snap_key, bool& snap) override {
    put(key, json_of(value));
    if (snap) put(snap_key, true);
  }

  void only_when(bool holds, std::string_view key, std::string_view) override {
    if (!holds) open_.back().erase(std::string(key));
  }

 protected:
  void choose(const StepKey& key, std::size_t& chosen,
              const std::vector<std::string_view>& names) override {
    put(key, names[chosen]);
  }
  bool enter(const StepKey& key, bool& given, ObjectForm form, bool is_default) override {
    if (form == ObjectForm::boolean && (!given || is_default)) {
      put(key, given);
      return false;
    }
    if (given) open(key);
    return given;
  }
  void leave() override { close(); }
  void begin_list(const StepKey& key, std::size_t, const ListWords&) override {
    open(key);
    open_.back() = Json::array();
  }
  void begin_item(std::size_t, const ListWords&) override { open_.push_back(Json::object()); }
  void end_item() override {
    Json item = std::move(open_.back());
    open_.pop_back();
    open_.back().push_back(std::move(item));
  }
  void end_list(const StepKey&) override { close(); }

 private:
  void put(const StepKey& key, Json value) {
    open_.back()[std::string(key.name)] = std::move(value);
  }
  void open(const StepKey& key) {
    names_.emplace_back(key.name);
    open_.push_back(Json::object());
  }
  void close() {
    Json value = std::move(open_.back());
    open_.pop_back();
    open_.back()[names_.back()] = std::move(value);
    names_.pop_back();
  }

  std::vector<Json> open_{Json::object()};  // the objects and lists being written, outermost first
  std::vector<std::string> names_;          // the keys of `open_`, without the root
};

Json json_of(const Step& step) {
  KeyWriter writer(operations()[step.index()].name);
  Step copy = step;
  describe(copy, writer);
  return writer.take();
}

constexpr std::size_t kLineWidth = 96;

std::string atom(const Json& json) {
  if (!json.is_number_float()) return json.dump();
  // Use the shortest digits that are read back as the same bits. The library would write 10.0
  // instead of 10.
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), json.get<double>());
  return {digits.data(), end.ptr};
}

// Returns `json` on one line.
std::string flat(const Json& json) {
  if (!json.is_structured()) return atom(json);
  std::string text;
  for (const auto& [key, value] : json.items()) {
    if (!text.empty()) text += ", ";
    if (json.is_object()) text += Json(key).dump() + ": ";
    text += flat(value);
  }
  return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

// Returns a list of numbers, broken into lines of at most the line width.
std::string filled(const Json& list, const std::string& indent) {
  std::string text = "[";
  std::size_t column = kLineWidth;
  for (const Json& value : list) {
    const std::string number = atom(value);
    if (text.size() > 1) text += ",";
    if (column + number.size() + 2 > kLineWidth) {
      text += "\n" + indent + "  ";
      column = indent.size() + 2;
    } else {
      text += " ";
      ++column;
    }
    text += number;
    column += number.size() + 1;
  }
  return text + "\n" + indent + "]";
}

// Returns `json` on one line if it fits after `column`, and otherwise one child per line.
std::string pretty(const Json& json, const std::string& indent, std::size_t column) {
  const std::string line = flat(json);
  if (column + line.size() < kLineWidth || !json.is_structured()) return line;
  if (json.is_array() && json.front().is_number()) return filled(json, indent);
  const std::string inner = indent + "  ";
  std::string text;
  for (const auto& [key, value] : json.items()) {
    const std::string label = json.is_object() ? Json(key).dump() + ": " : "";
    text += (text.empty() ? "\n" : ",\n") + inner + label;
    text += pretty(value, inner, inner.size() + label.size());
  }
  text += "\n" + indent;
  return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace

std::string to_json(const Recipe& recipe) {
  Json steps = Json::array();
  for (const Step& step : recipe.steps) steps.push_back(json_of(step));
  Json root{
      {"lapwing", kRecipeVersion}, {"mesh", recipe.mesh.string()}, {"steps", std::move(steps)}};
  if (!recipe.save.empty()) root["save"] = recipe.save.string();
  if (!recipe.morph_target.empty()) root["save_as"] = {{"morph_target", recipe.morph_target}};
  try {
    // The start at the end of a line makes the root span several lines.
    return pretty(root, "", kLineWidth) + "\n";
  } catch (const Json::type_error&) {
    throw InputError(
        "the name of the mesh, of a source or of the result is not UTF-8, but a recipe must be; "
        "rename the file");
  }
}

}  // namespace lapwing
