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

/// A file or folder as a list shows it.
struct FolderEntry {
  std::string name;
  bool is_folder = false;
  std::uint64_t bytes = 0;                     ///< of a file
  std::filesystem::file_time_type modified{};  ///< the epoch where it is not known
};

/// What is in a folder: folders first, then files, each by `comes_before`.
struct FolderListing {
  std::filesystem::path folder;
  std::vector<FolderEntry> entries;
  std::string trouble;  ///< why it cannot be read, and what to do; empty otherwise
};

/// What a list leaves out.
struct ListingFilter {
  FileKind kind;              ///< of files; all folders are shown
  bool shows_hidden = false;  ///< what begins with a dot
  bool folders_only = false;
};

/// The order of names for a person: numbers by their value, "part-2" before "part-10", and letters
/// of either case beside each other.
bool comes_before(std::string_view a, std::string_view b);

/// Reads `folder`. Links are followed; one that leads nowhere is left out. Asks `goes_on` before
/// each entry; where that says no, what has been read by then comes back unsorted.
FolderListing list_folder(const std::filesystem::path& folder, const ListingFilter& filter,
                          const std::function<bool()>& goes_on = {});

/// Reads folders beside the window, the one asked for last, so that none that is huge or far away
/// holds a frame up.
class FolderReader {
 public:
  /// `wake` is called on the reader's thread when there is a listing to take.
  explicit FolderReader(std::function<void()> wake = {});
  ~FolderReader();

  /// What was asked for before is given up.
  void read(const std::filesystem::path& folder, const ListingFilter& filter);
  bool is_reading() const;
  /// The listing, once; nothing while it is read.
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
