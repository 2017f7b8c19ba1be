#pragma once

#include <utility>

#include "editing/editor.h"
#include "ui/load_file.h"

namespace lapwing::viewer {

/// What is open.
struct Document {
  Document(LoadedFile file, VulkanKernels& kernels, Editor::Say say, std::function<void()> wake)
      : opened(file.opened),
        report(std::move(file.report)),
        save_path(opened.file ? opened.file->path : std::filesystem::path()),
        editor({std::move(file.history), opened.mesh, opened.file}, kernels, std::move(say),
               std::move(wake)) {}

  OpenedMesh opened;
  CheckReport report;
  std::filesystem::path save_path;  ///< empty as long as nobody has said where
  Editor editor;
};

}  // namespace lapwing::viewer
