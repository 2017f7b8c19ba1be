#pragma once

#include <string>
#include <string_view>

namespace lapwing {

/// The relative path that a URI means: "my%20mesh.bin" is "my mesh.bin".
std::string path_of_uri(std::string_view uri);
/// The other way round.
std::string uri_of_path(std::string_view path);

}  // namespace lapwing
