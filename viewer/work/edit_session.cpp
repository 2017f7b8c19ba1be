#include "work/edit_session.h"

#include <algorithm>
#include <iterator>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/gltf_scene.h"
#include "lapwing/io/paths.h"
#include "lapwing/io/source_file.h"
#include "lapwing/recipe/recipe.h"
#include "lapwing/recipe/recipe_files.h"
#include "lapwing/run/run_recipe.h"
#include "state/draft.h"
#include "state/whole_step.h"

namespace lapwing::viewer {

namespace fs = std::filesystem;

namespace {

// Returns the opened mesh file of the edit. If the file was overwritten, size and time are those of
// the copy from which the steps start.
MeshStamp file_of(const InterruptedEdit& edit) {
  if (!edit.has_copy()) return edit.mesh;
  return {edit.opened, edit.mesh.bytes, edit.mesh.modified};
}

void require_settled(const AppState& state) {
  if (!needs_settling(state)) return;
  throw InputError("The last move is not refined yet. Wait for its result, or undo it.");
}

bool same_surface(const AppState& a, const AppState& b) {
  return a.rest == b.rest && a.settled == b.settled && a.moves == b.moves && a.steps == b.steps &&
         a.carried == b.carried;
}

// Returns whether the mesh was read from a .gltf file with external buffers.
bool has_external_buffers(const Mesh& mesh) {
  if (!mesh.source || !mesh.source->gltf) return false;
  return std::ranges::any_of(mesh.source->gltf->file.buffers(), [](const GltfBuffer& buffer) {
    return buffer.kind == GltfBuffer::Kind::file;
  });
}

// Writes `original` to `folder` as NAME-original.EXT. If a file with this name and other contents
// exists, appends a number to the name.
fs::path write_copy(std::string_view original, const fs::path& folder, const fs::path& mesh) {
  for (int number = 1;; ++number) {
    const std::string suffix = number == 1 ? "-original" : "-original-" + std::to_string(number);
    const fs::path copy = folder / (mesh.stem().string() + suffix + mesh.extension().string());
    std::error_code error;
    if (!fs::exists(copy, error)) {
      replace_file(copy, original);
      return copy;
    }
    if (FileBytes::read(copy).view() == original) return copy;
  }
}

bool has_path(const Step& step) {
  const auto* deform = std::get_if<DeformRequest>(&step);
  return deform != nullptr && std::ranges::any_of(deform->handles, [](const MovedHandle& handle) {
           return !handle.path.empty();
         });
}

// Returns the largest distance between corresponding vertices, divided by the diagonal of `b`.
// Returns 1 if the numbers of vertices differ.
double relative_distance(const Positions& a, const Positions& b) {
  if (a.size() != b.size()) return 1.0;
  double largest = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
  const double diagonal = bounds_of(b).diagonal();
  return diagonal > 0.0 ? largest / diagonal : 0.0;
}

bool same_choice(const AppState& a, const AppState& b) {
  return a.selection == b.selection && a.parameters == b.parameters;
}

}  // namespace

EditSession::EditSession(History history, std::optional<MeshStamp> file, const fs::path& journals,
                         Preparation::MakeKernels make_kernels, std::function<void()> wake,
                         Preparation::Upload upload, const InterruptedEdit* restored)
    : history_(std::move(history)),
      file_(restored != nullptr ? file_of(*restored) : std::move(file)),
      preparation_(make_kernels, wake, std::move(upload)),
      carrying_out_(make_kernels, wake),
      checking_recipe_(std::move(make_kernels), std::move(wake)) {
  start_journal(journals, restored);
  if (restored != nullptr && restored->has_copy()) {
    original_ = FileBytes::read(restored->mesh.path);
    // The history does not record which of its states was saved to the file.
    history_.mark_unsaved();
  }
  follow();
}

void EditSession::start_journal(const fs::path& journals, const InterruptedEdit* restored) {
  if (!file_) return;
  try {
    journal_.emplace(journals, *file_);
    if (restored == nullptr) return;
    if (restored->has_copy()) journal_->keep_mesh(restored->mesh.path);
    journal_->continue_from(*restored);
  } catch (const Error& error) {
    // Without a copy of the mesh, the journal could not be restored.
    if (journal_) journal_->close();
    journal_.reset();
    warning_ = error.what();
  }
}

void EditSession::perform(const Command& command, Joining joining,
                          std::shared_ptr<const DragState> shown) {
  history_.perform(command, joining);
  follow(std::move(shown));
}

void EditSession::undo() {
  history_.undo();
  follow();
}

void EditSession::redo() {
  history_.redo();
  follow();
}

void EditSession::go_to(std::size_t steps) {
  history_.go_to(steps);
  follow();
}

void EditSession::continue_with(History history) {
  history_ = std::move(history);
  follow();
}

// Cancels settling first, because an earlier request may be outdated.
void EditSession::follow(std::shared_ptr<const DragState> shown) {
  preparation_.cancel_settling();
  prepare(std::move(shown));
  keep_step_if_wanted();
  if (!journal_) return;
  try {
    journal_->record(state());
    warning_.clear();
  } catch (const Error& error) {
    warning_ = error.what();
  }
}

void EditSession::use_kernels(Preparation::MakeKernels make_kernels, Preparation::Upload upload) {
  preparation_.use_kernels(make_kernels, std::move(upload));
  carrying_out_.use_kernels(make_kernels);
  checking_recipe_.use_kernels(std::move(make_kernels));
  prepare();
}

void EditSession::prepare(std::shared_ptr<const DragState> shown) {
  preparation_.follow(state());
  if (needs_settling(state())) preparation_.settle(state(), std::move(shown));
}

bool EditSession::take_result() {
  auto result = preparation_.take_result();
  if (!result || !needs_settling(state()) || result->moves != state().moves) return false;
  history_.perform(Settle{result->moved});
  follow();
  return true;
}

fs::path EditSession::folder() const {
  return file_ ? file_->path.parent_path() : fs::current_path();
}

void EditSession::carry_out(const Step& step) {
  require_settled(state());
  carried_out_on_ = state();
  needs_ = Needs::surface;
  carrying_out_.start(
      [state = state(), step = with_absolute_paths(step, folder())](
          const std::shared_ptr<Kernels>& kernels, const Progress& progress) -> StepResult {
        CarriedOut out = apply_step(state, step, {}, *kernels, progress);
        return {{Apply{step, std::move(out.result)}}, std::move(out.warnings)};
      });
}

void EditSession::replace_step(std::size_t index, const Step& step) {
  require_settled(state());
  Revision revision = revision_of(history_, index, with_absolute_paths(step, folder()));
  carried_out_on_ = state();
  needs_ = Needs::surface_and_choice;
  carrying_out_.start([revision = std::move(revision)](const std::shared_ptr<Kernels>& kernels,
                                                       const Progress& progress) -> StepResult {
    auto result =
        std::make_shared<const AppState>(revised(revision, carry_out_with(*kernels, progress)));
    return {{Revise{revision.step, std::move(result)}}, {}};
  });
}

void EditSession::carry_along(const std::vector<fs::path>& files) {
  if (is_carrying_out()) {
    throw InputError("A step is being applied. Attach the object when it is done.");
  }
  carried_out_on_ = state();
  needs_ = Needs::nothing;
  carrying_out_.start([files, folder = folder()](const std::shared_ptr<Kernels>&,
                                                 const Progress& progress) -> StepResult {
    StepResult result;
    for (const fs::path& file : files) {
      report_progress(progress, "read", 0.0);
      result.commands.push_back(
          CarryAlong{open_carried(fs::absolute(folder / file).lexically_normal())});
    }
    return result;
  });
}

void EditSession::cancel_step() {
  carrying_out_.cancel();
  carried_out_on_.reset();
}

void EditSession::keep_step_if_wanted() {
  if (!carried_out_on_) return;
  const AppState& asked = *carried_out_on_;
  const bool keeps_surface = needs_ == Needs::nothing || same_surface(asked, state());
  const bool keeps_choice = needs_ != Needs::surface_and_choice || same_choice(asked, state());
  if (!keeps_surface || !keeps_choice) cancel_step();
}

std::optional<StepTaken> EditSession::take_step() {
  std::optional<StepResult> result;
  try {
    result = carrying_out_.take();
  } catch (...) {
    carried_out_on_.reset();
    throw;
  }
  if (!result) return std::nullopt;
  carried_out_on_.reset();
  const std::shared_ptr<const Mesh> before = state().rest;
  for (const Command& command : result->commands) perform(command);
  return StepTaken{!before->shares_faces_with(*state().rest), std::move(result->warnings)};
}

std::shared_ptr<const DragState> EditSession::pose() const {
  const auto preview = preparation_.preview();
  if (!state().settled || !preview) return nullptr;
  auto pose = std::make_shared<DragState>(
      preview->response()->pose_at(positions_of(state()), motions_of(state())));
  // The pose is the settled result, so no further iteration is needed until the handles move.
  pose->last_result.settled = true;
  return pose;
}

void EditSession::settle_live(std::span<const HandleMove> moves,
                              std::shared_ptr<const DragState> from, bool rests) {
  // Copying the state takes time, so copy it only if the request will be accepted.
  if (preparation_.status().phase != PreparationStatus::Phase::ready) return;
  AppState dragged = state();
  dragged.moves.assign(moves.begin(), moves.end());
  dragged.settled.reset();
  preparation_.settle_live(dragged, std::move(from), rests);
}

const Certificate* EditSession::certificate() const {
  return state().settled ? state().settled->certificate.get() : nullptr;
}

// Returns the carried files on the current surface. Throws if one of them cannot be written beside
// `path`.
std::vector<AttachmentFile> EditSession::carried_for(const fs::path& path) const {
  std::vector<AttachmentFile> files;
  std::vector<fs::path> inputs;
  if (file_) inputs.push_back(file_->path);
  for (const auto& file : carried_of(state())) {
    files.push_back(*file);
    inputs.push_back(file->file());
  }
  for (const auto& step : state().steps) {
    for (fs::path& read : files_read(*step)) inputs.push_back(std::move(read));
  }
  require_targets(files, path, inputs);
  return files;
}

WriteReport EditSession::save(const fs::path& path) {
  require_settled(state());
  static_cast<void>(format_of(path));
  const std::vector<AttachmentFile> carried = carried_for(path);
  keep_original_of(path);
  FileReplacements files;
  WriteReport report = write_carried(carried, path, files);
  WriteReport of_mesh = write_mesh(mesh_of(state()), path, files);
  files.commit();
  std::ranges::move(of_mesh.not_carried, std::back_inserter(report.not_carried));
  std::ranges::move(of_mesh.notes, std::back_inserter(report.notes));
  history_.mark_saved();
  return report;
}

// Stores the original contents of the opened file if `path` is this file. Call this before writing
// to `path`. Throws InputError if a step reads `path`, or if the file has external buffers.
void EditSession::keep_original_of(const fs::path& path) {
  for (const auto& step : state().steps) {
    for (const fs::path& read : files_read(*step)) {
      if (!is_same_file(read, path)) continue;
      throw InputError(path.string() +
                       " is used by a step of this edit. Save the mesh under another name.");
    }
  }
  if (!file_ || original_ || !is_same_file(path, file_->path)) return;
  if (has_external_buffers(*state().rest)) {
    throw InputError(path.string() +
                     " stores its data in other files, which would be replaced as well. Save the "
                     "mesh as .glb or under another name.");
  }
  original_ = FileBytes::read(file_->path);
  if (journal_) journal_->keep_mesh();
}

WriteReport EditSession::save_carried(const fs::path& path) const {
  require_settled(state());
  FileReplacements files;
  WriteReport report = write_carried(carried_for(path), path, files);
  files.commit();
  return report;
}

fs::path EditSession::save_recipe(const fs::path& path) {
  require_settled(state());
  if (!file_) {
    throw InputError(
        "A recipe starts from a mesh file, and this mesh has none. Save the mesh, and open the "
        "saved file before you edit it.");
  }
  const fs::path folder = fs::absolute(path).parent_path();
  const fs::path copy = original_ ? write_copy(original_->view(), folder, file_->path) : fs::path();
  const fs::path& mesh = original_ ? copy : file_->path;
  const Recipe recipe = to_recipe(state(), mesh.lexically_proximate(folder), folder);
  replace_file(path, to_json(recipe));
  checking_recipe_.cancel();
  if (std::ranges::any_of(recipe.steps, has_path)) {
    checking_recipe_.start([path, shown = positions_of(state())](
                               const std::shared_ptr<Kernels>& kernels, const Progress& progress) {
      const auto run = run_recipe(read_recipe(path), *kernels, progress);
      return relative_distance(run->mesh.positions, shown);
    });
  }
  return copy;
}

std::optional<double> EditSession::take_recipe_check() {
  return checking_recipe_.take();
}

void EditSession::close() {
  if (journal_) journal_->close();
  journal_.reset();
  preparation_.cancel();
  cancel_step();
  checking_recipe_.cancel();
}

}  // namespace lapwing::viewer
