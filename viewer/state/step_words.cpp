#include "state/step_words.h"

#include <functional>

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

// One overload per operation.
struct StepDescriber {
  std::string operator()(const DeformRequest&) const { return "deform"; }
  std::string operator()(const CoatStep& step) const {
    const fs::path& mesh = step.source.mesh;
    return mesh.empty() ? "coat" : "coat from " + mesh.filename().string();
  }
  std::string operator()(const MixStep& step) const {
    std::string words = "mix";
    for (const FileSource& source : step.sources) {
      words += words == "mix" ? " " : " and ";
      words += source.mesh.empty() ? "the mesh itself" : source.mesh.filename().string();
    }
    return words;
  }
  std::string operator()(const TransplantStep& step) const {
    return step.part.empty() ? "transplant" : "transplant " + step.part.filename().string();
  }
};

// One overload per operation: `change` has every path that the step names, but for empty ones,
// which stand for the mesh itself.
struct PathChanger {
  std::function<fs::path(const fs::path&)> change;

  void operator()(DeformRequest&) const {}
  void operator()(CoatStep& step) const { renew(step.source.mesh); }
  void operator()(MixStep& step) const {
    for (FileSource& source : step.sources) renew(source.mesh);
  }
  void operator()(TransplantStep& step) const { renew(step.part); }

  void renew(fs::path& path) const {
    if (!path.empty()) path = change(path);
  }
};

}  // namespace

std::string describe(const Step& step) {
  return std::visit(StepDescriber{}, step);
}

Step with_absolute_paths(Step step, const fs::path& base_directory) {
  std::visit(PathChanger{[&](const fs::path& path) {
               return fs::absolute(base_directory / path).lexically_normal();
             }},
             step);
  return step;
}

Step with_paths_from(Step step, const fs::path& base_directory) {
  const fs::path folder = fs::absolute(base_directory).lexically_normal();
  std::visit(PathChanger{[&](const fs::path& path) { return path.lexically_proximate(folder); }},
             step);
  return step;
}

}  // namespace lapwing::viewer
