#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/file_purpose.h"
#include "work/worker.h"

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

/// Reads `folder`. Follows links and leaves out broken ones. Calls `goes_on` before each entry; if
/// it returns false, returns the entries so far, unsorted.
FolderListing list_folder(const std::filesystem::path& folder, const ListingFilter& filter,
                          const std::function<bool()>& goes_on = {});

/// Reads folders on a background thread, so that a huge or remote folder does not delay a frame.
/// Only the last request counts.
class FolderReader {
 public:
  /// `wake` is called on the reader's thread when there is a listing to take.
  explicit FolderReader(std::function<void()> wake = {});
  ~FolderReader();

  /// Starts to read `folder` and drops the previous request.
  void read(const std::filesystem::path& folder, const ListingFilter& filter);
  bool is_reading() const;
  /// Returns the listing once; nullopt while it is being read.
  std::optional<FolderListing> take();

 private:
  struct Request {
    std::filesystem::path folder;
    ListingFilter filter;
  };
  Worker::Work next();

  // Guarded by the worker's mutex.
  std::uint64_t ticket_ = 0;
  std::optional<Request> request_;
  std::optional<FolderListing> listing_;
  bool reading_ = false;

  Worker worker_;  // last: it uses all the others
};

}  // namespace lapwing::viewer
