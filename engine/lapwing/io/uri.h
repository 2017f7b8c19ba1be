#pragma once

#include <string>
#include <string_view>

namespace lapwing {

/// Returns the relative path of a URI: "my%20mesh.bin" becomes "my mesh.bin".
std::string path_of_uri(std::string_view uri);
/// Returns the URI of a relative path.
std::string uri_of_path(std::string_view path);

}  // namespace lapwing
