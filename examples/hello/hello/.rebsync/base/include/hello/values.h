// Copyright 2026 The rebsync authors
//
// Licensed under the Apache License, Version 2.0 (the "License");
// you may not use this file except in compliance with the License.
// You may obtain a copy of the License at
//
//     http://www.apache.org/licenses/LICENSE-2.0
//
// Unless required by applicable law or agreed to in writing, software
// distributed under the License is distributed on an "AS IS" BASIS,
// WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
// See the License for the specific language governing permissions and
// limitations under the License.

// What the bodies of the model work with: its arithmetic, its violations, the times of its sends.
#ifndef HELLO_VALUES_H
#define HELLO_VALUES_H

#include <array>
#include <boost/optional.hpp>
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "hello/Timing.h"

namespace hello {

constexpr int64_t kNever = std::numeric_limits<int64_t>::max();
constexpr int kNoPriority = INT_MAX;

/// The priority of a server among those of its rebec, or among those of all rebecs.
constexpr int priority(int number) { return number; }
constexpr int globalPriority(int number) { return number; }

/// A message server: its name in the model and its priority, the lower number first.
struct Server {
  const char* name;
  int priority;
};

/// A rebec of a class, by the name of its node.
template <class Class>
using Rebec = std::string;

/// A rule of the model that a body breaks: it is reported and the body is abandoned.
class Violation : public std::runtime_error {
 public:
  Violation(std::string kind, const std::string& facts)
      : std::runtime_error(facts), kind_(std::move(kind)) {}

  const std::string& kind() const { return kind_; }

 private:
  std::string kind_;
};

/// When a message arrives and expires, counted from the moment it is sent.
class When {
 public:
  When& after(int32_t time) {
    after_ = time;
    return *this;
  }

  When& deadline(int32_t time) {
    deadline_ = time;
    return *this;
  }

  Timing from(int64_t now) const {
    if (after_ < 0) throw Violation("time", "after " + std::to_string(after_));
    Timing timing;
    timing.arrival = now + after_;
    timing.deadline = deadline_ ? now + *deadline_ : kNever;
    timing.stamped = true;
    return timing;
  }

 private:
  int32_t after_ = 0;
  boost::optional<int32_t> deadline_;
};

inline When after(int32_t time) { return When().after(time); }
inline When deadline(int32_t time) { return When().deadline(time); }

/// Marks a wider value that the model stores in a narrower variable.
template <class T, class Wide>
constexpr T narrow(Wide value) {
  return static_cast<T>(value);
}

/// Marks a narrower value that the model takes as one of a wider type.
template <class T, class Narrow>
constexpr T widen(Narrow value) {
  return static_cast<T>(value);
}

namespace detail {

template <class T>
T divide(T a, T b, std::true_type /* integral */) {
  if (b == 0) throw Violation("division", std::to_string(a) + " / 0");
  using Wrapping = std::make_unsigned_t<T>;
  return b == -1 ? static_cast<T>(Wrapping{0} - static_cast<Wrapping>(a)) : a / b;
}

template <class T>
T divide(T a, T b, std::false_type /* integral */) {
  return a / b;
}

template <class T>
T remainder(T a, T b, std::true_type /* integral */) {
  if (b == 0) throw Violation("division", std::to_string(a) + " % 0");
  return b == -1 ? 0 : a % b;
}

template <class T>
T remainder(T a, T b, std::false_type /* integral */) {
  return std::fmod(a, b);
}

inline void print(std::ostream& out, bool value) { out << (value ? "true" : "false"); }
inline void print(std::ostream& out, uint8_t value) { print(out, value != 0); }  // ROS's bool
inline void print(std::ostream& out, int8_t value) { out << static_cast<int>(value); }
inline void print(std::ostream& out, const std::string& value) { out << value; }

template <class T>
void print(std::ostream& out, T value) {
  out << value;
}

template <class T, std::size_t size>
void print(std::ostream& out, const std::array<T, size>& values) {
  const char* before = "[";
  for (const T& value : values) {
    out << before;
    print(out, value);
    before = ", ";
  }
  out << ']';
}

inline void printAll(std::ostream& /* out */, const char* /* before */) {}

template <class T, class... Rest>
void printAll(std::ostream& out, const char* before, const T& value, const Rest&... rest) {
  out << before;
  print(out, value);
  printAll(out, ", ", rest...);
}

}  // namespace detail

/// Division of the model: it truncates and wraps; an integer divisor of zero is a violation.
template <class A, class B>
auto divide(A a, B b) {
  using Result = decltype(a / b);
  return detail::divide<Result>(a, b, std::is_integral<Result>());
}

template <class A, class B>
auto remainder(A a, B b) {
  using Result = decltype(a + b);
  return detail::remainder<Result>(a, b, std::is_integral<Result>());
}

/// The compound forms of the two.
template <class A, class B>
A& divideBy(A& target, B value) {
  return target = narrow<A>(divide(target, value));
}

template <class A, class B>
A& remainderBy(A& target, B value) {
  return target = narrow<A>(remainder(target, value));
}

/// Shifts of the model: only the lowest five bits of the distance count.
inline int32_t shiftLeft(int32_t value, int32_t distance) { return value << (distance & 31); }
inline int32_t shiftRight(int32_t value, int32_t distance) { return value >> (distance & 31); }

template <class A>
A& shiftLeftBy(A& target, int32_t distance) {
  return target = narrow<A>(shiftLeft(target, distance));
}

template <class A>
A& shiftRightBy(A& target, int32_t distance) {
  return target = narrow<A>(shiftRight(target, distance));
}

/// Marks what the model declares or computes and does not use.
template <class... Values>
void unused(const Values&... /* values */) {}

/// No rebec.
constexpr char kNull[] = "";

/// A rebec taken as one of the class T; rebecs are known by their names.
template <class T>
const std::string& as(const std::string& rebec) {
  return rebec;
}

namespace detail {

template <class T, class Put>
void visit(T& value, Put put) {
  put(value);
}

template <class T, std::size_t size, class Put>
void visit(std::array<T, size>& values, Put put) {
  for (T& value : values) visit(value, put);
}

template <class T, std::size_t size, class Put>
void visit(const std::array<T, size>& values, Put put) {
  for (const T& value : values) visit(value, put);
}

}  // namespace detail

/// Stores an array of the model, of any number of dimensions, in the flat array of a message.
template <class T, std::size_t size, class Flat>
void flatten(const std::array<T, size>& values, Flat& flat) {
  std::size_t next = 0;
  detail::visit(values, [&](const auto& value) { flat[next++] = value; });
}

/// The array of the model that a flat one stands for.
template <class Array, class Flat>
Array unflatten(const Flat& flat) {
  Array values{};
  std::size_t next = 0;
  detail::visit(values, [&](auto& value) {
    value = static_cast<std::decay_t<decltype(value)>>(flat[next++]);
  });
  return values;
}

/// The arguments of a message as text: `1, true, [0, 2]`.
template <class... Values>
std::string text(const Values&... values) {
  std::ostringstream out;
  detail::printAll(out, "", values...);
  return out.str();
}

}  // namespace hello

#endif  // HELLO_VALUES_H
