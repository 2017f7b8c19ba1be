#include "lapwing/base/limits.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>

#include "lapwing/base/errors.h"
#include "lapwing/base/memory_use.h"
#include "lapwing/base/printable_text.h"

namespace lapwing {
namespace {

std::optional<double> number_set(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == '\0') return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(text, &end);
  if (*end == '\0' && number > 0.0) return number;
  throw InputError(std::string(variable) + " is set to \"" + text +
                   "\"; set it to a number above 0, or unset it");
}

// Accepts counts that are too large for integer types.
std::string in_words(double count) {
  return grouped(static_cast<std::size_t>(std::min(count, 1e18)));
}

}  // namespace

double limit_value(const Limit& limit) {
  return number_set(limit.variable).value_or(limit.most);
}

void require_at_most(const Limit& limit, double count, const std::string& what,
                     const std::string& remedy) {
  const double most = limit_value(limit);
  if (count <= most) return;
  throw InputError(what + " " + in_words(count) + " " + limit.things + ", more than the limit of " +
                   in_words(most) + "; " + remedy + ", or set " + limit.variable +
                   " to a larger number");
}

std::size_t allowed_memory(std::size_t limit_bytes) {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  if (limit_bytes > 0) return limit_bytes;
  const auto whole = [](double bytes) {
    return bytes < static_cast<double>(kAll) ? static_cast<std::size_t>(bytes) : kAll;
  };
  if (const auto set = number_set(kMemoryVariable)) return whole(*set);
  const std::size_t available = available_memory_bytes();
  return available == 0 ? kAll : whole(kMemoryShare * static_cast<double>(available));
}

void require_memory(std::size_t bytes, const std::string& what, const std::string& remedy) {
  const std::size_t allowed = allowed_memory();
  if (bytes <= allowed) return;
  throw SolverError(what + " needs " + in_megabytes(bytes) + " of memory, more than the limit of " +
                    in_megabytes(allowed) + "; " + remedy + ", or set " + kMemoryVariable +
                    " to more bytes");
}

std::string in_megabytes(std::size_t bytes) {
  return std::to_string(bytes / 1'000'000 + 1) + " MB";
}

}  // namespace lapwing
