#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Int32.h>
#include <std_msgs/UInt16.h>
#include <std_msgs/UInt8.h>
#include <widths/Packed.h>

static std_msgs::UInt8 octet(int value) {
  std_msgs::UInt8 m;
  m.data = value;
  return m;
}

struct Sums {
  uint8_t low = 250;
  int64_t high = 0;
};

class Packer {
 public:
  Packer() {
    in_ = nh_.subscribe("number", 10, &Packer::number, this);
    kept_in_ = nh_.subscribe("octet", 10, &Packer::octets, this);
    packed_in_ = nh_.subscribe("packed", 10, &Packer::packed, this);
    truth_in_ = nh_.subscribe("truth", 10, &Packer::truth, this);
    word_in_ = nh_.subscribe("word", 10, &Packer::word, this);
    octet_ = nh_.advertise<std_msgs::UInt8>("octet", 10);
    word_ = nh_.advertise<std_msgs::UInt16>("word", 10);
    truth_ = nh_.advertise<std_msgs::Bool>("truth", 10);
    packed_ = nh_.advertise<widths::Packed>("packed", 10);
  }

 private:
  void number(const std_msgs::Int32::ConstPtr& msg) {
    const int k = msg->data;
    std_msgs::UInt8 m;
    m.data = k;
    octet_.publish(m);
    m.data += 300;
    octet_.publish(m);
    m.data = 300;
    octet_.publish(m);
    m.data = 44;
    m.data++;
    octet_.publish(m);
    octet_.publish(octet(k));
    std_msgs::UInt16 w;
    w.data = -k;
    word_.publish(w);
    w.data = m.data;
    word_.publish(w);
    std_msgs::Bool t;
    t.data = k > 3;
    truth_.publish(t);
    t.data = k > 3 ? 1 : 0;
    t.data |= on_;
    truth_.publish(t);
    t.data = k;
    truth_.publish(t);
    widths::Packed p;
    p.low = k;
    p.high = k;
    p.valid = true;
    p.total = k;
    p.ratio = 0.1;
    p.ratio = level_ / 3;
    p.valid++;
    packed_.publish(p);
  }
  void octets(const std_msgs::UInt8& msg) {
    last_ = msg;
    if (msg.data > 200) last_.data = total_;
    last_.data -= 1;
    total_ = msg.data + 1;
    sums_.low += msg.data;
    sums_.high += wide_[sums_.low % 2];
  }
  void word(const std_msgs::UInt16& msg) { last_.data = msg.data; }
  void truth(const std_msgs::BoolConstPtr& msg) {
    on_ = msg->data;
    last_.data = msg->data;
    total_ = msg->data == 2 ? 1 : 2;
  }
  void packed(const widths::Packed& msg) {
    kept_ = msg;
    kept_.low = kept_.high;
    kept_.valid = !kept_.valid;
    kept_.ratio += 0.5;
    if (kept_.low > 9 && kept_.valid && kept_.ratio > 1) total_ = msg.total;
  }

  ros::NodeHandle nh_;
  ros::Subscriber in_, kept_in_, packed_in_, truth_in_, word_in_;
  ros::Publisher octet_, word_, truth_, packed_;
  std_msgs::UInt8 last_;
  widths::Packed kept_;
  Sums sums_;
  uint32_t wide_[2] = {1, 2};
  int total_ = 0;
  double level_ = 0.0;
  bool on_ = false;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "packer");
  Packer packer;
  ros::spin();
  return 0;
}
