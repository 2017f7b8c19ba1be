#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "lapwing/batch/job_file.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/run/run_step.h"

namespace lapwing {

/// The output of each job.
struct BatchOutput {
  /// Extension of the mesh, without a dot. Empty: that of the recipe's "save", or ply.
  std::string extension = {};
  /// Type of displacements (float32 or float64) to write instead of a mesh.
  std::optional<Scalar> displacements = {};

  /// Returns a text that is different for every output.
  std::string words() const;
};

/// Writes the results of jobs into a folder. Threads may write at once.
class ResultWriter {
 public:
  /// `meshes` must outlive the object. `first_mesh` is the mesh file of the first job, whose rest
  /// mesh is rest.ply. Throws InputError if the extension is not that of a mesh format.
  ResultWriter(std::filesystem::path folder, BatchOutput output, const MeshCache& meshes,
               std::filesystem::path first_mesh);

  /// Writes `result` of `recipe`: a mesh, such as ID.ply, or ID.npy, the displacements from the
  /// mesh as read. That rest mesh is written beside it, as rest.ply for the first mesh and as
  /// rest-NAME-HASH.ply for others. Carried files become ID-NAME-carried.obj. Returns the line for
  /// the results, without its end. Throws InputError if the result cannot be written in this form,
  /// and IoError if the system refuses.
  std::string write(const Job& job, const Recipe& recipe, RunResult& result);

 private:
  std::string file_name(const Job& job, const Recipe& recipe) const;
  std::string write_rest(const Recipe& recipe, const Mesh& rest);
  void write_displacements(const std::filesystem::path& path, const Mesh& rest,
                           const RunResult& result, Scalar type) const;

  std::filesystem::path folder_;
  BatchOutput output_;
  const MeshCache& meshes_;
  std::filesystem::path first_mesh_;
  std::mutex mutex_;
  std::set<std::string> rests_;  ///< written so far
};

}  // namespace lapwing
