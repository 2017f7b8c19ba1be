#include "lapwing/base/errors.h"

#include <filesystem>

#include "arrays.h"
#include "messages.h"
#include "module.h"

namespace lapwing::python {
namespace {

// The Python classes of exceptions. They exist until the process ends, like the module.
struct Classes {
  py::handle error;
  py::handle input;
  py::handle solver;
  py::handle device;
  py::handle file;
};
Classes classes;

py::handle add_class(py::module_& module, const char* name, py::handle base, py::handle also,
                     const char* help) {
  const std::string full = "lapwing." + std::string(name);
  const py::tuple bases = also ? py::make_tuple(base, also) : py::make_tuple(base);
  py::handle made = PyErr_NewExceptionWithDoc(full.c_str(), help, bases.ptr(), nullptr);
  if (!made) throw py::error_already_set();
  module.add_object(name, made);
  return made;
}

void raise(py::handle type, const char* message, std::span<const Index> vertices = {}) {
  const py::object error = type(in_python_words(message));
  error.attr("vertices") = array_of(vertices);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Cancelled&) {
    // After Ctrl+C, Python has already set an exception such as KeyboardInterrupt.
    if (PyErr_Occurred() == nullptr) raise(classes.error, "cancelled");
  } catch (const InputError& error) {
    raise(classes.input, error.what(), error.vertices());
  } catch (const SolverError& error) {
    raise(classes.solver, error.what(), error.vertices());
  } catch (const GpuError& error) {
    raise(classes.device, error.what());
  } catch (const IoError& error) {
    raise(classes.file, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    raise(classes.file, error.what());
  }
}

}  // namespace

void add_errors(py::module_& module) {
  classes.error = add_class(module, "Error", PyExc_Exception, {},
                            "Base of the exceptions that Lapwing raises. `vertices` are all "
                            "vertices that the message is about; empty if it is about none.");
  classes.error.attr("vertices") = array_of(std::span<const Index>());
  classes.input = add_class(module, "InputError", classes.error, PyExc_ValueError,
                            "An array, region or key does not fit, or a file is malformed.");
  classes.solver = add_class(module, "SolverError", classes.error, PyExc_ArithmeticError,
                             "A system cannot be solved, or a result is not valid.");
  classes.device = add_class(module, "DeviceError", classes.error, PyExc_RuntimeError,
                             "No Vulkan device fits, or it failed.");
  classes.file = add_class(module, "FileError", classes.error, PyExc_OSError,
                           "A file cannot be opened, read or written.");
  py::register_exception_translator(translate);
  module.def("_in_python_words", py::overload_cast<std::string>(&in_python_words));
}

}  // namespace lapwing::python
