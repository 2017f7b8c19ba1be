#pragma once

#include <string>

namespace lapwing {

/// Returns the message of the `Error` that `act` throws. If it throws none, returns an empty
/// string, which no test expects.
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
