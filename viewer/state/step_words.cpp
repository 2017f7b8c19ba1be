#include "state/step_words.h"

#include <functional>

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

// One overload per operation.
struct Describer {
  std::string operator()(const DeformStep&) const { return "deform"; }
  std::string operator()(const CoatStep& step) const { return from("coat", step.source.mesh); }
  std::string operator()(const MixStep& step) const {
    const auto& [first, second] = step.sources;
    return from("mix", first.mesh) + (second.mesh.empty() ? "" : from(" and", second.mesh));
  }
  std::string operator()(const TransplantStep& step) const { return from("transplant", step.part); }

  // An empty path stands for the mesh itself.
  static std::string from(const std::string& what, const fs::path& path) {
    return path.empty() ? what : what + " from " + path.filename().string();
  }
};

// One overload per operation: `change` has every path that the step names, but for empty ones,
// which stand for the mesh itself.
struct PathChanger {
  std::function<fs::path(const fs::path&)> change;

  void operator()(DeformStep&) const {}
  void operator()(CoatStep& step) const { renew(step.source.mesh); }
  void operator()(MixStep& step) const {
    for (CoatSource& source : step.sources) renew(source.mesh);
  }
  void operator()(TransplantStep& step) const { renew(step.part); }

  void renew(fs::path& path) const {
    if (!path.empty()) path = change(path);
  }
};

}  // namespace

std::string describe(const Step& step) {
  return std::visit(Describer{}, step);
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
