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
        editor({std::move(file.history), opened.mesh, opened.file, std::move(file.restored)},
               kernels, std::move(say), std::move(wake)),
        save_path(editor.session().file()) {}

  OpenedMesh opened;
  CheckReport report;
  Editor editor;
  std::filesystem::path save_path;  ///< empty as long as nobody has said where
};

}  // namespace lapwing::viewer
