#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "lapwing/step/step.h"

namespace lapwing {

/// Passes `read` every file that the step reads, and `written` those that it names to write, as it
/// names them; either may change them. An empty path stands for the mesh itself.
void for_each_file(Step& step, const std::function<void(std::filesystem::path&)>& read,
                   const std::function<void(std::filesystem::path&)>& written);

/// The files that the step reads, as it names them.
std::vector<std::filesystem::path> files_read(const Step& step);

}  // namespace lapwing
