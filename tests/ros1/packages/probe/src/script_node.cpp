#include <ros/ros.h>

#include "probe/script.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "script");
  const ros::NodeHandle node("~");
  probe::Script rebec(node);
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.start();
  ros::waitForShutdown();
  rebec.stop();
  return 0;
}
