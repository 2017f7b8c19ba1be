#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/io/image.h"
#include "state/app_state.h"
#include "work/job.h"

namespace lapwing::gpu {
class Context;
}

namespace lapwing::viewer {

/// Returns the default folder of parts: lapwing/parts/ in $XDG_DATA_HOME, or in ~/.local/share.
std::filesystem::path parts_folder();

/// Lists the parts in a folder, with thumbnails. Reads each part once and renders its thumbnail in
/// the background.
class PartLibraryView {
 public:
  /// Renders the thumbnails on `context`. The other arguments are those of JobThread.
  PartLibraryView(std::shared_ptr<gpu::Context> context, JobThread::MakeKernels make_kernels,
                  std::function<void()> wake = {});

  struct Item {
    std::filesystem::path file;
    std::string name;
    std::size_t vertices = 0;
    std::optional<Image> picture;
    std::string trouble;  ///< why it cannot be used
  };

  /// Lists the parts in `folder`. A missing folder is empty.
  void open(const std::filesystem::path& folder);
  const std::filesystem::path& folder() const { return folder_; }
  std::span<const Item> items() const { return items_; }
  /// Returns a number that changes whenever an item changes. It is unique among all views.
  std::uint64_t version() const { return version_; }
  /// Returns why the folder or an added part could not be read. Empty if both could be read.
  const std::string& message() const { return message_; }

  /// Copies a mesh file into the folder.
  void add(const std::filesystem::path& file);
  /// Copies `region` of the surface of `state` into a new part called `name`.
  void cut(const AppState& state, const RegionSpec& region, const std::string& name);

  bool busy() const { return working_; }
  /// Continues on another device, after the first was lost.
  void use_device(std::shared_ptr<gpu::Context> context, JobThread::MakeKernels make_kernels);
  /// Takes the result of finished background work and starts the next. Returns true if an item or
  /// `message` has changed. Call this after `wake`.
  bool update();

 private:
  using Work = std::function<Item(const std::shared_ptr<gpu::Context>&)>;

  void keep(Item item);
  void renew_version();

  std::shared_ptr<gpu::Context> context_;
  std::filesystem::path folder_;
  std::vector<Item> items_;
  std::uint64_t version_ = 0;
  std::string message_;
  std::deque<Work> waiting_;
  bool working_ = false;
  Job<Item> job_;
};

}  // namespace lapwing::viewer
