#include "work/attachment_follower.h"

#include <algorithm>

namespace lapwing::viewer {

bool DraggedFrame::is_same_as(const DraggedFrame& other) const {
  return response == other.response && pose == other.pose &&
         std::equal(motions.begin(), motions.end(), other.motions.begin(), other.motions.end(),
                    [](const auto& a, const auto& b) { return a.matrix() == b.matrix(); });
}

// Attachments are computed on the CPU without kernels.
AttachmentFollower::AttachmentFollower(std::function<void()> wake)
    : job_([] { return std::unique_ptr<Kernels>(); }, std::move(wake)) {}

void AttachmentFollower::cancel() {
  asked_ = {};
  job_.cancel();
}

void AttachmentFollower::follow(const AppState& state, const Preparation& preparation,
                                const DraggedFrame& frame) {
  if (job_.status().busy || asked_.is_same_as(frame)) return;
  const std::shared_ptr<const DeformSolver> exact = preparation.exact();
  const std::shared_ptr<const DragPreview> preview = preparation.preview();
  if (!preview) return;
  asked_ = frame;
  const std::shared_ptr<const JoinedSurface> joined =
      joined_seams(state) == nullptr ? nullptr : state.joined;
  job_.start([contacts = preparation.attachment_cache(), frame, exact, preview, joined,
              rest = state.rest,
              objects = state.carried](const std::shared_ptr<Kernels>&, const Progress& progress) {
    Positions positions = rest->positions;
    Drag(frame.response, frame.pose).move(frame.motions, positions);
    const Deformed deformed =
        deformed_of(*rest, joined.get(), preview->region(), std::move(positions),
                    exact ? exact->rest_stretch(frame.motions) : std::vector<Eigen::Matrix3d>());
    std::vector<Positions> places;
    for (auto& carried : contacts->carry(objects, rest, deformed, progress)) {
      places.push_back(carried ? std::move(carried->positions)
                               : objects[places.size()].rest->positions());
    }
    return places;
  });
}

}  // namespace lapwing::viewer
