#pragma once

#include <string>

namespace lapwing::bench {

/// Throws IoError if the file cannot be written. Does not change its contents.
void require_writable(const std::string& path);

/// Replaces the contents of the file. Throws IoError if it cannot be written.
void write_text(const std::string& path, const std::string& text);

}  // namespace lapwing::bench
