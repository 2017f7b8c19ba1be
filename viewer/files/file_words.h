#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lapwing::viewer {

/// "2004-07-08 14:05", by the clock on the wall.
std::string date_in_words(std::filesystem::file_time_type time);

/// "512 B", "1.5 KB", "23 MB": at least two digits of what is more than a kilobyte, of 1000 bytes.
std::string size_in_words(std::uint64_t bytes);

}  // namespace lapwing::viewer
