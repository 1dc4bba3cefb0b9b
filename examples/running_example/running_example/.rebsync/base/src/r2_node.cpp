#include "running_example/r2.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "r2");
  const ros::NodeHandle node("~");
  running_example::R2 rebec(node, node.param("robot_id", 0), node.param("init_x", 0),
      node.param("init_y", 0));
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
