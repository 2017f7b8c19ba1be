#include <cmath>

#include "lapwing/base/errors.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/json/parse_json.h"
#include "lapwing/recipe/read_values.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {
namespace {

// Collects the names of an object's keys, so that an unknown key is reported before any value is
// read.
class KeyNames final : public KeyVisitor {
 public:
  std::vector<std::string_view> names{};

 protected:
  void other(const StepKey& key) override {
    if (depth_ == 0) names.push_back(key.name);
  }
  void begin_list(const StepKey& key, std::size_t, const ListWords&) override {
    other(key);
    ++depth_;
  }
  void end_list(const StepKey&) override { --depth_; }

 private:
  int depth_ = 0;  // nesting of lists
};

// Reads the keys that are present and leaves the other values unchanged.
class KeyReader final : public KeyVisitor {
 public:
  explicit KeyReader(JsonNode step) { open_.push_back(std::move(step)); }

  void number(const StepKey& key, double& value, const Range& range) override {
    if (const auto found = find(key)) value = number_in(*found, range);
  }
  void number(const StepKey& key, std::optional<double>& value, const Range& range) override {
    const auto found = find(key);
    if (!found) return;
    if (key.automatic && found->is_string()) {
      found->one_of(std::string(key.name), {"auto"});
    } else {
      value = number_in(*found, range);
    }
  }
  void whole(const StepKey& key, int& value, const Range& range) override {
    const auto found = find(key);
    if (!found) return;
    const double number = found->number();
    if (!range.contains(number) || number != std::floor(number)) {
      found->fail_expecting(range.words(true));
    }
    value = static_cast<int>(number);
  }
  void whole(const StepKey& key, std::optional<std::size_t>& value) override {
    if (const auto found = find(key)) value = found->vertex();
  }
  void boolean(const StepKey& key, bool& value) override {
    if (const auto found = find(key)) value = found->boolean();
  }

  void region(const StepKey& key, RegionSpec& value) override {
    if (const auto found = find(key)) value = read_region(*found);
  }
  void belt(const StepKey& key, BeltSpec& value) override {
    const auto found = find(key);
    value = found ? read_belt(*found) : BoundaryAnchors{.where = open_.back().where(key.name)};
  }
  void handles(const StepKey& key, std::vector<MovedHandle>& value, HandleForm form) override {
    const auto found = find(key);
    if (!found) return;
    for (const JsonNode& handle : found->elements()) value.push_back(read_handle(handle, form));
    if (key.required && value.empty()) found->fail("expected at least one handle");
  }
  void targets(const StepKey& key, TargetSpec& value) override {
    if (const auto found = find(key)) value = read_targets(*found);
  }
  void landmarks(const StepKey& key, LandmarkSpec& value) override {
    if (const auto found = find(key)) value = read_landmarks(*found);
  }
  void stiffness(const StepKey& key, std::vector<StiffnessSpec>& value) override {
    const auto found = find(key);
    if (!found) return;
    for (const JsonNode& part : found->elements()) value.push_back(read_stiffness(part));
  }
  void mirror(const StepKey& key, std::optional<MirrorSpec>& value) override {
    if (const auto found = find(key)) value = read_mirror(*found);
  }
  void carry(const StepKey& key, std::vector<CarrySpec>& value) override {
    const auto found = find(key);
    if (!found) return;
    for (const JsonNode& file : found->elements()) value.push_back(read_carry(file));
  }
  void pairs(const StepKey& key, std::vector<VertexPair>& value) override {
    if (const auto found = find(key)) value = read_pairs(*found);
  }
  void weight(const StepKey& key, MixWeight& value) override {
    if (const auto found = find(key)) value = read_weight(*found);
  }
  void file(const StepKey& key, std::filesystem::path& value) override {
    if (const auto found = find(key)) value = found->file_name();
  }
  void part(const StepKey& key, std::filesystem::path& mesh,
            std::optional<RegionSpec>& region) override {
    const auto found = find(key);
    if (!found) return;
    if (found->is_string()) {
      mesh = found->file_name();
      return;
    }
    found->require_keys({"mesh", "region"});
    if (const auto file = found->find("mesh")) {
      mesh = file->file_name();
    } else if (!found->has("region")) {
      found->fail("expected \"mesh\", \"region\" (of the mesh itself) or both");
    }
    if (const auto cut = found->find("region")) region = read_region(*cut);
  }
  void place(const StepKey& key, PartPlace& value, const StepKey& snap_key, bool& snap) override {
    if (const auto found = find(key)) value = read_place(*found);
    boolean(snap_key, snap);
    require(!snap || !std::holds_alternative<LoopFit>(value), std::string(snap_key.name),
            "a part that is fitted automatically is already on the surface; give \"place\" as a "
            "move, or remove \"snap\"");
  }

  void where(std::string& name) override { name = open_.back().where(); }
  void only_when(bool holds, std::string_view key, std::string_view otherwise) override {
    if (holds) return;
    if (const auto found = open_.back().find(key)) found->fail(std::string(otherwise));
  }
  void require(bool holds, const std::string& pointer, std::string_view otherwise) override {
    if (holds) return;
    throw InputError(open_.back().where(pointer) + ": " + std::string(otherwise));
  }

 protected:
  void choose(const StepKey& key, std::size_t& chosen,
              const std::vector<std::string_view>& names) override {
    if (const auto found = find(key)) chosen = found->one_of(std::string(key.name), names);
  }
  bool enter(const StepKey& key, bool& given, ObjectForm form, bool) override {
    const auto found = find(key);
    if (!found) return false;
    if (form == ObjectForm::boolean && !found->is_object()) {
      given = found->boolean();
      return false;
    }
    given = true;
    open_.push_back(*found);
    return true;
  }
  void leave() override { open_.pop_back(); }
  void begin_keys(const std::function<void(KeyVisitor&)>& keys) override {
    KeyNames known;
    keys(known);
    open_.back().require_keys(known.names);
  }
  void begin_list(const StepKey& key, std::size_t count, const ListWords& words) override {
    items_ = open_.back().at(key.name).elements();
    if (items_.size() == count) return;
    open_.back().at(key.name).fail("expected " + std::string(words.items) + ", got " +
                                   std::to_string(items_.size()) +
                                   (items_.size() < count ? "; " + std::string(words.fewer) : ""));
  }
  void begin_item(std::size_t number, const ListWords&) override {
    open_.push_back(items_[number]);
  }
  void end_item() override { open_.pop_back(); }

 private:
  std::optional<JsonNode> find(const StepKey& key) const {
    const JsonNode& object = open_.back();
    return key.required ? object.at(key.name) : object.find(key.name);
  }
  static double number_in(const JsonNode& node, const Range& range) {
    const std::optional<double> number = node.if_number();
    if (number && range.contains(*number)) return *number;
    node.fail_expecting(range.words());
  }

  std::vector<JsonNode> open_;  // the objects being read, outermost first
  std::vector<JsonNode> items_;
};

void require_version(const JsonNode& root) {
  const std::string current = std::to_string(kRecipeVersion);
  const auto version = root.find("lapwing");
  if (!version) {
    root.fail("the key \"lapwing\" is missing; add \"lapwing\": " + current +
              ", the version of the format");
  }
  if (version->number() != kRecipeVersion) {
    version->fail_expecting("version " + current + ", which this program reads");
  }
}

}  // namespace

Step read_step(const JsonNode& node) {
  std::vector<std::string_view> ops;
  for (const Operation& operation : operations()) ops.push_back(operation.name);
  Step step = operations()[node.at("op").one_of("op", ops)].step;
  KeyNames known;
  known.names.push_back("op");
  describe(step, known);
  node.require_keys(known.names);
  KeyReader reader(node);
  describe(step, reader);
  return step;
}

Recipe parse_recipe(std::string_view json_text, const std::filesystem::path& base_directory,
                    const std::string& name) {
  return parse_recipe(JsonNode::Document{parse_json(json_text, name)}, base_directory, name);
}

Recipe parse_recipe(JsonNode::Document document, const std::filesystem::path& base_directory,
                    const std::string& name) {
  const JsonNode root = JsonNode::of(std::move(document), name);
  root.require_keys({"lapwing", "mesh", "steps", "save", "save_as"});
  require_version(root);
  Recipe recipe;
  recipe.base_directory = base_directory;
  recipe.mesh = root.at("mesh").file_name();
  for (const JsonNode& step : root.at("steps").elements()) recipe.steps.push_back(read_step(step));
  if (const auto save = root.find("save")) recipe.save = save->file_name();
  if (const auto save_as = root.find("save_as")) {
    save_as->require_keys({"morph_target"});
    const JsonNode target = save_as->at("morph_target");
    recipe.morph_target = target.string();
    if (recipe.morph_target.empty() || recipe.morph_target.find('/') != std::string::npos) {
      target.fail("expected a name without \"/\", because some formats use it in a file name");
    }
  }
  return recipe;
}

Recipe read_recipe(const std::filesystem::path& path) {
  const FileBytes bytes = FileBytes::read(path);
  return parse_recipe(bytes.view(), path.parent_path(), path.string());
}

}  // namespace lapwing
