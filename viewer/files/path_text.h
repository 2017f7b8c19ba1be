#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace lapwing::viewer {

/// Returns the user's home folder, $HOME. Empty if $HOME is not an absolute path.
std::filesystem::path home_folder();

/// Returns `path` for display. In the home folder it starts with "~", as in "~/models/hand.ply".
std::string with_tilde(const std::filesystem::path& path);

/// Converts a typed path to an absolute path. "~" is the home folder, and relative paths start in
/// `folder`. Resolves "." and ".." without following links. Ignores spaces at both ends of `typed`.
/// Does not access the disk.
std::filesystem::path path_of(std::string_view typed, const std::filesystem::path& folder);

/// Extends `typed` to the longest common prefix of the matching file names. For example, "a"
/// becomes "arm-" if the folder contains "arm-1.ply" and "arm-2.ply". If no name matches, matches
/// without regard to case; the result then has the case of the file name. Ignores hidden files
/// unless the typed name begins with a dot. Returns `typed` if nothing matches. Reads one folder
/// from the disk.
std::string completed(std::string_view typed, const std::filesystem::path& folder);

/// Returns the local date and time, as in "2004-07-08 14:05".
std::string date_in_words(std::filesystem::file_time_type time);

/// Returns the size as text, such as "512 B", "1.5 KB" or "23 MB". A kilobyte is 1000 bytes. Sizes
/// of at least one kilobyte have at least two digits.
std::string size_in_words(std::uint64_t bytes);

/// Convert ASCII letters to lower case. Other bytes do not change.
char lower_case(char c);
std::string lower_case(std::string text);

}  // namespace lapwing::viewer
