#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/io/file_bytes.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// A job, one line of a job file.
struct Job {
  std::size_t line = 0;   ///< from 1
  std::string id;         ///< name of its results; by default the line number
  std::string_view text;  ///< the line
  /// Hash of the whole request without the contents of mesh files. Equal for the same recipe with
  /// the same values.
  std::uint64_t asked = 0;
  /// Index of the group of jobs that differ only in moves, in order of appearance.
  std::size_t group = 0;
  std::string error;  ///< error message if the job cannot run; otherwise empty
};

/// A file of jobs, one JSON object per line. Blank lines are skipped:
///
///     {"id": "a-0001", "recipe": "raise.json", "set": {"/steps/0/handles/0/move/degrees": 30}}
///
/// "recipe" is a path relative to the job file, or the recipe itself. "set" maps JSON pointers to
/// values, which replace the values in a copy of the recipe (`set_json`). Thread-safe.
class JobFile {
 public:
  /// Reads `path` and the recipes that it names. `recipe`, unless empty, is the recipe of jobs that
  /// name none. `output` describes the output of each job and is part of the request. A line that
  /// is malformed, or whose id is not a file name, becomes a job with an error. Throws IoError if
  /// `path` or `recipe` cannot be read, and InputError if two lines have the same id. Unless
  /// `sandbox` is empty, all recipes and all files that recipes name must be inside it
  /// (require_inside).
  JobFile(const std::filesystem::path& path, const std::filesystem::path& recipe,
          std::string_view output, const std::filesystem::path& sandbox = {});

  const std::vector<Job>& jobs() const { return jobs_; }
  const std::string& name() const { return name_; }  ///< prefix of messages

  /// Returns the recipe of a job. Throws InputError, which names the line, the recipe and the JSON
  /// pointer.
  Recipe recipe_of(const Job& job) const;

 private:
  struct Line;
  // A recipe file.
  struct Page {
    std::string text;
    std::string error;  ///< error message if it cannot be read; otherwise empty
  };

  void add(std::size_t line, std::string_view text, std::string_view output);
  void require_unique_ids() const;
  Line read_line(const Job& job) const;
  const Page& page(const std::filesystem::path& file);

  std::string name_;
  std::filesystem::path folder_;
  std::filesystem::path default_recipe_;
  std::filesystem::path sandbox_;
  FileBytes bytes_;
  std::map<std::filesystem::path, Page> pages_;
  std::map<std::uint64_t, std::size_t> groups_;
  std::vector<Job> jobs_;
};

/// Returns the FNV-1a hash of `text` appended to a text with the hash `before`. It is the same on
/// every machine.
std::uint64_t hash_of(std::string_view text, std::uint64_t before = 0xcbf29ce484222325);
/// Returns `hash` as 16 hexadecimal digits.
std::string text_of(std::uint64_t hash);

}  // namespace lapwing
