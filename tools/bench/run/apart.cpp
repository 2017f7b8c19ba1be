#include "run/apart.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <poll.h>
#include <string>
#include <string_view>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lapwing/base/errors.h"
#include "report/number_text.h"
#include "report/report_json.h"

namespace lapwing::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Work = std::function<void(const std::function<void(std::string_view)>& tell)>;

// Ends the text. The message of an exception may follow. A process that dies does not send it.
constexpr char kEnd = '\0';

[[noreturn]] void fail(const std::string& what) {
  throw Error(what + ": " + std::strerror(errno));
}

void send(int pipe, std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = write(pipe, text.data(), text.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) _exit(1);
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
}

// Skips the exit handlers, which belong to the original process.
[[noreturn]] void work_and_exit(const Work& work, int pipe) {
  // Stop if the parent is stopped.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::string end(1, kEnd);
  try {
    work([pipe](std::string_view text) { send(pipe, text); });
  } catch (const std::exception& error) {
    end += error.what();
  }
  send(pipe, end);
  _exit(0);
}

// Returns the timeout for poll; without a deadline it is -1, which means no limit.
int milliseconds_left(const std::optional<Clock::time_point>& deadline) {
  if (!deadline) return -1;
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(*deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, std::numeric_limits<int>::max()));
}

// Appends to `text` until the other end closes. Returns false if the deadline passes first.
bool receive(int pipe, const std::optional<Clock::time_point>& deadline, std::string& text) {
  std::array<char, 4096> part;
  for (;;) {
    pollfd waiting{pipe, POLLIN, 0};
    const int ready = poll(&waiting, 1, milliseconds_left(deadline));
    if (ready == 0) return false;
    if (ready < 0 && errno != EINTR) return true;
    if (ready < 0) continue;
    const ssize_t got = read(pipe, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return true;
    text.append(part.data(), static_cast<std::size_t>(got));
  }
}

// Describes how a process ended that did not send kEnd.
std::string end_of(int status) {
  const std::string who = "the process that measured ";
  if (!WIFSIGNALED(status)) return who + "ended with status " + std::to_string(WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  const std::string name = strsignal(signal);
  return who + "was ended by signal " + std::to_string(signal) + " (" + name + ")" +
         (signal == SIGKILL ? "; was there memory enough? --memory and --vertices ask for less"
                            : "");
}

}  // namespace

Told run_in_child_process(const Work& work, double most_seconds) {
  std::optional<Clock::time_point> deadline;
  if (most_seconds > 0.0) {
    deadline = Clock::now() + std::chrono::milliseconds(std::llround(1e3 * most_seconds));
  }
  std::array<int, 2> ends;
  if (pipe(ends.data()) != 0) fail("cannot open a pipe");
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) fail("cannot start a process to measure in");
  if (child == 0) {
    close(ends[0]);
    work_and_exit(work, ends[1]);
  }
  close(ends[1]);
  Told told;
  const bool in_time = receive(ends[0], deadline, told.text);
  if (!in_time) kill(child, SIGKILL);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::size_t end = told.text.find(kEnd);
  if (end != std::string::npos) {
    told.failure = told.text.substr(end + 1);
    told.text.resize(end);
  } else {
    told.failure = in_time ? end_of(status) : "not done in " + short_number(most_seconds) + " s";
  }
  return told;
}

Report report_from_child_process(const std::function<Report()>& work) {
  const Told told = run_in_child_process([&](const auto& tell) { tell(to_json(work())); });
  if (!told.failure.empty()) throw Error(told.failure);
  return parse_report(told.text, "what was measured");
}

}  // namespace lapwing::bench
