#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lapwing/base/printable_text.h"

namespace lapwing {

/// Base of everything the engine throws. `what()` names the place (file and line, vertex, JSON
/// pointer, device) and the next step, in words a user of the command line can act on; it is one
/// line of printable text (see printable), whatever the names and files say that it quotes.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& what, std::vector<std::uint32_t> vertices = {})
      : std::runtime_error(printable(what)), vertices_(std::move(vertices)) {}

  /// The vertices that the message is about, all of them where it names the first few; empty where
  /// it is about none. Of a transplant or coat they may be those of the other mesh.
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }

 private:
  std::vector<std::uint32_t> vertices_;
};

/// What the caller gave cannot be used: a malformed file, a recipe with an unknown key, a region
/// that does not fit the mesh.
class InputError : public Error {
 public:
  using Error::Error;
};

/// A system that cannot be solved, or a result that its certificate rejects.
class SolverError : public Error {
 public:
  using Error::Error;
};

/// A Vulkan call failed, or no device fits.
class GpuError : public Error {
 public:
  using Error::Error;
};

/// A file cannot be opened, read or written.
class IoError : public Error {
 public:
  using Error::Error;
};

/// The caller's progress callback asked to stop. Nothing was changed.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace lapwing
