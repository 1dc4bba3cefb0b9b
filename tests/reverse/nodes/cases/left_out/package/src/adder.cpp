#include "adder.h"

static int half(int value, int divisor = 2) { return value / divisor; }

Adder::Adder() {
  in_ = nh_.subscribe("total", 10, &Adder::take, this);
  out_ = nh_.advertise<std_msgs::Int32>("total", 10);
}

void Adder::add(int amount, int times, bool wrap) {
  total_ += amount * times;
  if (wrap && total_ > 100) total_ = 0;
}

int Adder::scaled(int value, int by) { return value * by; }

void Adder::narrow(int value, uint8_t least) {
  least += 1;
  if (value > least) total_ = least;
}

void Adder::send(int value, const std_msgs::Int32& other) {
  std_msgs::Int32 m = other;
  m.data += value;
  out_.publish(m);
}

void Adder::at_limit(int value, int limit) {
  if (value > limit) total_ = limit;
}

void Adder::take(const std_msgs::Int32& msg) {
  add(msg.data);
  add(msg.data, 3);
  add(msg.data, 3, true);
  total_ = scaled(total_) + half(total_);
  narrow(total_);
  narrow(total_, 5);
  send(total_, msg);
  send(total_);
  at_limit(total_);
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "adder");
  Adder adder;
  ros::spin();
  return 0;
}
