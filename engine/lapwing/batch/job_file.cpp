#include "lapwing/batch/job_file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <unordered_map>

#include "lapwing/base/errors.h"
#include "lapwing/batch/set_json.h"
#include "lapwing/io/paths.h"
#include "lapwing/json/parse_json.h"
#include "lapwing/json/suggest.h"
#include "lapwing/recipe/recipe_files.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// File names have at most 255 bytes, including an extension and the suffix of a temporary file.
constexpr std::size_t kLongestId = 200;

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r") == std::string_view::npos;
}

// Removes the moves, because the preparation of a region does not depend on them.
void erase_moves(Json& json) {
  if (json.is_object()) json.erase("move");
  if (!json.is_structured()) return;
  for (Json& inside : json) erase_moves(inside);
}

bool is_inside_move(const std::string& pointer) {
  return (pointer + "/").find("/move/") != std::string::npos;
}

std::string why_no_name(const std::string& id) {
  if (id.empty()) return "it is empty";
  if (id == "." || id == "..") return "it is a folder";
  if (id.size() > kLongestId) return "it is longer than " + std::to_string(kLongestId) + " bytes";
  if (id.find('/') != std::string::npos) return "it contains a \"/\"";
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (std::any_of(id.begin(), id.end(), is_control)) return "it contains a control character";
  return {};
}

}  // namespace

std::uint64_t hash_of(std::string_view text, std::uint64_t before) {
  for (const char c : text) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return before;
}

std::string text_of(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

struct JobFile::Line {
  std::string where;  ///< prefix of messages
  std::string id;
  fs::path file;  ///< path of the recipe; empty if the line contains the recipe
  Json recipe;    ///< the recipe, if the line contains it
  Json set = Json::object();

  void require_keys(const Json& json) const {
    constexpr std::array<std::string_view, 3> kKeys{"id", "recipe", "set"};
    if (!json.is_object()) {
      throw InputError(where + R"(: expected an object, as in {"id": "a", "set": {...}})");
    }
    for (const auto& [key, value] : json.items()) {
      if (std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end()) continue;
      throw InputError(where + ": /" + pointer_token(key) + ": unknown key; " +
                       suggest(key, kKeys));
    }
  }
};

JobFile::JobFile(const fs::path& path, const fs::path& recipe, std::string_view output,
                 const fs::path& sandbox)
    : name_(path.string()),
      folder_(path.parent_path()),
      default_recipe_(recipe),
      sandbox_(sandbox),
      bytes_(FileBytes::read(path)) {
  if (!recipe.empty() && !page(recipe).error.empty()) throw IoError(page(recipe).error);
  std::string_view rest = bytes_.view();
  for (std::size_t line = 1; !rest.empty(); ++line) {
    const std::string_view text = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(text.size() + 1, rest.size()));
    if (!is_blank(text)) add(line, text, output);
  }
  groups_.clear();
  require_unique_ids();
}

const JobFile::Page& JobFile::page(const fs::path& file) {
  const auto [at, is_new] = pages_.try_emplace(file);
  if (is_new) {
    try {
      at->second.text = FileBytes::read(file).view();
    } catch (const IoError& error) {
      at->second.error = error.what();
    }
  }
  return at->second;
}

JobFile::Line JobFile::read_line(const Job& job) const {
  Line line;
  line.where = name_ + ":" + std::to_string(job.line);
  const Json json = parse_json(job.text, name_, job.line);
  line.require_keys(json);
  line.id = std::to_string(job.line);
  if (const auto id = json.find("id"); id != json.end()) {
    if (!id->is_string() && !id->is_number()) {
      throw InputError(line.where + ": /id: expected a string or a number");
    }
    line.id = id->is_string() ? id->get<std::string>() : id->dump();
  }
  if (const std::string why = why_no_name(line.id); !why.empty()) {
    throw InputError(line.where + ": /id: the id cannot be a file name: " + why);
  }
  line.file = default_recipe_;
  if (const auto recipe = json.find("recipe"); recipe != json.end()) {
    if (!recipe->is_string() && !recipe->is_object()) {
      throw InputError(line.where + ": /recipe: expected a file name in quotes or a recipe");
    }
    line.file = recipe->is_string() ? folder_ / recipe->get<std::string>() : fs::path();
    if (recipe->is_object()) line.recipe = *recipe;
  } else if (default_recipe_.empty()) {
    throw InputError(line.where +
                     ": the line has no \"recipe\"; add one, or give one for all lines with "
                     "--recipe");
  }
  if (const auto set = json.find("set"); set != json.end()) {
    if (!set->is_object()) {
      throw InputError(line.where + ": /set: expected an object of JSON pointers and values");
    }
    line.set = *set;
  }
  return line;
}

void JobFile::add(std::size_t number, std::string_view text, std::string_view output) {
  Job job;
  job.line = number;
  job.id = std::to_string(number);
  job.text = text;
  std::string region;
  try {
    Line line = read_line(job);
    job.id = line.id;
    if (line.file.empty()) {
      job.asked = hash_of(line.recipe.dump());
      erase_moves(line.recipe);
      region = line.recipe.dump();
    } else {
      const bool is_named = line.file != default_recipe_ && !sandbox_.empty();
      if (is_named && !is_inside(line.file, sandbox_)) {
        throw InputError(line.where + ": /recipe: " + line.file.string() + " is outside " +
                         sandbox_.string() + "; move it there, or omit --sandbox");
      }
      const Page& recipe = page(line.file);
      if (!recipe.error.empty()) throw InputError(line.where + ": " + recipe.error);
      job.asked = hash_of(recipe.text);
      region = line.file.string();
    }
    job.asked = hash_of(output, hash_of(line.set.dump(), job.asked));
    for (auto& [pointer, value] : line.set.items()) {
      if (is_inside_move(pointer)) continue;
      erase_moves(value);
      region += "\n" + pointer + "\n" + value.dump();
    }
  } catch (const InputError& error) {
    job.error = error.what();
  }
  job.group = groups_.try_emplace(hash_of(region), groups_.size()).first->second;
  jobs_.push_back(std::move(job));
}

// Jobs with errors write no files, so their ids may repeat.
void JobFile::require_unique_ids() const {
  std::unordered_map<std::string_view, std::size_t> lines;
  for (const Job& job : jobs_) {
    if (!job.error.empty()) continue;
    const auto [at, is_new] = lines.try_emplace(job.id, job.line);
    if (is_new) continue;
    throw InputError(name_ + ":" + std::to_string(job.line) + ": the id \"" + job.id +
                     "\" is already used in line " + std::to_string(at->second) +
                     "; give each line a different id");
  }
}

Recipe JobFile::recipe_of(const Job& job) const {
  Line line = read_line(job);
  std::string name = line.where;
  fs::path base_directory = folder_;
  if (!line.file.empty()) {
    const Page& recipe = pages_.at(line.file);
    name += " (" + line.file.string() + ")";
    base_directory = line.file.parent_path();
    line.recipe = parse_json(recipe.text, name);
  }
  for (auto& [pointer, value] : line.set.items()) {
    set_json(line.recipe, pointer, std::move(value), line.where + ": /set");
  }
  Recipe recipe = parse_recipe(JsonNode::Document{std::move(line.recipe)}, base_directory, name);
  if (!sandbox_.empty()) require_inside(recipe, sandbox_);
  return recipe;
}

}  // namespace lapwing
