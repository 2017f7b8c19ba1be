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

/// A coarse surface, how a region is carried along with it, and what edits on it share.
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

/// The coarse surfaces of all edits with one ROI of one mesh. If handles, belt and targets are
/// those of the last edit, its surface serves the next one, whatever the weights. Otherwise the
/// merges of the first edit are repeated but for those near new borders (decimate_again), unless
/// many vertices that it kept one by one have been released; so a surface depends on the first
/// edit, too. Keeps about 190 bytes per vertex. Thread-safe.
class CoarseSurfaces {
 public:
  CoarseSurfaces();
  ~CoarseSurfaces();

  /// Prepares the first decimation up to its first merge, for an edit that will call `of`. Keeps
  /// about 320 bytes per vertex until then. Does nothing after the first.
  void begin(const EditRegion& region, const Topology& topology,
             const std::shared_ptr<const Positions>& rest);

  /// The surface with about `count` vertices in the region; `rest` is the same pointer for the same
  /// positions. Returns null if more than half of the vertices would remain, because too many are
  /// held one by one.
  std::shared_ptr<CoarseLevel> of(const EditRegion& region, const Topology& topology,
                                  const std::shared_ptr<const Positions>& rest, std::size_t count);

 private:
  // The last surface and the inputs it was made from.
  struct Last {
    std::shared_ptr<const Positions> rest;
    std::size_t count = 0;
    std::vector<Index> groups;  // per vertex of the mesh: what it may be merged with
    std::shared_ptr<CoarseLevel> level;
  };
  struct First {
    std::shared_ptr<const Positions> rest;
    std::vector<Index> groups;
    std::shared_ptr<const MergeHistory> merges;
  };
  struct Begun;
  std::unique_ptr<Begun> take_begun(const std::shared_ptr<const Positions>& rest,
                                    const std::vector<Index>& groups);

  std::mutex mutex_;  // not held while a surface is made
  std::unique_ptr<Begun> begun_;
  Last last_;
  First first_;
};

}  // namespace lapwing
