#include "editing/part_library_view.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/render/part_picture.h"
#include "lapwing/transplant/cut.h"
#include "lapwing/transplant/part_library.h"
#include "state/user_folder.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

PartLibraryView::Item item_of(const lapwing::Part& part,
                              const std::shared_ptr<gpu::Context>& context) {
  return {part.mesh_path,
          part.name,
          part.mesh.vertex_count(),
          part_picture(context, part.mesh, part.loops[part.loop], kThumbnailSide),
          {}};
}

}  // namespace

fs::path parts_folder() {
  return user_folder("XDG_DATA_HOME", ".local/share") / "parts";
}

PartLibraryView::PartLibraryView(std::shared_ptr<gpu::Context> context,
                                 JobThread::MakeKernels make_kernels, std::function<void()> wake)
    : context_(std::move(context)), job_(std::move(make_kernels), std::move(wake)) {}

void PartLibraryView::open(const fs::path& folder) {
  folder_ = folder;
  items_.clear();
  waiting_.clear();
  message_.clear();
  renew_version();
  job_.cancel();
  working_ = false;
  std::error_code missing;
  if (!fs::exists(folder, missing)) return;
  try {
    for (const fs::path& file : part_files(folder)) {
      items_.push_back({file, file.stem().string(), 0, {}, {}});
      waiting_.emplace_back([file](const std::shared_ptr<gpu::Context>& context) {
        try {
          return item_of(read_part(file), context);
        } catch (const InputError& error) {
          return Item{file, file.stem().string(), 0, {}, error.what()};
        } catch (const IoError& error) {
          return Item{file, file.stem().string(), 0, {}, error.what()};
        }
      });
    }
  } catch (const IoError& error) {
    message_ = error.what();
  }
}

void PartLibraryView::add(const fs::path& file) {
  message_.clear();
  waiting_.emplace_front([folder = folder_, file](const std::shared_ptr<gpu::Context>& context) {
    return item_of(add_part(folder, file, "", {}).part, context);
  });
}

void PartLibraryView::cut(const AppState& state, const RegionSpec& region,
                          const std::string& name) {
  message_.clear();
  waiting_.emplace_front(
      [folder = folder_, state, region, name](const std::shared_ptr<gpu::Context>& context) {
        const Mesh mesh = mesh_of(state);
        CutPiece piece = cut_out(mesh, resolve(region, mesh), region.where);
        return item_of(add_part(folder, std::move(piece.mesh), name).part, context);
      });
}

void PartLibraryView::use_device(std::shared_ptr<gpu::Context> context,
                                 JobThread::MakeKernels make_kernels) {
  context_ = std::move(context);
  job_.use_kernels(std::move(make_kernels));
}

void PartLibraryView::renew_version() {
  static std::atomic<std::uint64_t> last = 0;
  version_ = ++last;
}

void PartLibraryView::keep(Item item) {
  renew_version();
  const auto place = std::ranges::lower_bound(items_, item.file, {}, &Item::file);
  if (place != items_.end() && place->file == item.file) {
    *place = std::move(item);
  } else {
    items_.insert(place, std::move(item));
  }
}

bool PartLibraryView::update() {
  bool news = false;
  try {
    if (auto item = job_.take()) {
      keep(*std::move(item));
      working_ = false;
      news = true;
    }
  } catch (const Error& error) {
    message_ = error.what();
    working_ = false;
    news = true;
  }
  if (!working_ && !waiting_.empty()) {
    job_.start([work = std::move(waiting_.front()), context = context_](
                   const std::shared_ptr<Kernels>&, const Progress&) { return work(context); });
    waiting_.pop_front();
    working_ = true;
  }
  return news;
}

}  // namespace lapwing::viewer
