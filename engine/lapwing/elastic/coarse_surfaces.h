#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "lapwing/elastic/coarse_embedding.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/mesh/decimate.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// A coarse surface, the embedding of a region in it, and the cached preparation of edits on it.
struct CoarseLevel {
  CoarseLevel(CoarseSurface of, std::shared_ptr<const Positions> rest, const VertexSet& roi)
      : surface(std::move(of)),
        embedding(std::move(rest), roi, surface),
        prepared(surface.topology) {}
  CoarseLevel(const CoarseLevel&) = delete;
  CoarseLevel& operator=(const CoarseLevel&) = delete;

  const CoarseSurface surface;
  const CoarseEmbedding embedding;
  PreparedRegion prepared;  ///< of edits on the coarse surface; guarded by `preparing`
  std::mutex preparing;
};

/// Returns the region on a coarse surface: without the vertices that decimation removed, in coarse
/// indices. `coarse_of` maps vertices of the mesh to coarse vertices, or to kNoIndex. Decimation
/// keeps the corners of targets.
EditRegion coarse_region_of(const EditRegion& region, std::span<const Index> coarse_of);

/// The coarse surfaces of edits with the same ROI of the same mesh. The next edit reuses the last
/// surface if its handles, belt and targets are the same; weights may differ. Thread-safe.
class CoarseSurfaces {
 public:
  /// Returns the surface with about `count` vertices in the region. Calls with equal positions must
  /// pass the same pointer `rest`. Returns null if more than half of the region's vertices would
  /// remain, because decimation must not remove many of them.
  std::shared_ptr<CoarseLevel> of(const EditRegion& region, const Topology& topology,
                                  const std::shared_ptr<const Positions>& rest, std::size_t count);

 private:
  // The last surface, and the inputs of its computation.
  struct Last {
    std::shared_ptr<const Positions> rest;
    std::size_t count = 0;
    std::vector<Index> groups;  // group of each vertex of the mesh (groups_of)
    std::shared_ptr<CoarseLevel> level;
  };

  std::mutex mutex_;  // not locked while a surface is computed
  Last last_;
};

}  // namespace lapwing
