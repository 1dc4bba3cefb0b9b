#include "warehouse/carrier.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "carrier");
  const ros::NodeHandle node("~");
  warehouse::Carrier rebec(node, node.param("number", 0), node.param("start", 0),
      node.param("load_bay", 0));
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
