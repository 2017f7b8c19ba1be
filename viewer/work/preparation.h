#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/elastic/prepared_region.h"
#include "state/app_state.h"
#include "work/attachment_cache.h"
#include "work/settled_result.h"
#include "work/worker.h"

namespace lapwing {
class BlendResponse;
}

namespace lapwing::viewer {

/// Describes the current work of the background thread, for a progress bar and a status line.
struct PreparationStatus {
  enum class Phase {
    idle,        ///< there is nothing to prepare, or the preparation was cancelled
    previewing,  ///< the preview is being prepared
    solving,     ///< the preview is ready; the exact solver is being prepared
    ready,       ///< the preview and the exact solver are ready
    settling,    ///< the preview and the exact solver are ready; a result is being computed
    failed,      ///< the preparation has failed; `message` contains the error
  };
  Phase phase = Phase::idle;
  std::string stage;      ///< name of the engine's current stage, such as "factor"
  double fraction = 0.0;  ///< completed fraction of the preparation, or of settling; 0 to 1
  std::string message;    ///< error of the last computation; empty if it did not fail
};

/// The settled surface for one frame of a drag.
struct LiveResult {
  std::vector<HandleMove> moves;  ///< the moves of the requesting state
  /// The settled pose for `moves`, from which the drag continues. If the computation fails, this is
  /// the pose from which it started, where null means the rest shape.
  std::shared_ptr<const DragState> pose;
  bool is_done = false;  ///< whether a repeated request would return the same pose
  Bounds bounds = {};    ///< bounding box of the moving vertices at `pose`
};

/// Time budget of a live result. The rest of a 16.7 ms frame remains for uploading and drawing the
/// pose.
inline constexpr double kLiveBudgetMs = 12.0;
/// Time budget of a live result while the mouse does not move. With a larger budget, the surface
/// reaches the minimum sooner.
inline constexpr double kRestBudgetMs = 50.0;

/// Prepares the solver of an edit and computes results on a background thread, the worker. Prepares
/// the preview of a drag first, then the exact solver. Call all members from the window's thread.
/// They do not block, except the destructor, which waits until the current stage is finished.
class Preparation {
 public:
  /// A function that creates the kernels. It is called on the worker.
  using MakeKernels = std::function<std::unique_ptr<Kernels>()>;
  /// A function that uploads a response to the device that draws. It is called on the worker.
  using Upload = std::function<std::shared_ptr<BlendResponse>(const DragResponse&)>;

  /// `wake` is called on the worker whenever the status has changed. It must not call this object.
  explicit Preparation(MakeKernels make_kernels, std::function<void()> wake = {},
                       Upload upload = {});
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  /// Prepares `state` if it has an ROI and a handle. Does nothing if the selection, the parameters
  /// and the rest shape are those of the last call. Otherwise cancels the previous work. If the ROI
  /// is the same, the new preparation reuses the fill-reducing ordering and the symbolic analysis.
  void follow(const AppState& state);

  /// Sets the handles that the next drags move, in ascending order. The default is the first
  /// handle. If the response has no columns for some of these handles, the worker computes them
  /// before it computes any result.
  void drag_by(std::span<const std::size_t> handles);

  /// Requests the result for the moves of `state`. The worker computes it once the exact solver is
  /// ready. `follow` must have been called with `state`. The computation starts from the pose
  /// `from`. If `from` is null, it follows the path of the moves. A new request replaces the
  /// previous one.
  void settle(const AppState& state, std::shared_ptr<const DragState> from = nullptr);
  /// Returns the result once after it is computed; otherwise returns nullopt.
  std::optional<SettledResult> take_result();
  /// Returns true from the request of a result until the result is taken. Returns false if the
  /// request was cancelled or has failed.
  bool will_settle() const;

  /// Requests the live result for one frame of a drag. `state` has the moves of this frame. `from`
  /// is the last live pose or the pose of a settled state. The computation continues from `from`
  /// within the time budget kLiveBudgetMs, or kRestBudgetMs if the mouse `rests`. If `from` is
  /// null, it starts from the rest shape. If the parameters require substeps, it computes the
  /// complete result without a time budget. If the caller repeats the request until `is_done` is
  /// true, the result equals that of `settle` within the tolerance. Returns false and ignores the
  /// request if the solver is not ready, another result is being computed, or a result is waiting
  /// for `take_result` or `take_live_result`.
  bool settle_live(const AppState& state, std::shared_ptr<const DragState> from,
                   bool rests = false);
  /// Returns the live result once after it is computed; otherwise returns nullopt.
  std::optional<LiveResult> take_live_result();

  /// Cancels all requests, and discards results that the caller has not taken.
  void cancel_settling();
  /// Cancels all work and discards the preparation. The next `follow` prepares again.
  void cancel();
  /// Calls `cancel` and uses other kernels from then on. Call this after the device was lost.
  void use_kernels(MakeKernels make_kernels, Upload upload = {});

  PreparationStatus status() const;

  /// Return the prepared preview and solver, or null while they are not ready.
  std::shared_ptr<const DragPreview> preview() const;
  std::shared_ptr<const DeformSolver> exact() const;

  /// Returns the cached attachments of carried objects. Results and drags use the same cache.
  const std::shared_ptr<AttachmentCache>& attachment_cache() const { return attachment_cache_; }

  struct ToDragBy {
    std::shared_ptr<const DragResponse> response;
    std::shared_ptr<BlendResponse> on_device;  ///< null without Upload
    bool is_exact = false;                     ///< false if the preview computed the response
  };
  /// Returns the most accurate response that is ready. Its pointers are null if there is none.
  /// After `drag_by`, it is the response for the previous handles until the new columns are
  /// computed.
  ToDragBy drag_response() const;

 private:
  struct Ready {
    std::shared_ptr<const DragPreview> preview;
    std::shared_ptr<const DeformSolver> exact;
    std::shared_ptr<Kernels> exact_kernels;
    std::shared_ptr<DragSession> drag;  // used only by the worker; null if drags do not settle
    ToDragBy drag_by;
  };

  // Data that the next preparation on the same topology reuses.
  struct Kept {
    explicit Kept(std::shared_ptr<const Topology> of)
        : topology(std::move(of)), region(*topology) {}
    std::shared_ptr<const Topology> topology;
    PreparedRegion region;
  };

  struct Request {
    AppState state;
    std::uint64_t ticket = 0;
    bool is_live = false;
    std::shared_ptr<const DragState> from;  // the start pose, or null
    bool rests = false;                     // whether the mouse does not move
  };

  Worker::Work next();
  void prepare(const AppState& state, std::uint64_t ticket);
  bool has_columns() const;
  std::vector<std::size_t> dragged_of(std::size_t handle_count) const;
  ToDragBy response_of(const Ready& ready, std::span<const std::size_t> handles,
                       const Progress& progress) const;
  void respond(const Ready& ready, std::uint64_t ticket);
  void settle_now(const Request& request, const Ready& ready);
  LiveResult live_result(const Request& request, const Ready& ready, const Progress& progress);
  LiveResult follow_drag(const Request& request, DragSession& drag, const Progress& progress);
  std::shared_ptr<Kept> kept_for(const AppState& state, std::uint64_t ticket);
  bool publish(std::uint64_t ticket, Ready ready, PreparationStatus::Phase phase);
  void fail(std::uint64_t ticket, PreparationStatus::Phase phase, const std::string& message);
  Ready let_go();
  std::unique_ptr<Kernels> make_kernels() const;
  std::shared_ptr<BlendResponse> upload(const DragResponse& response) const;

  const std::shared_ptr<AttachmentCache> attachment_cache_ = std::make_shared<AttachmentCache>();

  // The worker's mutex guards the following members. The result of a computation is discarded if
  // its ticket is no longer the current one.
  MakeKernels make_kernels_;
  Upload upload_;
  std::uint64_t ticket_ = 0;
  std::uint64_t settle_ticket_ = 0;
  std::uint64_t wanted_ticket_ = 0;  // of the last request, cancelled if `settle_ticket_` differs
  std::optional<AppState> followed_;
  std::optional<AppState> to_prepare_;
  std::vector<std::size_t> dragged_{0};  // ascending
  std::optional<Request> to_settle_;
  std::optional<SettledResult> result_;
  std::optional<LiveResult> live_result_;
  PreparationStatus status_;
  std::shared_ptr<Kept> kept_;
  Ready ready_;

  std::shared_ptr<const DragState> last_live_;  // used only by the worker
  Worker worker_;                               // declared last, because it uses all other members
};

}  // namespace lapwing::viewer
