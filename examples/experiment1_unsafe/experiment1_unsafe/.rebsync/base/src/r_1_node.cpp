#include "experiment1_unsafe/r_1.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "r_1");
  const ros::NodeHandle node("~");
  experiment1_unsafe::R_1 rebec(node, node.param("fuel_capacity_initial", 0),
      node.param("fuel_per_step_initial", 0));
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
