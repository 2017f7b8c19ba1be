#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "lapwing/recipe/key_visitor.h"
#include "step_flags.h"

namespace lapwing::cli {

/// A step as flags give it: the keys that were given, and those that a flag has a default of its
/// own for. Recipes know the other defaults.
struct StepDraft {
  nlohmann::ordered_json json;
  /// What is known only when all flags are: paths from the recipe, what takes several flags.
  std::vector<std::function<void(nlohmann::ordered_json&, const StepFlags&)>> at_end;
};

/// Makes the flags of a command of a step's keys; they write `draft` when they are given.
class FlagVisitor final : public KeyVisitor {
 public:
  FlagVisitor(CLI::App& command, std::shared_ptr<StepDraft> draft)
      : command_(command), draft_(std::move(draft)) {}

  void number(const Key& key, double& value, const Range& range) override;
  void number(const Key& key, std::optional<double>& value, const Range& range) override;
  void whole(const Key& key, int& value, const Range& range) override;
  void whole(const Key& key, std::optional<std::size_t>& value) override;
  void boolean(const Key& key, bool& value) override;
  void region(const Key& key, RegionSpec& value) override;
  void belt(const Key& key, BeltSpec& value) override;
  void handles(const Key& key, std::vector<MovedHandle>& value) override;
  void pairs(const Key& key, std::vector<VertexPair>& value) override;
  void weight(const Key& key, MixWeight& value) override;
  void file(const Key& key, std::filesystem::path& value) override;
  void part(const Key& key, std::filesystem::path& mesh,
            std::optional<RegionSpec>& region) override;
  void place(const Key& key, PartPlace& value, const Key& snap_key, bool& snap) override;

  void where(std::string&) override {}
  void only_when(bool, std::string_view, std::string_view) override {}
  void require(bool, const std::string&, std::string_view) override {}

 protected:
  void choose(const Key& key, std::size_t& chosen,
              const std::vector<std::string_view>& names) override;
  bool enter(const Key& key, bool& given, ObjectForm form, bool is_default) override;
  void leave() override;
  void begin_list(const Key& key, std::size_t count, const ListWords& words) override;
  void begin_item(std::size_t number, const ListWords& words) override;
  void end_item() override;
  void end_list(const Key& key) override;

 private:
  using Json = nlohmann::ordered_json;
  using Place = Json::json_pointer;

  // An object that is optional as a whole.
  struct Scope {
    CLI::Option* off = nullptr;          // the flag that says there is none
    std::vector<CLI::Option*> required;  // without which the others mean nothing
    std::vector<CLI::Option*> others;
  };

  std::string flag(const Key& key) const;
  Place place_of(const Key& key) const { return path_ / std::string(key.name); }
  // Gives `option` what all of them have; `fallback` is what holds without it.
  CLI::Option* finish(const Key& key, CLI::Option* option, const std::string& fallback = "");
  void add_number(const Key& key, const Range& range, bool whole, const std::string& fallback);
  void add_region(const Key& key, const std::string& help, const std::string& fallback);
  void add_off(const Key& key, Json value);

  CLI::App& command_;
  std::shared_ptr<StepDraft> draft_;
  Place path_;
  std::string prefix_;
  std::vector<Scope> scopes_;
};

}  // namespace lapwing::cli
