#include "lapwing/step/step_files.h"

#include "lapwing/step/key_visitor.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Visit = std::function<void(fs::path&)>;

class StepFiles final : public KeyVisitor {
 public:
  StepFiles(const Visit& read, const Visit& written) : read_(read), written_(written) {}

  void file(const StepKey&, fs::path& value) override {
    if (!value.empty()) read_(value);
  }
  void targets(const StepKey&, TargetSpec& value) override {
    if (!value.file.empty()) read_(value.file);
  }
  void carry(const StepKey&, std::vector<CarrySpec>& value) override {
    for (CarrySpec& carry : value) {
      read_(carry.file);
      if (!carry.save.empty()) written_(carry.save);
    }
  }
  void part(const StepKey&, fs::path& mesh, std::optional<RegionSpec>&) override {
    if (!mesh.empty()) read_(mesh);
  }

 private:
  const Visit& read_;
  const Visit& written_;
};

}  // namespace

void for_each_file(Step& step, const Visit& read, const Visit& written) {
  StepFiles files(read, written);
  describe(step, files);
}

std::vector<fs::path> files_read(const Step& step) {
  std::vector<fs::path> paths;
  Step copy = step;
  for_each_file(
      copy, [&](const fs::path& path) { paths.push_back(path); }, [](fs::path&) {});
  return paths;
}

}  // namespace lapwing
