#include <rclcpp/rclcpp.hpp>
#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;
using namespace std::chrono_literals;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
    declare_parameter("gain", 3);
    handle_ = add_on_set_parameters_callback(std::bind(&N::changed, this, std::placeholders::_1));
  }

 private:
  rcl_interfaces::msg::SetParametersResult changed(const std::vector<rclcpp::Parameter>& all) {
    for (const auto& p : all) {
      if (p.get_name() == "gain") x_ = p.as_int();
    }
    rcl_interfaces::msg::SetParametersResult result;
    result.successful = true;
    return result;
  }

  void cb(const Int32&) {
    set_parameter(rclcpp::Parameter("gain", 8));
    put(x_);
  }

  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  rclcpp::node_interfaces::OnSetParametersCallbackHandle::SharedPtr handle_;
  int x_ = 0;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
