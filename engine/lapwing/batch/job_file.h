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

/// One line of a file of jobs.
struct Job {
  std::size_t line = 0;   ///< from 1
  std::string id;         ///< the name of what it makes; the line's number where it says none
  std::string_view text;  ///< of the line
  /// Of all that the line asks for but for the content of mesh files: the same for the same recipe
  /// with the same values.
  std::uint64_t asked = 0;
  /// The same for jobs that differ in moves alone, from 0 in order of appearance.
  std::size_t group = 0;
  std::string
      error;  ///< why it cannot be carried out, with the place; empty where nothing is known
};

/// A file of jobs, one JSON object a line; lines with nothing but blanks are passed over:
///
///     {"id": "a-0001", "recipe": "raise.json", "set": {"/steps/0/handles/0/move/degrees": 30}}
///
/// "recipe" is a path relative to the file, or the recipe itself; "set" are values by JSON pointer
/// (`set_json`), put into a copy of it. Not changed after construction: threads may ask at once.
class JobFile {
 public:
  /// Reads `path` and the recipes that it names; jobs without one take `recipe` (none if empty).
  /// `output` says what is made of each, which counts as asked for. A line that is no job is a job
  /// with an error, and so is one whose id is no name of a file. Throws IoError where `path` or
  /// `recipe` cannot be read, and InputError where two lines have one id. The recipes that lines
  /// name, and what all recipes name, are refused outside of `sandbox` (require_inside), unless it
  /// is empty.
  JobFile(const std::filesystem::path& path, const std::filesystem::path& recipe,
          std::string_view output, const std::filesystem::path& sandbox = {});

  const std::vector<Job>& jobs() const { return jobs_; }
  const std::string& name() const { return name_; }  ///< as messages begin

  /// What the job asks for. Throws InputError, naming the line, the recipe and the place in it.
  Recipe recipe_of(const Job& job) const;

 private:
  struct Line;
  // A recipe's file.
  struct Page {
    std::string text;
    std::string error;  ///< why it cannot be read; empty if it can
  };

  void add(std::size_t line, std::string_view text, std::string_view output);
  void require_unlike_ids() const;
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

/// A hash (FNV-1a) that is the same on every machine, of `text` behind what has the hash `before`.
std::uint64_t hash_of(std::string_view text, std::uint64_t before = 0xcbf29ce484222325);
/// In 16 hexadecimal digits.
std::string text_of(std::uint64_t hash);

}  // namespace lapwing
