#include "editing/detail_transfer_tool.h"

#include <utility>

#include "editing/kernels_like.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing::viewer {
namespace {

// Shows a painted field in the colours of parts, from none to all, on its patch.
std::vector<VertexClass> classes_of(const std::vector<double>& field, const VertexSet& patch) {
  std::vector<VertexClass> classes(field.size(), VertexClass::outside);
  for (const Index v : patch) {
    if (v < classes.size()) classes[v] = VertexClass::roi;
  }
  for (std::size_t v = 0; v < field.size(); ++v) {
    if (field[v] >= 0.25) classes[v] = VertexClass::belt;
    if (field[v] >= 0.75) classes[v] = VertexClass::handle;
  }
  return classes;
}

}  // namespace

ToolAnswer PointTool::handle(const InputEvent& event, const ToolScene& scene) {
  if (event.kind != InputKind::press || event.button != MouseButton::left) return {};
  const auto point = scene.pick(event.position);
  if (!point) return ToolAnswer::passed_on();
  picked = point->vertex;
  return ToolAnswer::only_taken();
}

DetailTransferTool::DetailTransferTool(UpAxis up_axis, const std::shared_ptr<gpu::Context>& context,
                                       Say say, std::function<void()> wake)
    : up_axis_(up_axis),
      context_(context),
      say_(std::move(say)),
      preview_(kernels_like(context), wake),
      reader_(kernels_like(context), std::move(wake)) {}

void DetailTransferTool::begin(Editor& editor, LayerDraft::Operation operation) {
  if (is_open_) close(editor);
  draft_ = {};
  draft_.operation = operation;
  if (operation == LayerDraft::Operation::mix) draft_.parameters.domain = Domain::square;
  taken_up_.reset();
  start_.reset();
  current_ = 0;
  weight_paint_.set_field({});
  seen_roi_ = {ListedVertices{}};
  lies_on_target_ = is_to_place_ = false;
  is_open_ = true;
}

bool DetailTransferTool::take_up(Editor& editor, std::size_t index) {
  const auto& steps = editor.state().steps;
  if (index >= steps.size()) return false;
  const auto draft = layer_draft_of(*steps[index]);
  if (!draft) return false;
  begin(editor, draft->operation);
  draft_ = *draft;
  taken_up_ = index;
  Revision revision = revision_of(editor.session().history(), index, *steps[index]);
  if (revision.starts_at_step()) start_ = std::move(revision.start);
  seen_roi_ = spec_of(editor.state().selection.roi, "target patch");
  for (std::size_t k = 0; k < draft_.source_count(); ++k) {
    is_to_read_[k] = !draft_.sources[k].mesh.empty();
  }
  return true;
}

void DetailTransferTool::close(Editor& editor) {
  is_open_ = false;
  applies_ = false;
  pick(Picking::none, editor);
  paint_weight(false, editor);
  preview_.stop();
  reader_.cancel();
  reading_.reset();
  is_to_read_ = {};
  for (auto& view : views_) view.reset();
  start_.reset();
  committed_.reset();
  committed_from_.reset();
  previewed_.reset();
  editor.view().shown().end_preview();
}

void DetailTransferTool::cancel(Editor& editor) {
  if (picking_ != Picking::none) return pick(Picking::none, editor);
  if (is_painting_) return paint_weight(false, editor);
  if (editor.session().is_carrying_out()) return editor.session().cancel_step();
  close(editor);
}

void DetailTransferTool::use_source(std::size_t k, const std::filesystem::path& mesh,
                                    bool lies_on_target) {
  if (k == 0) lies_on_target_ = is_to_place_ = lies_on_target;
  draft_.sources[k] = LayerDraft::nothing();
  draft_.sources[k].mesh = mesh;
  if (reading_ == k) {
    reader_.cancel();
    reading_.reset();
  }
  views_[k].reset();
  is_to_read_[k] = !mesh.empty();
}

void DetailTransferTool::release_device() {
  for (auto& view : views_) {
    if (view) view->release_device();
  }
  preview_.stop();
  previewed_.reset();
}

void DetailTransferTool::use_device(const std::shared_ptr<gpu::Context>& context) {
  context_ = context;
  for (auto& view : views_) {
    if (view) view->use_device(context);
  }
  preview_.use_kernels(kernels_like(context));
  reader_.use_kernels(kernels_like(context));
}

void DetailTransferTool::choose_source_patch(const RegionSpec& region) {
  if (view() == nullptr) return;
  say_errors(say_, [&] { view()->choose_patch(region); });
}

// If a step is edited again, its target may have other triangles than the present mesh.
bool DetailTransferTool::can_click_target(const Editor& editor) const {
  if (!start_ || start_->rest->shares_faces_with(*editor.state().rest)) return true;
  say_("This step changed the triangles of the target. Undo it before you click on the target.");
  return false;
}

void DetailTransferTool::paint_weight(bool on, Editor& editor) {
  if (on && !can_click_target(editor)) return;
  is_painting_ = on;
  if (on) {
    pick(Picking::none, editor);
    editor.tool().lend(weight_paint_);
  } else {
    editor.tool().give_back(weight_paint_);
    editor.view().shown().end_preview();
    previewed_.reset();
  }
}

void DetailTransferTool::pick(Picking what, Editor& editor) {
  if (what != Picking::none && !can_click_target(editor)) return;
  if (what != Picking::none && is_painting_) paint_weight(false, editor);
  take_what_was_done(editor);
  picking_ = what;
  picked_source_.reset();
  point_tool_.picked.reset();
  const bool picks = what != Picking::none;
  for (auto& view : views_) {
    if (view) view->take(picks ? SourceTool::point : SourceTool::disk);
  }
  if (picks) {
    editor.tool().lend(point_tool_);
  } else {
    editor.tool().give_back(point_tool_);
  }
}

// Returns the mesh to which the step will be applied: the settled surface if there is a result,
// otherwise the rest shape. Returns the same pointer until the user edits the surface, because a
// new pointer restarts the views and the preview.
std::shared_ptr<const Mesh> DetailTransferTool::target_of(const Editor& editor) {
  if (start_) return start_->rest;
  const AppState& now = editor.state();
  if (!now.settled) return now.rest;
  if (committed_from_ != now.settled) {
    committed_ = viewer::apply(now, Commit{}).rest;
    committed_from_ = now.settled;
  }
  return committed_;
}

void DetailTransferTool::update(Editor& editor) {
  if (!is_open_) return;
  if (applies_) {
    // If the step failed, the user may change it and apply it again.
    if (editor.session().is_carrying_out()) return;
    applies_ = false;
    if (editor.state().steps != steps_before_) {
      close(editor);
      editor.tool().begin_choosing({Part::Role::roi});
      return;
    }
  }
  // The user has taken another tool.
  if (is_painting_ && !editor.tool().is(weight_paint_)) paint_weight(false, editor);
  if (picking_ != Picking::none && !editor.tool().is(point_tool_)) pick(Picking::none, editor);
  take_read();
  read_next();
  if (needs_settling(editor.state())) return;
  const std::shared_ptr<const Mesh> target = target_of(editor);
  renew_own_views(target);
  take_what_was_done(editor);
  if (view() != nullptr) view()->update();
  if (is_to_place_) place_source(editor);
  take_weight(*target);
  if (is_painting_) return show_weight(editor, target);
  const bool wanted = wants_preview(editor);
  if (wanted) preview_.follow(target, draft_);
  if (preview_.update() || wanted != editor.view().shown().previews()) show_preview(editor);
}

// A user who chooses or picks must see the mesh without the preview.
bool DetailTransferTool::wants_preview(const Editor& editor) const {
  return previews_ && picking_ == Picking::none && !editor.tool().is_dragging();
}

// Replaces a field that belongs to another mesh.
void DetailTransferTool::take_weight(const Mesh& target) {
  auto* painted = std::get_if<PaintedWeight>(&draft_.weight.form);
  if (painted == nullptr) return;
  const std::size_t count = target.vertex_count();
  if (weight_paint_.field().size() != count) {
    weight_paint_.set_field(painted->field.size() == count ? painted->field
                                                           : std::vector<double>(count, 0.0));
  }
  if (painted->field != weight_paint_.field()) painted->field = weight_paint_.field();
}

void DetailTransferTool::show_weight(Editor& editor, const std::shared_ptr<const Mesh>& target) {
  previewed_.reset();
  editor.view().shown().show_preview(
      target, classes_of(weight_paint_.live_field(), editor.state().selection.roi.vertices));
}

void DetailTransferTool::take_read() {
  if (!reading_) return;
  std::optional<std::shared_ptr<const Mesh>> mesh;
  if (say_errors(say_, [&] { mesh = reader_.take(); }) && !mesh) return;
  const std::size_t k = *std::exchange(reading_, std::nullopt);
  if (mesh) say_errors(say_, [&] { show_source(k, *std::move(mesh)); });
}

void DetailTransferTool::show_source(std::size_t k, std::shared_ptr<const Mesh> mesh) {
  views_[k] = std::make_unique<SourceView>(std::move(mesh), up_axis_, context_);
  if (picking_ != Picking::none) views_[k]->take(SourceTool::point);
  const RegionSpec& patch = draft_.sources[k].patch;
  if (is_chosen(patch)) say_errors(say_, [&] { views_[k]->choose_patch(patch); });
}

void DetailTransferTool::read_next() {
  if (reading_) return;
  for (std::size_t k = 0; k < draft_.source_count(); ++k) {
    if (!std::exchange(is_to_read_[k], false)) continue;
    reading_ = k;
    reader_.start([path = draft_.sources[k].mesh](const auto&, const Progress& progress) {
      report_progress(progress, "read", 0.0);
      return open_state(read_mesh(path)).rest;
    });
    return;
  }
}

// A source without a file shows the edited mesh as it is.
void DetailTransferTool::renew_own_views(const std::shared_ptr<const Mesh>& target) {
  for (std::size_t k = 0; k < draft_.source_count(); ++k) {
    if (!draft_.sources[k].mesh.empty() || reading_ == k) continue;
    if (views_[k] && views_[k]->state().rest == target) continue;
    show_source(k, target);
  }
}

// Takes what was chosen since the last frame or key.
void DetailTransferTool::take_what_was_done(const Editor& editor) {
  if (!is_open_) return;
  take_patches(editor);
  take_points(editor);
}

void DetailTransferTool::take_patches(const Editor& editor) {
  for (std::size_t k = 0; k < draft_.source_count(); ++k) {
    if (!views_[k]) continue;
    CoatSource& source = draft_.sources[k];
    RegionSpec patch = spec_of(views_[k]->patch(), "source patch");
    if (patch == source.patch) continue;
    source.patch = std::move(patch);
    source.inner_pairs.clear();
    source.boundary_pairs.clear();
    const AppState& state = views_[k]->state();
    if (source.detail_size == 0.0) {
      source.detail_size = usual_detail_size(views_[k]->patch().vertices, *state.rest);
    }
  }
  RegionSpec roi = spec_of(editor.state().selection.roi, "target patch");
  if (roi == seen_roi_) return;
  seen_roi_ = roi;
  // Keep the patch if the ROI was cleared, perhaps because the triangles have changed.
  if (!is_chosen(roi)) return;
  draft_.target_patch = std::move(roi);
  is_to_place_ = lies_on_target_;
  for (CoatSource& source : draft_.sources) {
    source.inner_pairs.clear();
    source.boundary_pairs.clear();
  }
}

// Takes the part of the source that lies on the target patch.
void DetailTransferTool::place_source(const Editor& editor) {
  if (!views_[0] || !is_chosen(draft_.target_patch)) return;
  is_to_place_ = false;
  say_errors(say_, [&] {
    const std::shared_ptr<const Mesh> target = target_of(editor);
    const VertexSet patch = resolve(draft_.target_patch, *target);
    const Mesh& source = *views_[0]->state().rest;
    views_[0]->choose_patch(patch_on(source, *target, patch));
    take_patches(editor);
    draft_.sources[0].inner_pairs = pairs_on(source, views_[0]->patch().vertices, *target, patch);
  });
}

void DetailTransferTool::take_points(const Editor& editor) {
  if (picking_ == Picking::none || view() == nullptr) return;
  if (const auto point = view()->take_point()) picked_source_ = point->vertex;
  if (!picked_source_ || !point_tool_.picked) return;
  say_errors(say_, [&] { add_pair(editor); });
  picked_source_.reset();
  point_tool_.picked.reset();
}

void DetailTransferTool::add_pair(const Editor& editor) {
  const std::shared_ptr<const Mesh> target = target_of(editor);
  CoatSource& source = draft_.sources[current_];
  VertexPair pair{*picked_source_, *point_tool_.picked};
  if (picking_ == Picking::inside) {
    source.inner_pairs.push_back(pair);
    return;
  }
  const AppState& from = view()->state();
  pair[0] = nearest_on_border(pair[0], view()->patch().vertices, *from.rest);
  pair[1] = nearest_on_border(pair[1], resolve(draft_.target_patch, *target), *target);
  // The domain has so many pins; another pair starts over.
  if (source.boundary_pairs.size() >= pin_count(draft_.parameters.domain)) {
    source.boundary_pairs.clear();
  }
  source.boundary_pairs.push_back(pair);
}

void DetailTransferTool::show_preview(Editor& editor) {
  if (!wants_preview(editor) || !preview_.has_result()) {
    if (std::exchange(previewed_, nullptr)) editor.view().shown().end_preview();
    return;
  }
  const auto mesh = preview_.mesh();
  if (!previewed_ || !previewed_->shares_faces_with(*mesh) || !editor.view().shown().previews()) {
    editor.view().shown().show_preview(mesh);
    previewed_ = mesh;
  }
  editor.view().shown().show_preview(preview_.positions());
}

void DetailTransferTool::apply(Editor& editor) {
  take_what_was_done(editor);
  Step step;
  if (!say_errors(say_, [&] { step = step_of(draft_); })) return;
  say_({"", Tone::error});
  if (taken_up_) {
    editor.actions().replace_step(*taken_up_, step);
  } else {
    editor.actions().carry_out(step);
  }
  steps_before_ = editor.state().steps;
  applies_ = editor.session().is_carrying_out();
}

}  // namespace lapwing::viewer
