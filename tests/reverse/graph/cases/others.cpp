// Options, images, message filters, and what only looks like a call of ROS.
#include <geometry_msgs/PointStamped.h>
#include <image_transport/image_transport.h>
#include <image_transport/subscriber_filter.h>
#include <message_filters/subscriber.h>
#include <message_filters/synchronizer.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/String.h>
#include <std_srvs/Trigger.h>
namespace gm = geometry_msgs;

class Filters {
 public:
  explicit Filters(ros::NodeHandle n)
      : a_(n, "a", 3),  //= subscription .../a "sensor_msgs/CameraInfo" 3 -> Filters::both
        sync_(Policy(10), a_, b_) {
    b_.subscribe(n, "b", 4);  //= subscription .../b "sensor_msgs/CameraInfo" 4 -> Filters::both
    sync_.registerCallback(boost::bind(&Filters::both, this, _1, _2));
    alone_ = new message_filters::Subscriber<gm::PointStamped>(n, "c", 5);  //= subscription .../c "geometry_msgs/PointStamped" 5 -> Filters::point
    alone_->registerCallback(&Filters::point, this);
  }
  void both(const sensor_msgs::CameraInfoConstPtr& a, const sensor_msgs::CameraInfoConstPtr& b) {}
  void point(const gm::PointStamped::ConstPtr& p) {}

 private:
  message_filters::Subscriber<sensor_msgs::CameraInfo> a_, b_;
  message_filters::Subscriber<gm::PointStamped>* alone_;
  message_filters::Synchronizer<Policy> sync_;
};

class Images {
 public:
  explicit Images(ros::NodeHandle& n) : it_(n) {
    it_.subscribe("image", 1, &Images::seen, this);  //= subscription "~image" "sensor_msgs/Image" 1 -> Images::seen image_transport
    pub_ = it_.advertise("out", 2, true);  //= publisher "~out" "sensor_msgs/Image" 2 latched=true image_transport
    camera_ = it_.subscribeCamera("camera", 3, &Images::camera, this);  //= subscription "~camera" "sensor_msgs/Image" 3 -> Images::camera image_transport
  }
  void seen(const sensor_msgs::ImageConstPtr& image) {}
  void camera(const sensor_msgs::ImageConstPtr& i, const sensor_msgs::CameraInfoConstPtr& c) {}

 private:
  image_transport::ImageTransport it_;
};

bool serve(std_srvs::Trigger::Request& q, std_srvs::Trigger::Response& a) { return true; }
void heard(const std_msgs::String::ConstPtr& m) {}

struct Shop {
  int subscribe(const char* paper, int count) { return count; }
  int param(const char* name, int& value, int other) { return other; }
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "others");  //= node "others"
  ros::NodeHandle n("~");
  Images images(n);
  Shop shop;
  int value;
  shop.subscribe("daily", 2);
  shop.param("a", value, 3);
  ros::AdvertiseOptions options = ros::AdvertiseOptions::create<std_msgs::String>("d", 6, onConnect, onLeave, ros::VoidPtr(), NULL);
  options.latch = true;
  n.advertise(options);  //= publisher "~d" "std_msgs/String" 6 latched=true
  ros::SubscribeOptions listen;
  listen.init<std_msgs::String>("e", 7, heard);
  n.subscribe(listen);  //= subscription "~e" "std_msgs/String" 7 -> heard
  n.subscribe(ros::SubscribeOptions::create<std_msgs::String>("f", 8, heard, ros::VoidPtr(), NULL));  //= subscription "~f" "std_msgs/String" 8 -> heard
  n.advertiseService("g", serve);  //= service "~g" "std_srvs/Trigger" -> serve
  n.advertise<std_msgs::String>("h", 1, onConnect);  //= publisher "~h" "std_msgs/String" 1
  n.advertise<std_msgs::String>("i", 1, onConnect, onLeave, ros::VoidPtr(), true);  //= publisher "~i" "std_msgs/String" 1 latched=true
  auto l = topics["x"];
  n.advertise<std_msgs::String>(l, 1);  //= publisher ? "~*" "std_msgs/String" 1
#if 0
  n.advertise<std_msgs::String>("never", 1);
#else
  n.advertise<std_msgs::String>("always", 1);  //= publisher "~always" "std_msgs/String" 1
#endif
  // n.advertise<std_msgs::String>("comment", 1);
  const char* text = "n.advertise<std_msgs::String>(1, 1)";
}
