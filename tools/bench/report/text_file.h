#pragma once

#include <string>

namespace lapwing::bench {

/// Throws IoError when the file cannot be written; leaves what it holds.
void require_writable(const std::string& path);

/// Replaces what the file holds. Throws IoError when it cannot be written.
void write_text(const std::string& path, const std::string& text);

}  // namespace lapwing::bench
