#pragma once

#include <string>

namespace lapwing {

/// Returns the message of the `Error` that `act` throws, or an empty string, which no test expects,
/// if it throws none.
template <class Error, class Act>
std::string error_message(Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace lapwing
