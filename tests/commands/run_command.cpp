#include "run_command.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace isocnc::commands {

static void expect_success(int error, const char* what) {
  if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

namespace {

/// An open descriptor, closed at the end.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_ = -1;
};

struct Pipe {
  Descriptor read_end;
  Descriptor write_end;

  Pipe() {
    std::array<int, 2> ends{};
    expect_success(::pipe2(ends.data(), O_CLOEXEC) == 0 ? 0 : errno, "pipe");
    read_end = Descriptor(ends[0]);
    write_end = Descriptor(ends[1]);
  }
};

/// What posix_spawn is to do before the command begins.
class SpawnPlan {
 public:
  SpawnPlan() {
    expect_success(posix_spawn_file_actions_init(&actions_), "file actions");
    expect_success(posix_spawnattr_init(&attributes_), "attributes");
    // We ignore SIGPIPE, which would be inherited.
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    expect_success(posix_spawnattr_setsigdefault(&attributes_, &defaults), "signals");
    expect_success(posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF), "flags");
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }

  void connect(const Descriptor& ours, int theirs) {
    expect_success(posix_spawn_file_actions_adddup2(&actions_, ours.number(), theirs), "dup2");
  }
  void enter(const std::string& folder) {
    expect_success(posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()), "chdir");
  }
  pid_t spawn(const std::string& program, std::vector<std::string>& arguments, std::vector<std::string>& environment) {
    pid_t child = 0;
    expect_success(posix_spawn(&child, program.c_str(), &actions_, &attributes_, pointers(arguments).data(),
                               pointers(environment).data()),
                   program.c_str());
    return child;
  }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& strings) {
    std::vector<char*> result;
    for (std::string& each : strings) result.push_back(each.data());
    result.push_back(nullptr);
    return result;
  }

  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

static std::vector<std::string> environment_with(const std::map<std::string, std::string>& settings) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::string name(text.substr(0, text.find('=')));
    const bool speaks_of_locale = name == "LC_ALL" || name == "LC_MESSAGES" || name == "LANG" || name == "LANGUAGE";
    if (!speaks_of_locale && name != "NO_COLOR" && !settings.contains(name)) result.emplace_back(text);
  }
  for (const auto& [name, value] : settings) result.push_back(name + "=" + value);
  return result;
}

/// Appends what there is to read; closes at the end.
static void drain(Descriptor& source, std::string& text) {
  std::array<char, 65536> bytes{};
  const ssize_t count = ::read(source.number(), bytes.data(), bytes.size());
  if (count > 0) text.append(bytes.data(), static_cast<std::size_t>(count));
  if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) source.close();
}

/// Writes what the pipe takes; closes at the end, and when the reader has closed it.
static void feed(Descriptor& target, std::string_view& text) {
  const ssize_t count = ::write(target.number(), text.data(), text.size());
  if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  if (text.empty() || (count < 0 && errno != EINTR && errno != EAGAIN)) target.close();
}

/// Talks to the command until it has closed its outputs; false when that takes too long.
static bool converse(Descriptor& input, Descriptor& out, Descriptor& err, std::string_view text, CommandResult& result,
                     std::chrono::microseconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  if (text.empty()) input.close();
  while (out.is_open() || err.is_open()) {
    const auto left =
        std::chrono::duration_cast<std::chrono::microseconds>(deadline - std::chrono::steady_clock::now()).count();
    if (left <= 0) return false;
    const timespec time_left{left / 1'000'000, left % 1'000'000 * 1'000};
    std::array<pollfd, 3> waiting{{{input.number(), POLLOUT, 0}, {out.number(), POLLIN, 0}, {err.number(), POLLIN, 0}}};
    if (::ppoll(waiting.data(), waiting.size(), &time_left, nullptr) <= 0) continue;
    if (waiting[0].revents != 0) feed(input, text);
    if (waiting[1].revents != 0) drain(out, result.out);
    if (waiting[2].revents != 0) drain(err, result.err);
  }
  return true;
}

static int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// The programs of this build, or of the folder that the environment names: those for another system, with what runs
/// them here.
static std::string program_file(const std::string& name) {
  const char* const elsewhere = std::getenv("ISOCNC_BIN_DIR");
  return std::string(elsewhere != nullptr ? elsewhere : ISOCNC_BIN_DIR) + "/" + name;
}

CommandResult run_command(std::vector<std::string> arguments, const CommandSetup& setup) {
  std::signal(SIGPIPE, SIG_IGN);
  Pipe in;
  Pipe out;
  Pipe err;
  SpawnPlan plan;
  plan.connect(in.read_end, STDIN_FILENO);
  plan.connect(err.write_end, STDERR_FILENO);
  if (setup.standard_output == StandardOutput::FullDisk)
    out.write_end = Descriptor(::open("/dev/full", O_WRONLY | O_CLOEXEC));
  if (setup.standard_output != StandardOutput::Captured) out.read_end.close();
  plan.connect(out.write_end, STDOUT_FILENO);
  if (!setup.folder.empty()) plan.enter(setup.folder);
  const std::string program = program_file(arguments.front());
  std::vector<std::string> environment = environment_with(setup.environment);
  const pid_t child = plan.spawn(program, arguments, environment);
  in.read_end.close();
  out.write_end.close();
  err.write_end.close();
  ::fcntl(in.write_end.number(), F_SETFL, O_NONBLOCK);

  CommandResult result;
  result.timed_out = !converse(in.write_end, out.read_end, err.read_end, setup.input, result, setup.limit);
  if (result.timed_out) ::kill(child, SIGKILL);
  result.status = wait_for(child);
  return result;
}

std::vector<nlohmann::json> events_in(const std::string& trace) {
  std::vector<nlohmann::json> events;
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);) events.push_back(nlohmann::json::parse(line));
  return events;
}

std::vector<std::string> kinds_in(const std::vector<nlohmann::json>& events) {
  std::vector<std::string> kinds;
  for (const nlohmann::json& event : events) kinds.push_back(event.at("kind"));
  return kinds;
}

nlohmann::json timeless(nlohmann::json event) {
  event.erase("start");
  event.erase("duration");
  return event;
}

std::vector<nlohmann::json> trace_of(std::string_view program, std::vector<std::string> options) {
  options.insert(options.begin(), {"isorun", "--trace", "-", "-"});
  return events_in(run_command(options, {.input = std::string(program)}).out);
}

nlohmann::json summary_of(const std::string& program, std::vector<std::string> options) {
  options.insert(options.begin(), {"isorun", "--json", "-"});
  return nlohmann::json::parse(run_command(options, {.input = program}).out);
}

}  // namespace isocnc::commands
