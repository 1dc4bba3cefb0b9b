#include <ros/ros.h>
#include <std_msgs/Int32.h>
#define LIMIT 5
#define MORE (LIMIT + 1)
#define BIT (1 << 3)
#define NEG -2
#define BOTH BIT | LIMIT
enum Flags { A = 1 << 0, B = 1 << 1, C = A | B, D = C + 1, E, F = -1, G = MORE, H = sizeof(int), I = (int)7, J = 'a' };
enum class Mode : uint8_t { X = 0x10, Y = X * 2, Z = ~0 & 0xF };
constexpr int kFirst = D * 2;
class Valve {
 public:
  Valve() { sub_ = nh_.subscribe("in", 10, &Valve::on, this); }
 private:
  void on(const std_msgs::Int32::ConstPtr& msg) {
    if (msg->data & B) count_ = C;
    if (msg->data == MORE) count_ = BIT;
    switch (msg->data) { case D: count_ = NEG; break; case E: count_ = kFirst; break; case G: count_ = BOTH * 2; break; }
    mode_ = Mode::Y;
    if (mode_ == Mode::Z) count_ = I + J;
    if (mask_ == 4294967295u) count_ = H;
  }
  ros::NodeHandle nh_;
  ros::Subscriber sub_;
  int count_ = LIMIT;
  unsigned mask_ = 0xFFFFFFFF;
  Mode mode_ = Mode::X;
};
int main(int argc, char** argv) {
  ros::init(argc, argv, "valve");
  Valve valve;
  ros::spin();
}
