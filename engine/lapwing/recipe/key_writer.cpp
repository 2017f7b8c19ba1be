#include "lapwing/recipe/key_writer.h"

#include "lapwing/step/key_visitor.h"

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

  std::vector<Json> open_{Json::object()};  // objects and lists that are being written
  std::vector<std::string> names_;          // their keys, except for the first
};

}  // namespace

Json json_of(const Step& step) {
  KeyWriter writer(operations()[step.index()].name);
  Step copy = step;
  describe(copy, writer);
  return writer.take();
}

}  // namespace lapwing
