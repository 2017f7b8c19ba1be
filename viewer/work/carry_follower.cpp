#include "work/carry_follower.h"

#include <algorithm>
#include <map>

namespace lapwing::viewer {

bool DraggedFrame::is_same_as(const DraggedFrame& other) const {
  return response == other.response && pose == other.pose &&
         std::equal(motions.begin(), motions.end(), other.motions.begin(), other.motions.end(),
                    [](const auto& a, const auto& b) { return a.matrix() == b.matrix(); });
}

// What objects follow of the surface of a mesh, as far as it was found.
class CarryFollower::Contacts {
 public:
  // Nothing where it is too much to be kept.
  using Known = std::optional<CarryShares>;

  void use(const std::shared_ptr<const Mesh>& rest) {
    if (rest_ == rest) return;
    known_.clear();
    surface_ = std::make_shared<const SurfaceContacts>(rest->positions, rest->topology());
    rest_ = rest;
  }
  const std::shared_ptr<const SurfaceContacts>& surface() const { return surface_; }

  const Known& of(const std::shared_ptr<const CarriedFile>& file) {
    const auto at = known_.find(file);
    if (at != known_.end()) return at->second;
    std::erase_if(known_, [](const auto& known) { return known.first.expired(); });
    return known_.emplace(file, surface_->find_all(file->positions(), kMostShares)).first->second;
  }

 private:
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const SurfaceContacts> surface_;
  std::map<std::weak_ptr<const CarriedFile>, Known, std::owner_less<>> known_;
};

CarryFollower::CarryFollower(std::function<void()> wake)
    : contacts_(std::make_shared<Contacts>()),
      // It computes on the processor.
      job_([] { return std::unique_ptr<Kernels>(); }, std::move(wake)) {}

void CarryFollower::cancel() {
  asked_ = {};
  job_.cancel();
}

void CarryFollower::follow(const AppState& state, const Preparation& preparation,
                           const DraggedFrame& frame) {
  if (job_.status().busy || asked_.is_same_as(frame)) return;
  const std::shared_ptr<const Deformer> exact = preparation.exact();
  const std::shared_ptr<const DragPreview> preview = preparation.preview();
  if (!preview) return;
  asked_ = frame;
  const std::shared_ptr<const JoinedSurface> joined =
      joined_seams(state) == nullptr ? nullptr : state.joined;
  job_.start([contacts = contacts_, frame, exact, preview, joined, rest = state.rest,
              objects = state.carried](const std::shared_ptr<Kernels>&, const Progress& progress) {
    Positions positions = rest->positions;
    Drag(frame.response, frame.pose).move(frame.motions, positions);
    const Deformed deformed = deformed_of(
        *rest, joined.get(), exact ? exact->region() : preview->region(), std::move(positions),
        exact ? exact->asked_scales(frame.motions) : std::vector<double>());
    contacts->use(rest);
    const SurfaceCarrier carrier(contacts->surface(), deformed);
    std::vector<Positions> places;
    for (const CarriedObject& object : objects) {
      report_progress(progress, "carry", 0.0);
      const Positions& points = object.rest->positions();
      if (!object.follows) {
        places.push_back(points);
      } else if (const Contacts::Known& known = contacts->of(object.rest)) {
        places.push_back(carrier.carry(points, *known).positions);
      } else {
        places.push_back(carrier.carry(points).positions);
      }
    }
    return places;
  });
}

}  // namespace lapwing::viewer
