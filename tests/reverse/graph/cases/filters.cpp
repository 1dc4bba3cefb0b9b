// Message filters that are local objects, by names that a file uses, and one behind another.
#include <message_filters/subscriber.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/time_synchronizer.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/message_filter.h>
using namespace message_filters;
typedef sync_policies::ApproximateTime<sensor_msgs::Image, sensor_msgs::Image> Near;

class Transformed {
 public:
  explicit Transformed(tf2_ros::Buffer& buffer) {
    scans_ = new Subscriber<sensor_msgs::LaserScan>(n_, "scan", 100);  //= subscription "scan" "sensor_msgs/LaserScan" 100 -> Transformed::scan
    filter_ = new tf2_ros::MessageFilter<sensor_msgs::LaserScan>(*scans_, buffer, "odom", 100, n_);
    filter_->registerCallback(&Transformed::scan, this);
  }
  void scan(const sensor_msgs::LaserScanConstPtr& scan) {}

 private:
  ros::NodeHandle n_;
  Subscriber<sensor_msgs::LaserScan>* scans_;
  tf2_ros::MessageFilter<sensor_msgs::LaserScan>* filter_;
};

void seen(const sensor_msgs::ImageConstPtr& image, const sensor_msgs::CameraInfoConstPtr& info) {}
void both(const sensor_msgs::ImageConstPtr& left, const sensor_msgs::ImageConstPtr& right) {}

int main(int argc, char** argv) {
  ros::init(argc, argv, "filters");  //= node "filters"
  ros::NodeHandle n;
  message_filters::Subscriber<sensor_msgs::Image> image(n, "image", 1);  //= subscription "image" "sensor_msgs/Image" 1 -> seen
  message_filters::Subscriber<sensor_msgs::CameraInfo> info(n, "info", 2);  //= subscription "info" "sensor_msgs/CameraInfo" 2 -> seen
  TimeSynchronizer<sensor_msgs::Image, sensor_msgs::CameraInfo> exact(image, info, 10);
  exact.registerCallback(boost::bind(&seen, _1, _2));
  Subscriber<sensor_msgs::Image> left(n, "left", 3);  //= subscription "left" "sensor_msgs/Image" 3 -> both
  Subscriber<sensor_msgs::Image> right(n, "right", 4);  //= subscription "right" "sensor_msgs/Image" 4 -> both
  Synchronizer<Near> near(Near(10), left, right);
  near.registerCallback(&both);
  ros::spin();
}
