// Runs the executables of a package, each as a thread, in a time of its own, that of all clocks: when
// all threads wait it jumps to the next moment for which a timer or a thread waits.
//
// Usage: driver SYSTEM UNTIL [STEP], where SYSTEM has lines of fields set apart by tabs: `node EXECUTABLE
// NAME`, followed by the `param NAME TYPE VALUE...`, `remap FROM TO` and `change SECONDS TRANSITION`
// of that node,
// `ask SECONDS ID NAME FIELD=VALUE...` or `cancel SECONDS ID NAME` for clients of services and actions, and
// `foreign TOPIC` for a subscription of a tool that asks for what was sent before it; and UNTIL is
// the time of the end in seconds. With a STEP the clock of ROS is that of a simulation, which tells
// of each of its steps. What happens goes to standard output, one line each. With REVERSED_THREADS in
// the environment threads begin in the reverse of the order in which they are made, as far as they do
// not wait for one another.
#include <dlfcn.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

using Main = int (*)(int, char**);
const std::map<std::string, Main>& mains();  // by the name of the executable

namespace {

struct Process {
  Main main;
  rclcpp::fake::Arguments arguments;
};

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, '\t');) found.push_back(field);
  return found;
}

template <class T, class Read>
std::vector<T> all(const std::vector<std::string>& line, Read read) {
  std::vector<T> values;
  for (std::size_t i = 3; i < line.size(); ++i) values.push_back(read(line[i]));
  return values;
}

rclcpp::ParameterValue value(const std::vector<std::string>& line) {
  using rclcpp::ParameterValue;
  const auto truth = [](const std::string& text) { return text == "true"; };
  const auto whole = [](const std::string& text) { return int64_t{std::stoll(text)}; };
  const auto number = [](const std::string& text) { return std::stod(text); };
  const auto itself = [](const std::string& text) { return text; };
  const std::string& type = line[2];
  const std::string first = line.size() > 3 ? line[3] : "";
  if (type == "bool") return ParameterValue(truth(first));
  if (type == "int") return ParameterValue(whole(first));
  if (type == "float") return ParameterValue(number(first));
  if (type == "bools") return ParameterValue(all<bool>(line, truth));
  if (type == "ints") return ParameterValue(all<int64_t>(line, whole));
  if (type == "floats") return ParameterValue(all<double>(line, number));
  if (type == "strs") return ParameterValue(all<std::string>(line, itself));
  return ParameterValue(first);
}

// A subscription that no rebec has, and that hears nothing of writers that keep nothing.
void listen(const std::string& topic) {
  static std::vector<std::shared_ptr<rclcpp::fake::Reader>> readers;
  readers.push_back(std::make_shared<rclcpp::fake::Reader>(topic, "tool",
      rclcpp::QoS(1).transient_local(), std::make_shared<rclcpp::fake::Executor>(),
      [](const rclcpp::fake::Data&) {}));
  rclcpp::fake::middleware().add(readers.back());
}

// A client that asks at a time after the beginning.
void ask(const std::vector<std::string>& line) {
  rclcpp::fake::Ask ask{line[2], line[3], line[0] == "cancel", {}};
  for (std::size_t i = 4; i < line.size(); ++i) {
    const std::size_t end = line[i].find('=');
    ask.fields[line[i].substr(0, end)] = line[i].substr(end + 1);
  }
  auto& middleware = rclcpp::fake::middleware();
  const auto due = middleware.now() + static_cast<int64_t>(std::stod(line[1]) * 1e9);
  middleware.act_at(due, [ask] { rclcpp::fake::offers().ask(ask); });
}

std::vector<Process> read(const char* path) {
  std::vector<Process> processes;
  std::ifstream in(path);
  for (std::string text; std::getline(in, text);) {
    const std::vector<std::string> line = fields(text);
    if (line[0] == "node") {
      processes.push_back({mains().at(line[1]), {line[2], {}, {}, {}}});
    } else if (line[0] == "foreign") {
      listen(line[1]);
    } else if (line[0] == "ask" || line[0] == "cancel") {
      ask(line);
    } else if (line[0] == "change") {
      processes.back().arguments.changes.emplace_back(std::stod(line[1]), line[2]);
    } else if (line[0] == "param") {
      processes.back().arguments.overrides.emplace(line[1], value(line));
    } else {
      processes.back().arguments.remaps[line[1]] = line[2];
    }
  }
  return processes;
}

// Of each thread: what it does, and how often it has stopped to wait.
std::map<std::string, std::string> threads() {
  std::map<std::string, std::string> found;
  const std::string own = std::filesystem::read_symlink("/proc/thread-self").filename();
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    if (entry.path().filename() == own) continue;
    std::ifstream in(entry.path() / "status");
    std::string& facts = found[entry.path().filename()];
    for (std::string line; std::getline(in, line);) {
      if (line.rfind("State", 0) == 0 || line.rfind("voluntary", 0) == 0) facts += line;
    }
  }
  return found;
}

// Until every thread waits, and none has woken while the others were looked at.
void settle() {
  for (auto before = threads();; std::this_thread::yield()) {
    const auto now = threads();
    bool quiet = now == before;
    for (const auto& thread : now) {
      quiet = quiet && thread.second.find("S (sleeping)") != std::string::npos;
    }
    if (quiet) return;
    before = now;
  }
}

// On to the next moment for which anybody waits, while the run goes on.
template <class Goes>
void play(Goes goes_on) {
  auto& middleware = rclcpp::fake::middleware();
  while (true) {
    settle();
    const int64_t next = middleware.next();
    if (next < 0 || !goes_on(next)) return;
    middleware.advance(next);
  }
}

std::size_t countRebecs(const std::vector<Process>& processes) {
  std::size_t count = 0;
  for (const auto& p : processes) count += p.arguments.overrides.count("mailbox.rebecs");
  return count;
}

// Whether programs end without complaint that are told to stop while they make their nodes.
bool endsEarly(const std::vector<Process>& processes) {
  for (const Process& process : processes) {
    rclcpp::fake::arguments() = process.arguments;
    if (process.main(0, nullptr) != 0) return false;
  }
  return true;
}

// How much longer a thread is busy before it begins than the one that is made after it.
constexpr int64_t kApart = 50000000;  // ns
constexpr int64_t kMostThreads = 12;

struct Beginning {
  void* (*run)(void*);
  void* argument;
  int64_t pause;
};

int64_t realTime() {
  timespec now{};
  syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * 1000000000 + now.tv_nsec;
}

// It does not sleep: a thread that sleeps seems to wait for a time of the run.
void* beginLate(void* given) {
  const std::unique_ptr<Beginning> beginning(static_cast<Beginning*>(given));
  const int64_t end = realTime() + beginning->pause;
  while (realTime() < end) std::this_thread::yield();
  return beginning->run(beginning->argument);
}

}  // namespace

// --- the time of the run, in place of the machine's ---------------------------------------------

extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  if (clock != CLOCK_MONOTONIC) return static_cast<int>(syscall(SYS_clock_gettime, clock, time));
  const int64_t now = rclcpp::fake::middleware().now();
  time->tv_sec = now / 1000000000;
  time->tv_nsec = now % 1000000000;
  return 0;
}

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
    const timespec* until) {
  if (clock != CLOCK_MONOTONIC) rclcpp::fake::fail("a thread waits for a time of day");
  auto& middleware = rclcpp::fake::middleware();
  const int64_t due = int64_t{until->tv_sec} * 1000000000 + until->tv_nsec;
  if (middleware.now() >= due) return ETIMEDOUT;
  const auto sleeper = middleware.wake_at(due, [=] { pthread_cond_broadcast(condition); });
  pthread_cond_wait(condition, mutex);
  middleware.forget_sleeper(sleeper);
  return middleware.now() >= due ? ETIMEDOUT : 0;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
    void* argument) noexcept {
  static const auto create =
      reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  static const bool reversed = std::getenv("REVERSED_THREADS") != nullptr;
  static std::atomic<int64_t> made{0};
  if (!reversed) return create(thread, attributes, run, argument);
  const int64_t after = std::max<int64_t>(0, kMostThreads - ++made);
  return create(thread, attributes, beginLate, new Beginning{run, argument, after * kApart});
}

}  // extern "C"

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) return 2;
  const std::vector<Process> processes = read(argv[1]);
  auto& middleware = rclcpp::fake::middleware();
  if (argc == 4) middleware.simulate(static_cast<int64_t>(std::stod(argv[3]) * 1e9));
  std::vector<std::thread> running;
  for (const Process& process : processes) {
    running.emplace_back([process] {
      rclcpp::fake::arguments() = process.arguments;
      process.main(0, nullptr);
    });
  }
  const std::size_t rebecs = countRebecs(processes);
  play([&](int64_t) { return middleware.written("/startup") < rebecs; });
  const int64_t end = middleware.now() + static_cast<int64_t>(std::stod(argv[2]) * 1e9);
  play([end](int64_t next) { return next <= end; });
  middleware.record("end", "");
  middleware.shut_down();
  for (std::thread& thread : running) thread.join();
  return endsEarly(processes) ? 0 : 1;
}
