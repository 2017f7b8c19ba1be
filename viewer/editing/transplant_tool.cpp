#include "editing/transplant_tool.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "editing/kernels_like.h"
#include "files/path_text.h"
#include "lapwing/transplant/join_attributes.h"
#include "state/revision.h"

namespace lapwing::viewer {
namespace {

using Stage = PlaceTool::Stage;

// Puts both into one mesh as they are, in the colours of the result.
Mesh side_by_side(const Mesh& host, const Mesh& part) {
  Mesh both;
  both.positions = host.positions;
  both.positions.insert(both.positions.end(), part.positions.begin(), part.positions.end());
  Faces& faces = both.edit_faces();
  faces = host.faces();
  const auto first_vertex = static_cast<Index>(host.vertex_count());
  const auto first_corner = static_cast<Index>(host.face_vertices().size());
  for (const Index v : part.face_vertices()) faces.vertices.push_back(first_vertex + v);
  for (std::size_t f = 1; f < part.face_starts().size(); ++f) {
    faces.starts.push_back(first_corner + part.face_starts()[f]);
  }
  std::vector<Index> all_of_part(part.vertex_count());
  std::iota(all_of_part.begin(), all_of_part.end(), 0U);
  std::vector<std::string> said_with_the_result;
  both.edit_attributes() =
      join_attributes({host, part, std::move(all_of_part), {}}, {}, said_with_the_result);
  return both;
}

// Shows the part in the colour of the ROI.
std::vector<VertexClass> classes_of(std::size_t host_vertices, std::size_t all) {
  std::vector<VertexClass> classes(all, VertexClass::roi);
  std::fill_n(classes.begin(), host_vertices, VertexClass::outside);
  return classes;
}

AppState surface_now(const AppState& now, Kernels&, const Progress&) {
  return apply(now, Commit{});
}

// Returns the state before the step that is edited again.
AppState start_of(const Revision& revision, Kernels& kernels, const Progress& progress) {
  History history(revision.start);
  for (std::size_t k = 0; k < revision.changed; ++k) {
    perform(history, revision.rest.steps[k], carry_out_with(kernels, progress));
  }
  return apply(history.state(), Commit{});
}

}  // namespace

TransplantTool::TransplantTool(const std::shared_ptr<gpu::Context>& context, Say say,
                               std::function<void()> wake)
    : say_(std::move(say)),
      library_(context, kernels_like(context), wake),
      preview_(kernels_like(context), wake),
      reader_(kernels_like(context), std::move(wake)) {
  library_.open(parts_folder());
}

void TransplantTool::take_part(const std::filesystem::path& file) {
  taken_up_.reset();
  takes_roi_ = false;
  lends_ = true;
  begin_ = Begin{
      surface_now, [file](const AppState& host) {
        const Positions shown = surface_positions(host.rest->positions, host.rest->topology());
        return draft_with(std::make_shared<const TransplantPart>(read_transplant_part(file)),
                          bounds_of(shown).diagonal());
      }};
}

void TransplantTool::take_next_part() {
  const auto items = library_.items();
  const auto is_in_hand = [&](const PartLibraryView::Item& item) {
    return has_part() && item.file == tool_.draft().part->file;
  };
  auto at = std::find_if(items.begin(), items.end(), is_in_hand);
  for (std::size_t looked = 0; looked < items.size(); ++looked) {
    at = at == items.end() || at + 1 == items.end() ? items.begin() : at + 1;
    if (at->trouble.empty()) return take_part(at->file);
  }
  say_("There is no part in " + with_tilde(library_.folder()) +
       ". Add one in the Transplant tab, under \"More parts\".");
}

void TransplantTool::take_up(const Editor& editor, std::size_t index) {
  const auto& steps = editor.state().steps;
  const auto* step =
      index < steps.size() ? std::get_if<TransplantStep>(steps[index].get()) : nullptr;
  if (step == nullptr) return;
  say_errors(say_, [&] {
    const Revision revision = revision_of(editor.session().history(), index, *steps[index]);
    takes_roi_ = false;
    lends_ = true;
    taken_up_ = index;
    begin_ = Begin{[revision](const AppState&, Kernels& kernels, const Progress& progress) {
                     return start_of(revision, kernels, progress);
                   },
                   [step = *step](const AppState& host) { return viewer::taken_up(step, host); }};
  });
}

void TransplantTool::take_up_last(const Editor& editor) {
  const auto& steps = editor.state().steps;
  for (std::size_t k = steps.size(); k-- > 0;) {
    if (std::holds_alternative<TransplantStep>(*steps[k])) return take_up(editor, k);
  }
  say_("There is no transplant to edit.");
}

void TransplantTool::close(Editor& editor) {
  begin_.reset();
  is_reading_ = false;
  reader_.cancel();
  preview_.stop();
  tool_.end();
  editor.tool().give_back(tool_);
  taken_up_.reset();
  mesh_.reset();
  hole_.clear();
  applies_.reset();
  if (std::exchange(shown_, Shown::nothing) != Shown::nothing) editor.view().shown().end_preview();
}

void TransplantTool::take_roi(bool on) {
  takes_roi_ = on;
  if (!on) tool_.draft().chosen_hole.reset();
}

std::span<const Eigen::Vector3d> TransplantTool::hole() const {
  if (tool_.stage() != Stage::set_down || tool_.is_dragging()) return {};
  return hole_;
}

TransplantTool::InHand TransplantTool::in_hand(const Begin& begin, const AppState& now,
                                               Kernels& kernels, const Progress& progress) {
  report_progress(progress, "read", 0.0);
  InHand hand;
  hand.host.state = begin.host(now, kernels, progress);
  const Mesh& host = *hand.host.state.rest;
  hand.draft = begin.draft(hand.host.state);
  hand.mesh = std::make_shared<const Mesh>(side_by_side(host, hand.draft.part->mesh));
  hand.mesh->topology();
  hand.host.surface =
      std::make_shared<const SurfaceSnap>(host.topology().triangles, host.positions, "the mesh");
  return hand;
}

void TransplantTool::start_reading(const Editor& editor) {
  if (!begin_ || needs_settling(editor.state())) return;
  rest_ = editor.state().rest;
  settled_ = editor.state().settled;
  reader_.start([begin = *std::exchange(begin_, {}), now = editor.state()](
                    const std::shared_ptr<Kernels>& kernels, const Progress& progress) {
    return in_hand(begin, now, *kernels, progress);
  });
  is_reading_ = true;
}

void TransplantTool::take_read(Editor& editor) {
  if (!is_reading_) return;
  std::optional<InHand> hand;
  if (!say_errors(say_, [&] { hand = reader_.take(); })) return close(editor);
  if (!hand) return;
  is_reading_ = false;
  mesh_ = std::move(hand->mesh);
  positions_ = mesh_->positions;
  hole_.clear();
  preview_.stop();
  shown_ = Shown::nothing;
  tool_.begin(std::move(hand->draft), std::move(hand->host));
  if (lends_) editor.tool().lend(tool_);
}

bool TransplantTool::stands_on_other_surface(const AppState& now) const {
  return now.rest != rest_ || now.settled != settled_;
}

// After an undo, for example, a new part keeps its place on the present surface.
void TransplantTool::reset_history(Editor& editor) {
  if (taken_up_) {
    say_("The surface has changed. Click \"Edit\" in the Transplant tab again.");
    return close(editor);
  }
  preview_.stop();
  shown_ = Shown::nothing;
  begin_ = Begin{surface_now, [draft = tool_.draft()](const AppState&) { return draft; }};
  lends_ = editor.tool().is(tool_);
  tool_.end();
}

// The ROI's vertex numbers are those of the present surface only.
void TransplantTool::take_hole(const Editor& editor) {
  if (!takes_roi_ || taken_up_) return;
  const ChosenRegion& roi = editor.state().selection.roi;
  if (roi.vertices.empty()) {
    tool_.draft().chosen_hole.reset();
  } else {
    tool_.draft().chosen_hole = spec_of(roi, "the region");
  }
}

void TransplantTool::update(Editor& editor) {
  library_.update();
  if (finish_applying(editor)) return;
  start_reading(editor);
  take_read(editor);
  if (!has_part()) return;
  if (stands_on_other_surface(editor.state())) return reset_history(editor);
  take_hole(editor);
  switch (tool_.take_wish()) {
    case PlaceTool::Wish::apply:
      return apply(editor);
    case PlaceTool::Wish::give_up:
      return close(editor);
    case PlaceTool::Wish::nothing:
      break;
  }
  show(editor);
}

// Returns true while the step is under way, and when it is done. After a failure the part stays in
// hand.
bool TransplantTool::finish_applying(Editor& editor) {
  if (!applies_) return false;
  if (editor.session().is_carrying_out()) return true;
  const bool is_done = editor.session().history().done() != *std::exchange(applies_, {});
  if (is_done) close_applied(editor);
  return is_done;
}

void TransplantTool::show(Editor& editor) {
  // The preview was ended elsewhere.
  if (!editor.view().shown().previews()) shown_ = Shown::nothing;
  if (!editor.tool().is(tool_)) {
    // Another tool works on the surface as it is.
    if (std::exchange(shown_, Shown::nothing) != Shown::nothing)
      editor.view().shown().end_preview();
    return;
  }
  if (!tool_.draft().stands) return;
  if (tool_.stage() == Stage::carried || tool_.is_dragging()) {
    preview_.stop();
    return show_carried(editor);
  }
  preview_.follow(tool_.host().state, tool_.draft().step());
  const bool news = preview_.update();
  if (preview_.result() != nullptr) {
    if (news || shown_ != Shown::result) show_result(editor);
  } else if (shown_ != Shown::result || shown_version_ != tool_.version()) {
    show_carried(editor);
  }
}

void TransplantTool::show_carried(Editor& editor) {
  if (shown_ == Shown::carried && shown_version_ == tool_.version()) return;
  const Mesh& part = tool_.draft().part->mesh;
  const std::size_t first = positions_.size() - part.vertex_count();
  for (std::size_t v = 0; v < part.vertex_count(); ++v) {
    positions_[first + v] = tool_.draft().placement * part.positions[v];
  }
  if (std::exchange(shown_, Shown::carried) != Shown::carried) {
    editor.view().shown().show_preview(mesh_, classes_of(first, positions_.size()));
  }
  editor.view().shown().show_preview(positions_);
  shown_version_ = tool_.version();
}

void TransplantTool::show_result(Editor& editor) {
  const TransplantResult& result = *preview_.result();
  hole_ = result.hole;
  if (const auto* made = std::get_if<std::shared_ptr<const Mesh>>(&*result.carried_out.result)) {
    editor.view().shown().show_preview(*made);
  } else {
    Positions positions = tool_.host().state.rest->positions;
    place(std::get<MovedVertices>(*result.carried_out.result), positions);
    editor.view().shown().show_preview(tool_.host().state.rest);
    editor.view().shown().show_preview(positions);
  }
  shown_ = Shown::result;
  shown_version_ = tool_.version();
}

void TransplantTool::apply(Editor& editor) {
  if (tool_.stage() != Stage::set_down || applies_) return;
  const TransplantStep step = tool_.draft().step();
  const std::size_t done = editor.session().history().done();
  // Drops a result that is not of the present step.
  preview_.follow(tool_.host().state, step);
  const TransplantResult* result = preview_.result();
  if (taken_up_) {
    editor.actions().replace_step(*taken_up_, step);
  } else if (result != nullptr) {
    const std::vector<std::string> warnings = result->carried_out.warnings;
    editor.actions().perform(Apply{step, result->carried_out.result});
    for (const std::string& warning : warnings) {
      say_({warning, Tone::warning, editor.state().steps.back()});
    }
  } else {
    editor.actions().carry_out(step);
  }
  if (editor.session().is_carrying_out()) {
    applies_ = done;
  } else if (editor.session().history().done() != done) {
    close_applied(editor);
  }
}

// The user goes on with another region.
void TransplantTool::close_applied(Editor& editor) {
  close(editor);
  editor.tool().begin_choosing({Part::Role::roi});
}

void TransplantTool::release_device() {
  preview_.stop();
  shown_ = Shown::nothing;
}

void TransplantTool::use_device(const std::shared_ptr<gpu::Context>& context) {
  library_.use_device(context, kernels_like(context));
  preview_.use_kernels(kernels_like(context));
  reader_.use_kernels(kernels_like(context));
}

}  // namespace lapwing::viewer
