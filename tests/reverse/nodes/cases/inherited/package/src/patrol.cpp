#include "behaviours.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "patrol");
  Patrol patrol;
  ros::spin();
}
