#include "state/step_words.h"

#include <functional>

#include "lapwing/step/key_visitor.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

// Passes `read` every file that a step reads, and `written` those that it names to write; an empty
// path stands for the mesh itself.
class StepFiles final : public KeyVisitor {
 public:
  using Visit = std::function<void(fs::path&)>;
  explicit StepFiles(Visit read, Visit written = {})
      : read_(std::move(read)), written_(std::move(written)) {}

  void file(const StepKey&, fs::path& value) override { read_(value); }
  void targets(const StepKey&, TargetSpec& value) override {
    if (!value.file.empty()) read_(value.file);
  }
  void carry(const StepKey&, std::vector<CarrySpec>& value) override {
    for (CarrySpec& carry : value) {
      read_(carry.file);
      if (!carry.save.empty() && written_) written_(carry.save);
    }
  }
  void part(const StepKey&, fs::path& mesh, std::optional<RegionSpec>&) override { read_(mesh); }

 private:
  Visit read_;
  Visit written_;
};

Step with_paths(Step step, const std::function<fs::path(const fs::path&)>& change) {
  const auto change_it = [&](fs::path& path) {
    if (!path.empty()) path = change(path);
  };
  StepFiles files(change_it, change_it);
  describe(step, files);
  return step;
}

}  // namespace

std::vector<fs::path> files_read(const Step& step) {
  std::vector<fs::path> paths;
  StepFiles files([&](const fs::path& path) { paths.push_back(path); });
  Step copy = step;
  describe(copy, files);
  return paths;
}

std::string describe(const Step& step) {
  const std::vector<fs::path> paths = files_read(step);
  const Operation& operation = operation_of(step);
  std::string words(operation.name);
  if (paths.empty() || (paths.size() == 1 && paths.front().empty())) return words;
  std::string_view before = operation.before_files;
  for (const fs::path& path : paths) {
    words.append(before).append(path.empty() ? "the mesh itself" : path.filename().string());
    before = " and ";
  }
  return words;
}

Step with_absolute_paths(Step step, const fs::path& base_directory) {
  return with_paths(std::move(step), [&](const fs::path& path) {
    return fs::absolute(base_directory / path).lexically_normal();
  });
}

Step with_paths_from(Step step, const fs::path& base_directory) {
  const fs::path folder = fs::absolute(base_directory).lexically_normal();
  return with_paths(std::move(step),
                    [&](const fs::path& path) { return path.lexically_proximate(folder); });
}

}  // namespace lapwing::viewer
