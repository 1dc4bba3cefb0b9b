#include "warehouse/dispatcher.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "dispatcher");
  const ros::NodeHandle node("~");
  warehouse::Dispatcher rebec(node, node.param("cell1", 0), node.param("cell2", 0),
      node.param("cell3", 0), node.param("cell4", 0));
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
