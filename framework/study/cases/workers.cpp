#include "study/cases/workers.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <optional>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace trammel::study {
namespace {

struct Header {
  std::uint64_t task, size;
};
constexpr long long none = -1;

// Memory shared by the processes: the next task, and the present task of each worker.
class Board {
 public:
  explicit Board(std::size_t workers) : size_(sizeof(std::atomic<long long>) * (workers + 1)) {
    void* place = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (place == MAP_FAILED) throw std::bad_alloc();
    cells_ = static_cast<std::atomic<long long>*>(place);
    for (std::size_t i = 0; i <= workers; ++i) new (cells_ + i) std::atomic<long long>(i == 0 ? 0 : none);
  }
  ~Board() { ::munmap(cells_, size_); }
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;
  std::atomic<long long>& next() { return cells_[0]; }
  std::atomic<long long>& current(std::size_t worker) { return cells_[worker + 1]; }

 private:
  std::size_t size_;
  std::atomic<long long>* cells_;
};

void write_all(int to, const void* data, std::size_t size) {
  const char* p = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(to, p, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);  // the reader has gone
    p += n, size -= std::size_t(n);
  }
}

struct Worker {
  pid_t process = 0;
  int from = -1;
  std::string received;
};

class Crew {
 public:
  Crew(const Workers& plan, std::span<const std::size_t> tasks, std::size_t workers)
      : plan_(plan), tasks_(tasks), board_(workers), workers_(workers) {
    for (std::size_t i = 0; i < workers; ++i) start(i);
  }
  ~Crew() {
    for (Worker& worker : workers_)
      if (worker.process > 0) {
        ::kill(worker.process, SIGKILL);
        close(worker);
      }
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  bool operator()() {
    while (any()) {
      if (plan_.interrupt && plan_.interrupt->heed()) return drain(), false;
      wait();
    }
    return true;
  }

 private:
  bool any() const {
    return std::any_of(workers_.begin(), workers_.end(), [](const Worker& w) { return w.process > 0; });
  }

  void start(std::size_t i) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    const pid_t process = ::fork();
    if (process < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (process == 0) {
      ::close(ends[0]);
      serve(i, ends[1]);
    }
    ::close(ends[1]);
    workers_[i] = {process, ends[0], {}};
  }

  // Signals of the terminal or of a batch system reach all processes; the first one decides.
  [[noreturn]] void serve(std::size_t i, int to) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) ::signal(signal, SIG_IGN);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (;;) {
      const long long at = board_.next()++;
      if (at >= (long long)(tasks_.size())) ::_exit(0);
      board_.current(i) = at;
      const std::string answer = plan_.work(tasks_[std::size_t(at)]);
      const Header header{std::uint64_t(at), answer.size()};
      write_all(to, &header, sizeof header);
      write_all(to, answer.data(), answer.size());
      board_.current(i) = none;
    }
  }

  void wait() {
    std::vector<pollfd> all;
    std::vector<std::size_t> who;
    for (std::size_t i = 0; i < workers_.size(); ++i)
      if (workers_[i].process > 0) all.push_back({workers_[i].from, POLLIN, 0}), who.push_back(i);
    constexpr int look = 50;  // [ms] interval at which the interrupt is checked
    if (::poll(all.data(), all.size(), look) <= 0) return;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].revents && !receive(workers_[who[k]])) ended(who[k]);
  }

  bool receive(Worker& worker) {
    char block[1 << 16];
    const ssize_t n = ::read(worker.from, block, sizeof block);
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) return true;
    if (n <= 0) return false;
    worker.received.append(block, std::size_t(n));
    take(worker);
    return true;
  }

  void take(Worker& worker) {
    std::string& bytes = worker.received;
    std::size_t at = 0;
    while (bytes.size() - at >= sizeof(Header)) {
      Header header;
      std::memcpy(&header, bytes.data() + at, sizeof header);
      if (bytes.size() - at < sizeof header + header.size) break;
      answered_.push_back(header.task);
      plan_.answer(tasks_[header.task], bytes.substr(at + sizeof header, header.size));
      at += sizeof header + header.size;
    }
    bytes.erase(0, at);
  }

  int close(Worker& worker) {
    int status = 0;
    ::close(worker.from);
    while (::waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
    }
    worker.process = 0;
    return status;
  }

  void ended(std::size_t i) {
    const int status = close(workers_[i]);
    const long long at = board_.current(i).exchange(none);
    // A plugin may end its process with any code, also with that of success.
    if (at != none && std::find(answered_.begin(), answered_.end(), std::uint64_t(at)) == answered_.end())
      plan_.lost({tasks_[std::size_t(at)], how(status), from_outside(status)});
    else if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
      return;
    if (board_.next() < (long long)(tasks_.size())) start(i);
  }

  static bool from_outside(int status) {
    return WIFSIGNALED(status) && (WTERMSIG(status) == SIGKILL || WTERMSIG(status) == SIGTERM);
  }
  static std::string how(int status) {
    return WIFSIGNALED(status) ? fmt::format("its process was ended by signal {}", WTERMSIG(status))
                               : fmt::format("its process ended with exit code {}, as if a plugin had called exit",
                                             WEXITSTATUS(status));
  }

  // Reads complete answers that are already in the pipes.
  void drain() {
    for (Worker& worker : workers_) {
      if (worker.process <= 0) continue;
      ::kill(worker.process, SIGKILL);
      while (receive(worker)) {
      }
      close(worker);
    }
  }

  const Workers& plan_;
  std::span<const std::size_t> tasks_;
  Board board_;
  std::vector<Worker> workers_;
  std::vector<std::uint64_t> answered_;
};

}  // namespace

int cores_at_hand() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

bool Workers::run(std::span<const std::size_t> tasks) const {
  const std::size_t most = std::size_t(jobs > 0 ? jobs : cores_at_hand());
  return tasks.empty() || Crew(*this, tasks, std::min(most, tasks.size()))();
}

}  // namespace trammel::study
