#include "editing/part_shelf.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/parts/part_library.h"
#include "lapwing/render/part_picture.h"
#include "lapwing/transplant/cut.h"
#include "state/user_folder.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

PartShelf::Item item_of(const lapwing::Part& part, const std::shared_ptr<gpu::Context>& context) {
  PartShelf::Item item;
  item.file = part.mesh_path;
  item.name = part.name;
  item.vertices = part.mesh.vertex_count();
  item.looked_at = true;
  item.picture = part_picture(context, part.mesh, part.loops[part.loop], kThumbnailSide);
  return item;
}

}  // namespace

fs::path parts_folder() {
  return user_folder("XDG_DATA_HOME", ".local/share") / "parts";
}

PartShelf::PartShelf(std::shared_ptr<gpu::Context> context, JobThread::MakeKernels make_kernels,
                     std::function<void()> wake)
    : context_(std::move(context)), job_(std::move(make_kernels), std::move(wake)) {}

void PartShelf::open(const fs::path& folder) {
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
      items_.push_back({file, file.stem().string(), 0, {}, {}, false});
      waiting_.emplace_back([file](const std::shared_ptr<gpu::Context>& context) {
        try {
          return item_of(read_part(file), context);
        } catch (const InputError& error) {
          return Item{file, file.stem().string(), 0, {}, error.what(), true};
        } catch (const IoError& error) {
          return Item{file, file.stem().string(), 0, {}, error.what(), true};
        }
      });
    }
  } catch (const IoError& error) {
    message_ = error.what();
  }
}

void PartShelf::add(const fs::path& file) {
  message_.clear();
  waiting_.emplace_front([folder = folder_, file](const std::shared_ptr<gpu::Context>& context) {
    return item_of(add_part(folder, file, "", {}).part, context);
  });
}

void PartShelf::cut(const AppState& state, const RegionSpec& region, const std::string& name) {
  message_.clear();
  waiting_.emplace_front(
      [folder = folder_, state, region, name](const std::shared_ptr<gpu::Context>& context) {
        const Mesh mesh = mesh_of(state);
        CutPiece piece = cut_out(mesh, resolve(region, mesh), region.where);
        return item_of(add_part(folder, std::move(piece.mesh), name).part, context);
      });
}

void PartShelf::use_device(std::shared_ptr<gpu::Context> context,
                           JobThread::MakeKernels make_kernels) {
  context_ = std::move(context);
  job_.use_kernels(std::move(make_kernels));
}

void PartShelf::renew_version() {
  static std::atomic<std::uint64_t> last = 0;
  version_ = ++last;
}

void PartShelf::keep(Item item) {
  renew_version();
  const auto place = std::lower_bound(items_.begin(), items_.end(), item,
                                      [](const Item& a, const Item& b) { return a.file < b.file; });
  if (place != items_.end() && place->file == item.file) {
    *place = std::move(item);
  } else {
    items_.insert(place, std::move(item));
  }
}

bool PartShelf::update() {
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
