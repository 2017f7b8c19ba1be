#pragma once

#include <filesystem>
#include <string>

namespace lapwing::test {

/// Drops `file` on the X window number `window` of the display ":N", as a file manager does (XDND,
/// version 5). Whether the window took it, which it has a few seconds for.
bool drop_file(const std::string& display, const std::string& window,
               const std::filesystem::path& file);

}  // namespace lapwing::test
