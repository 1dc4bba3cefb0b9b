// Objects whose classes send or get transforms, and ends of actions; what makes no object says nothing.
#include <rclcpp/rclcpp.hpp>
#include <tf2_ros/transform_broadcaster.h>

class Arm : public rclcpp::Node {
 public:
  Arm() : Node("arm"), own_(this) {
    listener_ = std::make_shared<tf2_ros::TransformListener>(*buffer_);  //= Arm listener listener_
    fixed_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>(this);  //= Arm static broadcaster fixed_
    other_.reset(new tf2_ros::TransformListener(*buffer_));  //= Arm listener other_
    go_ = rclcpp_action::create_client<demo::action::Go>(this, "go");  //= Arm action client go_ "go" "demo/Go"
  }
  void use(tf2_ros::TransformBroadcaster& given, std::shared_ptr<tf2_ros::TransformListener> held) {
    static tf2_ros::TransformBroadcaster here(this);  //= Arm broadcaster here
  }

 private:
  tf2_ros::TransformBroadcaster own_;  //= Arm broadcaster own_
  tf2_ros::TransformBroadcaster* kept_;
  std::shared_ptr<tf2_ros::TransformListener> listener_;
  strange::TransformListener no_;
};
