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
  /// Extension of the mesh file, without a dot. If empty, the extension of the recipe's "save", or
  /// ply.
  std::string extension = {};
  /// Type (float32 or float64) of the displacements, if these are written instead of a mesh.
  std::optional<Scalar> displacements = {};

  /// Returns a text that identifies the output.
  std::string words() const;
};

/// Writes the results of jobs to a folder. Thread-safe.
class ResultWriter {
 public:
  /// `meshes` must outlive the object. `first_mesh` is the mesh file of the first job; its rest
  /// mesh is saved as rest.ply. Throws InputError unless the extension belongs to a mesh format.
  ResultWriter(std::filesystem::path folder, BatchOutput output, const MeshCache& meshes,
               std::filesystem::path first_mesh);

  /// Writes `result` of `recipe`: a mesh, such as ID.ply, or ID.npy with the displacements from the
  /// mesh as read. That rest mesh is written to the same folder, as rest.ply for `first_mesh` and
  /// as rest-NAME-HASH.ply for others. Attachment files are written as ID-NAME-carried.obj. Returns
  /// the line for the results, without line end. Throws InputError if the result cannot be written
  /// in this format, and IoError.
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
  std::set<std::string> rests_;  ///< names of the rest meshes written so far
};

}  // namespace lapwing
