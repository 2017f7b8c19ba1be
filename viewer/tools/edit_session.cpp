#include "tools/edit_session.h"

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "state/draft.h"

namespace lapwing::viewer {

namespace fs = std::filesystem;

namespace {

// The file that the edit was begun on. One that was saved over is named by its copy's stamp: the
// copy is what counts.
MeshStamp file_of(const InterruptedEdit& edit) {
  if (!edit.has_copy()) return edit.mesh;
  return {edit.opened, edit.mesh.bytes, edit.mesh.modified};
}

}  // namespace

EditSession::EditSession(History history, std::optional<MeshStamp> file, const fs::path& journals,
                         Preparation::MakeKernels make_kernels, std::function<void()> wake)
    : history_(std::move(history)),
      file_(std::move(file)),
      preparation_(std::move(make_kernels), std::move(wake)) {
  start_journal(journals, {});
  follow();
}

EditSession::EditSession(const InterruptedEdit& edit, History history, const fs::path& journals,
                         Preparation::MakeKernels make_kernels, std::function<void()> wake)
    : history_(std::move(history)),
      file_(file_of(edit)),
      preparation_(std::move(make_kernels), std::move(wake)) {
  start_journal(journals, edit.has_copy() ? std::optional(edit.mesh.path) : std::nullopt);
  // What was saved over the file cannot be told from the history.
  if (edit.has_copy()) history_.mark_unsaved();
  follow();
  if (needs_settling(state())) preparation_.settle(state());
}

void EditSession::start_journal(const fs::path& journals, const std::optional<fs::path>& copy) {
  if (!file_) return;
  try {
    journal_.emplace(journals, *file_);
    if (copy) journal_->keep_mesh(*copy);
  } catch (const IoError& error) {
    // Steps that start from a mesh that nobody kept would be no help.
    if (journal_) journal_->close();
    journal_.reset();
    warning_ = error.what();
  }
}

void EditSession::perform(const Command& command) {
  history_.perform(command);
  follow();
  if (needs_settling(state())) preparation_.settle(state());
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
  if (needs_settling(state())) preparation_.settle(state());
}

// What was asked for before may not be wanted any more.
void EditSession::follow() {
  preparation_.cancel_settling();
  preparation_.follow(state());
  if (!journal_) return;
  try {
    journal_->record(state());
    warning_.clear();
  } catch (const Error& error) {
    warning_ = error.what();
  }
}

void EditSession::use_kernels(Preparation::MakeKernels make_kernels) {
  preparation_.use_kernels(std::move(make_kernels));
  prepare();
}

void EditSession::prepare() {
  preparation_.follow(state());
  if (needs_settling(state())) preparation_.settle(state());
}

bool EditSession::take_result() {
  auto result = preparation_.take_result();
  if (!result || !needs_settling(state()) || result->moves != state().moves) return false;
  history_.perform(Settle{result->moved});
  std::erase_if(certificates_, [](const auto& known) { return known.first.expired(); });
  certificates_.insert_or_assign(result->moved, std::move(result->certificate));
  follow();
  return true;
}

void EditSession::settle_live(std::span<const Move> moves) {
  // A copy of the state costs the selection: only where it is going to be used.
  if (preparation_.status().phase != PreparationStatus::Phase::ready) return;
  AppState dragged = state();
  dragged.moves.assign(moves.begin(), moves.end());
  dragged.settled.reset();
  preparation_.settle_live(dragged);
}

std::shared_ptr<const MovedVertices> EditSession::take_live_result() {
  auto result = preparation_.take_live_result();
  return result ? std::move(result->moved) : nullptr;
}

const Certificate* EditSession::certificate() const {
  if (!state().settled) return nullptr;
  const auto known = certificates_.find(state().settled);
  return known == certificates_.end() ? nullptr : &known->second;
}

WriteReport EditSession::save(const fs::path& path) {
  std::error_code error;
  if (journal_ && fs::equivalent(path, file_->path, error)) journal_->keep_mesh();
  WriteReport report = write_mesh(mesh_of(state()), path);
  history_.mark_saved();
  return report;
}

void EditSession::save_recipe(const fs::path& path) const {
  if (!file_) throw InputError("a recipe names a mesh file; save the mesh first, and open that");
  const fs::path folder = fs::absolute(path).parent_path();
  replace_file(path, to_json(to_recipe(state(), file_->path.lexically_proximate(folder), folder)));
}

void EditSession::close() {
  if (journal_) journal_->close();
  journal_.reset();
  preparation_.cancel();
}

}  // namespace lapwing::viewer
