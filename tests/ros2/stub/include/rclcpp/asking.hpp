// Clients of services and actions: what the driver asks, and what it is told.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <rclcpp/middleware.hpp>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

namespace rclcpp::fake {

using Fields = std::map<std::string, std::string>;

/// A request, a goal, or the wish to cancel all goals.
struct Ask {
  std::string id;
  std::string name;
  bool cancels = false;
  Fields fields;
};

/// Has the client of an ask hear of it.
inline void tell(const Ask& ask, const std::string& state, const std::string& fields = "{}") {
  if (middleware().is_shut_down()) fail(ask.name + " tells '" + state + "' without a context");
  middleware().record("answer", ask.id + "\t" + state + "\t" + fields);
}

template <class M>
std::string yaml(const M& message) {
  std::ostringstream text;
  to_flow_style_yaml(message, text);
  return text.str();
}

/// A field from its text.
template <class T>
T value(const std::string& text) {
  if constexpr (std::is_same_v<T, bool>) {
    return text == "true";
  } else {
    return static_cast<T>(std::stod(text));
  }
}

template <class M, class = void>
struct IsRead : std::false_type {};

template <class M>
struct IsRead<M, std::void_t<decltype(fake_read(std::declval<M&>(), Fields()))>> : std::true_type {
};

/// A request or goal from its texts; programs that ask have a `fake_read` for it.
template <class M>
std::shared_ptr<M> read(const Fields& fields) {
  const auto message = std::make_shared<M>();
  if constexpr (IsRead<M>::value) {
    fake_read(*message, fields);
  } else {
    if (!fields.empty()) fail("nobody reads what is asked");
  }
  return message;
}

/// What is offered in the process, by name: the last one to come.
class Offers {
 public:
  void add(const std::string& name, const std::weak_ptr<void>& offer,
      std::function<void(const Ask&)> take) {
    const std::lock_guard<std::mutex> lock(mutex_);
    offers_[name] = {offer, std::move(take)};
  }

  void ask(const Ask& ask) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = offers_.find(ask.name);
    if (found == offers_.end() || found->second.first.expired()) return tell(ask, "nobody");
    found->second.second(ask);
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::pair<std::weak_ptr<void>, std::function<void(const Ask&)>>> offers_;
};

inline Offers& offers() {
  static Offers* const the_only_one = new Offers();
  return *the_only_one;
}

}  // namespace rclcpp::fake
