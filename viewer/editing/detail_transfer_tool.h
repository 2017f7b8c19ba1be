#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/editor.h"
#include "editing/source_view.h"
#include "tools/weight_paint.h"
#include "work/layer_preview.h"

namespace lapwing::viewer {

/// Picks points on the target.
class PointTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  const char* hint(const AppState&, const Part&) const override {
    return "Click the same place on the source and on the target.";
  }
  /// The vertex clicked last, until it is reset.
  std::optional<Index> picked;
};

/// Lets the user make a coat or mix. Holds the draft, views of its sources, the pairs of points
/// that the user picks, and the preview on the editor's surface. Reports errors to `say`.
class DetailTransferTool {
 public:
  DetailTransferTool(UpAxis up_axis, const std::shared_ptr<gpu::Context>& context, Say say,
                     std::function<void()> wake);

  /// `begin` starts a new coat or mix. `take_up` opens the recipe step at `index` for editing.
  /// Returns false, without any change, if that step is neither a coat nor a mix. Both functions
  /// replace the current draft.
  void begin(Editor& editor, LayerDraft::Operation operation);
  bool take_up(Editor& editor, std::size_t index);
  /// Drops what was not applied.
  void close(Editor& editor);
  /// Ends picking or painting; otherwise cancels the step that is being applied; otherwise closes.
  void cancel(Editor& editor);
  bool is_open() const { return is_open_; }
  /// The step that is edited again, if any.
  std::optional<std::size_t> taken_up() const { return taken_up_; }

  LayerDraft& draft() { return draft_; }
  const LayerDraft& draft() const { return draft_; }
  /// Sets the mesh of source `k` to a file, or to the edited mesh if `mesh` is empty. If the
  /// source `lies_on_target`, its patch and pairs follow the target patch.
  void use_source(std::size_t k, const std::filesystem::path& mesh, bool lies_on_target = false);
  bool lies_on_target() const { return lies_on_target_; }

  /// The source that is shown beside the target.
  std::size_t current() const { return current_; }
  void show(std::size_t k) { current_ = k; }
  /// Null while the source is read, or if it cannot be read.
  SourceView* view() { return views_[current_].get(); }
  const SourceView* view() const { return views_[current_].get(); }

  /// Chooses the patch of the shown source. Reports an error.
  void choose_source_patch(const RegionSpec& region);

  /// Whether the weight of a mix is being painted on the target.
  bool is_painting() const { return is_painting_; }
  void paint_weight(bool on, Editor& editor);
  WeightPaint& weight_paint() { return weight_paint_; }
  const WeightPaint& weight_paint() const { return weight_paint_; }

  /// Picks points in pairs, one on the source and one on the target.
  enum class Picking { none, inside, border };
  Picking picking() const { return picking_; }
  void pick(Picking what, Editor& editor);
  /// The points of an incomplete pair.
  std::optional<Index> picked_source() const { return picked_source_; }
  std::optional<Index> picked_target() const { return point_tool_.picked; }

  bool previews() const { return previews_; }
  void set_previews(bool on) { previews_ = on; }
  const LayerPreview& preview() const { return preview_; }
  bool is_reading() const { return reading_.has_value(); }

  /// Call this once per frame, after the editor's update.
  void update(Editor& editor);
  /// Carries out the step, whether or not its preview is ready.
  void apply(Editor& editor);

  void release_device();
  void use_device(const std::shared_ptr<gpu::Context>& context);

 private:
  bool can_click_target(const Editor& editor) const;
  void take_read();
  void read_next();
  void show_source(std::size_t k, std::shared_ptr<const Mesh> mesh);
  void renew_own_views(const std::shared_ptr<const Mesh>& target);
  void take_what_was_done(const Editor& editor);
  void take_patches(const Editor& editor);
  void place_source(const Editor& editor);
  void take_points(const Editor& editor);
  void add_pair(const Editor& editor);
  void take_weight(const Mesh& target);
  void show_weight(Editor& editor, const std::shared_ptr<const Mesh>& target);
  bool wants_preview(const Editor& editor) const;
  void show_preview(Editor& editor);
  std::shared_ptr<const Mesh> target_of(const Editor& editor);

  UpAxis up_axis_;
  std::shared_ptr<gpu::Context> context_;
  Say say_;

  bool is_open_ = false;
  LayerDraft draft_;
  std::optional<std::size_t> taken_up_;
  std::optional<AppState> start_;  // before the step that is edited again
  // Otherwise the edited surface, if the open edit has moved it.
  std::shared_ptr<const Mesh> committed_;
  std::shared_ptr<const MovedVertices> committed_from_;
  std::size_t current_ = 0;
  std::array<std::unique_ptr<SourceView>, 2> views_;
  std::array<bool, 2> is_to_read_{};
  std::optional<std::size_t> reading_;
  bool lies_on_target_ = false;  // the first source
  bool is_to_place_ = false;
  RegionSpec seen_roi_{ListedVertices{}};

  Picking picking_ = Picking::none;
  PointTool point_tool_;
  std::optional<Index> picked_source_;

  bool is_painting_ = false;
  WeightPaint weight_paint_;

  bool previews_ = true;
  bool applies_ = false;  // the editor carries out the step, which follows `steps_before_`
  std::vector<std::shared_ptr<const Step>> steps_before_;
  std::shared_ptr<const Mesh> previewed_;
  LayerPreview preview_;
  Job<std::shared_ptr<const Mesh>> reader_;
};

}  // namespace lapwing::viewer
