#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "lapwing/elastic/coarse_embedding.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/mesh/decimate.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// A coarse surface, the embedding of a region in it, and the preparation that edits on it share.
struct CoarseLevel {
  CoarseLevel(CoarseSurface of, std::shared_ptr<const Positions> rest, const VertexSet& roi)
      : surface(std::move(of)),
        embedding(std::move(rest), roi, surface),
        prepared(surface.topology) {}
  CoarseLevel(const CoarseLevel&) = delete;
  CoarseLevel& operator=(const CoarseLevel&) = delete;

  const CoarseSurface surface;
  const CoarseEmbedding embedding;
  PreparedRegion prepared;  ///< of edits on the surface; used under `preparing`
  std::mutex preparing;
};

/// The coarse surfaces of edits with one ROI of one mesh. Reuses the last surface for the next edit
/// if handles, belt and targets are the same, for any weights. Thread-safe.
class CoarseSurfaces {
 public:
  /// Returns the surface with about `count` vertices in the region. `rest` is the same pointer for
  /// the same positions. Returns null if more than half of the vertices would remain because too
  /// many must be kept.
  std::shared_ptr<CoarseLevel> of(const EditRegion& region, const Topology& topology,
                                  const std::shared_ptr<const Positions>& rest, std::size_t count);

 private:
  // The last surface and the inputs it was made from.
  struct Last {
    std::shared_ptr<const Positions> rest;
    std::size_t count = 0;
    std::vector<Index> groups;  // per vertex of the mesh (groups_of)
    std::shared_ptr<CoarseLevel> level;
  };

  std::mutex mutex_;  // not held while a surface is made
  Last last_;
};

}  // namespace lapwing
