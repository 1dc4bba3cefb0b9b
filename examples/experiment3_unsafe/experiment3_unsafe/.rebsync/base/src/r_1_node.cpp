#include "experiment3_unsafe/r_1.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "r_1");
  const ros::NodeHandle node("~");
  experiment3_unsafe::R_1 rebec(node);
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
