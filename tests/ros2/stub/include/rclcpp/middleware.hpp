// What stands in for the middleware: topics, clock and timers of all nodes of the process.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <rclcpp/qos.hpp>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace rclcpp::fake {

using Data = std::shared_ptr<const void>;

/// What must not happen with the real one either: the run ends here, and says why.
inline void fail(const std::string& why) {
  std::cerr << why << std::endl;
  std::_Exit(3);
}

/// One thread's work: callbacks one by one, in the order in which they became ready.
class Executor {
 public:
  /// What it waits for may change only in its own thread: it may be about to look at it.
  void changes(const char* what) const {
    const std::thread::id runner = runner_;
    if (runner == std::thread::id() || runner == std::this_thread::get_id()) return;
    fail(std::string(what) + " by another thread while the executor waits");
  }

  void post(std::function<void()> work) {
    const std::lock_guard<std::mutex> lock(mutex_);
    work_.push_back(std::move(work));
    changed_.notify_all();
  }

  template <class Go>
  void run(Go goes_on) {
    runner_ = std::this_thread::get_id();
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return !goes_on() || !work_.empty(); });
      if (!goes_on()) break;
      const auto work = std::move(work_.front());
      work_.pop_front();
      lock.unlock();
      work();
      lock.lock();
    }
    runner_ = std::thread::id();
  }

  void wake() {
    const std::lock_guard<std::mutex> lock(mutex_);
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> work_;
  std::atomic<std::thread::id> runner_{std::thread::id()};
};

struct Reader {
  Reader(std::string topic_, std::string node_, QoS qos_, std::shared_ptr<Executor> executor_,
      std::function<void(const Data&)> take_)
      : topic(std::move(topic_)),
        node(std::move(node_)),
        qos(qos_),
        executor(std::move(executor_)),
        take(std::move(take_)) {}

  const std::string topic;
  const std::string node;
  const QoS qos;
  const std::shared_ptr<Executor> executor;
  const std::function<void(const Data&)> take;
  std::atomic<std::size_t> waiting{0};
};

struct Alarm {
  Alarm(std::shared_ptr<Executor> executor_, std::function<void()> ring_)
      : executor(std::move(executor_)), ring(std::move(ring_)) {}

  const std::shared_ptr<Executor> executor;
  const std::function<void()> ring;
  int64_t due = 0;
  int64_t period = 0;
  std::atomic<bool> cancelled{false};
};

class Writer;

class Middleware {
 public:
  void add(const std::shared_ptr<Reader>& reader);
  std::shared_ptr<Writer> writer(const std::string& topic, const QoS& qos);
  std::vector<std::shared_ptr<Reader>> readers(const std::string& topic);
  void write(Writer& writer, const Data& data, const std::string& text);

  int64_t now() const { return now_; }

  /// Whether the clock is that of a simulation, which tells of each of its steps.
  bool is_simulated() const { return step_ > 0; }
  void simulate(int64_t step) { step_ = step; }

  std::size_t on_jump(std::function<void()> act) {
    const std::lock_guard<std::recursive_mutex> lock(clock_mutex_);
    jumps_.emplace(++jump_, std::move(act));
    return jump_;
  }
  void forget_jump(std::size_t jump) {
    const std::lock_guard<std::recursive_mutex> lock(clock_mutex_);
    jumps_.erase(jump);
  }

  /// Has a thread woken at a time that waits for no more than that.
  std::size_t wake_at(int64_t due, std::function<void()> wake) {
    const std::lock_guard<std::mutex> lock(mutex_);
    sleepers_.emplace(++sleeper_, Sleeper{due, std::move(wake)});
    return sleeper_;
  }
  void forget_sleeper(std::size_t sleeper) {
    const std::lock_guard<std::mutex> lock(mutex_);
    sleepers_.erase(sleeper);
  }

  std::size_t before_shut_down(std::function<void()> callback) {
    const std::lock_guard<std::recursive_mutex> lock(context_mutex_);
    last_calls_.emplace(++last_call_, std::move(callback));
    return last_call_;
  }
  bool forget_before_shut_down(std::size_t callback) {
    const std::lock_guard<std::recursive_mutex> lock(context_mutex_);
    return last_calls_.erase(callback) > 0;
  }

  void set(const std::shared_ptr<Alarm>& alarm, int64_t period) {
    const std::lock_guard<std::mutex> lock(mutex_);
    alarm->period = period;
    alarm->due = now_ + period;
    alarms_.push_back(alarm);
  }

  /// Has something happen at a time that no node does.
  void act_at(int64_t due, std::function<void()> act) {
    const std::lock_guard<std::mutex> lock(mutex_);
    acts_.emplace(due, std::move(act));
  }

  /// When the next timer is due or thread to be woken; -1 when there is none.
  int64_t next() {
    const std::lock_guard<std::mutex> lock(mutex_);
    forget();
    int64_t first = -1;
    for (const auto& weak : alarms_) {
      const auto alarm = weak.lock();
      if (alarm && (first < 0 || alarm->due < first)) first = alarm->due;
    }
    for (const auto& entry : sleepers_) {
      if (first < 0 || entry.second.due < first) first = entry.second.due;
    }
    if (!acts_.empty() && (first < 0 || acts_.begin()->first < first)) {
      first = acts_.begin()->first;
    }
    return is_simulated() ? std::min(first, now_ + step_) : std::max(first, first < 0 ? first : now_.load());
  }

  /// Sets the clock and rings what is due.
  void advance(int64_t time) {
    {
      const std::lock_guard<std::recursive_mutex> lock(clock_mutex_);
      now_ = time;
      for (const auto& entry : jumps_) {
        if (is_simulated()) entry.second();
      }
    }
    for (const auto& act : due_acts(time)) act();
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& entry : sleepers_) {
      if (entry.second.due <= time) entry.second.wake();
    }
    for (const auto& weak : alarms_) {
      const auto alarm = weak.lock();
      if (!alarm || alarm->cancelled || alarm->due > time) continue;
      alarm->due = std::max(alarm->due + alarm->period, time + 1);
      alarm->executor->post([alarm] { alarm->ring(); });
    }
  }

  /// How many writers have written to a topic.
  std::size_t written(const std::string& topic) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return written_[topic].size();
  }

  void log(const std::string& level, const std::string& node, const std::string& text) {
    record("log", level + "\t" + node + "\t" + text);
  }

  /// One line of the recording: its kind, the time on the clock, and what happened.
  void record(const std::string& kind, const std::string& rest) {
    const std::lock_guard<std::mutex> lock(recording_);
    std::cout << kind << '\t' << now_ << '\t' << rest << std::endl;
  }

  bool is_shut_down() const { return shut_down_; }
  void shut_down() {
    {
      const std::lock_guard<std::recursive_mutex> lock(context_mutex_);
      if (shut_down_) return;
      const auto calls = last_calls_;
      for (const auto& entry : calls) {
        if (last_calls_.count(entry.first) > 0) entry.second();
      }
      shut_down_ = true;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& weak : executors_) {
      if (const auto executor = weak.lock()) executor->wake();
    }
  }

  void add(const std::shared_ptr<Executor>& executor) {
    const std::lock_guard<std::mutex> lock(mutex_);
    executors_.push_back(executor);
  }

 private:
  std::vector<std::function<void()>> due_acts(int64_t time) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<std::function<void()>> found;
    const auto end = acts_.upper_bound(time);
    for (auto it = acts_.begin(); it != end; ++it) found.push_back(it->second);
    acts_.erase(acts_.begin(), end);
    return found;
  }

  void forget() {
    const auto gone = [](const std::weak_ptr<Alarm>& weak) {
      const auto alarm = weak.lock();
      return !alarm || alarm->cancelled;
    };
    alarms_.erase(std::remove_if(alarms_.begin(), alarms_.end(), gone), alarms_.end());
  }

  static std::size_t kept(const QoS& qos) {
    return qos.history() == HistoryPolicy::KeepAll ? SIZE_MAX : qos.depth();
  }

  static void deliver(const std::shared_ptr<Reader>& reader, const Data& data) {
    if (reader->waiting >= kept(reader->qos)) return;
    ++reader->waiting;
    const std::weak_ptr<Reader> weak = reader;
    reader->executor->post([weak, data] {
      const auto held = weak.lock();
      if (!held) return;
      --held->waiting;
      held->take(data);
    });
  }

  struct Sleeper {
    int64_t due;
    std::function<void()> wake;
  };

  std::mutex mutex_;
  std::mutex recording_;
  std::recursive_mutex clock_mutex_;
  std::map<std::size_t, std::function<void()>> jumps_;
  std::size_t jump_ = 0;
  int64_t step_ = 0;
  std::map<std::size_t, Sleeper> sleepers_;
  std::size_t sleeper_ = 0;
  std::multimap<int64_t, std::function<void()>> acts_;
  std::recursive_mutex context_mutex_;
  std::map<std::size_t, std::function<void()>> last_calls_;
  std::size_t last_call_ = 0;
  std::map<std::string, std::vector<std::weak_ptr<Reader>>> readers_;
  std::map<std::string, std::vector<std::weak_ptr<Writer>>> writers_;
  std::vector<std::weak_ptr<Alarm>> alarms_;
  std::vector<std::weak_ptr<Executor>> executors_;
  std::map<std::string, std::set<const Writer*>> written_;
  std::atomic<int64_t> now_{100000000000};  // the clock has run for a while
  std::atomic<bool> shut_down_{false};
};

inline Middleware& middleware() {
  static Middleware* const the_only_one = new Middleware();  // outlives every thread
  return *the_only_one;
}

class Writer {
 public:
  Writer(std::string topic, const QoS& qos) : topic_(std::move(topic)), qos_(qos) {}

  void write(const Data& data, const std::string& text) { middleware().write(*this, data, text); }
  const std::string& topic() const { return topic_; }
  std::size_t matched() const {
    std::size_t count = 0;
    for (const auto& reader : middleware().readers(topic_)) count += match(qos_, reader->qos);
    return count;
  }

 private:
  friend class Middleware;
  const std::string topic_;
  const QoS qos_;
  std::deque<Data> kept_;
};

inline void Middleware::add(const std::shared_ptr<Reader>& reader) {
  const std::lock_guard<std::mutex> lock(mutex_);
  readers_[reader->topic].push_back(reader);
  if (reader->qos.durability() != DurabilityPolicy::TransientLocal) return;
  for (const auto& weak : writers_[reader->topic]) {
    const auto writer = weak.lock();
    if (!writer || !match(writer->qos_, reader->qos)) continue;
    for (const Data& data : writer->kept_) deliver(reader, data);
  }
}

inline std::shared_ptr<Writer> Middleware::writer(const std::string& topic, const QoS& qos) {
  const auto writer = std::make_shared<Writer>(topic, qos);
  const std::lock_guard<std::mutex> lock(mutex_);
  writers_[topic].push_back(writer);
  return writer;
}

inline std::vector<std::shared_ptr<Reader>> Middleware::readers(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::shared_ptr<Reader>> found;
  for (const auto& weak : readers_[topic]) {
    if (auto reader = weak.lock()) found.push_back(std::move(reader));
  }
  return found;
}

inline void Middleware::write(Writer& writer, const Data& data, const std::string& text) {
  if (shut_down_) return;  // nobody hears what is sent without a context
  const std::lock_guard<std::mutex> lock(mutex_);
  record("message", writer.topic_ + "\t" + text);
  written_[writer.topic_].insert(&writer);
  if (writer.qos_.durability() == DurabilityPolicy::TransientLocal) {
    writer.kept_.push_back(data);
    if (writer.kept_.size() > kept(writer.qos_)) writer.kept_.pop_front();
  }
  for (const auto& weak : readers_[writer.topic_]) {
    const auto reader = weak.lock();
    if (reader && match(writer.qos_, reader->qos)) deliver(reader, data);
  }
}

}  // namespace rclcpp::fake
