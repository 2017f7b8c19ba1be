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

/// Where parts are kept unless somebody says otherwise: lapwing/parts/ in $XDG_DATA_HOME, or in
/// ~/.local/share.
std::filesystem::path parts_folder();

/// A folder of parts as a strip shows it. They are looked at beside the window, one after the
/// other, each drawn once.
class PartShelf {
 public:
  /// Pictures are drawn on `context`; the rest is JobThread's.
  PartShelf(std::shared_ptr<gpu::Context> context, JobThread::MakeKernels make_kernels,
            std::function<void()> wake = {});

  struct Item {
    std::filesystem::path file;
    std::string name;
    std::size_t vertices = 0;
    std::optional<Image> picture;
    std::string trouble;  ///< why it cannot be used
    bool looked_at = false;
  };

  /// Lists what is in `folder`; one that is not there is empty.
  void open(const std::filesystem::path& folder);
  const std::filesystem::path& folder() const { return folder_; }
  std::span<const Item> items() const { return items_; }
  /// Another number whenever an item has changed, and of no other shelf.
  std::uint64_t version() const { return version_; }
  /// Why the folder or what was to be added could not be read; empty otherwise.
  const std::string& message() const { return message_; }

  /// Copies a mesh file into the folder.
  void add(const std::filesystem::path& file);
  /// Cuts what is chosen out of the surface of `state`, which waits for no result, as a part.
  void cut(const AppState& state, const RegionSpec& region, const std::string& name);

  bool busy() const { return working_; }
  /// Of a device that takes the place of one that was lost.
  void use_device(std::shared_ptr<gpu::Context> context, JobThread::MakeKernels make_kernels);
  /// Takes what the worker has, and gives it more to do. True if there is news. Call it when woken.
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
