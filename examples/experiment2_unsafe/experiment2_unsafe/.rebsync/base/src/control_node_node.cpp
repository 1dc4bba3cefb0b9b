#include "experiment2_unsafe/control_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "control_node");
  const ros::NodeHandle node("~");
  experiment2_unsafe::ControlNode rebec(node, node.param("r1x", 0), node.param("r1y", 0),
      node.param("r2x", 0), node.param("r2y", 0));
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
