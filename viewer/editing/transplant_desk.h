#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "editing/editor.h"
#include "editing/part_shelf.h"
#include "tools/place_tool.h"
#include "work/transplant_preview.h"

namespace lapwing::viewer {

/// A transplant being made by hand: the parts to choose from, the one in hand, and what of it is on
/// the screen of an editor: while it is carried or dragged the part itself, then what the step
/// comes to. What does not work is said to the editor.
class TransplantDesk {
 public:
  TransplantDesk(const std::shared_ptr<gpu::Context>& context, Say say, std::function<void()> wake);

  PartShelf& shelf() { return shelf_; }
  const PartShelf& shelf() const { return shelf_; }

  /// Reads a part beside the window, for the hand; in place of one that is there.
  void take_part(const std::filesystem::path& file);
  /// The first part of the shelf, or the one behind that in hand.
  void take_next_part();
  /// Takes the `index`th step of the recipe up again. Says why not, where it cannot be.
  void take_up(const Editor& editor, std::size_t index);
  /// The last one that is a transplant.
  void take_up_last(const Editor& editor);
  std::optional<std::size_t> taken_up() const { return taken_up_; }
  /// Gives up what was not applied.
  void close(Editor& editor);

  /// Whether a part is being read or in hand.
  bool is_open() const { return begin_ || is_reading_ || has_part(); }
  bool has_part() const { return tool_.stage() != PlaceTool::Stage::empty; }
  bool is_reading() const { return begin_ || is_reading_; }
  PlaceTool& tool() { return tool_; }
  const PlaceTool& tool() const { return tool_; }
  const TransplantPreview& preview() const { return preview_; }
  /// The hole's loop in the surface, as far as it is known.
  std::span<const Eigen::Vector3d> hole() const;

  /// The ROI is the hole, as it is and as it will be; or a disk around the part.
  bool takes_roi() const { return takes_roi_; }
  void take_roi(bool on);

  /// Makes the step, what the preview came to if that is there.
  void apply(Editor& editor);

  /// Once a frame, after the editor's.
  void update(Editor& editor);

  void release_device();
  void use_device(const std::shared_ptr<gpu::Context>& context);

 private:
  // How a part comes to be in hand: all of it beside the window.
  struct Begin {
    std::function<AppState(const AppState& now, Kernels&, const Progress&)> host;
    std::function<TransplantDraft(const AppState& host)> draft;
  };
  struct InHand {
    TransplantDraft draft;
    TransplantHost host;
    // The surface and, behind it, the part, where its file has it.
    std::shared_ptr<const Mesh> mesh;
  };
  enum class Shown { nothing, carried, result };

  static InHand in_hand(const Begin& begin, const AppState& now, Kernels& kernels,
                        const Progress& progress);
  void start_reading(const Editor& editor);
  void take_read(Editor& editor);
  bool stands_on_other_surface(const AppState& now) const;
  void begin_anew(Editor& editor);
  void take_hole(const Editor& editor);
  void show(Editor& editor);
  void show_carried(Editor& editor);
  void show_result(Editor& editor);
  bool finish_applying(Editor& editor);

  Say say_;
  PartShelf shelf_;
  std::optional<Begin> begin_;  // to be read as soon as nothing is waited for
  bool is_reading_ = false;
  bool lends_ = true;  // the tool, then
  std::optional<std::size_t> taken_up_;
  // The editor's surface that the part in hand was read for.
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const MovedVertices> settled_;

  PlaceTool tool_;
  std::shared_ptr<const Mesh> mesh_;  // InHand's
  Positions positions_;               // of them, with the part where it is
  bool takes_roi_ = false;
  std::vector<Eigen::Vector3d> hole_;

  Shown shown_ = Shown::nothing;
  std::uint64_t shown_version_ = 0;     // of the part's place
  std::optional<std::size_t> applies_;  // the steps of the history before; under way
  TransplantPreview preview_;
  Job<InHand> reader_;
};

}  // namespace lapwing::viewer
