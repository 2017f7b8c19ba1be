#include "files/folder_listing.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "files/path_text.h"
#include "lapwing/base/cancellation.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Removes the number at the start of `text` and returns it without leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  while (number.size() > 1 && number.front() == '0') number.remove_prefix(1);
  return number;
}

std::optional<FolderEntry> entry_of(const fs::directory_entry& found, const ListingFilter& filter) {
  FolderEntry entry;
  entry.name = found.path().filename().string();
  if (!filter.shows_hidden && entry.name.starts_with('.')) return {};
  std::error_code error;
  entry.is_folder = found.is_directory(error);
  if (error || (!entry.is_folder && !found.is_regular_file(error))) return {};
  if (!entry.is_folder) {
    if (filter.folders_only || !filter.kind.holds(found.path())) return {};
    entry.bytes = found.file_size(error);
  }
  entry.modified = found.last_write_time(error);
  if (error) entry.modified = {};
  return entry;
}

}  // namespace

bool comes_before(std::string_view a, std::string_view b) {
  const std::string_view all_a = a;
  const std::string_view all_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view left = take_number(a);
      const std::string_view right = take_number(b);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
      continue;
    }
    const auto left = static_cast<unsigned char>(lower_case(a.front()));
    const auto right = static_cast<unsigned char>(lower_case(b.front()));
    if (left != right) return left < right;
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  if (a.empty() != b.empty()) return a.empty();
  return all_a < all_b;
}

FolderListing list_folder(const fs::path& folder, const ListingFilter& filter) {
  FolderListing listing;
  listing.folder = folder;
  std::error_code error;
  for (fs::directory_iterator found(folder, error), end; !error && found != end;
       found.increment(error)) {
    check_cancelled();
    if (auto entry = entry_of(*found, filter)) listing.entries.push_back(*std::move(entry));
  }
  if (error) {
    listing.trouble = folder.string() + " cannot be read: " + error.message() +
                      ". Choose another folder, or type the path of the file.";
  }
  std::sort(listing.entries.begin(), listing.entries.end(),
            [](const FolderEntry& a, const FolderEntry& b) {
              if (a.is_folder != b.is_folder) return a.is_folder;
              return comes_before(a.name, b.name);
            });
  return listing;
}

}  // namespace lapwing::viewer
