#include <base_pkg/base.hpp>

class Robot : public base_pkg::Base {
 protected:
  void on_level(int level) override {
    if (level > 3) {
      count_ = 1;
      send(1);
    }
  }
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Robot>());
  rclcpp::shutdown();
}
