#include "lapwing/recipe/key_visitor.h"
#include "lapwing/recipe/step.h"

namespace lapwing {
namespace {

std::string quoted(std::string_view name) {
  return "`\"" + std::string(name) + "\"`";
}

class KeyTable final : public KeyVisitor {
 public:
  std::string text = "| key | value | default | |\n|---|---|---|---|\n";

  void number(const StepKey& key, double& value, const Range& range) override {
    add(key, range.words(), digits(value));
  }
  void number(const StepKey& key, std::optional<double>&, const Range& range) override {
    add(key, range.words(), key.automatic ? quoted("auto") : "");
  }
  void whole(const StepKey& key, int& value, const Range& range) override {
    add(key, range.words(true), std::to_string(value));
  }
  void whole(const StepKey& key, std::optional<std::size_t>&) override {
    add(key, "a whole number from 0");
  }
  void boolean(const StepKey& key, bool& value) override {
    add(key, "true or false", value ? "true" : "false");
  }

  void region(const StepKey& key, RegionSpec&) override { add(key, "a region"); }
  void belt(const StepKey& key, BeltSpec& value) override {
    const auto* border = std::get_if<BoundaryAnchors>(&value);
    add(key, "a fraction or a region",
        border == nullptr ? "" : "`{\"fraction\": " + digits(border->fraction) + "}`");
  }
  void handles(const StepKey& key, std::vector<MovedHandle>&, HandleForm form) override {
    add(key, form == HandleForm::firm
                 ? "a list of `{\"region\": REGION, \"move\": MOVE}`"
                 : "a list of `{\"region\": REGION, \"move\": MOVE}`, each optionally with "
                   "`\"falloff\"` or `\"weight\"`, `\"orientation\": \"free\"`, and "
                   "`\"path\"`: a list of moves");
  }
  void targets(const StepKey& key, TargetSpec&) override {
    add(key, "rows, or `{\"rows\" or \"file\", \"hard\"}`");
  }
  void landmarks(const StepKey& key, LandmarkSpec&) override {
    add(key, "rows, a file, or `{\"template\": FILE, \"scan\": FILE}`");
  }
  void stiffness(const StepKey& key, std::vector<StiffnessSpec>&) override {
    add(key,
        "a list of `{\"region\": REGION, \"factor\": FACTOR}`, where FACTOR is a number from "
        "0.01 to 100, `\"rigid\"`, or `{\"field\": [...]}` with one of these for each vertex");
  }
  void mirror(const StepKey& key, std::optional<MirrorSpec>&) override {
    add(key, "`\"auto\"`, `{\"plane\": \"x\"}` or `{\"point\", \"normal\"}`");
  }
  void carry(const StepKey& key, std::vector<CarrySpec>&) override {
    add(key, "a list of files, or `{\"file\", \"save\"}`");
  }
  void pairs(const StepKey& key, std::vector<VertexPair>&) override { add(key, "`[[s, t], ...]`"); }
  void weight(const StepKey& key, MixWeight&) override { add(key, "an object"); }
  void file(const StepKey& key, std::filesystem::path&) override { add(key, "a file"); }
  void part(const StepKey& key, std::filesystem::path&, std::optional<RegionSpec>&) override {
    add(key, "a file or `{\"mesh\": FILE, \"region\": REGION}`");
  }
  void place(const StepKey& key, PartPlace&, const StepKey& snap_key, bool& snap) override {
    add(key, "`{\"auto\": {...}}` or a move", "`{\"auto\": {}}`");
    boolean(snap_key, snap);
  }

 protected:
  void choose(const StepKey& key, std::size_t& chosen,
              const std::vector<std::string_view>& names) override {
    std::string choices;
    for (const std::string_view name : names) {
      choices += (choices.empty() ? "" : " or ") + quoted(name);
    }
    add(key, choices, quoted(names[chosen]));
  }
  bool enter(const StepKey& key, bool& given, ObjectForm form, bool) override {
    const bool switches = form == ObjectForm::boolean;
    add(key, switches ? "true, false or an object" : "an object",
        switches ? (given ? "true" : "false") : "");
    open(key);
    return true;
  }
  void leave() override { close(); }
  void begin_list(const StepKey& key, std::size_t, const ListWords&) override {
    add(key, "a list");
    open(key);
  }
  // All items have the same keys, so only the first is listed.
  void begin_item(std::size_t number, const ListWords&) override { told_ = number > 0; }
  void end_item() override { told_ = false; }
  void end_list(const StepKey&) override { close(); }

 private:
  void add(const StepKey& key, const std::string& value, const std::string& fallback = "") {
    if (told_) return;
    const std::string_view other = fallback.empty() ? key.absent : fallback;
    text.append("| `").append(path_).append(key.name).append("` | ").append(value).append(" | ");
    text.append(key.required ? "required" : other).append(" | ").append(key.help).append(" |\n");
  }
  void open(const StepKey& key) {
    lengths_.push_back(path_.size());
    path_ += std::string(key.name) + ".";
  }
  void close() {
    path_.resize(lengths_.back());
    lengths_.pop_back();
  }

  std::string path_;  // path of the open object, with a dot after each name
  std::vector<std::size_t> lengths_;
  bool told_ = false;
};

}  // namespace

std::string key_table(const Operation& operation) {
  KeyTable table;
  Step step = operation.step;
  describe(step, table);
  return std::move(table.text);
}

}  // namespace lapwing
