// What a library does to the process that loads and uses it: nothing.
#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <clocale>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "plugin/process/settings.hpp"
#include "testing/kit/components/common.hpp"
#include "testing/kit/exercise.hpp"

namespace trammel::kit {

namespace {

std::string working_folder() {
  std::error_code error;
  return std::filesystem::current_path(error).string();
}

constexpr std::array watched = {SIGINT, SIGTERM, SIGSEGV, SIGFPE, SIGABRT, SIGALRM, SIGCHLD, SIGPIPE};

// The settings of a process that a library may spoil, as text.
struct Settings {
  std::string locale, folder, arithmetic, signals;

  static Settings now() {
    Settings s{std::setlocale(LC_ALL, nullptr), working_folder(), plugin::arithmetic_fault(), ""};
    for (const int signal : watched) {
      struct sigaction action = {};
      ::sigaction(signal, nullptr, &action);
      s.signals += fmt::format("{} {} ", signal, reinterpret_cast<void*>(action.sa_handler));
    }
    return s;
  }
};

void claim_same(Report& report, const std::string& when, const Settings& before, const Settings& after) {
  report.claim("the locale stays " + when, before.locale == after.locale,
               before.locale == after.locale ? "" : fmt::format("\"{}\" became \"{}\"", before.locale, after.locale));
  report.claim("the working folder stays " + when, before.folder == after.folder,
               before.folder == after.folder ? "" : fmt::format("{} became {}", before.folder, after.folder));
  report.claim("arithmetic stays IEEE's " + when, after.arithmetic.empty(), after.arithmetic);
  report.claim("signal handlers stay " + when, before.signals == after.signals);
}

// Standard output and error go to a file for as long as this lives.
class Listening {
 public:
  Listening()
      : file_(::memfd_create("listening", MFD_CLOEXEC)), out_(::dup(STDOUT_FILENO)), err_(::dup(STDERR_FILENO)) {
    flush();
    ::dup2(file_, STDOUT_FILENO), ::dup2(file_, STDERR_FILENO);
  }
  ~Listening() {
    flush();
    ::dup2(out_, STDOUT_FILENO), ::dup2(err_, STDERR_FILENO);
    for (const int file : {file_, out_, err_}) ::close(file);
  }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  std::string heard() const {
    flush();
    std::string text(200, '\0');
    const ssize_t n = ::pread(file_, text.data(), text.size(), 0);
    text.resize(n > 0 ? std::size_t(n) : 0);
    return text;
  }

 private:
  static void flush() { std::fflush(stdout), std::fflush(stderr), std::cout.flush(); }
  int file_, out_, err_;
};

// As the Registry does, but without its care for the settings.
Report keeps_settings_when_loaded(const Subject& s) {
  // This process has loaded it; a copy is another library.
  const std::string copy = fmt::format("/tmp/trammel_check_{}.so", ::getpid());
  std::error_code error;
  std::filesystem::copy_file(s.entry.file, copy, std::filesystem::copy_options::overwrite_existing, error);
  Report report;
  if (error) {
    report.claim("the library can be copied", false, error.message());
    return report;
  }
  const Settings before = Settings::now();
  std::string heard;
  void* library = nullptr;
  {
    const Listening listening;
    library = ::dlopen(copy.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (const auto entry =
            reinterpret_cast<const Declarations* (*)()>(library ? ::dlsym(library, "trammel_declarations") : nullptr))
      entry();
    heard = listening.heard();
  }
  const Settings after = Settings::now();
  std::filesystem::remove(copy, error);
  report.claim("it loads a second time", library != nullptr, library ? "" : ::dlerror());
  claim_same(report, "when it is loaded", before, after);
  report.claim("loading prints nothing", heard.empty(), heard);
  return report;
}

Report keeps_settings_in_use(const Subject& s) {
  Report report;
  const Settings before = Settings::now();
  const auto component = s.make();
  exercise(s, *component);
  claim_same(report, "in use", before, Settings::now());
  return report;
}

Report prints_nothing(const Subject& s) {
  std::string heard;
  {
    const Listening listening;
    const auto component = s.make();
    exercise(s, *component);
    heard = listening.heard();
  }
  Report report;
  report.claim("making and using it prints nothing", heard.empty(), heard.empty() ? "" : fmt::format("\"{}\"", heard));
  return report;
}

Report is_deterministic(const Subject& s) {
  std::vector<double> once, twice;
  const auto first = s.make(), second = s.make();
  exercise(s, *first, &once);
  exercise(s, *second, &twice);
  Report report;
  const bool same =
      once.size() == twice.size() && std::memcmp(once.data(), twice.data(), once.size() * sizeof(double)) == 0;
  report.claim("two components with the same parameters give the same numbers bit for bit", same,
               fmt::format("{} numbers", once.size()));
  return report;
}

Report can_be_used_side_by_side(const Subject& s) {
  std::vector<double> alone, beside;
  const auto first = s.make();
  exercise(s, *first, &alone);
  const auto second = s.make(), other = s.make();
  Subject another = s;
  another.seed = s.seed + 1;
  exercise(another, *other);
  exercise(s, *second, &beside);
  Report report;
  const bool same =
      alone.size() == beside.size() && std::memcmp(alone.data(), beside.data(), alone.size() * sizeof(double)) == 0;
  report.claim("a component does not depend on others of its kind", same);
  return report;
}

Report throws_nothing(const Subject& s) {
  Report report;
  try {
    const auto component = s.make();
    const std::string fault = exercise(s, *component);
    report.claim("every function returns finite numbers", fault.empty(), fault);
  } catch (const std::exception& e) {
    report.claim("no function throws at an ordinary state", false, e.what());
  } catch (...) {
    report.claim("no function throws at an ordinary state", false, "it threw something that is no std::exception");
  }
  return report;
}

Words words(const char* name, const char* claim, const char* equation, const char* file, const char* line) {
  return {std::string("process.") + name, claim, equation, {file, line}};
}

}  // namespace

Checks process_checks() {
  const char* const once = "Use it once per library, outside any anonymous namespace.";
  const char* const prepared =
      "Called once, after the declared parameters were set and checked, before any other method.";
  return {{words("keeps-settings-when-loaded",
                 "Loading leaves locale, arithmetic, working folder, signals and output alone.",
                 "settings after = settings before", "trammel/plugin.hpp", once),
           Level::quick, keeps_settings_when_loaded},
          {words("keeps-settings-in-use", "Using it leaves locale, arithmetic, working folder and signals alone.",
                 "settings after = settings before", "trammel/component.hpp", prepared),
           Level::quick, keeps_settings_in_use},
          {words("prints-nothing", "It writes nothing to standard output and standard error.", "bytes written = 0",
                 "trammel/component.hpp", prepared),
           Level::quick, prints_nothing},
          {words("throws-nothing", "At ordinary states it throws nothing.", "|result| < infinity",
                 "trammel/outcome.hpp", "An expected failure is a value, not an exception."),
           Level::quick, throws_nothing},
          {words("is-deterministic", "The same parameters and states give the same numbers bit for bit.",
                 "x = x', bit for bit", "trammel/component.hpp", prepared),
           Level::quick, is_deterministic},
          {words("shares-no-state", "Two components of the same kind do not see each other.",
                 "x beside another = x alone", "trammel/component.hpp", prepared),
           Level::quick, can_be_used_side_by_side}};
}

}  // namespace trammel::kit
