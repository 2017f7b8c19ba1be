#include "lapwing/deform/prepared_deform.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/worker_pool.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/modifiers/joined_request.h"
#include "lapwing/deform/modifiers/mirrored_request.h"

namespace lapwing {

using Eigen::Affine3d;
using Eigen::Vector3d;

namespace {

// Rethrows the current error, with the index of its motion in the message.
[[noreturn]] void rethrow_of_motion(std::size_t k) {
  const std::string place = "motion " + std::to_string(k) + ": ";
  try {
    throw;
  } catch (const InputError& error) {
    throw InputError(place + error.what(), error.vertices());
  } catch (const SolverError& error) {
    throw SolverError(place + error.what(), error.vertices());
  }
}

// State shared by the threads of one `solve_many`.
struct SharedCount {
  std::size_t count;
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> stopped = false;
  std::mutex mutex;
  std::exception_ptr first_error;

  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex);
    if (!first_error) first_error = std::move(error);
    stopped = true;
  }

  double fraction() const { return static_cast<double>(done) / static_cast<double>(count); }
};

// Returns the motion about `center` that adds `length` to entry (a, b) of the linear part. If b is
// 3, it translates by `length` along axis a.
Affine3d unit_motion(const Vector3d& center, double length, Eigen::Index a, Eigen::Index b) {
  Affine3d motion = Affine3d::Identity();
  if (b == 3) {
    motion.translation()[a] = length;
  } else {
    motion.linear()(a, b) += length;
    motion.translation()[a] = -length * center[b];
  }
  return motion;
}

// Converts motions of single handles of a request to parameters of its edit, which also contains
// their mirror images.
class HandleParameters {
 public:
  HandleParameters(const MirroredRequest& both, const EditRegion& region, const Positions& rest)
      : images_(both.handle_images), plane_(both.plane) {
    for (const VertexSet& handle : region.handles) frames_.push_back(handle_frame(handle, rest));
  }

  std::size_t image_of(std::size_t handle) const {
    return images_.empty() ? handle : images_[handle];
  }

  // Sets the parameters of the handles `moved` of the edit (ascending), if `handle` moves by
  // `motion` and all other handles are at rest.
  void set_parameters(std::size_t handle, const Affine3d& motion,
                      std::span<const std::size_t> moved, std::span<double> parameters) const {
    std::fill(parameters.begin(), parameters.end(), 0.0);
    const auto set = [&](std::size_t h, const Affine3d& by) {
      const auto at = std::lower_bound(moved.begin(), moved.end(), h) - moved.begin();
      motion_parameters(
          frames_[h], by,
          parameters.subspan(kMotionParameters * static_cast<std::size_t>(at), kMotionParameters));
    };
    if (!plane_) return set(handle, motion);
    const Affine3d mirror = reflection(*plane_);
    const Affine3d mirrored = mirror * motion * mirror;
    if (image_of(handle) != handle) {
      set(handle, motion);
      return set(image_of(handle), mirrored);
    }
    Affine3d along = motion;  // the handle lies across the plane
    along.affine() = 0.5 * (motion.affine() + mirrored.affine());
    set(handle, along);
  }

 private:
  const std::vector<std::size_t>& images_;
  const std::optional<MirrorPlane>& plane_;
  std::vector<HandleFrame> frames_;
};

}  // namespace

PreparedDeform::PreparedDeform(Mesh mesh, DeformRequest request, const Progress& progress)
    : mesh_(std::move(mesh)), request_(std::move(request)) {
  for (MovedHandle& handle : request_.handles) {
    handle.move = SimilarityMove();
    handle.path.clear();
  }
  region_ = solved(request_, progress).region;
}

Deformed PreparedDeform::solved(const DeformRequest& request, const Progress& progress) {
  is_at_rest_ = false;
  Deformed result = deform(mesh_, request, kernels_, workspace_, progress);
  is_at_rest_ = result.commits == 1;  // otherwise, the solver belongs to the last substep
  return result;
}

Deformed PreparedDeform::solve(std::span<const Move> moves, const Progress& progress) {
  std::vector<HandleOrientation> orientations;
  for (const MovedHandle& handle : request_.handles) orientations.push_back(handle.orientation);
  return solve(moves, orientations, progress);
}

Deformed PreparedDeform::solve(std::span<const Move> moves,
                               std::span<const HandleOrientation> orientations,
                               const Progress& progress) {
  const auto require_count = [this](std::size_t count, const std::string& what) {
    if (count == request_.handles.size()) return;
    throw InputError("the edit has " + std::to_string(request_.handles.size()) + " handles, but " +
                     std::to_string(count) + " " + what + " were given; give one per handle");
  };
  require_count(moves.size(), "moves");
  require_count(orientations.size(), "orientations");
  DeformRequest moved = request_;
  for (std::size_t h = 0; h < moves.size(); ++h) {
    moved.handles[h].move = moves[h];
    moved.handles[h].orientation = orientations[h];
  }
  return solved(moved, progress);
}

SurfaceResponse PreparedDeform::response(std::span<const std::size_t> handles,
                                         const Progress& progress) {
  for (const std::size_t h : handles) {
    if (h < request_.handles.size()) continue;
    throw InputError("the edit has " + std::to_string(request_.handles.size()) +
                     " handles, numbered from 0; handle " + std::to_string(h) + " does not exist");
  }
  const ProgressScope scope(progress);
  if (!is_at_rest_) solved(request_, progress);
  const JoinedSurface* joined =
      workspace_.joined && !workspace_.joined->empty() ? &*workspace_.joined : nullptr;
  const MirroredRequest both =
      joined == nullptr ? mirrored_request(request_, mesh_)
                        : mirrored_request(joined_request(request_, *joined), joined->surface);
  const DeformSolver& solver = *workspace_.solver;
  const HandleParameters motions(both, solver.region(), mesh_.positions);
  std::vector<std::size_t> moved(handles.begin(), handles.end());
  for (const std::size_t h : handles) moved.push_back(motions.image_of(h));

  SurfaceResponse response;
  const std::size_t n = mesh_.vertex_count();
  require_memory(sizeof(Vector3d) * kMotionParameters * handles.size() * n,
                 "the response of " + std::to_string(n) + " vertices to " +
                     std::to_string(handles.size()) + " handles",
                 "ask for fewer handles at a time");
  const auto drag = solver.response_of(moved, progress);
  response.vertex_count = n;
  response.why_not_exact = drag->why_not_exact();
  response.columns.assign(kMotionParameters * handles.size() * n, Vector3d::Zero());
  const double length = bounds_of(mesh_.positions).diagonal();
  std::vector<double> parameters(drag->columns().count);
  Vector3d* column = response.columns.data();
  for (const std::size_t h : handles) {
    const Vector3d center = handle_frame(region_.handles[h], mesh_.positions).centroid;
    response.centers.push_back(center);
    for (std::size_t k = 0; k < kMotionParameters; ++k, column += n) {
      const auto a = static_cast<Eigen::Index>(k / 4);
      const auto b = static_cast<Eigen::Index>(k % 4);
      // The motion has the size of the mesh, so that its rounding errors are similar to those of
      // the coordinates.
      const double by = b == 3 ? length : 1.0;
      motions.set_parameters(h, unit_motion(center, by, a, b), drag->handles(), parameters);
      for (double& parameter : parameters) parameter /= by;
      const std::span displacement(column, n);
      blend_response(displacement, drag->columns(), parameters, displacement);
      if (joined == nullptr) continue;
      for (const Index v : joined->followers) displacement[v] = displacement[joined->leaders[v]];
    }
  }
  return response;
}

void PreparedDeform::solve_many(std::size_t count, const MovesOf& moves_of, const Take& take,
                                unsigned threads, const Progress& progress) {
  if (count == 0) return;
  SharedCount shared{count};
  const auto work = [&](PreparedDeform& edit, const Progress& heard) {
    while (!shared.stopped) {
      const std::size_t k = shared.next++;
      if (k >= count) return;
      try {
        take(k, edit.solve(moves_of(k), heard));
        ++shared.done;
      } catch (const Cancelled&) {
        shared.fail(std::current_exception());
      } catch (...) {
        try {
          rethrow_of_motion(k);
        } catch (...) {
          shared.fail(std::current_exception());
        }
      }
    }
  };
  const Progress heard_aside = [&](std::string_view, double) { return !shared.stopped; };
  const Progress heard_here = [&](std::string_view, double) {
    return !shared.stopped && (!progress || progress("solve_many", shared.fraction()));
  };

  const std::size_t total = threads > 0 ? threads : thread_count();
  std::vector<std::jthread> others;
  for (std::size_t t = 1; t < std::min(total, count); ++t) {
    others.emplace_back([&] {
      const SerialScope alone;
      try {
        PreparedDeform own(mesh_, request_, heard_aside);
        work(own, heard_aside);
      } catch (...) {
        shared.fail(std::current_exception());
      }
    });
  }
  {
    std::optional<SerialScope> alone;
    if (!others.empty()) alone.emplace();
    work(*this, heard_here);
  }
  others.clear();
  if (shared.first_error) std::rethrow_exception(shared.first_error);
  report_progress(progress, "solve_many", 1.0);
}

}  // namespace lapwing
