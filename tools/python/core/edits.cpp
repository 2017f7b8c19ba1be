#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>
#include <utility>

#include "arrays.h"
#include "interruptible.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/prepared_deform.h"
#include "lapwing/recipe/recipe.h"
#include "lapwing/recipe/step.h"
#include "lapwing/run/mesh_cache.h"
#include "lapwing/run/run_recipe.h"
#include "lapwing/vulkan/open_device.h"
#include "messages.h"
#include "module.h"
#include "result.h"

namespace lapwing::python {
namespace {

using NamedMeshes = std::map<std::string, Mesh>;

void put(const NamedMeshes& meshes, MeshCache& shelf) {
  for (const auto& [name, mesh] : meshes) shelf.put(name, mesh);
}

// Runs the step `step_json` on `mesh`. `name` is the name of the JSON text in messages.
Result carry_out(const Mesh& mesh, const std::string& step_json, const std::string& name,
                 const NamedMeshes& meshes, const std::string& device, const py::object& heard) {
  return Interruptible(heard).call([&](const Progress& progress) {
    const Step step = read_step(JsonNode::parse(step_json, name));
    const Device opened = open_device(device);
    MeshCache shelf;
    put(meshes, shelf);
    RunResult run;
    run.mesh = mesh;
    run.original = mesh.positions;
    run.report.device = opened.kernels->device();
    if (!opened.note.empty()) run.report.notes.push_back(opened.note);
    run.report.vertices = mesh.vertex_count();
    run.report.faces = mesh.face_count();
    run.report.steps.push_back(
        run_step(step, {0, std::filesystem::path(), *opened.kernels, progress, run, shelf}));
    return Result{std::move(run.mesh), std::move(run.original), std::move(run.region),
                  std::move(run.report)};
  });
}

Result run(const std::string& recipe_json, const std::filesystem::path& folder,
           const NamedMeshes& meshes, const std::string& device, bool saves,
           const py::object& heard) {
  return Interruptible(heard).call([&](const Progress& progress) {
    const Recipe recipe = parse_recipe(recipe_json, folder, "recipe");
    const Device opened = open_device(device);
    MeshCache shelf;
    put(meshes, shelf);
    const auto result = run_recipe(recipe, *opened.kernels, progress, {.meshes = &shelf});
    if (!opened.note.empty()) result->report.notes.push_back(opened.note);
    if (saves && !recipe.save.empty()) save_result(*result, recipe.save_path());
    return Result{std::move(result->mesh), std::move(result->original), std::move(result->region),
                  std::move(result->report)};
  });
}

// A deform that is prepared once. Concurrent calls run one after another.
class Edit {
 public:
  Edit(const Mesh& mesh, const std::string& step_json, const py::object& heard) {
    prepared_ = Interruptible(heard).call([&](const Progress& progress) {
      const Step step = read_step(JsonNode::parse(step_json, "Deformer"));
      return std::make_unique<PreparedDeform>(mesh, std::get<DeformRequest>(step), progress);
    });
  }

  Edit(const Edit&) = delete;
  Edit& operator=(const Edit&) = delete;
  // Release the GIL, because freeing a large factor takes time.
  ~Edit() {
    const py::gil_scoped_release unlocked;
    prepared_.reset();
  }

  // If `free` is None, uses the orientations of the step.
  Result solve(const py::object& motions, const std::optional<std::vector<bool>>& free,
               const py::object& heard) {
    const Motions matrices(motions, handle_count());
    return Interruptible(heard).call([&](const Progress& progress) {
      const std::lock_guard lock(mutex_);
      if (!free) return result_of(prepared_->solve(moves(matrices, 0), progress));
      std::vector<HandleOrientation> orientations;
      for (const bool is_free : *free) {
        orientations.push_back(is_free ? HandleOrientation::free : HandleOrientation::kept);
      }
      return result_of(prepared_->solve(moves(matrices, 0), orientations, progress));
    });
  }

  // Returns the vertices, of shape (k, n, 3), and a list of certificates.
  template <class Number>
  py::tuple solve_many(const py::object& motions, unsigned threads, const py::object& heard) {
    const Motions matrices(motions, handle_count());
    const std::size_t rows = prepared_->mesh().vertex_count();
    py::array_t<Number> vertices({static_cast<py::ssize_t>(matrices.count()),
                                  static_cast<py::ssize_t>(rows), py::ssize_t{3}});
    Number* const numbers = vertices.mutable_data();
    std::vector<Certificate> certificates(matrices.count());
    Interruptible(heard).call([&](const Progress& progress) {
      const std::lock_guard lock(mutex_);
      prepared_->solve_many(
          matrices.count(), [&](std::size_t k) { return moves(matrices, k); },
          [&](std::size_t k, Deformed&& result) {
            Number* to = numbers + k * rows * 3;
            for (const Eigen::Vector3d& v : result.mesh.positions) {
              for (const double x : v) *to++ = static_cast<Number>(x);
            }
            certificates[k] = std::move(result.certificate);
          },
          threads, progress);
      return true;
    });
    return py::make_tuple(std::move(vertices), std::move(certificates));
  }

  // Returns the columns, of shape (k, 3, 4, n, 3), the centres, of shape (k, 3), and the reason why
  // the system is not exact.
  py::tuple response(const std::vector<std::size_t>& handles, const py::object& heard) {
    const SurfaceResponse response = Interruptible(heard).call([&](const Progress& progress) {
      const std::lock_guard lock(mutex_);
      return prepared_->response(handles, progress);
    });
    const auto count = static_cast<py::ssize_t>(handles.size());
    const auto rows = static_cast<py::ssize_t>(response.vertex_count);
    py::array_t<double> columns({count, py::ssize_t{3}, py::ssize_t{4}, rows, py::ssize_t{3}});
    double* to = columns.mutable_data();
    {
      const py::gil_scoped_release unlocked;  // the copy takes time
      for (const Eigen::Vector3d& v : response.columns) to = std::copy(v.data(), v.data() + 3, to);
    }
    return py::make_tuple(std::move(columns), array_of(response.centers),
                          in_python_words(response.why_not_exact));
  }

  const PreparedDeform& prepared() const { return *prepared_; }
  std::size_t handle_count() const { return prepared_->request().handles.size(); }

 private:
  static std::vector<Move> moves(const Motions& matrices, std::size_t k) {
    std::vector<Move> all;
    for (std::size_t h = 0; h < matrices.handles(); ++h) {
      all.emplace_back(MatrixMove{matrices.matrix(k, h)});
    }
    return all;
  }

  Result result_of(Deformed done) const {
    RunReport report;
    report.vertices = done.mesh.vertex_count();
    report.faces = done.mesh.face_count();
    report.steps.push_back(report_of(done));
    report.steps.back().op = "deform";
    report.warnings = std::move(done.warnings);
    report.notes = std::move(done.notes);
    return {std::move(done.mesh), prepared_->mesh().positions, std::move(done.region),
            std::move(report)};
  }

  std::unique_ptr<PreparedDeform> prepared_;
  std::mutex mutex_;
};

std::string keys(const std::string& op) {
  std::string known;
  for (const Operation& operation : operations()) {
    if (operation.name == op) return key_table(operation);
    known += (known.empty() ? "" : ", ") + std::string(operation.name);
  }
  throw InputError("unknown operation \"" + op + "\"; choose one of " + known);
}

}  // namespace

void add_edits(py::module_& module) {
  module.def("run_step", &carry_out, py::arg("mesh"), py::arg("step"), py::arg("name"),
             py::arg("meshes"), py::arg("device"), py::arg("progress"));
  module.def("run", &run, py::arg("recipe"), py::arg("folder"), py::arg("meshes"),
             py::arg("device"), py::arg("save"), py::arg("progress"));
  py::class_<Edit>(module, "Edit")
      .def(py::init<const Mesh&, const std::string&, const py::object&>(), py::arg("mesh"),
           py::arg("step"), py::arg("progress"))
      .def("solve", &Edit::solve, py::arg("motions"), py::arg("free"), py::arg("progress"))
      .def("solve_many", &Edit::solve_many<double>, py::arg("motions"), py::arg("threads"),
           py::arg("progress"))
      .def("solve_many_float32", &Edit::solve_many<float>, py::arg("motions"), py::arg("threads"),
           py::arg("progress"))
      .def("response", &Edit::response, py::arg("handles"), py::arg("progress"))
      .def_property_readonly("handle_count", &Edit::handle_count)
      .def_property_readonly("mesh", [](const Edit& edit) { return edit.prepared().mesh(); })
      .def_property_readonly(
          "roi", [](const Edit& edit) { return read_only(array_of(edit.prepared().region().roi)); })
      .def_property_readonly(
          "belt",
          [](const Edit& edit) { return read_only(array_of(edit.prepared().region().belt)); })
      .def_property_readonly("handles", [](const Edit& edit) {
        py::list handles;
        for (const VertexSet& handle : edit.prepared().region().handles) {
          handles.append(array_of(handle));
        }
        return read_only(handles);
      });
  module.def("key_table", &keys, py::arg("op"));
  module.def("operations", [] {
    std::vector<std::string> names;
    for (const Operation& operation : operations()) names.emplace_back(operation.name);
    return names;
  });
}

}  // namespace lapwing::python
