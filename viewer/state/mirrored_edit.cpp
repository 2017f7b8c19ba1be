#include "state/mirrored_edit.h"

#include "lapwing/base/errors.h"
#include "lapwing/deform/handle_motion.h"

namespace lapwing::viewer {

std::shared_ptr<const MirroredEdit> mirrored_edit(const DeformRequest& step, const Mesh& mesh) {
  try {
    MirroredRequest both = mirrored_request(step, mesh);
    auto edit = std::make_shared<MirroredEdit>();
    edit->region = resolve_edit_region(both.request, mesh);
    edit->handle_images = std::move(both.handle_images);
    for (const VertexSet& handle : edit->region.handles) {
      edit->centroids.push_back(handle_frame(handle, mesh.positions).centroid);
    }
    return edit;
  } catch (const InputError&) {
    return nullptr;  // preparing the edit reports why
  }
}

}  // namespace lapwing::viewer
