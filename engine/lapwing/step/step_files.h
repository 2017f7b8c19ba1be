#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "lapwing/step/step.h"

namespace lapwing {

/// Calls `read` with every file that the step reads, and `written` with every file that it names to
/// write. Paths are as written; both functions may change them. An empty path stands for the mesh
/// itself.
void for_each_file(Step& step, const std::function<void(std::filesystem::path&)>& read,
                   const std::function<void(std::filesystem::path&)>& written);

/// Returns the files that the step reads, as written.
std::vector<std::filesystem::path> files_read(const Step& step);

}  // namespace lapwing
