#include "run/apart.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <sys/prctl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lapwing/base/errors.h"
#include "report/number_text.h"
#include "report/report_json.h"

namespace lapwing::bench {
namespace {

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
[[noreturn]] void work_and_exit(const Work& work, int pipe, double most_seconds) {
  // The kernel kills this process when the parent ends or the time limit expires.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  itimerval limit{};
  limit.it_value.tv_sec = static_cast<time_t>(most_seconds);
  limit.it_value.tv_usec =
      static_cast<suseconds_t>(1e6 * (most_seconds - std::floor(most_seconds)));
  setitimer(ITIMER_REAL, &limit, nullptr);
  std::string end(1, kEnd);
  try {
    work([pipe](std::string_view text) { send(pipe, text); });
  } catch (const std::exception& error) {
    end += error.what();
  }
  send(pipe, end);
  _exit(0);
}

// Returns all bytes that the other process writes before it closes the pipe.
std::string receive(int pipe) {
  std::string text;
  std::array<char, 4096> part;
  for (;;) {
    const ssize_t got = read(pipe, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
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
  std::array<int, 2> ends;
  if (pipe(ends.data()) != 0) fail("cannot open a pipe");
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) fail("cannot start a process to measure in");
  if (child == 0) {
    close(ends[0]);
    work_and_exit(work, ends[1], most_seconds);
  }
  close(ends[1]);
  Told told{receive(ends[0]), ""};
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::size_t end = told.text.find(kEnd);
  if (end != std::string::npos) {
    told.failure = told.text.substr(end + 1);
    told.text.resize(end);
  } else if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    told.failure = "not done in " + short_number(most_seconds) + " s";
  } else {
    told.failure = end_of(status);
  }
  return told;
}

Report report_from_child_process(const std::function<Report()>& work) {
  const Told told = run_in_child_process([&](const auto& tell) { tell(to_json(work())); });
  if (!told.failure.empty()) throw Error(told.failure);
  return parse_report(told.text, "what was measured");
}

}  // namespace lapwing::bench
