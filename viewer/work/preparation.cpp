#include "work/preparation.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lapwing/base/errors.h"
#include "state/waypoints.h"

namespace lapwing::viewer {
namespace {

using Phase = PreparationStatus::Phase;

constexpr std::array<std::string_view, 11> kStages{
    "pattern", "constraints",   "order",  "laplacian", "preview", "assemble",
    "analyze", "normal_matrix", "factor", "shares",    "response"};

// All stages count equally, because their relative times depend on the mesh and the device.
double fraction_of_preparation(std::string_view stage, double fraction) {
  const auto found = std::ranges::find(kStages, stage);
  if (found == kStages.end()) return 1.0;
  return (static_cast<double>(found - kStages.begin()) + fraction) / kStages.size();
}

// Returns whether each frame of a drag can settle. This is not possible with substeps.
bool settles_frames(const AppState& state) {
  return state.parameters.settle && !uses_substeps(state.parameters, state.moves);
}

Bounds bounds_at(const DragState& pose, std::span<const Index> vertices, const Positions& rest) {
  Positions places;
  places.reserve(vertices.size());
  for (const Index v : vertices) places.push_back(rest[v] + pose.displacement[v]);
  return bounds_of(places);
}

bool can_be_prepared(const AppState& state) {
  return !state.selection.roi.vertices.empty() && !state.selection.handles.empty();
}

bool same_preparation(const AppState& a, const AppState& b) {
  return a.rest == b.rest && a.parameters == b.parameters && a.selection == b.selection;
}

}  // namespace

Preparation::Preparation(MakeKernels make_kernels, std::function<void()> wake, Upload upload)
    : make_kernels_(std::move(make_kernels)),
      upload_(std::move(upload)),
      worker_([this] { return next(); }, std::move(wake)) {}

Preparation::~Preparation() {
  const std::lock_guard lock(worker_.mutex());
  ++ticket_;
  ++settle_ticket_;
}

// Cancels all work, clears the results and returns the previous `ready_`. The caller should destroy
// it after releasing the lock, because freeing large factors takes time.
Preparation::Ready Preparation::let_go() {
  ++ticket_;
  ++settle_ticket_;
  to_prepare_.reset();
  to_settle_.reset();
  result_.reset();
  live_result_.reset();
  status_ = {};
  return std::exchange(ready_, {});
}

void Preparation::follow(const AppState& state) {
  Ready old;
  {
    const std::lock_guard lock(worker_.mutex());
    if (followed_ && same_preparation(*followed_, state)) return;
    old = let_go();
    followed_ = state;
    if (can_be_prepared(state)) {
      to_prepare_ = state;
      status_.phase = Phase::previewing;
    }
  }
  worker_.notify();
}

void Preparation::drag_by(std::span<const std::size_t> handles) {
  {
    const std::lock_guard lock(worker_.mutex());
    if (std::ranges::equal(dragged_, handles)) return;
    dragged_.assign(handles.begin(), handles.end());
    if (!ready_.exact || has_columns()) return;
  }
  worker_.notify();
}

// Returns the handles of the next drags without indices that are out of range. Returns the first
// handle if no index remains.
std::vector<std::size_t> Preparation::dragged_of(std::size_t handle_count) const {
  std::vector<std::size_t> handles = dragged_;
  std::erase_if(handles, [&](std::size_t h) { return h >= handle_count; });
  if (handles.empty()) handles.push_back(0);
  return handles;
}

// Returns whether the current response has columns for all handles of the next drags. The caller
// must hold the lock.
bool Preparation::has_columns() const {
  const std::vector<std::size_t>& there = ready_.drag_by.response->handles();
  const std::size_t handle_count = ready_.exact->region().handles.size();
  return std::ranges::all_of(dragged_, [&](std::size_t h) {
    return h >= handle_count || std::ranges::binary_search(there, h);
  });
}

void Preparation::settle(const AppState& state, std::shared_ptr<const DragState> from) {
  {
    const std::lock_guard lock(worker_.mutex());
    result_.reset();
    live_result_.reset();
    to_settle_ = Request{state, wanted_ticket_ = ++settle_ticket_, false, std::move(from)};
    if (status_.phase == Phase::ready) status_.phase = Phase::settling;
  }
  worker_.notify();
}

bool Preparation::will_settle() const {
  const std::lock_guard lock(worker_.mutex());
  // After a cancellation, the phase remains `settling` until the worker has stopped.
  const bool is_wanted = wanted_ticket_ == settle_ticket_;
  const bool is_under_way = to_settle_ || result_ || status_.phase == Phase::settling;
  return is_wanted && is_under_way && status_.phase != Phase::failed &&
         status_.phase != Phase::idle;
}

std::optional<SettledResult> Preparation::take_result() {
  const std::lock_guard lock(worker_.mutex());
  return std::exchange(result_, std::nullopt);
}

bool Preparation::settle_live(const AppState& state, std::shared_ptr<const DragState> from,
                              bool rests) {
  {
    const std::lock_guard lock(worker_.mutex());
    if (status_.phase != Phase::ready || result_ || live_result_) return false;
    to_settle_ = Request{state, wanted_ticket_ = ++settle_ticket_, true, std::move(from), rests};
    status_.phase = Phase::settling;
  }
  worker_.notify();
  return true;
}

std::optional<LiveResult> Preparation::take_live_result() {
  const std::lock_guard lock(worker_.mutex());
  return std::exchange(live_result_, std::nullopt);
}

void Preparation::cancel_settling() {
  const std::lock_guard lock(worker_.mutex());
  ++settle_ticket_;
  result_.reset();
  live_result_.reset();
  // In phase `settling`, the worker discards the request and updates the status.
  if (status_.phase != Phase::settling) to_settle_.reset();
}

void Preparation::cancel() {
  Ready old;
  std::shared_ptr<Kept> kept;
  const std::lock_guard lock(worker_.mutex());
  old = let_go();
  kept = std::exchange(kept_, nullptr);
  followed_.reset();
}

PreparationStatus Preparation::status() const {
  const std::lock_guard lock(worker_.mutex());
  return status_;
}

std::shared_ptr<const DragPreview> Preparation::preview() const {
  const std::lock_guard lock(worker_.mutex());
  return ready_.preview;
}

std::shared_ptr<const DeformSolver> Preparation::exact() const {
  const std::lock_guard lock(worker_.mutex());
  return ready_.exact;
}

Preparation::ToDragBy Preparation::drag_response() const {
  const std::lock_guard lock(worker_.mutex());
  return ready_.drag_by;
}

void Preparation::use_kernels(MakeKernels make_kernels, Upload upload) {
  cancel();
  const std::lock_guard lock(worker_.mutex());
  make_kernels_ = std::move(make_kernels);
  upload_ = std::move(upload);
}

std::unique_ptr<Kernels> Preparation::make_kernels() const {
  std::unique_lock lock(worker_.mutex());
  const MakeKernels make = make_kernels_;
  lock.unlock();
  return make();
}

std::shared_ptr<BlendResponse> Preparation::upload(const DragResponse& response) const {
  std::unique_lock lock(worker_.mutex());
  const Upload upload = upload_;
  lock.unlock();
  return upload ? upload(response) : nullptr;
}

Worker::Work Preparation::next() {
  if (to_prepare_) {
    return [this, state = *std::exchange(to_prepare_, std::nullopt), ticket = ticket_] {
      prepare(state, ticket);
    };
  }
  if (!ready_.exact) return {};
  if (!has_columns()) {
    return [this, ready = ready_, ticket = ticket_] { respond(ready, ticket); };
  }
  if (!to_settle_) return {};
  return [this, request = *std::exchange(to_settle_, std::nullopt), ready = ready_] {
    settle_now(request, ready);
  };
}

void Preparation::prepare(const AppState& state, std::uint64_t ticket) {
  const Progress progress =
      worker_.progress(ticket_, ticket, [this](std::string_view stage, double fraction) {
        status_.stage = stage;
        status_.fraction = std::max(status_.fraction, fraction_of_preparation(stage, fraction));
      });
  last_live_.reset();
  try {
    Ready ready;
    const std::shared_ptr<Kept> kept = kept_for(state, ticket);
    EditRegion region = edit_region(state);
    const auto dragged = [&, count = region.handles.size()] {
      const std::lock_guard lock(worker_.mutex());
      return dragged_of(count);
    };
    ready.preview = std::shared_ptr<const DragPreview>(
        new DragPreview(kept->region, state.rest->positions, std::move(region), state.parameters,
                        dragged(), progress),
        [topology = surface_of(state)->shared_topology()](DragPreview* p) { delete p; });
    ready.drag_by = {ready.preview->response(), upload(*ready.preview->response()), false};
    if (!publish(ticket, ready, Phase::solving)) return;
    ready.exact_kernels = make_kernels();
    // The deleter owns the kernels and the topology, because they must outlive the solver.
    ready.exact = std::shared_ptr<const DeformSolver>(
        new DeformSolver(*ready.preview, *ready.exact_kernels, progress),
        [kernels = ready.exact_kernels,
         topology = surface_of(state)->shared_topology()](DeformSolver* d) { delete d; });
    if (settles_frames(state)) {
      ready.drag = std::make_shared<DragSession>(ready.exact);
    } else {
      ready.drag_by = response_of(ready, dragged(), progress);
    }
    if (!publish(ticket, ready, Phase::ready)) return;
    // Prepare the drag session now, because otherwise the first drag would wait for it.
    if (ready.drag) ready.drag->prepare();
  } catch (const Cancelled&) {
    // The call that cancelled the work has already set the status.
  } catch (const std::exception& error) {
    fail(ticket, Phase::failed, error.what());
  }
}

Preparation::ToDragBy Preparation::response_of(const Ready& ready,
                                               std::span<const std::size_t> handles,
                                               const Progress& progress) const {
  std::shared_ptr<const DragResponse> response = ready.drag
                                                     ? ready.preview->response_of(handles)
                                                     : ready.exact->response_of(handles, progress);
  std::shared_ptr<BlendResponse> on_device = upload(*response);
  const bool is_exact = !ready.drag && response->why_not_exact().empty();
  return {std::move(response), std::move(on_device), is_exact};
}

// Computes the response for the handles of the next drags.
void Preparation::respond(const Ready& ready, std::uint64_t ticket) {
  const Progress progress = worker_.progress(
      ticket_, ticket, [](std::string_view, double) {}, false);
  try {
    std::vector<std::size_t> handles;
    {
      const std::lock_guard lock(worker_.mutex());
      handles = dragged_of(ready.exact->region().handles.size());
    }
    ToDragBy drag_by = response_of(ready, handles, progress);
    const std::lock_guard lock(worker_.mutex());
    if (ticket_ == ticket) ready_.drag_by = std::move(drag_by);
  } catch (const Cancelled&) {
    // The call that cancelled the work has already set the status.
  } catch (const std::exception& error) {
    fail(ticket, Phase::failed, error.what());
    // Restore the handles of the old response, so that the worker does not repeat the failure.
    const std::lock_guard lock(worker_.mutex());
    if (ticket_ == ticket) dragged_ = ready.drag_by.response->handles();
  }
}

// Returns the data to reuse for the topology of `state`. Throws Cancelled if the request with
// `ticket` is no longer current.
std::shared_ptr<Preparation::Kept> Preparation::kept_for(const AppState& state,
                                                         std::uint64_t ticket) {
  std::shared_ptr<Kept> before;
  const std::lock_guard lock(worker_.mutex());
  if (ticket_ != ticket) throw Cancelled();
  const auto topology = surface_of(state)->shared_topology();
  if (kept_ == nullptr || kept_->topology != topology) {
    before = std::exchange(kept_, std::make_shared<Kept>(topology));
  }
  return kept_;
}

bool Preparation::publish(std::uint64_t ticket, Ready ready, Phase phase) {
  {
    const std::lock_guard lock(worker_.mutex());
    if (ticket_ != ticket) return false;
    ready_ = std::move(ready);
    // If a result is already requested, skip the phase `ready`.
    status_.phase = phase == Phase::ready && to_settle_ ? Phase::settling : phase;
    if (phase == Phase::ready) status_.fraction = 1.0;
  }
  worker_.wake();
  return true;
}

void Preparation::fail(std::uint64_t ticket, Phase phase, const std::string& message) {
  const std::lock_guard lock(worker_.mutex());
  if (ticket_ != ticket) return;
  status_.phase = phase;
  status_.message = message;
}

void Preparation::settle_now(const Request& request, const Ready& ready) {
  // A live result is computed in milliseconds and needs no progress bar.
  const Progress progress = worker_.progress(
      settle_ticket_, request.ticket,
      [this](std::string_view stage, double fraction) {
        status_.stage = stage;
        status_.fraction = fraction;
      },
      !request.is_live);
  const AppState& state = request.state;
  std::optional<SettledResult> result;
  std::optional<LiveResult> live;
  std::string message;
  try {
    if (request.is_live) {
      live = live_result(request, ready, progress);
    } else {
      if (ready.drag) ready.drag->release_memory();
      result = settled_result(state, request.from.get(), *ready.exact, *ready.exact_kernels,
                              *attachment_cache_, progress);
    }
  } catch (const Cancelled&) {
    // `result` and `live` remain empty.
  } catch (const std::exception& error) {
    message = error.what();
    // The live result is marked as done, because the same request would fail again.
    if (request.is_live) live = LiveResult{state.moves, request.from, true};
  }
  if (live && live->pose) {
    live->bounds =
        bounds_at(*live->pose, ready.drag_by.response->columns().moving, state.rest->positions);
  }
  const std::lock_guard lock(worker_.mutex());
  if (ready_.exact != ready.exact) return;  // another preparation has begun
  status_.phase = to_settle_ ? Phase::settling : Phase::ready;
  if (settle_ticket_ != request.ticket) return;
  status_.message = message;
  live_result_ = std::move(live);
  result_ = std::move(result);
}

LiveResult Preparation::live_result(const Request& request, const Ready& ready,
                                    const Progress& progress) {
  AppState state = request.state;
  // During a drag, AttachmentFollower moves the carried objects instead.
  state.carried.clear();
  if (ready.drag && settles_frames(state)) return follow_drag(request, *ready.drag, progress);
  state.settled = settled_result(state, request.from.get(), *ready.exact, *ready.exact_kernels,
                                 *attachment_cache_, progress)
                      .moved;
  return {state.moves,
          std::make_shared<const DragState>(
              ready.drag_by.response->pose_at(positions_of(state), motions_of(state))),
          true};
}

LiveResult Preparation::follow_drag(const Request& request, DragSession& drag,
                                    const Progress& progress) {
  if (request.from == nullptr || request.from != last_live_) {
    drag.begin(request.from ? *request.from : DragState());
  }
  const Stopwatch watch;
  const double budget = request.rests ? kRestBudgetMs : kLiveBudgetMs;
  const auto go_on = [&](double ms) { return ms == 0.0 || watch.elapsed_ms() + ms < budget; };
  const DragState& pose = drag.step(motions_of(request.state), go_on, progress);
  const bool is_done = pose.last_result.settled || pose.last_result.exhausted;
  last_live_ = std::make_shared<const DragState>(pose);
  return {request.state.moves, last_live_, is_done};
}

}  // namespace lapwing::viewer
