// See ../README.md: time, topics, and callbacks that wait for an executor.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace fake {

/// Thrown out of a program when its run is over.
struct Ended {};

enum class Exclusion { mutual, none };

/// Callbacks of which only one runs at a time, or any number.
struct Group {
  Exclusion exclusion = Exclusion::mutual;
  bool busy = false;
};

/// What is ready at a time for the executor that has a node.
struct Event {
  int64_t due;
  const void* node;
  std::shared_ptr<Group> group;
  std::function<void()> work;
};

struct Reader {
  const void* node;
  std::shared_ptr<Group> group;
  std::size_t depth;
  std::function<void(const std::shared_ptr<const void>&)> take;
  std::deque<std::shared_ptr<const void>> waiting;
};

using Served = std::function<void(const std::shared_ptr<void>&, std::function<void(std::shared_ptr<void>)>)>;

struct World {
  int64_t now = 0;
  int64_t end = 40'000'000'000;
  bool shut_down = false;
  bool parallel = false;  // whether callbacks go on while one of them sleeps
  std::set<const void*> spun;
  std::vector<Event> events;  // in the order in which they were asked for
  std::map<std::string, std::vector<std::weak_ptr<Reader>>> readers;
  std::map<std::string, Served> services;
  std::vector<std::pair<std::string, int>> sent;
  std::vector<std::function<void()>> on_shutdown;

  bool ok() const { return !shut_down && now < end; }

  void at(int64_t due, const void* node, std::shared_ptr<Group> group, std::function<void()> work) {
    events.push_back({due, node, std::move(group), std::move(work)});
  }

  /// Serves what is due first, up to a time, and what comes from outside before; whether there was
  /// something to serve.
  bool step(int64_t until) {
    auto first = events.end();
    for (auto it = events.begin(); it != events.end(); ++it) {
      const bool free = it->node == nullptr ||
          (spun.count(it->node) > 0 && !(it->group && it->group->busy));
      if (free && it->due <= until && (first == events.end() || it->due < first->due)) first = it;
    }
    if (first == events.end()) return false;
    const Event event = *first;
    events.erase(first);
    now = std::max(now, event.due);
    const bool held = event.group && event.group->exclusion == Exclusion::mutual;
    if (held) event.group->busy = true;
    event.work();
    if (held) event.group->busy = false;
    return event.node != nullptr || step(until);
  }

  /// Others go on while a callback sleeps if several threads serve; messages arrive in any case.
  void sleep(int64_t span) {
    const int64_t woken = now + std::max<int64_t>(span, 0);
    const std::set<const void*> kept = spun;
    if (!parallel) spun.clear();
    while (step(woken)) continue;
    spun = kept;
    now = std::max(now, woken);
    if (now >= end) throw Ended();
  }

  template <class M>
  void publish(const std::string& topic, const std::shared_ptr<const M>& message) {
    for (const auto& weak : readers[topic]) {
      const auto reader = weak.lock();
      if (!reader) continue;
      if (reader->waiting.size() >= reader->depth) reader->waiting.pop_front();
      reader->waiting.push_back(message);
      at(now, reader->node, reader->group, [weak] {
        const auto held = weak.lock();
        if (!held || held->waiting.empty()) return;
        const auto taken = held->waiting.front();
        held->waiting.pop_front();
        held->take(taken);
      });
    }
  }
};

inline World& world() {
  static World one;
  return one;
}

}  // namespace fake
