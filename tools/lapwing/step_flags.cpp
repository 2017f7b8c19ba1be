#include "step_flags.h"

#include <filesystem>

#include <CLI/CLI.hpp>

#include "lapwing/json/parse_json.h"

namespace lapwing::cli {
namespace {

std::filesystem::path base_of(const std::string& recipe) {
  return recipe.empty() ? std::filesystem::current_path()
                        : std::filesystem::absolute(recipe).parent_path();
}

}  // namespace

std::string StepFlags::from_recipe(const std::string& path) const {
  return std::filesystem::proximate(std::filesystem::absolute(path), base_of(recipe)).string();
}

void StepFlags::run(const StepDraft& draft) const {
  if (output.save.empty() && output.render.empty() && recipe.empty() && output.report.empty()) {
    throw CLI::RequiredError("one of --save, --render, --report and --recipe");
  }
  nlohmann::ordered_json step = draft.json;
  for (const auto& [place, value] : draft.given) step[place] = value;
  for (const auto& finish : draft.at_end) finish(step, *this);
  nlohmann::ordered_json json = {{"lapwing", kRecipeVersion},
                                 {"mesh", from_recipe(mesh)},
                                 {"steps", nlohmann::ordered_json::array({step})}};
  if (!output.save.empty()) json["save"] = from_recipe(output.save);
  const Recipe parsed = parse_recipe(JsonNode::Document{std::move(json)}, base_of(recipe),
                                     "flags of lapwing " + command);
  output.run(parsed, {}, recipe);
}

}  // namespace lapwing::cli
