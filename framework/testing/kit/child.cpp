#include "testing/kit/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <system_error>

namespace trammel::kit {

namespace {

using Clock = std::chrono::steady_clock;

// Ends the answer, so that one that a crash cut off is not taken for whole.
constexpr char whole = '\4';

// --- the child ---

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    done += std::size_t(n);
  }
}

[[noreturn]] void work_and_end(const Job& job, int answer_to, int print_to) noexcept {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit none{0, 0}, some{1 << 24, 1 << 24};
  ::setrlimit(RLIMIT_CORE, &none);
  ::setrlimit(RLIMIT_FSIZE, &some);
  // A high descriptor, which a library is unlikely to write to.
  const int high = ::fcntl(answer_to, F_DUPFD_CLOEXEC, 220);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO), ::dup2(print_to, STDOUT_FILENO), ::dup2(print_to, STDERR_FILENO);
  for (const int fatal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT, SIGHUP})
    std::signal(fatal, SIG_DFL);
  std::set_terminate([] { std::abort(); });
  const std::string answer = job.work();
  std::fflush(stdout), std::fflush(stderr);
  write_all(high, answer + whole);
  ::kill(::getpid(), SIGKILL);  // neither a plugin's globals nor its exit handlers run
  for (;;) ::pause();
}

// --- the parent ---

[[noreturn]] void fail() {
  throw std::system_error(errno, std::generic_category(), "cannot start a process for a check");
}

class Running {
 public:
  Running(const Job& job) : started_(Clock::now()), deadline_(started_ + job.limit), limit_(job.limit) {
    std::array<int, 2> ends;
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail();
    printed_ = ::memfd_create("printed", MFD_CLOEXEC);
    std::fflush(stdout);  // else the child's copy of the buffer would be printed twice
    pid_ = ::fork();
    if (pid_ == 0) work_and_end(job, ends[1], printed_);
    ::close(ends[1]);
    pipe_ = ends[0];
    if (pid_ < 0) fail();
    ::setpgid(pid_, pid_);  // the child does this, too, because either may run first
    ::fcntl(pipe_, F_SETFL, O_NONBLOCK);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    if (pid_ > 0 && !status_) ::kill(pid_, SIGKILL), reap(0);
    ::close(pipe_), ::close(printed_);
  }

  int pipe() const { return open_ ? pipe_ : -1; }

  // Its ending, once there is one.
  std::optional<Ending> look() {
    drain();
    if (!status_) reap(WNOHANG);
    const bool answered = !answer_.empty() && answer_.back() == whole;
    if (answered || status_) return end(answered ? Ending::How::answered : Ending::How::crashed);
    if (Clock::now() >= deadline_) return end(Ending::How::timed_out);
    return {};
  }

 private:
  void drain() {
    std::array<char, 4096> buffer;
    while (open_) {
      const ssize_t n = ::read(pipe_, buffer.data(), buffer.size());
      if (n < 0 && errno == EINTR) continue;
      if (n == 0) open_ = false;
      if (n <= 0) return;
      answer_.append(buffer.data(), std::size_t(n));
    }
  }
  void reap(int options) {
    int status = 0;
    pid_t ended = 0;
    while ((ended = ::waitpid(pid_, &status, options)) < 0 && errno == EINTR) {
    }
    if (ended == pid_) status_ = status;
  }
  Ending end(Ending::How how) {
    ::kill(-pid_, SIGKILL);
    if (!status_) reap(0);
    drain();
    Ending ending;
    // The answer may have come between the last look at the pipe and the end.
    if (how == Ending::How::crashed && !answer_.empty() && answer_.back() == whole) how = Ending::How::answered;
    ending.how = how;
    ending.seconds = std::chrono::duration<double>(Clock::now() - started_).count();
    ending.printed = first_of_what_it_printed();
    if (how == Ending::How::answered) ending.answer = answer_.substr(0, answer_.size() - 1);
    if (how == Ending::How::timed_out)
      ending.cause = fmt::format("it did not end within {} s", limit_.count() / 1000.0);
    if (how == Ending::How::crashed) ending.cause = cause();
    return ending;
  }
  std::string cause() const {
    if (WIFSIGNALED(*status_)) return fmt::format("it crashed: {}", ::strsignal(WTERMSIG(*status_)));
    return fmt::format("it ended the process with code {}", WEXITSTATUS(*status_));
  }
  std::string first_of_what_it_printed() const {
    std::string text(512, '\0');
    const ssize_t n = ::pread(printed_, text.data(), text.size(), 0);
    text.resize(n > 0 ? std::size_t(n) : 0);
    return text;
  }

  Clock::time_point started_, deadline_;
  std::chrono::milliseconds limit_;
  pid_t pid_ = -1;
  int pipe_ = -1, printed_ = -1;
  bool open_ = true;
  std::string answer_;
  std::optional<int> status_;
};

void wait_a_moment(const std::vector<std::unique_ptr<Running>>& running) {
  std::vector<pollfd> ready;
  for (const auto& one : running)
    if (one) ready.push_back({one->pipe(), POLLIN, 0});
  ::poll(ready.data(), ready.size(), 10);
}

}  // namespace

void run_in_children(const std::vector<Job>& jobs, int parallel,
                     const std::function<void(std::size_t, const Ending&)>& ended) {
  std::vector<std::unique_ptr<Running>> running(jobs.size());
  std::vector<std::unique_ptr<Ending>> endings(jobs.size());
  std::size_t started = 0, reported = 0;
  int under_way = 0;
  while (reported < jobs.size()) {
    while (started < jobs.size() && under_way < parallel)
      running[started] = std::make_unique<Running>(jobs[started]), ++started, ++under_way;
    for (std::size_t i = reported; i < started; ++i) {
      if (!running[i]) continue;
      if (auto ending = running[i]->look())
        endings[i] = std::make_unique<Ending>(std::move(*ending)), running[i].reset(), --under_way;
    }
    while (reported < started && endings[reported]) ended(reported, *endings[reported]), ++reported;
    if (under_way > 0) wait_a_moment(running);
  }
}

Ending run_in_child(const Job& job) {
  Ending only;
  run_in_children({job}, 1, [&](std::size_t, const Ending& ending) { only = ending; });
  return only;
}

}  // namespace trammel::kit
