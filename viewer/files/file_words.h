#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lapwing::viewer {

/// Returns the local time, as in "2004-07-08 14:05".
std::string date_in_words(std::filesystem::file_time_type time);

/// Returns the size, as in "512 B", "1.5 KB", "23 MB". A kilobyte is 1000 bytes, and larger sizes
/// have at least two digits.
std::string size_in_words(std::uint64_t bytes);

}  // namespace lapwing::viewer
