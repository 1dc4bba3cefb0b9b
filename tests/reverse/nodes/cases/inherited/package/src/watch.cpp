#include "behaviours.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "watch");
  auto watch = std::make_shared<Watch>();
  ros::spin();
}
