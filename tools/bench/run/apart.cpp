#include "run/apart.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lapwing/base/errors.h"
#include "report/report_json.h"

namespace lapwing::bench {
namespace {

// The first letter of what comes back.
constexpr char kReport = 'r';
constexpr char kFailure = 'f';

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

// Without what runs at a program's end: that is for the process that this is a copy of.
[[noreturn]] void work_and_exit(const std::function<Report()>& work, int pipe) {
  // Who stops this program means that, too.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::string answer;
  try {
    answer = kReport + to_json(work());
  } catch (const std::exception& error) {
    answer = std::string(1, kFailure) + error.what();
  }
  send(pipe, answer);
  _exit(0);
}

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

// How a process ended that said nothing.
std::string end_of(int status) {
  if (!WIFSIGNALED(status)) return "ended with status " + std::to_string(WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  const std::string name = strsignal(signal);
  return "was ended by signal " + std::to_string(signal) + " (" + name + ")" +
         (signal == SIGKILL ? "; was there memory enough? --memory and --vertices ask for less"
                            : "");
}

}  // namespace

Report made_apart(const std::function<Report()>& work) {
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
  const std::string answer = receive(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (answer.empty()) throw Error("the process that measured " + end_of(status));
  const std::string_view text = std::string_view(answer).substr(1);
  if (answer.front() == kFailure) throw Error(std::string(text));
  return parse_report(text, "what was measured");
}

}  // namespace lapwing::bench
