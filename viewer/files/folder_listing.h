#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "files/file_purpose.h"

namespace lapwing::viewer {

/// A file or folder in a listing.
struct FolderEntry {
  std::string name;
  bool is_folder = false;
  std::uint64_t bytes = 0;                     ///< size of a file; 0 for a folder
  std::filesystem::file_time_type modified{};  ///< the epoch of the file clock if unknown
};

/// The contents of a folder: folders first, then files, each sorted by `comes_before`.
struct FolderListing {
  std::filesystem::path folder;
  std::vector<FolderEntry> entries;
  std::string trouble;  ///< message if the folder cannot be read; otherwise empty
};

/// Selects the entries of a listing.
struct ListingFilter {
  FileKind kind;              ///< filter for files; folders are always listed
  bool shows_hidden = false;  ///< also list names that begin with a dot
  bool folders_only = false;
};

/// Returns whether `a` precedes `b` in natural order, which compares numbers by value ("part-2"
/// before "part-10") and ignores upper and lower case.
bool comes_before(std::string_view a, std::string_view b);

/// Lists `folder`. Follows symbolic links and omits broken ones. Calls `check_cancelled`, so that a
/// Job can cancel it.
FolderListing list_folder(const std::filesystem::path& folder, const ListingFilter& filter);

}  // namespace lapwing::viewer
