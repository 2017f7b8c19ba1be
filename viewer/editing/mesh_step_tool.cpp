#include "editing/mesh_step_tool.h"

#include <utility>

#include "editing/kernels_like.h"
#include "lapwing/base/errors.h"

namespace lapwing::viewer {

MeshStepTool::MeshStepTool(std::shared_ptr<const Mesh> mesh, CheckReport report,
                           const std::shared_ptr<gpu::Context>& context, std::function<void()> wake)
    : preview_(kernels_like(context), wake),
      checked_(std::move(mesh)),
      report_(std::move(report)),
      checking_(kernels_like(context), std::move(wake)) {}

void MeshStepTool::preview(const Step& step) {
  preview_.stop();
  step_ = step;
  rest_.reset();
}

void MeshStepTool::close(Editor& editor) {
  if (shown_) editor.view().shown().end_preview();
  give_way();
}

void MeshStepTool::give_way() {
  preview_.stop();
  step_.reset();
  rest_.reset();
  shown_ = false;
}

void MeshStepTool::apply(Editor& editor) {
  if (!step_ || preview_.result() == nullptr) return;
  const Apply applied{*step_, preview_.result()->result};
  close(editor);
  editor.actions().perform(applied);
}

void MeshStepTool::start(const Editor& editor) {
  if (!step_ || rest_ || needs_settling(editor.state()) || editor.tool().is_dragging()) return;
  rest_ = editor.state().rest;
  settled_ = editor.state().settled;
  preview_.start(editor.state(), *step_);
}

void MeshStepTool::update_report(const Editor& editor) {
  const std::shared_ptr<const Mesh>& rest = editor.state().rest;
  if (!rest->shares_faces_with(*checked_)) {
    checked_ = rest;
    report_.reset();
    checking_.start([rest](const std::shared_ptr<Kernels>&, const Progress& progress) {
      const ProgressScope scope(progress);
      return check(*rest);
    });
  }
  try {
    if (auto report = checking_.take()) report_ = std::move(report);
  } catch (const Error&) {
    report_.emplace();  // the step that needs the holes reports why
  }
}

void MeshStepTool::update(Editor& editor, bool others_preview) {
  update_report(editor);
  if (!step_) return;
  const bool is_changed =
      rest_ && (editor.state().rest != rest_ || editor.state().settled != settled_);
  if (others_preview || is_changed || (shown_ && !editor.view().shown().previews())) {
    return others_preview ? give_way() : close(editor);
  }
  start(editor);
  if (!preview_.update()) return;
  const std::shared_ptr<const Mesh> mesh = preview_.mesh();
  if (mesh != nullptr) {
    editor.view().shown().show_preview(mesh);
    shown_ = true;
  } else if (std::exchange(shown_, false)) {
    editor.view().shown().end_preview();
  }
}

void MeshStepTool::release_device() {
  give_way();
}

void MeshStepTool::use_device(const std::shared_ptr<gpu::Context>& context) {
  preview_.use_kernels(kernels_like(context));
  checking_.use_kernels(kernels_like(context));
}

}  // namespace lapwing::viewer
