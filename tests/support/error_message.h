#pragma once

#include <string>

namespace lapwing {

/// What the `Error` thrown by `act` says; an empty string, which no test expects, when it throws
/// none.
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
