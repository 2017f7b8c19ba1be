#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lapwing/base/printable_text.h"

namespace lapwing {

/// Base of all exceptions of the engine. `what()` names the location (file and line, vertex, JSON
/// pointer, device) and the next step, in terms of the command line. It is one line of printable
/// text, even if it quotes names or files (see `printable`).
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& what, std::vector<std::uint32_t> vertices = {})
      : std::runtime_error(printable(what)), vertices_(std::move(vertices)) {}

  /// Returns all vertices that cause the error, of which the message may name only some. May be
  /// empty. In a transplant or coat, they may belong to the other mesh.
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }

 private:
  std::vector<std::uint32_t> vertices_;
};

/// The input is invalid: a malformed file, a recipe with an unknown key, a region that does not fit
/// the mesh.
class InputError : public Error {
 public:
  using Error::Error;
};

/// A system cannot be solved, or the certificate of a result fails.
class SolverError : public Error {
 public:
  using Error::Error;
};

/// A Vulkan call failed, or no device is suitable.
class GpuError : public Error {
 public:
  using Error::Error;
};

/// A file cannot be opened, read or written.
class IoError : public Error {
 public:
  using Error::Error;
};

/// The progress callback returned false. Nothing was changed.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace lapwing
