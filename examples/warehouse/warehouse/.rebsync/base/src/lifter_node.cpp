#include "warehouse/lifter.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "lifter");
  const ros::NodeHandle node("~");
  warehouse::Lifter rebec(node, node.param("start", 0));
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
