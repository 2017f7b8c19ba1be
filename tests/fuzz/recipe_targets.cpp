// Fuzz targets for JSON documents of every kind.
#include <array>

#include "batch/bent_tubes.h"
#include "fuzz/targets.h"
#include "lapwing/base/errors.h"
#include "lapwing/batch/job_file.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/recipe/recipe.h"
#include "lapwing/recipe/recipe_files.h"
#include "lapwing/transplant/part_library.h"
#include "state/journal.h"

namespace lapwing::fuzz {
namespace {

namespace fs = std::filesystem;

void read_recipe_text(Bytes bytes) {
  try {
    const Recipe recipe = parse_recipe(text_of(bytes), "folder", "fuzz");
    const std::string text = to_json(recipe);
    require(parse_recipe(text, "folder", "fuzz") == recipe, "a recipe is read as it was written");
    require(to_json(parse_recipe(text, "folder", "fuzz")) == text, "and written as it was");
    files_of(recipe);
  } catch (const InputError&) {
  }
}

void read_jobs(Bytes bytes) {
  static const fs::path recipe = file_of(test::kBendTube, "jobs-recipe.json");
  try {
    const JobFile jobs(file_of(bytes, "jobs.jsonl"), recipe, "fuzz", recipe.parent_path());
    for (const Job& job : jobs.jobs()) {
      if (!job.error.empty()) continue;
      require(job.id.find('/') == std::string::npos, "an id names no folder");
      try {
        jobs.recipe_of(job);
      } catch (const InputError&) {
      }
    }
  } catch (const InputError&) {
  }
}

void read_journal_lines(Bytes bytes) {
  const auto path = file_of(bytes, "edit.journal");
  const auto edit = viewer::read_journal(path);
  if (!edit) return;
  for (const auto& [key, where] : edit->results) viewer::read_result(path, where);
}

// Reads `bytes` as the details file of a part whose mesh is valid.
void read_details(Bytes bytes) {
  static const fs::path mesh = [] {
    const fs::path path = file_of("", "part.obj");
    write_mesh(cylinder(6, 3, 0.5, 1.0), path);
    return path;
  }();
  file_of(bytes, "part.json");
  try {
    const Part part = read_part(mesh);
    require(part.loop < part.loops.size(), "the loop is one of the part's");
  } catch (const InputError&) {
  }
}

// Reads a folder with one part. In `bytes`, a line `---` separates the mesh from the details.
void read_whole_part(Bytes bytes) {
  constexpr std::string_view kBetween = "\n---\n";
  const std::string_view text = text_of(bytes);
  const std::size_t end = text.find(kBetween);
  const fs::path mesh = file_of(text.substr(0, end), "whole.obj");
  const fs::path details = mesh.parent_path() / "whole.json";
  fs::remove(details);
  if (end != text.npos) file_of(text.substr(end + kBetween.size()), "whole.json");
  try {
    const Part part = read_part(mesh);
    require(part.loop < part.loops.size(), "the loop is one of the part's");
    for (const BoundaryLoop& loop : part.loops) {
      require(loop.size() >= 3, "a loop goes around something");
      for (const Index v : loop) require(v < part.mesh.vertex_count(), "a vertex");
    }
  } catch (const InputError&) {
  }
}

// Every operation and every key once.
std::vector<std::string> recipe_seeds() {
  const std::string head = R"({"lapwing": 1, "mesh": "a.obj", "save": "b.obj", "steps": [)";
  std::vector<std::string> seeds{test::kBendTube};
  seeds.push_back(head + R"({"op": "deform", "roi": {"union": [{"near": [0, 0, 0], "radius": 1},
      {"difference": [{"all": true}, {"vertices": [1, 2]}]}]}, "belt": {"fraction": 0.1},
      "handles": [{"region": {"disk": {"center": 3, "radius": 1}}, "falloff": {"width": 0.1},
        "move": {"translate": [1, 2, 3], "rotate": {"axis": [0, 0, 1], "degrees": 30},
                 "scale": [1, 2, 1], "pivot": [0, 0, 0]}},
       {"region": {"vertices": [4]}, "move": {"matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}}],
      "targets": {"vertices": [5], "positions": [[0, 0, 1]], "weights": 2}, "mirror": {"plane": "x"},
      "constraint_weight": 2, "detail_length": "auto", "commit_every": 20,
      "carry": ["hat.obj", {"file": "p.csv", "save": "q.csv"}]}]})");
  seeds.push_back(head +
                  R"({"op": "coat", "source": "s.ply", "source_patch": {"disk_in": {"all": true}},
      "target_patch": {"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}, "detail_size": 0.2,
      "smooth_target": 0.5, "amplitude": 2, "transition": {"width": 0.1, "profile": "linear"},
      "pins": [[1, 2], [3, 4]], "domain": "square", "remesh": "none"}]})");
  seeds.push_back(head + R"({"op": "mix", "sources": [{"mesh": "s.ply", "patch": {"all": true},
      "detail_size": 1}, {"mesh": "t.ply", "patch": {"all": true}, "detail_size": 1}],
      "target_patch": {"all": true}, "weight": {"domain_v": [0, 1]}}]})");
  seeds.push_back(head + R"({"op": "transplant", "part": {"mesh": "p.obj", "region": {"all": true}},
      "target_region": {"all": true}, "place": {"auto": {"rotate_degrees": 10, "scale": 2,
      "keep_size": false}}, "transition": 0.1, "loop": 0, "snap": true}]})");
  return seeds;
}
std::vector<std::string> job_seeds() {
  return {R"({"id": "a-1", "set": {"/steps/0/handles/0/move/translate": [1, 2, 3]}})"
          "\n\n"
          R"({"id": 2, "recipe": "jobs-recipe.json", "set": {"/steps/0/handles/-": {}}})"
          "\n"
          R"({"recipe": {"lapwing": 1, "mesh": "m.obj", "steps": []}, "set": {"/save": "x.ply"}})"
          "\n"};
}
std::vector<std::string> journal_seeds() {
  return {R"({"lapwing_journal": 2, "mesh": "/a.obj", "bytes": 10, "modified": 3})"
          "\n"
          R"({"keep": 0, "add": [], "open": {"op": "deform", "roi": {"all": true}, "handles": )"
          R"([{"region": {"vertices": [1]}, "move": {"translate": [0, 0, 1]}}]}, "handles": 1, )"
          R"("settled": false})"
          "\n"
          R"({"result": 17, "start": 10, "vertices": 2})"
          "\n"
          R"({"mesh": {"lapwing_journal": 3, "mesh": "/b.obj", "bytes": 1, "modified": 2}})"
          "\n"};
}
std::vector<std::string> details_seeds() {
  return {R"({"loop": 1})", R"({"loop": 99})"};
}

std::vector<std::string> part_seeds() {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  return {triangle + "f 1 2 3\n---\n{\"loop\": 0}",
          triangle + "v 0 0 1\nv 2 2 2\nf 1 2 3\nf 1 3 4\nf 5 4 2\n",
          triangle + "v 1 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 4 3\nf 5 6 7\n---\n{\"loop\": 1}"};
}

constexpr std::array kRecipeTargets{
    Target{"recipe", "read, written, read: the same recipe", &read_recipe_text, &recipe_seeds,
           "recipe.dict", 1000},
    Target{"jobs", "jobs of a batch, with what they set in a recipe", &read_jobs, &job_seeds,
           "recipe.dict", 400},
    Target{"journal", "the record of an interrupted edit", &read_journal_lines, &journal_seeds,
           "recipe.dict", 400},
    Target{"details", "what stands beside a part", &read_details, &details_seeds, "recipe.dict",
           200},
    Target{"part", "the mesh of a part and its details", &read_whole_part, &part_seeds, "obj.dict",
           400}};

}  // namespace

std::span<const Target> recipe_targets() {
  return kRecipeTargets;
}

}  // namespace lapwing::fuzz
