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
  std::uint64_t bytes = 0;                     ///< of a file
  std::filesystem::file_time_type modified{};  ///< the epoch if it is not known
};

/// The contents of a folder: folders first, then files, each sorted by `comes_before`.
struct FolderListing {
  std::filesystem::path folder;
  std::vector<FolderEntry> entries;
  std::string trouble;  ///< why it cannot be read, and what to do; empty otherwise
};

/// Selects the entries of a listing.
struct ListingFilter {
  FileKind kind;              ///< for files; folders always show
  bool shows_hidden = false;  ///< also names that begin with a dot
  bool folders_only = false;
};

/// The natural order of names: numbers by value ("part-2" before "part-10"), letters regardless of
/// case.
bool comes_before(std::string_view a, std::string_view b);

/// Lists `folder`. Follows symbolic links and omits broken ones. Calls `check_cancelled`, so that a
/// Job can cancel it.
FolderListing list_folder(const std::filesystem::path& folder, const ListingFilter& filter);

}  // namespace lapwing::viewer
