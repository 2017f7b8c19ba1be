#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace lapwing::viewer {

/// Returns the user's home folder from $HOME; empty if that is not an absolute path.
std::filesystem::path home_folder();

/// Returns `path` for display. If it is in the home folder it starts with "~", as in
/// "~/models/hand.ply".
std::string with_tilde(const std::filesystem::path& path);

/// Returns the absolute path that the user means by `typed`. "~" and "~/x" are in the home folder,
/// a relative path is in `folder`, "." and ".." are resolved by name. Ignores spaces around it.
/// Does not access the disk.
std::filesystem::path path_of(std::string_view typed, const std::filesystem::path& folder);

/// Extends `typed` to the longest common prefix of the matching file names. For example, "a"
/// becomes "arm-" if the folder contains "arm-1.ply" and "arm-2.ply". If no name matches, ignores
/// case and corrects it in the result. Ignores hidden files unless the user has typed their dot.
/// Returns `typed` if nothing matches. Reads one folder from the disk.
std::string completed(std::string_view typed, const std::filesystem::path& folder);

/// Returns the local time, as in "2004-07-08 14:05".
std::string date_in_words(std::filesystem::file_time_type time);

/// Returns the size, as in "512 B", "1.5 KB", "23 MB". A kilobyte is 1000 bytes, and larger sizes
/// have at least two digits.
std::string size_in_words(std::uint64_t bytes);

/// Converts ASCII letters; other bytes stay.
char lower_case(char c);
std::string lower_case(std::string text);

}  // namespace lapwing::viewer
