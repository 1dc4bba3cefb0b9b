#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
#include <std_srvs/srv/set_bool.hpp>

using std_msgs::msg::Int32;

using std_srvs::srv::SetBool;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
    service_ = create_service<SetBool>("switch",
        std::bind(&N::serve, this, std::placeholders::_1, std::placeholders::_2));
    client_ = create_client<SetBool>("switch");
  }

 private:
  void serve(const SetBool::Request::SharedPtr request, SetBool::Response::SharedPtr response) {
    x_ = request->data ? 30 : 40;
    response->success = true;
  }

  void cb(const Int32&) {
    auto request = std::make_shared<SetBool::Request>();
    request->data = true;
    client_->async_send_request(request, [this](rclcpp::Client<SetBool>::SharedFuture future) {
      if (future.get()->success) put(x_);
    });
  }

  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  rclcpp::Service<SetBool>::SharedPtr service_;
  rclcpp::Client<SetBool>::SharedPtr client_;
  int x_ = 0;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
