// Declared here, defined elsewhere; the defaults of arguments and members are here.
#pragma once
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/Float64.h>
#include <string>

namespace robot {
class Base {
 public:
  explicit Base(ros::NodeHandle n, std::string prefix = "base");
  virtual ~Base() = default;
  virtual void setUp(const std::string& name) = 0;
  void start() { setUp(prefix_ + "/set_up"); }

 protected:
  ros::NodeHandle n_;
  std::string prefix_;
  std::string frame_ = "odom";
  int depth_{5};
};

class ROBOT_EXPORT Driver : public Base {
 public:
  explicit Driver(ros::NodeHandle n);
  void setUp(const std::string& name) override;
  void stop(bool hard = false);

  class Part {
   public:
    Part(Driver& driver, const std::string& name);
    ros::Publisher pub_;
  };

 private:
  void imu(const sensor_msgs::Imu& message);
  ros::Subscriber sub_;
  Part left_, right_;
};

class Nodelet : public nodelet::Nodelet {
 public:
  void onInit() override;

 private:
  std::unique_ptr<Driver> driver_;
  ros::NodeHandle nh_;
  ros::Timer timer_;
  void tick(const ros::TimerEvent& event);
};
}  // namespace robot
