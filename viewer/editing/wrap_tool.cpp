#include "editing/wrap_tool.h"

#include <algorithm>
#include <utility>

#include "editing/kernels_like.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/wrap/nonrigid_icp.h"
#include "lapwing/wrap/surfels.h"

namespace lapwing::viewer {
namespace {

// Returns the mesh that displays the scan. A point cloud is displayed as surfels.
std::shared_ptr<const Mesh> read_scan(const std::filesystem::path& file) {
  Mesh mesh = read_mesh(file);
  if (mesh.face_count() == 0 && mesh.vertex_count() > 0) mesh = surfels_of(mesh, file.string());
  return open_state(std::move(mesh)).rest;
}

}  // namespace

WrapTool::WrapTool(UpAxis up_axis, const std::shared_ptr<gpu::Context>& context, Say say,
                   std::function<void()> wake)
    : up_axis_(up_axis),
      context_(context),
      say_(std::move(say)),
      preview_(kernels_like(context), wake),
      reader_(kernels_like(context), std::move(wake)) {}

void WrapTool::open_scan(Editor& editor, const std::filesystem::path& scan) {
  close(editor);
  scan_ = scan;
  template_ = base(editor).rest;
  is_reading_ = true;
  reader_.start([scan](const auto&, const Progress& progress) {
    const ProgressScope scope(progress);
    report_progress(progress, "read", 0.0);
    return read_scan(scan);
  });
  pick(true, editor);
  restore_closed();
}

// Takes the landmarks and settings of the closed wrap if it had the same scan, and a template with
// the same triangles.
void WrapTool::restore_closed() {
  if (closed_.scan != scan_ || !closed_.of->shares_faces_with(*template_)) return;
  settings = closed_.settings;
  if (!closed_.rows.empty()) set_landmarks(closed_.rows);
}

bool WrapTool::take_up(Editor& editor, std::size_t index) {
  const auto& steps = editor.state().steps;
  const auto* step = index < steps.size() ? std::get_if<WrapStep>(steps[index].get()) : nullptr;
  if (step == nullptr) return false;
  const WrapStep taken = *step;
  Revision revision = revision_of(editor.session().history(), index, taken);
  open_scan(editor, taken.scan);
  taken_up_ = index;
  settings = {taken.aligned, taken.hard, taken.mirror, taken.detail};
  edits_.assign(1, {});
  edit_ = 0;
  to_load_ = taken.landmarks;
  if (revision.starts_at_step()) start_ = std::move(revision.start);
  template_ = base(editor).rest;
  return true;
}

void WrapTool::close(Editor& editor) {
  if (is_open()) closed_ = {scan_, template_, edits_[edit_].rows, settings};
  drop_result(editor);
  pick(false, editor);
  reader_.cancel();
  is_reading_ = false;
  view_.reset();
  scan_.clear();
  taken_up_.reset();
  start_.reset();
  template_.reset();
  to_load_ = {};
  edits_.assign(1, {});
  edit_ = 0;
  settings = {};
}

void WrapTool::cancel(Editor& editor) {
  if (preview_.status().busy) return drop_result(editor);
  if (moved_ || on_scan_ || point_tool_.picked) return drop_half_pair();
  if (picks_) return pick(false, editor);
  close(editor);
}

void WrapTool::pick(bool on, Editor& editor) {
  picks_ = on;
  drop_half_pair();
  on ? editor.tool().lend(point_tool_) : editor.tool().give_back(point_tool_);
}

void WrapTool::drop_half_pair() {
  moved_.reset();
  on_scan_.reset();
  point_tool_.picked.reset();
}

void WrapTool::take_points(Editor& editor) {
  if (!is_open() || !view_) return;
  if (const auto point = view_->take_point()) {
    if (!picks_) pick(true, editor);
    on_scan_ = point->position;
  }
  std::vector<TargetRow> rows = edits_[edit_].rows;
  if (moved_) {
    if (point_tool_.picked) rows[*moved_].point = *point_tool_.picked;
    if (on_scan_) rows[*moved_].position = *on_scan_;
    if (!point_tool_.picked && !on_scan_) return;
  } else {
    if (!point_tool_.picked || !on_scan_) return;
    rows.push_back({*point_tool_.picked, *on_scan_});
  }
  drop_half_pair();
  set_landmarks(std::move(rows));
}

void WrapTool::set_landmarks(const LandmarkSpec& spec) {
  say_errors(say_, [&] {
    std::vector<std::string> notes;
    const LandmarkSpec read = with_rows(spec, {}, notes);
    for (const std::string& note : notes) say_({note, Tone::warning});
    drop_half_pair();
    set_landmarks(targets_of(read, *template_, *view_->state().rest).rows);
  });
}

void WrapTool::set_landmarks(std::vector<TargetRow> rows) {
  say_errors(say_, [&] {
    // A repeated row has no effect and gets no number.
    std::vector<TargetRow> distinct;
    for (const TargetRow& row : rows) {
      if (std::ranges::count(distinct, row) == 0) distinct.push_back(row);
    }
    std::vector<Target> points =
        resolve_targets({.rows = distinct, .where = "landmarks"},
                        resolve({AllVertices{}}, *template_), {}, *template_);
    edits_.resize(++edit_);
    edits_.push_back({std::move(distinct), std::move(points)});
  });
}

void WrapTool::remove(std::size_t landmark) {
  drop_half_pair();
  Landmarks left = edits_[edit_];
  left.rows.erase(left.rows.begin() + static_cast<std::ptrdiff_t>(landmark));
  set_landmarks(std::move(left.rows));
}

void WrapTool::move(Editor& editor, std::size_t landmark) {
  pick(true, editor);
  moved_ = landmark;
}

bool WrapTool::undo() {
  if (moved_ || on_scan_ || point_tool_.picked) {
    drop_half_pair();
    return true;
  }
  if (edit_ == 0) return false;
  --edit_;
  return true;
}

bool WrapTool::redo() {
  if (edit_ + 1 == edits_.size()) return false;
  drop_half_pair();
  ++edit_;
  return true;
}

void WrapTool::load_landmarks(std::filesystem::path file, std::filesystem::path scan_file) {
  to_load_ = {.file = std::move(file), .scan_file = std::move(scan_file)};
}

void WrapTool::save_landmarks(const std::filesystem::path& file) {
  say_errors(say_, [&] { write_landmarks(edits_[edit_].rows, *template_, file); });
}

WrapStep WrapTool::step(const Editor& editor) const {
  WrapStep step{.scan = scan_,
                .aligned = settings.aligned,
                .stiffness = editor.state().selection.stiffness,
                .hard = settings.hard,
                .mirror = settings.mirror,
                .detail = settings.detail};
  for (const TargetRow& row : edits_[edit_].rows) {
    step.landmarks.rows.push_back({row.point, row.position, row.weight});
  }
  return step;
}

void WrapTool::wrap(const Editor& editor) {
  preview_.stop();
  step_ = step(editor);
  rest_.reset();
}

void WrapTool::start(const Editor& editor) {
  const AppState& state = base(editor);
  if (!step_ || rest_ || needs_settling(editor.state()) || editor.tool().is_dragging()) return;
  rest_ = editor.state().rest;
  settled_ = editor.state().settled;
  reaches_ = reaches_of(template_->positions,
                        mean_edge_length(template_->topology().rings, template_->positions));
  const double diagonal = bounds_of(template_->positions).diagonal();
  for (double& reach : reaches_) reach /= diagonal;
  preview_.start(state, *step_);
}

const WrapStepReport* WrapTool::report() const {
  const CarriedOut* result = preview_.result();
  return result != nullptr && result->report.wrap ? &*result->report.wrap : nullptr;
}

void WrapTool::drop_result(Editor& editor) {
  if (step_) editor.view().shown().end_preview();
  preview_.stop();
  step_.reset();
  rest_.reset();
}

void WrapTool::show(Editor& editor) {
  ShownSurface& shown = editor.view().shown();
  if (report() == nullptr) return shown.end_preview();
  const AppState& state = base(editor);
  Positions positions = positions_of(state);
  place(std::get<MovedVertices>(*preview_.result()->result), positions);
  // If the result has the triangles of the state, the user can also pick points on it.
  const bool is_of_state = state.rest->shares_faces_with(*editor.state().rest);
  shown.show_preview(surface_of(is_of_state ? editor.state() : state));
  shown.show_preview(positions);
  show_colors(editor);
}

void WrapTool::show_colors(Editor& editor) {
  const WrapStepReport* result = report();
  if (result == nullptr) return;
  std::vector<float> percent;
  if (colors_by_distance) percent = result->distances;
  for (float& distance : percent) {
    distance *= static_cast<float>(100.0 / result->scan_diagonal);
  }
  editor.view().shown().color_by(std::move(percent));
  editor.view().shown().renew_measure();
}

void WrapTool::apply(Editor& editor) {
  if (report() == nullptr || !is_current(editor)) return;
  const Apply applied{*step_, preview_.result()->result};
  const auto index = taken_up_;
  close(editor);
  if (index) {
    editor.actions().replace_step(*index, applied.step);
  } else {
    editor.actions().perform(applied);
  }
  editor.tool().begin_choosing({Part::Role::roi});
}

void WrapTool::take_read() {
  if (!is_reading_) return;
  std::optional<std::shared_ptr<const Mesh>> mesh;
  if (say_errors(say_, [&] { mesh = reader_.take(); }) && !mesh) return;
  is_reading_ = false;
  if (!mesh) return;
  view_ = std::make_unique<SourceView>(*std::move(mesh), up_axis_, context_);
  view_->take(SourceTool::point);
}

void WrapTool::update(Editor& editor) {
  if (!is_open()) return;
  take_read();
  // The user has undone or changed the edit.
  const AppState& now = editor.state();
  if (!base(editor).rest->shares_faces_with(*template_)) return close(editor);
  template_ = base(editor).rest;
  if (picks_ && !editor.tool().is(point_tool_)) pick(false, editor);
  if (view_) {
    view_->update();
    if (!to_load_.empty()) set_landmarks(std::exchange(to_load_, {}));
  }
  if (rest_ && (now.rest != rest_ || now.settled != settled_)) drop_result(editor);
  start(editor);
  const bool has_changed = preview_.update();
  if (has_changed || (report() != nullptr && !editor.view().shown().previews())) show(editor);
}

void WrapTool::release_device() {
  if (view_) view_->release_device();
  preview_.stop();
  rest_.reset();
}

void WrapTool::use_device(const std::shared_ptr<gpu::Context>& context) {
  context_ = context;
  if (view_) view_->use_device(context);
  preview_.use_kernels(kernels_like(context));
  reader_.use_kernels(kernels_like(context));
}

}  // namespace lapwing::viewer
