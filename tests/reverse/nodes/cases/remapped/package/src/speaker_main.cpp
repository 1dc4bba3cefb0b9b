#include "speaker.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "speaker");
  voices::Speaker speaker;
  ros::spin();
}
