#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "lapwing/recipe/key_visitor.h"

namespace lapwing::cli {

/// The files that a command with one step reads or writes.
struct StepFiles {
  std::string mesh;
  std::string recipe;  ///< output file for the recipe; empty if the recipe is not written

  /// Returns the folder to which relative paths in the recipe refer.
  std::filesystem::path recipe_folder() const;
  /// Converts a path relative to the current folder to a path relative to `recipe_folder`.
  std::string from_recipe(const std::string& path) const;
};

/// A step that is built from flags. It contains the keys of the given flags, and the keys for which
/// the flag has another default than the recipe.
struct StepDraft {
  using Json = nlohmann::ordered_json;

  Json json;
  /// Values of flags, each with its position in `json`. They are written only after CLI11 has
  /// checked the combination of all flags.
  std::vector<std::pair<Json::json_pointer, Json>> given;
  /// Actions that run after all flags are parsed, for example to make paths relative to the recipe.
  std::vector<std::function<void(Json&, const StepFiles&)>> at_end;
};

/// Adds a flag to a command for each key of a step. The parser writes the value of a flag to
/// `draft`.
class FlagVisitor final : public KeyVisitor {
 public:
  FlagVisitor(CLI::App& command, std::shared_ptr<StepDraft> draft)
      : command_(command), draft_(std::move(draft)) {}

  void number(const StepKey& key, double& value, const Range& range) override;
  void number(const StepKey& key, std::optional<double>& value, const Range& range) override;
  void whole(const StepKey& key, int& value, const Range& range) override;
  void whole(const StepKey& key, std::optional<std::size_t>& value) override;
  void boolean(const StepKey& key, bool& value) override;
  void region(const StepKey& key, RegionSpec& value) override;
  void belt(const StepKey& key, BeltSpec& value) override;
  void handles(const StepKey& key, std::vector<MovedHandle>& value, HandleForm form) override;
  void targets(const StepKey& key, TargetSpec& value) override;
  void stiffness(const StepKey& key, std::vector<StiffnessSpec>& value) override;
  void mirror(const StepKey& key, std::optional<MirrorSpec>& value) override;
  void carry(const StepKey& key, std::vector<CarrySpec>& value) override;
  void pairs(const StepKey& key, std::vector<VertexPair>& value) override;
  void weight(const StepKey& key, MixWeight& value) override;
  void file(const StepKey& key, std::filesystem::path& value) override;
  void part(const StepKey& key, std::filesystem::path& mesh,
            std::optional<RegionSpec>& region) override;
  void place(const StepKey& key, PartPlace& value, const StepKey& snap_key, bool& snap) override;

 protected:
  void choose(const StepKey& key, std::size_t& chosen,
              const std::vector<std::string_view>& names) override;
  bool enter(const StepKey& key, bool& given, ObjectForm form, bool is_default) override;
  void leave() override;
  void begin_list(const StepKey& key, std::size_t count, const ListWords& words) override;
  void begin_item(std::size_t number, const ListWords& words) override;
  void end_item() override;
  void end_list(const StepKey& key) override;

 private:
  using Json = nlohmann::ordered_json;
  using Place = Json::json_pointer;

  // The flags of an optional object of the step.
  struct Scope {
    CLI::Option* off = nullptr;          // the flag that disables the object
    std::vector<CLI::Option*> required;  // required if one of `others` is given
    std::vector<CLI::Option*> others;
  };

  std::string flag(const StepKey& key) const;
  Place place_of(const StepKey& key) const { return path_ / std::string(key.name); }
  // Returns a function that sets the value of `key` to its argument.
  std::function<void(Json)> setter(const StepKey& key) const;
  // Calls `value` after all flags are parsed. Stores the result as the value of `key` unless it is
  // null.
  void set_at_end(const StepKey& key, std::function<Json(const Json&, const StepFiles&)> value);
  // Sets the common properties of options. `fallback` is the default in the help.
  CLI::Option* finish(const StepKey& key, CLI::Option* option, const std::string& fallback = "");
  void add_number(const StepKey& key, const Range& range, bool whole, const std::string& fallback);
  void add_region(const StepKey& key, const std::string& help, const std::string& fallback);
  void add_off(const StepKey& key, Json value);

  CLI::App& command_;
  std::shared_ptr<StepDraft> draft_;
  Place path_;
  std::string prefix_;
  std::vector<Scope> scopes_;
};

}  // namespace lapwing::cli
