// Prints what the arithmetic of values.h makes of a few operands, one `expression = value` a line.
#include <array>
#include <boost/array.hpp>
#include <cstdint>
#include <iostream>
#include <string>

#include "probe/values.h"

namespace {

template <class Value>
void show(const std::string& expression, const Value& value) {
  std::cout << expression << " = " << probe::text(value) << '\n';
}

template <class Compute>
void showViolation(const std::string& expression, Compute compute) {
  try {
    compute();
    show(expression, std::string("no violation"));
  } catch (const probe::Violation& violation) {
    show(expression, violation.kind() + " " + violation.what());
  }
}

void showArrays() {
  const std::array<std::array<bool, 2>, 2> flags{{{{true, false}}, {{false, true}}}};
  boost::array<uint8_t, 4> field;
  probe::flatten(flags, field);
  show("flatten", std::array<uint8_t, 4>{{field[0], field[1], field[2], field[3]}});
  show("unflatten", probe::unflatten<std::array<std::array<bool, 2>, 2>>(field));
}

void showStores() {
  int8_t byte = -128;
  probe::divideBy(byte, -1);
  show("byte -128 /= -1", byte);
  int16_t rest = 1000;
  probe::remainderBy(rest, 300);
  show("short 1000 %= 300", rest);
}

}  // namespace

int main() {
  using probe::divide;
  using probe::narrow;
  using probe::remainder;
  show("7 / -2", divide(7, -2));
  show("7 % -2", remainder(7, -2));
  show("-7 % 2", remainder(-7, 2));
  show("min / -1", divide(INT32_MIN, -1));
  show("min % -1", remainder(INT32_MIN, -1));
  show("byte -128 / -1", divide(int8_t{-128}, int8_t{-1}));
  show("short 9 % 4", remainder(int16_t{9}, int16_t{4}));
  show("7.0 / 2", divide(7.0, 2));
  show("7.5 % 2", remainder(7.5, 2));
  show("1.0 / 0", divide(1.0, 0));
  show("byte 200", narrow<int8_t>(200));
  show("short 40000", narrow<int16_t>(40000));
  showArrays();
  showStores();
  showViolation("1 / 0", [] { divide(1, 0); });
  showViolation("1 % 0", [] { remainder(1, 0); });
  showViolation("after(-1)", [] { probe::after(-1).from(3); });
  const probe::Timing timing = probe::after(2).deadline(5).from(3);
  show("after(2).deadline(5) at 3", probe::text(timing.arrival, timing.deadline));
  show("no deadline",
       probe::deadline(1).from(0).deadline == 1 && probe::When().from(0).deadline == probe::kNever);
  std::cout << "text = "
            << probe::text(1, true, int8_t{-3}, 0.1, std::array<bool, 2>{{true, false}},
                           std::array<std::array<int8_t, 2>, 1>{{{1, 2}}}, std::string("r"))
            << '\n';
}
