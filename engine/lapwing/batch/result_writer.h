#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "lapwing/batch/job_file.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// What a batch makes of each job.
struct BatchOutput {
  /// The mesh's extension without its dot; empty: that of the recipe's "save", or ply.
  std::string extension = {};
  /// Displacements of this type (float32 or float64) in place of meshes.
  std::optional<Scalar> displacements = {};

  /// Another text for another output.
  std::string words() const;
};

/// Writes what jobs come to into one folder. Threads may write at once.
class ResultWriter {
 public:
  /// `meshes` must outlive it. `first_mesh` is the mesh file of the batch's first job, whose rest
  /// mesh is rest.ply. Throws InputError for an extension of no mesh format.
  ResultWriter(std::filesystem::path folder, BatchOutput output, const MeshShelf& meshes,
               std::filesystem::path first_mesh);

  /// Writes what `result` of `recipe` has come to: ID.ply, say, or ID.npy, the displacements from
  /// the mesh as it was read, which is beside it as rest.ply, or rest-NAME-HASH.ply for another
  /// than the first; and beside that what was carried along, as ID-NAME-carried.obj. Returns the
  /// line that says so, without its end. Throws InputError for a result that cannot be written so,
  /// and IoError where the system refuses.
  std::string write(const Job& job, const Recipe& recipe, RunResult& result);

 private:
  std::string file_name(const Job& job, const Recipe& recipe) const;
  std::string write_rest(const Recipe& recipe, const Mesh& rest);
  void write_displacements(const std::filesystem::path& path, const Mesh& rest,
                           const RunResult& result) const;

  std::filesystem::path folder_;
  BatchOutput output_;
  const MeshShelf& meshes_;
  std::filesystem::path first_mesh_;
  std::mutex mutex_;
  std::set<std::string> rests_;  ///< written so far
};

}  // namespace lapwing
