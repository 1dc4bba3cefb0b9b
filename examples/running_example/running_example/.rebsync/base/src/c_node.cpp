#include "running_example/c.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "c");
  const ros::NodeHandle node("~");
  running_example::C rebec(node, node.param("x1", 0), node.param("y1", 0), node.param("x2", 0),
      node.param("y2", 0));
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
