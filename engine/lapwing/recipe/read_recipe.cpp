#include "lapwing/io/file_bytes.h"
#include "lapwing/json/parse_json.h"
#include "lapwing/recipe/key_reader.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {
namespace {

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
